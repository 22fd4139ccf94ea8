// What several parts share. profile.scad comes from `python -m tools.kit`, all lengths in mm.
include <profile.scad>
$fn = facets;

eps = 0.01;
fulcrum_height = fulcrum[2];
tilt = tilt_limit;
cage_height = 2 * bearing_width;              // two bearings, one above the other
tube_bore = shaft_diameter + tube_play;
// Gear = turns of the motor per turn of the joint, along the middle of the cable.
pulley_diameter = (drum_diameter + cable_diameter) / gear - cable_diameter;
motor_distance = (drum_diameter + pulley_diameter) / 2 + cable_diameter;

// How wide a tilted tube needs an opening, at a height over the ball's middle.
function opening(height) = height * tan(tilt) + tube_outer / 2 / cos(tilt);

// Parts are stacks of flat layers: OpenSCAD joins flat shapes at once, and solids slowly.
module layer(bottom, top)
    translate([0, 0, bottom]) linear_extrude(top - bottom) children();

// A disc at a place.
module disc(place, diameter)
    translate([place[0], place[1]]) circle(d = diameter);

// Flat bar with round ends between two places.
module bar(from, to, width_from, width_to)
    hull() {
        disc(from, width_from);
        disc(to, width_to);
    }
