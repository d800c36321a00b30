// For tests/real/gallery.txt: bodies that openscad cuts before it draws them; without render() it cuts as it draws.
render() {
    difference() { cube(20, center = true); sphere(13, $fn = 48); }
    translate([32, 0, 0]) difference() {
        sphere(12, $fn = 48);
        cylinder(h = 40, r = 5, center = true, $fn = 32);
        translate([0, -30, 0]) cube(30);
    }
}
