// Half of the cage of a ball joint; printed four times: two at the tool, two at the fulcrum.
include <common.scad>

assert(sqrt(pow(ball_diameter / 2, 2) - pow(ball_lip, 2)) > opening(ball_lip) + 0.5,
       "the tube needs an opening through which the ball would come out: a smaller tilt or tube");

module ball_cage() {
    height = cage_height / 2;
    top = height + cage_flange_height;
    radius = (ball_diameter + clearance) / 2;
    circle = (opening(top) + cage_outer / 2) / 2;              // of the screws through both halves
    assert(cage_outer / 2 - opening(top) > cage_screw + 1.6, "no wall is left beside the screws");
    screws = [for (turn = [45 : 90 : 315]) circle * [cos(turn), sin(turn)]];
    difference() {
        union() {
            layer(0, height) difference() {
                disc([0, 0], cage_outer);
                for (place = screws) disc(place, cage_screw);
            }
            layer(height, top) difference() {
                disc([0, 0], cage_flange);
                for (place = screws) disc(place, cage_screw);
            }
        }
        rotate_extrude() polygon(concat(                       // the ball up to its lip, the tilted tube
            [[0, -eps]],
            [for (z = [-eps : (ball_lip + eps) / 12 : ball_lip]) [sqrt(radius * radius - z * z), z]],
            [[opening(ball_lip), ball_lip], [opening(top + eps), top + eps], [0, top + eps]]));
    }
}
ball_cage();
