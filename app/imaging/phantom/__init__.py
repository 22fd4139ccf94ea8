"""A made-up torso: anatomy from a seed, written as a real DICOM CT series."""
