"""ICube's YAML pair (`cam_0_info.yaml`, `cam_1_info.yaml`; also `world_to_cam_N_info.yaml`).

It looks like ROS camera_info and is not: `projection_matrix` holds [R|t] without the camera
matrix, takes points of the first camera (or of the board, for `world_to_...`) to the camera, and
its translation is in centimetres. "mean squared" errors are root mean squares.
"""

from pathlib import Path
from typing import Final

from app.tracking.calibration.formats.fields import Fields, intrinsics, pose
from app.tracking.calibration.formats.imported import NAMES, ImportedCamera, stereo_of
from app.tracking.optics.calibration import StereoCalibration

_CENTIMETRE: Final = 1e-2

MODELS: Final = ("plum_bob", "plumb_bob")
"""Names of the distortion model; the first is how ICube's files spell it."""

_OWN_RMS: Final = "single camera reprojection error (mean squared)"
_STEREO_RMS: Final = "stereo reprojection error (mean squared)"


def read_icube(left: Path, right: Path, names: tuple[str, str] = NAMES) -> StereoCalibration:
    """Read the pair.

    Raises:
        CalibrationError: naming file, field, value and what is valid.
    """
    files = Fields(left), Fields(right)
    rms = files[1].number(_STEREO_RMS) or files[0].number(_STEREO_RMS) or 0.0
    first, second = (_camera(fields) for fields in files)
    return stereo_of(first, second, "ICube YAML pair", rms_px=rms, names=names)


def _camera(fields: Fields) -> ImportedCamera:
    fields.text("distortion_model", MODELS)
    where = f"{fields.path}: camera_matrix"
    focal, centre = intrinsics(fields.matrix("camera_matrix", 3, 3), where)
    k1, k2, p1, p2, k3 = fields.matrix("distortion_coefficients", 1, 5)[0].tolist()
    matrix = fields.matrix("projection_matrix", 3, 4)
    return ImportedCamera(
        fields.path,
        fields.size(),
        focal,
        centre,
        (k1, k2, p1, p2, k3),
        pose(matrix, _CENTIMETRE, f"{fields.path}: projection_matrix"),
        fields.number(_OWN_RMS) or 0.0,
    )
