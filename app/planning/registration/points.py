"""Points that were touched or picked, by name, and the files they come in.

In a CT a picked point is the centre of a bright bead, finer than a voxel, from a click near it.
"""

import csv
import io
from dataclasses import dataclass
from pathlib import Path
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray, frozen
from app.core.configuration import read_yaml
from app.core.files import read_at_most
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.imaging.errors import BeadError, OutsideImageError
from app.imaging.volume import Volume
from app.planning.registration.errors import RegistrationError
from app.planning.registration.rigid import checked_points

LEAST_CONTRAST = 150.0
"""A bead is this much brighter than what surrounds it [HU]; soft tissue against air is no bead."""
_STEPS = 20
_CONVERGED = 1e-3


@dataclass(frozen=True, slots=True, eq=False)
class Bead:
    """A bead as the CT shows it.

    Attributes:
        centre_mm: patient LPS, shape (3,).
        contrast: brightest voxel above the surroundings [HU].
        diameter_mm: of a ball with the volume at half the contrast; blur and metal widen it.
        moved_mm: from the click to the centre.
    """

    centre_mm: FloatArray
    contrast: float
    diameter_mm: float
    moved_mm: float


def find_bead(volume: Volume, near_mm: ArrayLike, diameter_mm: float) -> Bead:
    """Find the bead that was clicked: its intensity-weighted centroid above the surroundings.

    The brightest voxel within one and a half diameters of the click is the seed. Its connected
    part above half the contrast must have the size of the bead; then the centroid of what stands
    above the surroundings is taken in a ball round the centre until the centre stays. The ball
    holds the blur's tails, so that partial volume does not pull the centre to voxels.

    Args:
        volume: the CT.
        near_mm: the click, patient LPS [mm], shape (3,).
        diameter_mm: of the bead.

    Raises:
        OutsideImageError: if the click lies outside the CT.
        BeadError: if there is nothing bright, or what is bright is not a bead of that size, or it
            reaches the edge of the CT.
    """
    click = frozen(near_mm, (3,), "near_mm")
    if not volume.contains(click):
        raise OutsideImageError(
            sentence("the point {point} lies outside the CT: click a slice", point=_text(click))
        )
    search = 1.5 * diameter_mm + float(volume.spacing_mm.max())
    reach = 0.5 * diameter_mm + 1.5 * float(volume.spacing_mm.max())
    box = _Crop.around(volume, click, search + reach + 0.5 * diameter_mm)
    distance = np.linalg.norm(box.points - click, axis=-1)
    background = float(np.median(box.hu))
    near = np.where(distance <= search, box.hu, -np.inf)
    seed = np.unravel_index(int(np.argmax(near)), near.shape)
    contrast = float(box.hu[seed]) - background
    if contrast < LEAST_CONTRAST:
        raise BeadError(
            sentence(
                "no bead within {search:.1f} mm of {point}: the brightest voxel is "
                "{contrast:.0f} HU above its surroundings, {least_contrast:.0f} are needed",
                search=search,
                point=_text(click),
                contrast=contrast,
                least_contrast=LEAST_CONTRAST,
            )
        )
    diameter = _diameter(box, seed, background + 0.5 * contrast)
    _require_size(diameter, diameter_mm, float(volume.spacing_mm.max()), click)
    centre = _centroid(box, box.points[seed], background, reach)
    if box.clipped and not _inside(volume, centre, reach):
        raise BeadError(
            sentence(
                "the bead at {centre} reaches the edge of the CT: use another one",
                centre=_text(centre),
            )
        )
    return Bead(frozen(centre), contrast, diameter, float(np.linalg.norm(centre - click)))


@dataclass(frozen=True, slots=True, eq=False)
class _Crop:
    """Part of a volume: values (k, j, i), patient points (k, j, i, 3) [mm], volume of a voxel."""

    hu: FloatArray
    points: FloatArray
    voxel_mm3: float
    clipped: bool

    @classmethod
    def around(cls, volume: Volume, centre_mm: FloatArray, radius_mm: float) -> "_Crop":
        middle, half = volume.voxel(centre_mm), radius_mm * volume.voxels_per_mm
        wanted = np.floor(middle - half), np.ceil(middle + half) + 1
        low = np.maximum(wanted[0], 0).astype(int)
        high = np.minimum(wanted[1], volume.size).astype(int)
        i, j, k = (np.arange(low[a], high[a]) for a in range(3))
        hu: NDArray[Any] = volume.hu[low[2] : high[2], low[1] : high[1], low[0] : high[0]]
        grid = np.stack(np.meshgrid(k, j, i, indexing="ij")[::-1], axis=-1)
        clipped = bool((low > wanted[0]).any() or (high < wanted[1]).any())
        size = float(abs(np.linalg.det(volume.affine_mm[:3, :3])))
        return cls(hu.astype(np.float64), volume.lps_mm(grid), size, clipped)


def _diameter(box: _Crop, seed: tuple[Any, ...], level: float) -> float:
    """Diameter [mm] of a ball as large as the part above `level` that holds the seed."""
    from scipy.ndimage import label

    parts, _ = label(box.hu >= level)
    count = int(np.count_nonzero(parts == parts[seed]))
    return float((6.0 / np.pi * count * box.voxel_mm3) ** (1.0 / 3.0))


def _require_size(result: float, wanted: float, voxel: float, at: FloatArray) -> None:
    largest = 1.6 * wanted + voxel
    if result > largest:
        raise BeadError(
            sentence(
                "what is bright at {point} is {measured_mm:.1f} mm across, a bead is "
                "{bead_mm:.1f} mm "
                "(at most {largest_mm:.1f} mm in this CT): bone, or two beads; click on a bead",
                point=_text(at),
                measured_mm=result,
                bead_mm=wanted,
                largest_mm=largest,
            )
        )


def _centroid(box: _Crop, start: FloatArray, background: float, reach: float) -> FloatArray:
    centre = start
    for _ in range(_STEPS):
        weight = np.where(np.linalg.norm(box.points - centre, axis=-1) <= reach, box.hu, background)
        weight = np.maximum(weight - background, 0.0)
        following = np.tensordot(weight, box.points, axes=3) / weight.sum()
        moved = float(np.linalg.norm(following - centre))
        centre = following
        if moved < _CONVERGED:
            break
    return centre


def _inside(volume: Volume, centre: FloatArray, reach: float) -> bool:
    corners = volume.voxel(centre), reach * volume.voxels_per_mm
    low, high = corners[0] - corners[1], corners[0] + corners[1]
    return bool((low >= -0.5).all() and (high <= np.array(volume.size) - 0.5).all())


def _text(point_mm: FloatArray) -> str:
    return "(" + ", ".join(f"{value:.1f}" for value in point_mm) + ") mm"


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
            raise RegistrationError(
                sentence(
                    "{names} names for {points} points",
                    names=len(self.names),
                    points=len(self.points),
                )
            )
        for name in self.names:
            if self.names.count(name) > 1:
                raise RegistrationError(
                    sentence("fiducial {name!r} is given twice; keep one of them", name=name)
                )

    @property
    def stated(self) -> bool:
        """Return whether every point came with a covariance."""
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
        raise RegistrationError(sentence("{path} holds no points", path=path))
    names, points, deviations = zip(*rows, strict=True)
    variances = (np.array(deviations) * MILLIMETRE) ** 2
    return NamedPoints(names, np.array(points) * MILLIMETRE, variances[:, None, None] * np.eye(3))


_Row = tuple[str, list[float], float]


def _from_csv(path: Path) -> list[_Row]:
    try:
        text = read_at_most(path).decode("utf-8-sig")
    except OSError as error:
        raise RegistrationError(
            sentence(
                "cannot read {path}: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    except UnicodeDecodeError as error:
        raise RegistrationError(
            sentence(
                "{path} is no text; give a CSV file with the header name,x_mm,y_mm,z_mm, or YAML",
                path=path,
            )
        ) from error
    reader = csv.DictReader(io.StringIO(text), skipinitialspace=True)
    missing = [k for k in ("name", "x_mm", "y_mm", "z_mm") if k not in (reader.fieldnames or ())]
    if missing:
        raise RegistrationError(
            sentence(
                "{path}: column {column} is missing; the first line must be "
                "name,x_mm,y_mm,z_mm and may add sd_mm",
                path=path,
                column=missing[0],
            )
        )
    return [_row(path, f"line {reader.line_num}", row) for row in reader]


def _row(path: Path, where: str, row: dict[str, Any]) -> _Row:
    values = [_number(path, where, row[key]) for key in ("x_mm", "y_mm", "z_mm")]
    deviation = _number(path, where, row.get("sd_mm") or 0.0)
    if deviation < 0.0:
        raise RegistrationError(
            sentence(
                "{path}, {where}: sd_mm {deviation:g} is negative",
                path=path,
                where=where,
                deviation=deviation,
            )
        )
    return str(row["name"]).strip(), values, deviation


def _from_yaml(path: Path) -> list[_Row]:
    document = read_yaml(path)
    if not isinstance(document, dict):
        raise RegistrationError(
            sentence("{path}: a mapping of names to [x, y, z] in mm is needed", path=path)
        )
    rows = []
    for name, value in document.items():
        if not isinstance(value, list) or len(value) != 3:
            raise RegistrationError(
                sentence(
                    "{path}, {name}: [x, y, z] in mm is needed, got {entry!r}",
                    path=path,
                    name=name,
                    entry=value,
                )
            )
        rows.append((str(name), [_number(path, str(name), v) for v in value], 0.0))
    return rows


def _number(path: Path, where: str, text: object) -> float:
    try:
        value = float(str(text))
    except ValueError as error:
        raise RegistrationError(
            sentence(
                "{path}, {where}: {entry!r} is not a number", path=path, where=where, entry=text
            )
        ) from error
    if not np.isfinite(value):
        raise RegistrationError(
            sentence("{path}, {where}: {entry!r} is not finite", path=path, where=where, entry=text)
        )
    return value
