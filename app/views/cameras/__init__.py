"""Cameras in the window: sources, calibration, boards to print."""
