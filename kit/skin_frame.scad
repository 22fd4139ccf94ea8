// Ring that clamps the silicone sheet of the fake skin; printed twice, one below, one above the
// sheet. The lower one is screwed to the carrier of the fulcrum.
include <common.scad>

module skin_frame() {
    layer(0, 6) difference() {
        union() {
            difference() {
                disc([0, 0], skin_frame);
                disc([0, 0], skin_opening);
            }
            translate([-20, -skin_opening / 2 - 4]) square([40, 30]);    // over the carrier
        }
        for (turn = [0 : 45 : 315])
            disc((skin_opening + skin_frame) / 4 * [cos(turn), sin(turn)], screw);
        for (side = [-1, 1]) disc([side * 12, -skin_opening / 2 + 12 + rail / 2], screw);
    }
}
skin_frame();
