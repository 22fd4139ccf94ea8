"""Calibration files: the own YAML, and those of other programs."""
