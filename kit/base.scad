// Plate that holds both axes and both motors; world's x and y, its top at z = 0 of the part.
include <common.scad>

function motor(side) = [side * (base / 2 + motor_distance * cos(motor_turn)),
                        -motor_distance * sin(motor_turn)];
function legs() = [[0, -52], for (side = [-1, 1]) each [[side * 14, 26], [side * (base / 2 + 18), 14]]];
// Where a stop's middle stands, so that the link lies against it at its home angle: `stop_away`
// along the link, its radius beyond the link's edge, which touches both round ends.
function stop(side) = let (
        near = bearing_outer / 2 + wall, far = 2 * wall + bearing_bore / 2,
        slope = asin((near - far) / proximal), angle = side < 0 ? home[0] : home[1],
        across = -side * (near + stop_diameter / 2 - stop_away * sin(slope)) / cos(slope))
    [side * base / 2 + stop_away * cos(angle) - across * sin(angle),
     stop_away * sin(angle) + across * cos(angle)];

module base_plate() {
    layer(-base_thickness, 0) difference() {
        hull() for (side = [-1, 1]) {
            disc([side * base / 2, 0], drum_diameter * 0.9);
            disc(motor(side), motor_body + 14);
            disc(stop(side), 2 * stop_diameter);
        }
        for (side = [-1, 1]) {
            disc([side * base / 2, 0], bearing_bore);
            disc(motor(side), 24);
            for (turn = [0 : 60 : 300])
                disc(motor(side) + motor_screw_circle / 2 * [cos(turn), sin(turn)], screw);
        }
        for (leg = legs()) disc(leg, wood_screw + 1);
    }
    for (side = [-1, 1]) {
        layer(0, drum_bottom - base_top - 0.5) difference() {  // bosses of the axes
            disc([side * base / 2, 0], 2 * bearing_bore - 2);
            disc([side * base / 2, 0], bearing_bore);
        }
        layer(0, arm_top - base_top) disc(stop(side), stop_diameter);
    }
}
base_plate();
