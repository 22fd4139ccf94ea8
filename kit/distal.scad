// Link from elbow to tool joint; printed twice. Elbow at the origin, tool along +x.
include <common.scad>

module distal() {
    hub = bearing_outer + 2 * wall;
    layer(0, bearing_width) difference() {
        union() {
            disc([0, 0], hub);
            bar([0, 0], [distal, 0], hub * 0.6, hub * 0.6);
            disc([distal, 0], cage_bearing_outer + 2 * wall);
        }
        disc([0, 0], bearing_outer);
        disc([distal, 0], cage_bearing_outer);
        bar([0.25 * distal, 0], [0.72 * distal, 0], 8, 8);     // less to turn
    }
    layer(bearing_width, 2 * bearing_width) difference() {     // its bearings stand one width apart
        disc([0, 0], hub);
        disc([0, 0], bearing_outer - 3);
    }
    layer(2 * bearing_width, 3 * bearing_width) difference() {
        disc([0, 0], hub);
        disc([0, 0], bearing_outer);
    }
}
distal();
