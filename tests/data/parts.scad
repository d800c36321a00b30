// For tests/real/gallery.txt: bodies in three colours, nothing cut.
color("orange") cube(20, center = true);
translate([0, 0, 18]) color("green") sphere(8, $fn = 48);
translate([20, 0, 0]) color("red") cylinder(h = 10, r = 5, $fn = 48);
