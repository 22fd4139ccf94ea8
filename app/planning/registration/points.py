"""Points that were touched or picked, by name, and the files they come in."""

import csv
import io
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np

from app.core.arrays import FloatArray, frozen
from app.core.configuration import read_yaml
from app.core.units import MILLIMETRE
from app.planning.registration.errors import RegistrationError
from app.planning.registration.rigid import checked_points


@dataclass(frozen=True, slots=True, eq=False)
class NamedPoints:
    """Fiducials as they were found in one frame.

    Attributes:
        names: of the fiducials, each once.
        points: in the frame of whoever made them: world for touches, LPS for picks [m], (n, 3).
        covariances: of each point [m²], shape (n, 3, 3); zero where nobody stated one.

    Raises:
        RegistrationError: if a name comes twice, or a point is not finite.
    """

    names: tuple[str, ...]
    points: FloatArray
    covariances: FloatArray

    def __post_init__(self) -> None:
        object.__setattr__(self, "points", checked_points(self.points, "given"))
        shape = (len(self.names), 3, 3)
        object.__setattr__(self, "covariances", frozen(self.covariances, shape, "covariances"))
        if len(self.points) != len(self.names):
            raise RegistrationError(f"{len(self.names)} names for {len(self.points)} points")
        for name in self.names:
            if self.names.count(name) > 1:
                raise RegistrationError(f"fiducial {name!r} is given twice; keep one of them")

    @property
    def stated(self) -> bool:
        """Whether every point came with a covariance."""
        return bool(len(self.names)) and bool(
            (np.trace(self.covariances, axis1=1, axis2=2) > 0.0).all()
        )


def read_points(path: Path) -> NamedPoints:
    """Read points from CSV or YAML, millimetres.

    CSV: a header `name,x_mm,y_mm,z_mm`, optionally `sd_mm` (standard deviation per axis). YAML: a
    mapping of names to `[x, y, z]`.

    Raises:
        RegistrationError: naming the file, the line and what is needed.
        ConfigurationError: if the YAML cannot be read.
    """
    rows = _from_yaml(path) if path.suffix in (".yaml", ".yml") else _from_csv(path)
    if not rows:
        raise RegistrationError(f"{path} holds no points")
    names, points, deviations = zip(*rows, strict=True)
    variances = (np.array(deviations) * MILLIMETRE) ** 2
    return NamedPoints(names, np.array(points) * MILLIMETRE, variances[:, None, None] * np.eye(3))


_Row = tuple[str, list[float], float]


def _from_csv(path: Path) -> list[_Row]:
    try:
        text = path.read_text(encoding="utf-8-sig")
    except OSError as error:
        raise RegistrationError(f"cannot read {path}: {error.strerror or error}") from error
    except UnicodeDecodeError as error:
        raise RegistrationError(
            f"{path} is no text; give a CSV file with the header name,x_mm,y_mm,z_mm, or YAML"
        ) from error
    reader = csv.DictReader(io.StringIO(text), skipinitialspace=True)
    missing = [k for k in ("name", "x_mm", "y_mm", "z_mm") if k not in (reader.fieldnames or ())]
    if missing:
        raise RegistrationError(
            f"{path}: column {missing[0]} is missing; the first line must be "
            "name,x_mm,y_mm,z_mm and may add sd_mm"
        )
    return [_row(path, f"line {reader.line_num}", row) for row in reader]


def _row(path: Path, where: str, row: dict[str, Any]) -> _Row:
    values = [_number(path, where, row[key]) for key in ("x_mm", "y_mm", "z_mm")]
    deviation = _number(path, where, row.get("sd_mm") or 0.0)
    if deviation < 0.0:
        raise RegistrationError(f"{path}, {where}: sd_mm {deviation:g} is negative")
    return str(row["name"]).strip(), values, deviation


def _from_yaml(path: Path) -> list[_Row]:
    document = read_yaml(path)
    if not isinstance(document, dict):
        raise RegistrationError(f"{path}: a mapping of names to [x, y, z] in mm is needed")
    rows = []
    for name, value in document.items():
        if not isinstance(value, list) or len(value) != 3:
            raise RegistrationError(f"{path}, {name}: [x, y, z] in mm is needed, got {value!r}")
        rows.append((str(name), [_number(path, str(name), v) for v in value], 0.0))
    return rows


def _number(path: Path, where: str, text: object) -> float:
    try:
        value = float(str(text))
    except ValueError as error:
        raise RegistrationError(f"{path}, {where}: {text!r} is not a number") from error
    if not np.isfinite(value):
        raise RegistrationError(f"{path}, {where}: {text!r} is not finite")
    return value
