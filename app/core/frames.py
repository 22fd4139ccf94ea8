"""The frames of the program. A transform is named `T_to_from`, so that neighbours cancel."""

from enum import StrEnum


class Frame(StrEnum):
    """Names of the right-handed frames, all in metres.

    `WORLD` is the robot base: origin midway between the two motor axes, x to the right motor, z up
    towards the skin; the pantograph moves in z = 0. `PATIENT` is DICOM's LPS. `NEEDLE` has its
    origin at the tip and +z out of the tip along the shaft. `VOXEL` counts columns, rows and
    slices (dimensionless). `CAMERA` is OpenCV's: x right, y down, z into the scene.
    """

    WORLD = "world"
    PATIENT = "patient"
    NEEDLE = "needle"
    VOXEL = "voxel"
    CAMERA = "camera"
