"""The three slice panes: image, crosshair, plan, needle, read-outs and the mouse on them."""
