"""Matrices of OpenCV's FileStorage files (YAML, XML, JSON), read by OpenCV in the worker process.

These files come from elsewhere, and OpenCV's parser ends the process that it runs in on some of
them (a list nested half a million deep, for one). What is read is the part of the format that
calibrations use: named matrices at the top, each with rows, cols, dt and data row by row. OpenCV
takes the first of two of the same name and stops at a control character; both are refused here.
"""

import re
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Annotated

import numpy as np

from app.core.arrays import FloatArray
from app.core.configuration import LARGEST_FILE, shown
from app.core.errors import AcusError
from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.errors import FileDamagedError, WorkerLostError
from app.imaging.worker.jobs import Job
from app.imaging.worker.limits import PACKAGE_SECONDS, for_file, size_of
from app.imaging.worker.pool import shared_worker
from app.imaging.worker.values import ATTACHED
from app.tracking.errors import CalibrationError

if TYPE_CHECKING:
    import cv2

_HEADS = (b"%YAML:1.0", b"<?xml", b"<opencv_storage")
_TYPE = b"opencv-matrix"
_FIELDS = ("rows", "cols", "dt", "data")
_KIND = re.compile(r"\(?(\d{0,2})[ucwsifdh]\)?")
"""dt: how many numbers each element has (1 if left out), and which type they had in memory."""

_MOST = 10_000
"""Numbers of a matrix; a calibration's have at most 16."""

_WHOLE = 2**53
"""Whole numbers from here on are not exact any more; OpenCV cuts those off that it cannot hold."""

_CONTROL = re.compile(r"[\0-\x08\x0b\x0c\x0e-\x1f\x7f]")
_PARSER = re.compile(r"\((\d+)\): ([^()\n]{1,100})$")
"""How OpenCV's parser ends a complaint: with the line, and what is wrong with it."""

Matrices = tuple[tuple[str, Annotated[FloatArray, ATTACHED]], ...]
MATRICES: Job[Matrices] = Job("app.tracking.calibration.formats.storage:matrices_in", Matrices)


def is_storage(path: Path) -> bool:
    """Return whether a file is one of FileStorage, by its beginning.

    Raises:
        CalibrationError: if it cannot be read.
    """
    try:
        with path.open("rb") as file:
            head = file.read(4096).lstrip()
    except OSError as error:
        raise CalibrationError(
            sentence(
                "cannot read {path}: {error_strerror}; check its name and that it may be read",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    return head.startswith(_HEADS) or _TYPE in head  # OpenCV 5 begins as any other YAML


def read_matrices(path: Path, keys: tuple[str, ...]) -> dict[str, FloatArray]:
    """Read those of the named matrices that a file holds, in the worker process.

    Returns:
        Matrices of shape (rows, cols); elements of several numbers stand side by side.

    Raises:
        CalibrationError: naming the file, the matrix and what is wrong, or how the file ended the
            process that read it.
    """
    allowed = for_file(size_of(path), least=PACKAGE_SECONDS)
    try:
        arguments = (path.absolute(), keys)
        found: Matrices = shared_worker().call(MATRICES, arguments, allowed, Progress())
    except WorkerLostError as error:
        raise CalibrationError(
            sentence("{path}: {error}; write it again", path=path, error=error)
        ) from error
    except FileDamagedError as error:
        raise CalibrationError(sentence("{path}: {error}", path=path, error=error)) from error
    except OSError as error:
        if isinstance(error, AcusError):
            raise
        raise CalibrationError(
            sentence(
                "cannot read {path}: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    return dict(found)


def matrices_in(path: Path, keys: tuple[str, ...], progress: Progress) -> Matrices:
    """Read the named matrices of a file; in the worker process.

    Raises:
        CalibrationError: naming the matrix and what is wrong, but not the file.
        OSError: if it cannot be read.
    """
    import cv2

    with path.open("rb") as file:
        data = file.read(LARGEST_FILE + 1)
    if len(data) > LARGEST_FILE:
        raise CalibrationError(
            sentence(
                "it is larger than {largest_file} MB; a calibration is not",
                largest_file=LARGEST_FILE >> 20,
            )
        )
    storage = cv2.FileStorage()
    try:
        text = data.decode("utf-8")
        if _CONTROL.search(text):
            raise ValueError(sentence("control characters are not read"))
        storage.open(text, cv2.FILE_STORAGE_READ | cv2.FILE_STORAGE_MEMORY)
        top = _fields(storage.root())
        progress.check()
        return tuple((key, _matrix(key, top[key])) for key in keys if key in top)
    except (ValueError, cv2.error) as error:
        reason = _PARSER.search(getattr(error, "func", ""))
        words = f"line {reason[1]}: {reason[2]}" if reason else _line(error)
        raise CalibrationError(
            sentence(
                "it begins as a file of OpenCV's FileStorage but is damaged ({fault}); write it "
                "again",
                fault=words,
            )
        ) from error
    finally:
        storage.release()


def _line(error: Exception) -> str:
    text = sentence("OpenCV cannot read it") if hasattr(error, "func") else str(error)
    return " ".join(text.split())[:200]


def _fields(node: "cv2.FileNode") -> "dict[str, cv2.FileNode]":
    """Return what stands in a node by name; nothing if it is no mapping."""
    names = node.keys() if node.isMap() else ()
    twice = [name for place, name in enumerate(names) if name in names[:place]]
    if twice:
        raise ValueError(sentence("{double_name} is given twice", double_name=twice[0][:40]))
    return {name: node.getNode(name) for name in names}


def _matrix(key: str, node: "cv2.FileNode") -> FloatArray:
    fields = _fields(node)
    if not set(_FIELDS) <= set(fields):
        raise CalibrationError(
            sentence("{key}: a matrix with rows, cols, dt and data is needed", key=key)
        )
    dt = _value(fields["dt"])
    kind = _KIND.fullmatch(dt) if isinstance(dt, str) else None
    if kind is None:
        raise CalibrationError(
            sentence(
                "{key}: dt names the numbers' type, e.g. d; got {shown}", key=key, shown=shown(dt)
            )
        )
    rows, columns = (_count(f"{key}: {name}", fields[name]) for name in ("rows", "cols"))
    columns *= int(kind[1] or 1)
    data = fields["data"]
    if rows * columns > _MOST:
        raise CalibrationError(
            sentence(
                "{key}: {rows} x {columns} numbers; at most {most} are read",
                key=key,
                rows=rows,
                columns=columns,
                most=_MOST,
            )
        )
    count = data.size() if data.isSeq() else 0
    if count != rows * columns:
        raise CalibrationError(
            sentence(
                "{key}: {rows} x {columns} numbers are needed, got {count} values",
                key=key,
                rows=rows,
                columns=columns,
                count=count,
            )
        )
    numbers = [_number(key, data.at(place)) for place in range(count)]
    return np.array(numbers, dtype=np.float64).reshape(rows, columns)


def _count(where: str, node: "cv2.FileNode") -> int:
    if not node.isInt() or not 1 <= node.real() <= _MOST:
        raise CalibrationError(
            sentence("{where}: a whole number from 1 to {most} is needed", where=where, most=_MOST)
        )
    return int(node.real())


def _number(key: str, node: "cv2.FileNode") -> float:
    value = _value(node)
    if not isinstance(value, float) or not isfinite(value):
        raise CalibrationError(
            sentence(
                "{key}: a matrix of finite numbers is needed, got {shown}",
                key=key,
                shown=shown(value),
            )
        )
    if node.isInt() and abs(value) >= _WHOLE:
        raise CalibrationError(
            sentence(
                "{key}: a whole number is too large, got {length:.0f} or more",
                key=key,
                length=value,
            )
        )
    return value


def _value(node: "cv2.FileNode") -> float | str | list[str]:
    """Return a number, a text, or for what is neither its names."""
    if node.isString():
        return str(node.string())
    return float(node.real()) if node.isReal() or node.isInt() else list(node.keys())
