// Ball on the tube: slides on it at the tool, is glued to it at the fulcrum. Better turned of steel.
include <common.scad>

module ball() {
    inner = tube_outer / 2 + clearance / 4;
    edge = acos(inner * 2 / ball_diameter);
    rotate_extrude() polygon([for (turn = [-edge : edge / 30 : edge + eps])
        ball_diameter / 2 * [cos(turn), sin(turn)]]);
}
ball();
