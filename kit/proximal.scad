// Driven link with the drum of its capstan; printed twice. Axis at the origin, elbow along +x. The
// cable's ends go through the two small holes and under the heads of screws in them.
include <common.scad>

module proximal() {
    hub = bearing_outer + 2 * wall;
    end = 4 * wall + bearing_bore;
    height = arm_top - drum_bottom;
    drum = arm_bottom - drum_bottom;
    module drum_with(bore) difference() {
        disc([0, 0], drum_diameter);
        disc([0, 0], bore);
        for (turn = [60 : 60 : 300])                           // less to turn
            disc(drum_diameter * 0.33 * [cos(turn), sin(turn)], 14);
        for (turn = [-12, 12])
            rotate(180 + turn) disc([drum_diameter / 2 - 5, 0], 2.5);
    }
    module arm_with(bore) difference() {
        bar([0, 0], [proximal, 0], hub, end);
        disc([0, 0], bore);
        disc([proximal, 0], bearing_bore);                     // the elbow's pin, pressed in
    }
    layer(0, bearing_width) drum_with(bearing_outer);
    layer(bearing_width, drum) drum_with(bearing_outer - 3);
    layer(drum, height - bearing_width) arm_with(bearing_outer - 3);
    layer(height - bearing_width, height) arm_with(bearing_outer);
}
proximal();
