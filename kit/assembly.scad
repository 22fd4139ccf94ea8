// All of it, with the needle upright (or `lean` degrees to the right), for the picture; not printed.
include <common.scad>
use <base.scad>
use <proximal.scad>
use <distal.scad>
use <ball_cage.scad>
use <ball.scad>
use <fulcrum.scad>
use <skin_frame.scad>
use <axis_jig.scad>
use <camera_foot.scad>
use <camera_head.scad>
lean = 20;
with_jig = false;

tool = [fulcrum[0] - fulcrum_height * tan(lean), fulcrum[1], 0];
function elbow(side) = let (
        motor = [side * base / 2, 0], line = [tool[0], tool[1]] - motor, away = norm(line),
        opening = acos((proximal * proximal + away * away - distal * distal) / (2 * proximal * away)),
        angle = atan2(line[1], line[0]) - side * opening)
    [motor[0] + proximal * cos(angle), proximal * sin(angle), angle];

module rail_(length) color("silver") translate([-rail / 2, -rail / 2, 0]) cube([rail, rail, length]);

color("burlywood") translate([-330, -110, board_top - 18]) cube([660, 640, 18]);
color("slategray") translate([0, 0, base_top]) base_plate();
for (side = [-1, 1]) {
    at = elbow(side);
    color("dimgray") translate([side * base / 2, 0, base_top - 10]) cylinder(d = bearing_bore, h = axis_top - base_top + 10);
    color("steelblue") translate([side * base / 2, 0, drum_bottom]) rotate(at[2]) proximal();
    low = side < 0 ? -bearing_width : 0;
    color("lightsteelblue") translate([at[0], at[1], low])
        rotate(atan2(tool[1] - at[1], tool[0] - at[0])) distal();
    color("dimgray") translate([at[0], at[1], arm_bottom]) cylinder(d = bearing_bore, h = 3 * bearing_width + 18);
    color("black") translate(concat(motor(side), base_top - base_thickness - 64))
        cylinder(d = motor_body, h = 64);
    color("goldenrod") translate(concat(motor(side), drum_bottom))
        cylinder(d = pulley_diameter, h = 16);
    translate([side * bridge_half, bridge_y, board_top]) rail_(fulcrum_height - cage_height / 2 - rail - board_top);
}
for (leg = legs())
    color("silver") translate([leg[0], leg[1], board_top])
        cylinder(d = 8, h = base_top - base_thickness - board_top);
translate([-bridge_half - rail / 2, bridge_y, fulcrum_height - cage_height / 2 - rail / 2]) rotate([0, 90, 0]) rail_(2 * bridge_half + rail);
for (joint = [tool, fulcrum]) translate(joint) {
    color("white") for (turn = [0, 180]) rotate([turn, 0, 0]) ball_cage();
    color("gray") ball();
}
color("slategray") translate(fulcrum) fulcrum_plate();
translate(fulcrum + [0, 0, cage_height / 2]) {
    color("peru") skin_frame();
    color("peachpuff") translate([0, 0, 6]) difference() {
        cylinder(d = skin_frame, h = skin_thickness - 0.2);
        cylinder(d = 40, h = 20, center = true);
    }
    color("peru") translate([0, 0, 6 + skin_thickness]) difference() {
        cylinder(d = skin_frame, h = 6);
        cylinder(d = skin_opening, h = 20, center = true);
    }
}
translate(fulcrum) rotate([0, lean, 0]) {                  // hub above, tip below
    color("lightcyan", 0.5) translate([0, 0, -125]) cylinder(d = tube_outer, h = 140);
    color("dimgray") translate([0, 0, -60]) cylinder(d = shaft_diameter, h = needle_length);
    color("red") translate([0, 0, -60 + marker_offset - marker_length / 2]) cylinder(d = tube_outer + 0.3, h = marker_length);
    color("black") translate([0, 0, needle_length - 60]) cylinder(d = 12, h = 25);
}
for (k = [0 : len(cameras) - 1]) {
    line = looks_at[k] - cameras[k];
    middle = camera_holes / 2 + 4;
    translate([cameras[k][0], cameras[k][1], board_top]) {
        color("slategray") camera_foot(k);
        rotate(atan2(line[1], line[0])) translate([0, 0, 4]) rail_(cameras[k][2] - middle - 7 - board_top);
    }
    translate([cameras[k][0], cameras[k][1], cameras[k][2] - middle]) rotate(atan2(line[1], line[0])) {
        color("slategray") camera_head(k);
        color("black") translate([0, 0, middle]) rotate([0, 90, 0]) cylinder(d = 14, h = 14);
    }
}
if (with_jig) color("seagreen") axis_jig();
