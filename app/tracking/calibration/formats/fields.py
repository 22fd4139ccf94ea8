"""Fields of other programs' calibration files, each checked and named when it is wrong."""

from collections.abc import Mapping, Sequence
from math import isfinite
from pathlib import Path
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.configuration import read_yaml, shown
from app.core.errors import ConfigurationError
from app.core.messages import sentence, sentence_of
from app.core.transform import RigidTransform
from app.tracking.errors import CalibrationError

_ROUNDED: Final = 2e-3
"""How far a rotation matrix may be from orthonormal: files give four or five decimals."""

FARTHEST: Final = 1e3
"""Distance [m] that no camera of a pair has from the other."""

LARGEST_SIZE: Final = 20_000
"""Pixels; a larger picture is a mistake in the file."""


class Fields:
    """One YAML file of named fields.

    Args:
        path: of the file.

    Raises:
        CalibrationError: if it cannot be read or is no mapping.
    """

    def __init__(self, path: Path) -> None:
        self.path = path
        try:
            document = read_yaml(path)
        except ConfigurationError as error:
            raise CalibrationError(sentence_of(error)) from error
        if not isinstance(document, Mapping):
            raise CalibrationError(
                sentence(
                    "{path}: a file of names and values is needed, got {shown}",
                    path=path,
                    shown=shown(document),
                )
            )
        self._document: Mapping[Any, Any] = document

    def __contains__(self, key: str) -> bool:
        return key in self._document

    def text(self, key: str, valid: Sequence[str] = ()) -> str:
        """Return a text; one of `valid` if any are given."""
        value = self._value(key)
        if not isinstance(value, str) or (valid and value not in valid):
            wanted = f"one of {', '.join(valid)}" if valid else "a text"
            raise self.wrong(key, value, wanted)
        return value

    def size(self) -> tuple[int, int]:
        """Return image_width, image_height [px]."""
        return self._pixels("image_width"), self._pixels("image_height")

    def number(self, key: str) -> float | None:
        """Return `data` of a field that may be absent; negative ones are refused."""
        if key not in self._document:
            return None
        value = self._document[key]
        data: Any = value.get("data") if isinstance(value, Mapping) else value
        if not _is_number(data) or data < 0.0:
            raise self.wrong(key, data, sentence("a number of at least 0"))
        return float(data)

    def matrix(self, key: str, rows: int, columns: int) -> FloatArray:
        """Return the matrix of a field with rows, cols and data (row by row)."""
        value = self._value(key)
        if not isinstance(value, Mapping) or "data" not in value:
            raise self.wrong(
                key,
                value,
                sentence("rows: {rows}, cols: {columns} and data", rows=rows, columns=columns),
            )
        shape = value.get("rows", rows), value.get("cols", columns)
        if shape != (rows, columns):
            raise self.wrong(
                key,
                sentence("{rows} x {columns}", rows=shape[0], columns=shape[1]),
                sentence("{rows} rows of {columns}", rows=rows, columns=columns),
            )
        data = value["data"]
        if not isinstance(data, Sequence) or len(data) != rows * columns:
            count = len(data) if isinstance(data, Sequence) else 0
            raise self.wrong(
                f"{key}.data",
                sentence("{count} values", count=count),
                sentence("{rows} numbers", rows=rows * columns),
            )
        for number in data:
            if not _is_number(number):
                raise self.wrong(f"{key}.data", number, sentence("a finite number"))
        return np.array(data, dtype=np.float64).reshape(rows, columns)

    def row(self, key: str) -> list[float]:
        """Return the numbers of a matrix of one row, as many as there are."""
        value = self._value(key)
        data = value.get("data") if isinstance(value, Mapping) else None
        return self.matrix(key, 1, len(data) if isinstance(data, list) else 0)[0].tolist()

    def wrong(self, key: str, value: object, wanted: str) -> CalibrationError:
        """Return the error that names file, field, value and what is valid."""
        return CalibrationError(
            sentence(
                "{path}: {key}: {wanted} is needed, got {shown}",
                path=self.path,
                key=key,
                wanted=wanted,
                shown=shown(value),
            )
        )

    def _value(self, key: str) -> Any:
        if key not in self._document:
            there = ", ".join(str(name) for name in self._document) or "nothing"
            raise CalibrationError(
                sentence(
                    "{path}: {key} is missing; the file has {there}",
                    path=self.path,
                    key=key,
                    there=there,
                )
            )
        return self._document[key]

    def _pixels(self, key: str) -> int:
        value = self._value(key)
        if type(value) is not int or not 16 <= value <= LARGEST_SIZE:
            raise self.wrong(
                key,
                value,
                sentence(
                    "a whole number of pixels from 16 to {largest_size}", largest_size=LARGEST_SIZE
                ),
            )
        return value


def intrinsics(matrix: FloatArray, where: str) -> tuple[tuple[float, float], tuple[float, float]]:
    """Return focal lengths and centre [px] of a camera matrix, shape (3, 3).

    Raises:
        CalibrationError: if it is none, or has a skew, which is not supported.
    """
    (fx, skew, cx), (zero, fy, cy), last = matrix.tolist()
    if fx <= 0.0 or fy <= 0.0 or zero != 0.0 or last != [0.0, 0.0, 1.0]:
        raise CalibrationError(
            sentence(
                "{where}: fx 0 cx, 0 fy cy, 0 0 1 with positive focal lengths is needed, "
                "got {matrix}",
                where=where,
                matrix=matrix.tolist(),
            )
        )
    if abs(skew) > 1e-9 * fx:
        raise CalibrationError(
            sentence(
                "{where}: a skew of {skew} px is not supported; only 0 is", where=where, skew=skew
            )
        )
    return (fx, fy), (cx, cy)


def pose(matrix: FloatArray, unit: float, where: str) -> RigidTransform:
    """Return the transform of [R|t], shape (3, 4), with t in `unit` metres.

    The rotation's rounding is taken out: the nearest rotation is used.

    Raises:
        CalibrationError: if the first three columns are no rotation.
    """
    u, _, vt = np.linalg.svd(matrix[:, :3])
    rotation = u @ vt
    error = float(np.abs(rotation - matrix[:, :3]).max())
    if np.linalg.det(rotation) < 0.0 or error > _ROUNDED:
        raise CalibrationError(
            sentence(
                "{where}: the first three columns are no rotation matrix: they differ from one "
                "by {error:.3g} (at most {rounded:g}) or mirror; got {matrix}",
                where=where,
                error=error,
                rounded=_ROUNDED,
                matrix=matrix[:, :3].tolist(),
            )
        )
    translation = matrix[:, 3] * unit
    if np.abs(translation).max() > FARTHEST:
        raise CalibrationError(
            sentence(
                "{where}: its translation is {matrix} in units of {unit:g} m; cameras "
                "up to {farthest:g} m apart are read",
                where=where,
                matrix=matrix[:, 3].tolist(),
                unit=unit,
                farthest=FARTHEST,
            )
        )
    return RigidTransform(rotation, translation)


def _is_number(value: Any) -> bool:
    return isinstance(value, int | float) and not isinstance(value, bool) and isfinite(value)
