"""Reads calibration files of any known format: which one it is shows in their content."""

from collections.abc import Sequence
from pathlib import Path

from app.tracking.calibration.formats.fields import Fields
from app.tracking.calibration.formats.icube import read_icube
from app.tracking.calibration.formats.imported import NAMES
from app.tracking.calibration.formats.opencv import read_opencv
from app.tracking.calibration.formats.own import load_calibration
from app.tracking.calibration.formats.ros import read_ros
from app.tracking.calibration.formats.storage import is_storage
from app.tracking.calibration.formats.temuge import find_pair, read_temuge
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import StereoCalibration

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
