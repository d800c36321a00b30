% For tests/real/gallery.txt: a surface in Octave's own plotting, by OpenGL in an FLTK window.
graphics_toolkit("fltk");
[x, y] = meshgrid(-2:0.2:2);
surf(x, y, x .* exp(-x .^ 2 - y .^ 2));
for turn = 1:60
  view(turn * 3, 30);
  drawnow;
  pause(0.2);
end
