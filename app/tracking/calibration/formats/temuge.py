"""TemugeB's text files: `cameraN_intrinsics.dat` and `[world_to_]cameraN_rot_trans.dat`.

They hold neither the picture's size nor a unit: lengths are in the unit the board's square was
typed in. Both must be said by whoever reads them.
"""

from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.calibration.formats.fields import intrinsics, pose
from app.tracking.calibration.formats.imported import NAMES, ImportedCamera, stereo_of
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import StereoCalibration

_COEFFICIENTS: Final = (4, 5)


@dataclass(frozen=True, slots=True)
class TemugeFiles:
    """The two text files of one camera."""

    intrinsics: Path
    rot_trans: Path


def find_pair(folder: Path) -> tuple[TemugeFiles, TemugeFiles]:
    """Return the files of the two cameras in a folder; the lower number is the left one.

    `cameraN_rot_trans.dat` is preferred to `world_to_cameraN_rot_trans.dat`.

    Raises:
        CalibrationError: if there are not exactly two cameras, or one lacks its pose.
    """
    found = sorted(folder.glob("camera*_intrinsics.dat"), key=_order)
    if len(found) != 2:
        names = ", ".join(path.name for path in found) or "none"
        raise CalibrationError(
            f"{folder}: two files cameraN_intrinsics.dat are needed, found {names}"
        )
    first, second = (_with_pose(path) for path in found)
    return first, second


def read_temuge(
    left: TemugeFiles,
    right: TemugeFiles,
    *,
    unit: float,
    image_size: tuple[int, int],
    names: tuple[str, str] = NAMES,
) -> StereoCalibration:
    """Read the four files.

    Args:
        left: of the first camera.
        right: of the second.
        unit: metres in the unit of the board (0.01 if the square was typed in cm).
        image_size: width, height [px] of the pictures.
        names: of the cameras in the rig.

    Raises:
        CalibrationError: naming file, section, value and what is valid.
    """
    if not isfinite(unit) or not 1e-6 <= unit <= 10.0:
        raise CalibrationError(f"unit {unit} m: from 1e-6 (a micrometre) to 10 is valid")
    first, second = (_camera(files, unit, image_size) for files in (left, right))
    return stereo_of(first, second, "TemugeB text files", names=names)


def _camera(files: TemugeFiles, unit: float, image_size: tuple[int, int]) -> ImportedCamera:
    lines = _lines(files.intrinsics)
    matrix = _section(files.intrinsics, lines, "intrinsic:", (3, 3))
    focal, centre = intrinsics(matrix, f"{files.intrinsics}: intrinsic")
    coefficients = _section(files.intrinsics, lines, "distortion:", (1, 0))[0].tolist()
    if len(coefficients) not in _COEFFICIENTS:
        raise CalibrationError(
            f"{files.intrinsics}: distortion: 4 or 5 numbers (k1 k2 p1 p2 k3) are needed, "
            f"got {len(coefficients)}"
        )
    k1, k2, p1, p2, k3 = (*coefficients, 0.0)[:5]
    lines = _lines(files.rot_trans)
    rotation = _section(files.rot_trans, lines, "R:", (3, 3))
    translation = _section(files.rot_trans, lines, "T:", (3, 1))
    placed = pose(np.hstack([rotation, translation]), unit, f"{files.rot_trans}: R")
    return ImportedCamera(files.intrinsics, image_size, focal, centre, (k1, k2, p1, p2, k3), placed)


def _lines(path: Path) -> list[str]:
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise CalibrationError(
            f"cannot read {path}: {error.strerror or error}; check its name and that it may be read"
        ) from error
    except UnicodeDecodeError as error:
        raise CalibrationError(
            f"{path} is no text file; one of lines of numbers is needed, as TemugeB's program "
            "writes it"
        ) from error
    return [line.strip() for line in text.splitlines() if line.strip()]


def _section(path: Path, lines: list[str], title: str, shape: tuple[int, int]) -> FloatArray:
    """Return the rows below a title; a shape of 0 columns takes as many as there are."""
    if title not in lines:
        raise CalibrationError(f"{path}: no line {title!r}; the file begins {lines[:1]}")
    start = lines.index(title) + 1
    rows = [_numbers(path, title, line) for line in lines[start : start + shape[0]]]
    columns = shape[1] or (len(rows[0]) if rows else 0)
    if len(rows) != shape[0] or any(len(row) != columns for row in rows):
        raise CalibrationError(
            f"{path}: {title} {shape[0]} lines of {columns} numbers are needed, got "
            f"{[len(row) for row in rows]} numbers in {len(rows)} lines"
        )
    return np.array(rows, dtype=np.float64)


def _numbers(path: Path, title: str, line: str) -> list[float]:
    try:
        values = [float(word) for word in line.split()]
    except ValueError as error:
        raise CalibrationError(f"{path}: {title} numbers are needed, got {line!r}") from error
    if not all(isfinite(value) for value in values):
        raise CalibrationError(f"{path}: {title} finite numbers are needed, got {line!r}")
    return values


def _with_pose(path: Path) -> TemugeFiles:
    name = path.name.replace("_intrinsics", "_rot_trans")
    for candidate in (path.with_name(name), path.with_name(f"world_to_{name}")):
        if candidate.is_file():
            return TemugeFiles(path, candidate)
    raise CalibrationError(f"{path}: its pose is missing: there is no {name} beside it")


def _order(path: Path) -> tuple[int, str]:
    digits = "".join(filter(str.isdigit, path.stem))
    return int(digits or 0), path.name
