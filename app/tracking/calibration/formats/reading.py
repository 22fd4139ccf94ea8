"""Reads calibration files of any known format: which one it is shows in their content.

What a file leaves out (unit of lengths, size of pictures) is asked for.

- ICube's YAML pair (`cam_0_info.yaml`, `cam_1_info.yaml`; also `world_to_cam_N_info.yaml`) looks
  like ROS camera_info and is not: `projection_matrix` holds [R|t] without the camera matrix, takes
  points of the first camera (or of the board, for `world_to_...`) to the camera, and its
  translation is in centimetres. "mean squared" errors are root mean squares.
- OpenCV's FileStorage, as the sample `stereo_calib` writes it: `intrinsics.yml` holds M1, D1, M2,
  D2 (camera matrices and distortion of left and right), `extrinsics.yml` R, T (x_right = R·x_left +
  T) beside what follows from them. One file may hold all six. T is in the unit of the board's
  square; neither the unit nor the pictures' size is in them. XML and JSON are read as well, by
  OpenCV in the worker process (`storage`).
- TemugeB's text files, `cameraN_intrinsics.dat` and `[world_to_]cameraN_rot_trans.dat`: neither the
  picture's size nor a unit; lengths are in the unit the board's square was typed in.
"""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from math import isfinite
from pathlib import Path
from typing import Final

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.tracking.calibration.boards import UNITS
from app.tracking.calibration.formats.fields import Fields, intrinsics, pose
from app.tracking.calibration.formats.imported import NAMES, ImportedCamera, stereo_of
from app.tracking.calibration.formats.lenses import lens_coefficients
from app.tracking.calibration.formats.own import load_calibration
from app.tracking.calibration.formats.ros import read_ros
from app.tracking.calibration.formats.storage import is_storage, read_matrices
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import StereoCalibration
from app.tracking.optics.lens import LensModel


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
            sentence(
                "{folder}: two files cameraN_intrinsics.dat are needed, found {names}",
                folder=folder,
                names=names,
            )
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
        raise CalibrationError(
            sentence("unit {unit} m: from 1e-6 (a micrometre) to 10 is valid", unit=unit)
        )
    first, second = (_temuge_camera(files, unit, image_size) for files in (left, right))
    return stereo_of(first, second, "TemugeB text files", names=names)


def _temuge_camera(files: TemugeFiles, unit: float, image_size: tuple[int, int]) -> ImportedCamera:
    lines = _lines(files.intrinsics)
    matrix = _section(files.intrinsics, lines, "intrinsic:", (3, 3))
    focal, centre = intrinsics(matrix, f"{files.intrinsics}: intrinsic")
    coefficients = _section(files.intrinsics, lines, "distortion:", (1, 0))[0].tolist()
    lens, distortion = lens_coefficients(f"{files.intrinsics}: distortion", coefficients)
    lines = _lines(files.rot_trans)
    rotation = _section(files.rot_trans, lines, "R:", (3, 3))
    translation = _section(files.rot_trans, lines, "T:", (3, 1))
    placed = pose(np.hstack([rotation, translation]), unit, f"{files.rot_trans}: R")
    return ImportedCamera(
        files.intrinsics, image_size, focal, centre, distortion, placed, lens=lens
    )


def _lines(path: Path) -> list[str]:
    try:
        text = path.read_text(encoding="utf-8")
    except OSError as error:
        raise CalibrationError(
            sentence(
                "cannot read {path}: {error_strerror}; check its name and that it may be read",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    except UnicodeDecodeError as error:
        raise CalibrationError(
            sentence(
                "{path} is no text file; one of lines of numbers is needed, as TemugeB's program "
                "writes it",
                path=path,
            )
        ) from error
    return [line.strip() for line in text.splitlines() if line.strip()]


def _section(path: Path, lines: list[str], title: str, shape: tuple[int, int]) -> FloatArray:
    """Return the rows below a title; a shape of 0 columns takes as many as there are."""
    if title not in lines:
        raise CalibrationError(
            sentence(
                "{path}: no line {title!r}; the file begins {lines}",
                path=path,
                title=title,
                lines=lines[:1],
            )
        )
    start = lines.index(title) + 1
    rows = [_numbers(path, title, line) for line in lines[start : start + shape[0]]]
    columns = shape[1] or (len(rows[0]) if rows else 0)
    if len(rows) != shape[0] or any(len(row) != columns for row in rows):
        raise CalibrationError(
            sentence(
                "{path}: {title} {needed_lines} lines of {columns} numbers are needed, got "
                "{numbers_by_line} numbers in {found_lines} lines",
                path=path,
                title=title,
                needed_lines=shape[0],
                columns=columns,
                numbers_by_line=[len(row) for row in rows],
                found_lines=len(rows),
            )
        )
    return np.array(rows, dtype=np.float64)


def _numbers(path: Path, title: str, line: str) -> list[float]:
    try:
        values = [float(word) for word in line.split()]
    except ValueError as error:
        raise CalibrationError(
            sentence(
                "{path}: {title} numbers are needed, got {line!r}",
                path=path,
                title=title,
                line=line,
            )
        ) from error
    if not all(isfinite(value) for value in values):
        raise CalibrationError(
            sentence(
                "{path}: {title} finite numbers are needed, got {line!r}",
                path=path,
                title=title,
                line=line,
            )
        )
    return values


def _with_pose(path: Path) -> TemugeFiles:
    name = path.name.replace("_intrinsics", "_rot_trans")
    for candidate in (path.with_name(name), path.with_name(f"world_to_{name}")):
        if candidate.is_file():
            return TemugeFiles(path, candidate)
    raise CalibrationError(
        sentence("{path}: its pose is missing: there is no {name} beside it", path=path, name=name)
    )


def _order(path: Path) -> tuple[int, str]:
    digits = "".join(filter(str.isdigit, path.stem))
    return int(digits or 0), path.name


_PAIR: Final = ("M1", "D1", "M2", "D2", "R", "T")
_LENS: Final = "camera_matrix"


def read_opencv(
    files: Sequence[Path],
    *,
    unit: float | None,
    image_size: tuple[int, int] | None,
    names: tuple[str, str] = NAMES,
    lens: LensModel | None = None,
) -> StereoCalibration:
    """Read a pair of cameras from one or two files, in any order.

    Args:
        files: with M1, D1, M2, D2, R and T between them.
        unit: metres in the unit of the board's square.
        image_size: width, height [px] of the pictures.
        names: of the cameras in the rig.
        lens: model of both lenses; None for OpenCV's pinhole ones, told by the number of
            coefficients.

    Raises:
        CalibrationError: if something is missing or cannot be; says what.
        WorkerError: if the process that reads the files cannot be started.
    """
    found: dict[str, tuple[Path, FloatArray]] = {}
    for path in files:
        found |= {key: (path, value) for key, value in read_matrices(path, (*_PAIR, _LENS)).items()}
    named = " and ".join(str(path) for path in files)
    _require(named, found)
    if unit is None or image_size is None:
        raise CalibrationError(
            sentence(
                "{named}: OpenCV's files hold neither unit nor picture size; say them, e.g. "
                "--unit 1cm (the unit in which the board's square was typed) --size 640x480",
                named=named,
            )
        )
    values = {key: value for key, (_, value) in found.items()}
    where = found["R"][0]
    if values["R"].size == 3:
        values["R"] = cv2.Rodrigues(values["R"])[0]
    placed = np.hstack(
        [_shaped(where, "R", values["R"], (3, 3)), _shaped(where, "T", values["T"], (3, 1))]
    )
    poses = (RigidTransform.identity(), pose(placed, unit, f"{where}: R"))
    cameras = []
    for i, T_camera_left in enumerate(poses, start=1):
        source = found[f"M{i}"][0]
        matrix = _shaped(source, f"M{i}", values[f"M{i}"], (3, 3))
        focal, centre = intrinsics(matrix, f"{source}: M{i}")
        where_d = f"{found[f'D{i}'][0]}: D{i}"
        model, distortion = lens_coefficients(where_d, values[f"D{i}"].ravel().tolist(), lens)
        cameras.append(
            ImportedCamera(source, image_size, focal, centre, distortion, T_camera_left, lens=model)
        )
    return stereo_of(cameras[0], cameras[1], "OpenCV FileStorage", names=names)


def _require(named: str, result: dict[str, tuple[Path, FloatArray]]) -> None:
    missing = [key for key in _PAIR if key not in result]
    if missing and _LENS in result:
        raise CalibrationError(
            sentence(
                "{named}: a lens of OpenCV's one-camera sample; it does not say how two cameras "
                "stand to each other. Give what stereo_calib writes (intrinsics.yml and "
                "extrinsics.yml), or calibrate the pictures with `acus calibrate stereo`",
                named=named,
            )
        )
    if missing:
        there = ", ".join(key for key in _PAIR if key in result) or "none of them"
        raise CalibrationError(
            sentence(
                "{named}: a pair of OpenCV needs M1, D1, M2, D2 (intrinsics.yml) and R, T "
                "(extrinsics.yml), found {there}; give both files",
                named=named,
                there=there,
            )
        )


def _shaped(path: Path, key: str, value: FloatArray, shape: tuple[int, int]) -> FloatArray:
    if value.size != shape[0] * shape[1]:
        raise CalibrationError(
            sentence(
                "{path}: {key}: {rows} x {columns} numbers are needed, got {found_shape}",
                path=path,
                key=key,
                rows=shape[0],
                columns=shape[1],
                found_shape=value.shape,
            )
        )
    return value.reshape(shape)


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
            sentence(
                "--unit {unit}: a length with its unit is needed, e.g. 1cm or 25.4mm", unit=text
            )
        )
    return float(found[1]) * _UNITS[found[2]]


def picture_size(text: str) -> tuple[int, int]:
    """Width and height [px] of `1280x720`.

    Raises:
        CalibrationError: if it is none.
    """
    found = re.fullmatch(r"(\d{2,5})[xX×](\d{2,5})", text.strip())
    if found is None:
        raise CalibrationError(
            sentence("--size {size}: WIDTHxHEIGHT in pixels is needed, e.g. 1280x720", size=text)
        )
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
    lens: LensModel | None = None,
) -> StereoCalibration:
    """Read one calibration.

    Args:
        files: see the error message of `CalibrationError`; left before right.
        unit: metres in the board's unit; only TemugeB's and OpenCV's files need it.
        image_size: width, height [px]; only TemugeB's and OpenCV's files need it.
        names: of the cameras in the rig, for files of other programs.
        lens: model of both lenses; only OpenCV's files of fisheye cameras need it: they look like
            others.

    Raises:
        CalibrationError: if the files are not of a known format, or one is wrong: named.
        WorkerError: if the process that reads OpenCV's files cannot be started.
    """
    if len(files) == 1 and files[0].is_dir():
        return _text_files(files[0], unit, image_size, names)
    if len(files) not in (1, 2):
        raise CalibrationError(
            sentence(
                "{files} files were given; {expected}",
                files=len(files),
                expected=_EXPECTED,
            )
        )
    if any(is_storage(path) for path in files):
        return read_opencv(files, unit=unit, image_size=image_size, names=names, lens=lens)
    if len(files) == 1:
        return load_calibration(files[0])
    left, right = files
    kinds = {_is_ros(path) for path in files}
    if len(kinds) == 2:
        raise CalibrationError(
            sentence(
                "{left} and {right} are of different formats; {expected}",
                left=left,
                right=right,
                expected=_EXPECTED,
            )
        )
    return (read_ros if kinds.pop() else read_icube)(left, right, names)


def _is_ros(path: Path) -> bool:
    if path.suffix.lower() not in {".yaml", ".yml"}:
        raise CalibrationError(
            sentence("{path} is no YAML file; {expected}", path=path, expected=_EXPECTED)
        )
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
            sentence(
                "{folder}: TemugeB's files hold neither unit nor picture size; say them, e.g. "
                "--unit 1cm (the unit in which the board's square was typed) --size 1280x720",
                folder=folder,
            )
        )
    return read_temuge(left, right, unit=unit, image_size=image_size, names=names)
