// Gauge for the marker: put the needle's tip on its ground, wind red tape or paint through the window.
include <common.scad>

module marker_gauge() {
    ground = 5;
    low = ground + marker_offset - marker_length / 2;
    high = low + marker_length;
    module ring() difference() {
        circle(d = shaft_diameter + 14);
        circle(d = shaft_diameter + clearance);
    }
    layer(0, ground) circle(d = shaft_diameter + 14);
    layer(ground, low) ring();
    layer(low, high) difference() {
        ring();
        translate([-shaft_diameter / 2 - 2, -20]) square(40);
    }
    layer(high, high + 20) ring();
}
marker_gauge();
