// Head on a camera's post: holds the camera board upright, pitched to where the rig's camera looks.
// The board stands over the post's middle, at the height of the profile; x is where it looks.
include <common.scad>
camera = 0;

function elevation(k) = let (line = looks_at[k] - cameras[k])
    atan2(line[2], norm([line[0], line[1]]));
camera_middle = camera_holes / 2 + 4;                      // of the board's holes over the post's end

module camera_head(k) {
    layer(-20, -3) difference() {
        square(rail + 8, center = true);
        square(rail + clearance, center = true);
        square([2 * rail, 5.3], center = true);
    }
    layer(-3, 0) square([rail + 8, camera_holes + 10], center = true);
    translate([0, 0, camera_middle]) rotate([0, 90 - elevation(k), 0])
        layer(-2.5, 2.5) difference() {
            square(camera_holes + 10, center = true);
            circle(d = 18);
            for (x = [-1, 1], y = [-1, 1]) disc(camera_holes / 2 * [x, y], 2.2);
        }
}
camera_head(camera);
