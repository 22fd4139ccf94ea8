// Stepped plate for the registration: pits for the needle's tip, a bead's hole below each from the
// underside. Origin in the middle of the underside, as in the fiducials' file.
include <common.scad>

module plate() {
    foot = 8;
    rim = 3;                                                 // of a tower above its pit's bottom
    wide = rim * (shaft_diameter / 2 / point_length + 0.3);  // a pit opens wider than the needle's point
    difference() {
        union() {
            layer(0, foot) difference() {
                square(96, center = true);
                for (x = [-42, 42], y = [-42, 42]) disc([x, y], 4.3);
            }
            for (one = fiducials) layer(0, one[0][2] + rim) disc(one[0], 14);
        }
        for (one = fiducials) {
            translate(one[0]) cylinder(r1 = 0, r2 = wide * 1.1, h = rim * 1.1);
            layer(-eps, one[1][2] + bead_diameter / 2) disc(one[1], bead_diameter + clearance);
        }
    }
}
plate();
