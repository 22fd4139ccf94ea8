// Jig: sits on both axes and holds the tube upright under the fulcrum. Its top carries the cage of
// the fulcrum at its height while the carrier is bolted; later it holds the needle for
// `acus device calibrate --step offsets`. Origin and axes are the robot's, seen from above.
include <common.scad>

module axis_jig() {
    bottom = cage_height / 2 + cage_flange_height + 1;   // over the tool's joint
    plate = bottom + 10;
    top = fulcrum_height - cage_height / 2 - cage_flange_height;
    tower = 4 * wall + tube_outer;
    layer(bottom, plate) difference() {
        union() {
            for (side = [-1, 1])
                bar([side * base / 2, 0], fulcrum, bearing_bore + 4 * wall, tower);
            bar([-base / 2, 0], [base / 2, 0], 16, 16);
        }
        for (side = [-1, 1]) disc([side * base / 2, 0], bearing_bore + clearance / 2);
        disc(fulcrum, tube_outer + clearance);
    }
    layer(plate, top) difference() {
        disc(fulcrum, tower);
        disc(fulcrum, tube_outer + clearance);
    }
}
axis_jig();
