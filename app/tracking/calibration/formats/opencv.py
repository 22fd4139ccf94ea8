"""OpenCV's FileStorage files, as the sample `stereo_calib` writes them.

`intrinsics.yml` holds M1, D1, M2, D2 (camera matrices and distortion of left and right),
`extrinsics.yml` holds R, T (x_right = R·x_left + T) beside what follows from them. One file may
hold all six. T is in the unit of the board's square; neither the unit nor the pictures' size is in
them. XML and JSON of FileStorage are read as well. The files are parsed by `storage`, not OpenCV.
"""

from collections.abc import Sequence
from pathlib import Path
from typing import Final

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.core.transform import RigidTransform
from app.tracking.calibration.formats.fields import intrinsics, pose
from app.tracking.calibration.formats.imported import NAMES, ImportedCamera, stereo_of
from app.tracking.calibration.formats.storage import read_matrices
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import StereoCalibration

_PAIR: Final = ("M1", "D1", "M2", "D2", "R", "T")
_LENS: Final = "camera_matrix"
_COUNTS: Final = (4, 5, 8, 12, 14)
_GRID: Final = 21

WORST_PX: Final = 0.2
"""Five coefficients stand for more of them if no pixel is moved by more than this."""


def read_opencv(
    files: Sequence[Path],
    *,
    unit: float | None,
    image_size: tuple[int, int] | None,
    names: tuple[str, str] = NAMES,
) -> StereoCalibration:
    """Read a pair of cameras from one or two files, in any order.

    Args:
        files: with M1, D1, M2, D2, R and T between them.
        unit: metres in the unit of the board's square.
        image_size: width, height [px] of the pictures.
        names: of the cameras in the rig.

    Raises:
        CalibrationError: if something is missing or cannot be; says what.
    """
    found: dict[str, tuple[Path, FloatArray]] = {}
    for path in files:
        found |= {key: (path, value) for key, value in read_matrices(path, (*_PAIR, _LENS)).items()}
    named = " and ".join(str(path) for path in files)
    _require(named, found)
    if unit is None or image_size is None:
        raise CalibrationError(
            f"{named}: OpenCV's files hold neither unit nor picture size; say them, e.g. "
            "--unit 1cm (the unit in which the board's square was typed) --size 640x480"
        )
    values = {key: value for key, (_, value) in found.items()}
    where = found["R"][0]
    if values["R"].size == 3:
        values["R"] = cv2.Rodrigues(values["R"])[0]
    placed = np.hstack([_shaped(where, "R", values["R"], (3, 3)),
                        _shaped(where, "T", values["T"], (3, 1))])  # fmt: skip
    poses = (RigidTransform.identity(), pose(placed, unit, f"{where}: R"))
    notes: list[str] = []
    cameras = []
    for i, T_camera_left in enumerate(poses, start=1):
        source = found[f"M{i}"][0]
        matrix = _shaped(source, f"M{i}", values[f"M{i}"], (3, 3))
        focal, centre = intrinsics(matrix, f"{source}: M{i}")
        where_d = f"{found[f'D{i}'][0]}: D{i}"
        k1, k2, p1, p2, k3 = _five(where_d, values[f"D{i}"], matrix, image_size, notes)
        lens = (k1, k2, p1, p2, k3)
        cameras.append(ImportedCamera(source, image_size, focal, centre, lens, T_camera_left))
    made = stereo_of(cameras[0], cameras[1], "OpenCV FileStorage", names=names)
    return made.model_copy(update={"notes": (*made.notes, *notes)})


def _require(named: str, found: dict[str, tuple[Path, FloatArray]]) -> None:
    missing = [key for key in _PAIR if key not in found]
    if missing and _LENS in found:
        raise CalibrationError(
            f"{named}: a lens of OpenCV's one-camera sample; it does not say how two cameras stand "
            "to each other. Give what stereo_calib writes (intrinsics.yml and extrinsics.yml), or "
            "calibrate the pictures with `acus calibrate stereo`"
        )
    if missing:
        there = ", ".join(key for key in _PAIR if key in found) or "none of them"
        raise CalibrationError(
            f"{named}: a pair of OpenCV needs M1, D1, M2, D2 (intrinsics.yml) and R, T "
            f"(extrinsics.yml), found {there}; give both files"
        )


def _shaped(path: Path, key: str, value: FloatArray, shape: tuple[int, int]) -> FloatArray:
    if value.size != shape[0] * shape[1]:
        raise CalibrationError(
            f"{path}: {key}: {shape[0]} x {shape[1]} numbers are needed, got {value.shape}"
        )
    return value.reshape(shape)


def _five(
    where: str,
    given: FloatArray,
    matrix: FloatArray,
    image_size: tuple[int, int],
    notes: list[str],
) -> list[float]:
    """Return k1, k2, p1, p2, k3; of a longer model those that come nearest over the picture.

    The distortion is linear in the five, so that least squares over a grid of pixels finds them.
    """
    values = given.ravel()
    if values.size not in _COUNTS:
        raise CalibrationError(f"{where}: {_COUNTS} coefficients are possible, got {values.size}")
    five = np.zeros(5)
    five[: min(5, values.size)] = values[:5]
    if not values[5:].any():
        return list(five)
    u, v = (np.linspace(0.0, side - 1.0, _GRID) for side in image_size)
    pixels = np.stack(np.meshgrid(u, v), axis=-1).reshape(-1, 1, 2)
    x, y = np.asarray(cv2.undistortPoints(pixels, matrix, values))[:, 0].T  # nearly: a start
    ahead = np.column_stack([x, y, np.ones_like(x)])
    bent = cv2.projectPoints(ahead, np.zeros(3), np.zeros(3), np.eye(3), values)[0][:, 0]
    r2 = x * x + y * y
    rows = np.array([[x * r2, x * r2**2, 2 * x * y, r2 + 2 * x * x, x * r2**3],
                     [y * r2, y * r2**2, r2 + 2 * y * y, 2 * x * y, y * r2**3]])  # fmt: skip
    design = np.concatenate([rows[0], rows[1]], axis=1).T
    to_pixels = np.diag(matrix)[:2].repeat(x.size)
    wanted = np.concatenate([bent[:, 0] - x, bent[:, 1] - y])
    if not (np.isfinite(design).all() and np.isfinite(wanted).all()):
        raise CalibrationError(f"{where}: coefficients that bend the picture beyond any number")
    five = np.linalg.lstsq(design, wanted, rcond=None)[0]
    worst = float(np.abs((design @ five - wanted) * to_pixels).max())
    if not worst <= WORST_PX:
        raise CalibrationError(
            f"{where}: a model of {values.size} coefficients that five cannot stand for (pixels "
            f"would move by up to {worst:.2g} px, {WORST_PX:g} px are allowed): calibrate the "
            "pictures with `acus calibrate stereo`"
        )
    notes.append(f"{where}: {values.size} coefficients replaced by five, within {worst:.2g} px")
    return list(five)
