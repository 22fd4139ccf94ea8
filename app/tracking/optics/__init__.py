"""Calibrated cameras: points to pixels, pixels to rays, and the rig they form."""
