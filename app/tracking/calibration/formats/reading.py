"""Reads calibration files of any known format: which one it is shows in their content.

What a file leaves out (unit of lengths, size of pictures) is asked for. ICube's YAML pair
(`cam_0_info.yaml`, `cam_1_info.yaml`; also `world_to_cam_N_info.yaml`) looks like ROS camera_info
and is not: `projection_matrix` holds [R|t] without the camera matrix, takes points of the first
camera (or of the board, for `world_to_...`) to the camera, and its translation is in centimetres.
"mean squared" errors are root mean squares.
"""

import re
from collections.abc import Sequence
from pathlib import Path
from typing import Final

from app.tracking.calibration.boards import UNITS
from app.tracking.calibration.formats.fields import Fields, intrinsics, pose
from app.tracking.calibration.formats.imported import NAMES, ImportedCamera, stereo_of
from app.tracking.calibration.formats.opencv import read_opencv
from app.tracking.calibration.formats.own import load_calibration
from app.tracking.calibration.formats.ros import read_ros
from app.tracking.calibration.formats.storage import is_storage
from app.tracking.calibration.formats.temuge import find_pair, read_temuge
from app.tracking.errors import CalibrationError
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


_UNITS: Final = UNITS | {"in": 0.0254}


def length(text: str) -> float:
    """Metres of a length with its unit, such as `1cm`.

    Raises:
        CalibrationError: if it is none.
    """
    found = re.fullmatch(r"(\d+(?:\.\d*)?|\.\d+)\s*(mm|cm|m|in)", text.strip())
    if found is None:
        raise CalibrationError(
            f"--unit {text}: a length with its unit is needed, e.g. 1cm or 25.4mm"
        )
    return float(found[1]) * _UNITS[found[2]]


def picture_size(text: str) -> tuple[int, int]:
    """Width and height [px] of `1280x720`.

    Raises:
        CalibrationError: if it is none.
    """
    found = re.fullmatch(r"(\d{2,5})[xX×](\d{2,5})", text.strip())
    if found is None:
        raise CalibrationError(f"--size {text}: WIDTHxHEIGHT in pixels is needed, e.g. 1280x720")
    return int(found[1]), int(found[2])


_EXPECTED = (
    "give one file of Acus, two YAML files of ICube or ROS (left, right), the folder with "
    "TemugeB's cameraN_intrinsics.dat and cameraN_rot_trans.dat, or intrinsics.yml and "
    "extrinsics.yml of OpenCV's stereo_calib"
)


def read_calibration(
    files: Sequence[Path],
    *,
    unit: float | None = None,
    image_size: tuple[int, int] | None = None,
    names: tuple[str, str] = NAMES,
) -> StereoCalibration:
    """Read one calibration.

    Args:
        files: see the error message of `CalibrationError`; left before right.
        unit: metres in the board's unit; only TemugeB's and OpenCV's files need it.
        image_size: width, height [px]; only TemugeB's and OpenCV's files need it.
        names: of the cameras in the rig, for files of other programs.

    Raises:
        CalibrationError: if the files are not of a known format, or one is wrong: named.
    """
    if len(files) == 1 and files[0].is_dir():
        return _text_files(files[0], unit, image_size, names)
    if len(files) not in (1, 2):
        raise CalibrationError(f"{len(files)} files were given; {_EXPECTED}")
    if any(is_storage(path) for path in files):
        return read_opencv(files, unit=unit, image_size=image_size, names=names)
    if len(files) == 1:
        return load_calibration(files[0])
    left, right = files
    kinds = {_is_ros(path) for path in files}
    if len(kinds) == 2:
        raise CalibrationError(f"{left} and {right} are of different formats; {_EXPECTED}")
    return (read_ros if kinds.pop() else read_icube)(left, right, names)


def _is_ros(path: Path) -> bool:
    if path.suffix.lower() not in {".yaml", ".yml"}:
        raise CalibrationError(f"{path} is no YAML file; {_EXPECTED}")
    return "rectification_matrix" in Fields(path)


def _text_files(
    folder: Path,
    unit: float | None,
    image_size: tuple[int, int] | None,
    names: tuple[str, str],
) -> StereoCalibration:
    left, right = find_pair(folder)
    if unit is None or image_size is None:
        raise CalibrationError(
            f"{folder}: TemugeB's files hold neither unit nor picture size; say them, e.g. "
            "--unit 1cm (the unit in which the board's square was typed) --size 1280x720"
        )
    return read_temuge(left, right, unit=unit, image_size=image_size, names=names)
