// Carrier of the fulcrum's ball: clamped between the two halves of its cage, bolted to the rail
// behind it. The ball's middle is the origin.
include <common.scad>

module fulcrum_plate() {
    back = bridge_y - fulcrum[1];             // middle of the rail, seen from the fulcrum
    width = cage_flange + 4 * wall;
    layer(-cage_height / 2, cage_height / 2) difference() {
        union() {
            disc([0, 0], width);
            translate([-width / 2, back - rail / 2]) square([width, rail / 2 - back]);
        }
        disc([0, 0], cage_outer + clearance);
        for (side = [-1, 1]) {
            bar([side * 12, back - 4], [side * 12, back + 4], 5.3, 5.3);    // the jig says where
            disc([side * 12, -skin_opening / 2 + 12 + rail / 2], 2.5);      // screws of the skin's frame
        }
    }
}
fulcrum_plate();
