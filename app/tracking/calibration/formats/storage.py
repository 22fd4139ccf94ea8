"""Matrices of OpenCV's FileStorage files (YAML, XML, JSON), read without OpenCV.

OpenCV's own parser frees memory twice on damaged files and ends the program with it; these files
come from elsewhere. What is read here is the part of the format that calibrations use: named
matrices at the top, each with rows, cols, dt and data row by row.
"""

import json
import re
import xml.etree.ElementTree as ET
from collections.abc import Mapping
from math import isfinite
from pathlib import Path
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.configuration import LARGEST_FILE, parse_yaml, shown
from app.core.errors import ConfigurationError
from app.tracking.errors import CalibrationError

_TYPE: Final = "opencv-matrix"
_YAML_TAG: Final = re.compile(r"!!opencv-matrix\b")
_KIND: Final = re.compile(r"\(?(\d{0,2})[ucwsifdh]\)?")
"""dt: how many numbers each element has (1 if left out), and which type they had in memory."""

_NUMBER: Final = re.compile(r"[-+]?(\d+\.?\d*|\.\d+)([eE][-+]?\d+)?")
_MOST: Final = 10_000
"""Numbers of a matrix; a calibration's have at most 16."""


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
            f"cannot read {path}: {error.strerror or error}; check its name and that it may be read"
        ) from error
    heads = (b"%YAML:1.0", b"<?xml", b"<opencv_storage")
    return head.startswith(heads) or _TYPE.encode() in head  # OpenCV 5 begins as any other YAML


def read_matrices(path: Path, keys: tuple[str, ...]) -> dict[str, FloatArray]:
    """Read those of the named matrices that a file holds.

    Returns:
        Matrices of shape (rows, cols); elements of several numbers stand side by side.

    Raises:
        CalibrationError: naming the file, the matrix and what is wrong.
    """
    document = _document(path)
    if not isinstance(document, Mapping):
        raise CalibrationError(f"{path}: a file of named matrices is needed; it names none")
    return {key: _matrix(f"{path}: {key}", document[key]) for key in keys if key in document}


def _document(path: Path) -> Any:
    damaged = f"{path} begins as a file of OpenCV's FileStorage but is damaged"
    try:
        with path.open("rb") as file:
            data = file.read(LARGEST_FILE + 1)
        if len(data) > LARGEST_FILE:
            raise CalibrationError(
                f"{path} is larger than {LARGEST_FILE >> 20} MB; a calibration is not"
            )
        text = data.decode("utf-8")
        if text.lstrip().startswith("<"):
            return _xml(text)
        if text.lstrip().startswith("{"):
            return json.loads(text)
        lines = text.lstrip().splitlines()
        if lines and lines[0].startswith("%YAML"):  # `%YAML:1.0` is no directive of YAML's own
            lines = lines[1:]
        return parse_yaml(_YAML_TAG.sub("", "\n".join(lines)), str(path))
    except OSError as error:
        raise CalibrationError(f"cannot read {path}: {error.strerror or error}") from error
    except ConfigurationError as error:
        raise CalibrationError(f"{error}; write it again") from error
    except (ValueError, ET.ParseError, RecursionError) as error:
        reason = " ".join(str(error).split())[:200]
        raise CalibrationError(f"{damaged} ({reason}); write it again") from error


def _xml(text: str) -> dict[str, Any]:
    """Matrices of an XML file as the YAML has them."""
    if "<!" in re.sub(r"<!--.*?-->", "", text, flags=re.DOTALL):
        raise ValueError("declarations and entities are not read")
    root = ET.fromstring(text)  # no declarations, so no entities
    if root.tag != "opencv_storage":
        raise ValueError(f"its outermost element is {root.tag!r}, not 'opencv_storage'")
    found: dict[str, Any] = {}
    for node in root:
        if node.tag in found:
            raise ValueError(f"{node.tag} is given twice")
        fields: dict[str, Any] = {child.tag: (child.text or "").strip() for child in node}
        if "data" in fields:
            fields["data"] = fields["data"].split()
        found[node.tag] = fields
    return found


def _matrix(where: str, node: Any) -> FloatArray:
    if not isinstance(node, Mapping) or not {"rows", "cols", "dt", "data"} <= set(node):
        raise CalibrationError(f"{where}: a matrix with rows, cols, dt and data is needed")
    kind = _KIND.fullmatch(node["dt"]) if isinstance(node["dt"], str) else None
    if kind is None:
        raise CalibrationError(
            f"{where}: dt names the numbers' type, e.g. d; got {node['dt']!r:.40}"
        )
    rows, columns = (_count(where, key, node[key]) for key in ("rows", "cols"))
    columns *= int(kind[1] or 1)
    data = node["data"]
    if isinstance(data, str | bytes):
        raise CalibrationError(f"{where}: data in base64 is not read; write it as numbers")
    if not isinstance(data, list) or len(data) != rows * columns:
        count = f"{len(data)} values" if isinstance(data, list) else "none"
        raise CalibrationError(f"{where}: {rows} x {columns} numbers are needed, got {count}")
    numbers = [_number(where, value) for value in data]
    return np.array(numbers, dtype=np.float64).reshape(rows, columns)


def _count(where: str, key: str, value: Any) -> int:
    text = str(value) if isinstance(value, int | str) and not isinstance(value, bool) else ""
    if not re.fullmatch(r"\d{1,4}", text) or not 1 <= int(text) <= _MOST:
        raise CalibrationError(f"{where}: {key}: a whole number from 1 is needed")
    return int(text)


def _number(where: str, value: Any) -> float:
    if isinstance(value, str) and _NUMBER.fullmatch(value):  # 1e5 is a text to YAML 1.1
        value = float(value)
    if isinstance(value, bool) or not isinstance(value, int | float) or not _is_finite(value):
        raise CalibrationError(f"{where}: a matrix of finite numbers is needed, got {shown(value)}")
    return float(value)


def _is_finite(value: float) -> bool:
    try:
        return isfinite(value)
    except OverflowError:  # a whole number beyond any float
        return False
