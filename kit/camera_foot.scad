// Foot of a camera's post, screwed to the board square to its edges: the rail stands turned in it by
// the camera's azimuth. `camera` chooses which; print one of each.
include <common.scad>
camera = 0;

function azimuth(k) = let (line = looks_at[k] - cameras[k]) atan2(line[1], line[0]);

module camera_foot(k) {
    inside = rail + clearance;
    module plate_() difference() {
        square(64, center = true);
        for (x = [-26, 26], y = [-26, 26]) disc([x, y], wood_screw);
    }
    layer(0, 4) plate_();
    layer(4, 6) difference() {
        plate_();
        rotate(azimuth(k)) square(inside, center = true);
    }
    layer(6, 28) rotate(azimuth(k)) difference() {
        square(rail + 12, center = true);
        square(inside, center = true);
        square([2 * rail, 5.3], center = true);            // a slit for a screw into the rail's groove
    }
}
camera_foot(camera);
