"""The tissue field: which tissue lies where in the patient, and where in a voxel it ends.

Each voxel has the code of its tissue and the distance of its centre from the nearest boundary of
that tissue, without a sign. Between voxels one rule holds, for scoring, pictures and loop alike.

**The rule.** A point has eight corners, the voxels around it, with their trilinear weights w, codes
and distances d. For every code A among the corners

    s_A = sum of w * (+d where the corner is A, -d where it is not).

The A of the largest s is the tissue there; of equal ones, that of the first corner in the order of
(k, j, i). B, of the second largest, is the tissue on the other side of the nearest wall. The wall
lies where s_A = s_B, about (s_A - s_B) / 2 from the point, and its unit normal, out of A into B, is
the negative gradient of s_A - s_B. Where all corners are A, there is no B: the wall is s_A away,
as far as a distance reaches. A point beyond the outermost centres of voxels is unknown, code 0.

For a flat wall between two tissues the rule is exact but for the steps of the distances; labels
alone would put it half a voxel off, and its normal by tens of degrees.
"""

from __future__ import annotations

import hashlib
import json
from collections.abc import Iterator
from dataclasses import asdict, dataclass
from enum import StrEnum
from functools import cached_property
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray, frozen
from app.core.messages import sentence
from app.imaging.field.errors import FieldError
from app.imaging.field.tissue_words import tissue_words

STEPS_PER_MM: Final = 40.0
"""Distances are stored in steps of 1/40 mm."""

FARTHEST: Final = 127
"""Largest stored distance, 3.175 mm: so far or farther."""

FARTHEST_MM: Final = FARTHEST / STEPS_PER_MM

UNKNOWN: Final = 0
"""Code of what nobody labelled, and of all beyond the field: neither safe nor failed."""

MOST_TISSUES: Final = 256

_FAR_MM = 1e12  # beyond every field
_CHUNK: Final = 20_000  # points that are looked up at a time


class TissueKind(StrEnum):
    """What a voxel is made of."""

    UNKNOWN = "unknown"
    AIR = "air"
    LUNG = "lung"
    SKIN = "skin"
    FAT = "fat"
    MUSCLE = "muscle"
    ORGAN = "organ"
    VESSEL = "vessel"
    GUT = "gut"
    HEART = "heart"
    BONE = "bone"


@dataclass(frozen=True, slots=True)
class FieldTissue:
    """One tissue of a field; its place in the table is its code.

    Attributes:
        code: of its voxels.
        kind: what it is; with the name the key of a table of values.
        name: "liver", "rib", "aorta"; empty where nobody named it.
        confidence: that a voxel of it is what it says, 0 to 1.
        source: "structure", "recipe", "HU" or the like: who says so.
    """

    code: int
    kind: TissueKind
    name: str = ""
    confidence: float = 1.0
    source: str = ""

    @property
    def words(self) -> str:
        """Return it for people: the name, else the kind."""
        return tissue_words(self.name or self.kind.value)


NOBODYS: Final = FieldTissue(UNKNOWN, TissueKind.UNKNOWN, "", 0.0, "")
"""What stands at code 0 of every field."""


@dataclass(frozen=True, slots=True, eq=False)
class Lookup:
    """Points looked up in a field, arrays of length n.

    Attributes:
        code: of the tissue there, shape (n,).
        other: code beyond the nearest wall; -1 where no corner of the voxel has another.
        wall_mm: distance of that wall, shape (n,).
        normal: of the wall, out of the tissue into the other, LPS, unit, shape (n, 3); zero
            without another.
    """

    code: NDArray[np.intp]
    other: NDArray[np.intp]
    wall_mm: FloatArray
    normal: FloatArray


@dataclass(frozen=True, eq=False)
class TissueField:
    """Labels of a patient's tissues on a grid; patient data.

    Attributes:
        labels: code of each voxel, uint8, shape (nz, ny, nx), C order, read-only.
        distance: of its centre from the nearest boundary of its tissue in 1/40 mm, at most 127,
            int8, same shape, read-only.
        affine_mm: voxel (i, j, k) -> LPS [mm], shape (4, 4), read-only.
        tissues: the table; row = code, row 0 is unknown.
        notes: what a user should know of how it was made, a line each.

    Raises:
        FieldError: if the arrays do not fit each other, or a code has no row.
    """

    labels: NDArray[np.uint8]
    distance: NDArray[np.int8]
    affine_mm: FloatArray
    tissues: tuple[FieldTissue, ...]
    notes: tuple[str, ...] = ()

    def __post_init__(self) -> None:
        shapes = {self.labels.shape, self.distance.shape}
        if len(shapes) > 1 or self.labels.ndim != 3 or min(self.labels.shape) < 2:
            raise FieldError(
                sentence(
                    "labels of {labels_shape}, distances of {distance_shape} voxels: both "
                    "need one shape (nz, ny, nx) of two voxels at least",
                    labels_shape=self.labels.shape,
                    distance_shape=self.distance.shape,
                )
            )
        if self.labels.dtype != np.uint8 or self.distance.dtype != np.int8:
            raise FieldError(
                sentence(
                    "labels are {labels_dtype} and distances {distance_dtype}; uint8 and "
                    "int8 are needed",
                    labels_dtype=self.labels.dtype,
                    distance_dtype=self.distance.dtype,
                )
            )
        codes = tuple(tissue.code for tissue in self.tissues)
        if codes != tuple(range(len(codes))) or not 1 <= len(codes) <= MOST_TISSUES:
            raise FieldError(
                sentence(
                    "the table of tissues has the codes {codes}; row = code is needed", codes=codes
                )
            )
        if self.tissues[0].kind is not TissueKind.UNKNOWN:
            raise FieldError(
                sentence(
                    "code 0 is {tissues_first_words}; it must be unknown",
                    tissues_first_words=self.tissues[0].words,
                )
            )
        largest = int(self.labels.max())
        if largest >= len(codes):
            raise FieldError(
                sentence(
                    "label {largest} has no row in the table of {tissues} tissues",
                    largest=largest,
                    tissues=len(codes),
                )
            )
        if int(self.distance.min()) < 0:
            raise FieldError(sentence("a distance is negative; they have no sign"))
        affine = frozen(self.affine_mm, (4, 4), "affine_mm")
        if abs(np.linalg.det(affine[:3, :3])) < 1e-12:
            raise FieldError(sentence("affine_mm {affine} is singular", affine=affine.tolist()))
        object.__setattr__(self, "affine_mm", affine)
        for name in ("labels", "distance"):
            array = np.ascontiguousarray(getattr(self, name))
            array.setflags(write=False)
            object.__setattr__(self, name, array)

    @cached_property
    def inverse_mm(self) -> FloatArray:
        """LPS [mm] -> voxel (i, j, k), shape (4, 4)."""
        return frozen(np.linalg.inv(self.affine_mm))

    @cached_property
    def spacing_mm(self) -> FloatArray:
        """Distance between voxels along i, j and k, shape (3,)."""
        return frozen(np.linalg.norm(self.affine_mm[:3, :3], axis=0))

    @property
    def megabytes(self) -> float:
        """Memory of its two arrays [MB]."""
        return (self.labels.nbytes + self.distance.nbytes) / 1e6

    @cached_property
    def digest(self) -> str:
        """SHA-256 of all of it, in hexadecimal."""
        whole = hashlib.sha256(json.dumps(self.header(), sort_keys=True).encode())
        whole.update(self.labels.data)
        whole.update(self.distance.data)
        return whole.hexdigest()

    def header(self) -> dict[str, Any]:
        """Return all but the arrays as JSON-ready values."""
        return {
            "shape": list(self.labels.shape),
            "affine_mm": [float(number) for number in self.affine_mm.ravel()],
            "tissues": [asdict(tissue) for tissue in self.tissues],
            "notes": list(self.notes),
        }

    def of_kind(self, *kinds: TissueKind) -> tuple[FieldTissue, ...]:
        """Return the tissues of some kinds."""
        return tuple(tissue for tissue in self.tissues if tissue.kind in kinds)

    def look_up(self, points_mm: ArrayLike) -> Lookup:
        """Look patient points [mm] up by the rule above, shape (n, 3) or (3,)."""
        points = np.asarray(points_mm, np.float64).reshape(-1, 3)
        parts = [self._looked_up(part) for part in _chunks(points)]
        columns: list[Any] = [np.concatenate(column) for column in zip(*parts, strict=True)]
        return Lookup(*columns)

    def codes_at(self, points_mm: ArrayLike) -> NDArray[np.intp]:
        """Return the codes of the tissues at patient points [mm], shape (n, 3) -> (n,)."""
        return self.look_up(points_mm).code

    def _looked_up(self, points: FloatArray) -> tuple[NDArray[Any], ...]:
        points = np.where(np.abs(points) < _FAR_MM, points, _FAR_MM)  # NaN and what overflows too
        ijk = points @ self.inverse_mm[:3, :3].T + self.inverse_mm[:3, 3]
        last = np.array(self.labels.shape[::-1]) - 1.0
        inside = np.asarray(((ijk >= 0.0) & (ijk <= last)).all(axis=1))  # beyond it is outside
        at = np.where(inside[:, None], ijk, 0.0)
        base = np.minimum(np.floor(at), last - 1.0).astype(np.intp)
        labels, distance, weights, slopes = self._corners(base, at - base)
        same = labels[:, :, None] == labels[:, None, :]  # corner whose code, corner summed
        signed = np.where(same, distance[:, None, :], -distance[:, None, :])
        sums = (signed * weights[:, None, :]).sum(axis=2)
        rows = np.arange(len(points))
        first = sums.argmax(axis=1)
        own = same[rows, first]
        second = np.where(own, -np.inf, sums).argmax(axis=1)
        alone = own.all(axis=1)
        code = np.where(inside, labels[rows, first], UNKNOWN)
        other = np.where(alone | ~inside, -1, labels[rows, second])
        two = np.where(alone, -sums[rows, first], sums[rows, second])
        wall = np.where(inside, 0.5 * (sums[rows, first] - two), FARTHEST_MM)
        # gradient by voxel, then by millimetre: places change by the inverse transposed
        way = ((signed[rows, second] - signed[rows, first])[:, :, None] * slopes).sum(axis=1)
        way = way @ self.inverse_mm[:3, :3]
        length = np.linalg.norm(way, axis=1, keepdims=True)
        usable = (length > 1e-12) & (other >= 0)[:, None]
        normal = np.where(usable, way / np.where(usable, length, 1.0), 0.0)
        return code, other, wall, normal

    def _corners(
        self, base: NDArray[np.intp], share: FloatArray
    ) -> tuple[NDArray[np.intp], FloatArray, FloatArray, FloatArray]:
        """Codes, distances [mm], weights, shape (n, 8), and slopes of the weights, (n, 8, 3)."""
        k, j, i = base[:, 2], base[:, 1], base[:, 0]
        offsets = np.array(list(np.ndindex(2, 2, 2)))  # (k, j, i)
        at = (
            k[:, None] + offsets[:, 0],
            j[:, None] + offsets[:, 1],
            i[:, None] + offsets[:, 2],
        )
        up = offsets[:, ::-1].astype(bool)  # (i, j, k) of the corners, shape (8, 3)
        each = np.where(up, share[:, None, :], 1.0 - share[:, None, :])  # (n, 8, 3)
        sign = np.where(up, 1.0, -1.0)
        slopes = np.stack(
            [
                sign[:, axis] * each[:, :, (axis + 1) % 3] * each[:, :, (axis + 2) % 3]
                for axis in range(3)
            ],
            axis=2,
        )
        labels = self.labels[at].astype(np.intp)
        return labels, self.distance[at] / STEPS_PER_MM, each.prod(axis=2), slopes


def _chunks(points: FloatArray) -> Iterator[FloatArray]:
    for start in range(0, max(1, len(points)), _CHUNK):
        yield points[start : start + _CHUNK]


def tissue_of(document: dict[str, Any]) -> FieldTissue:
    """Return a tissue from its JSON values.

    Raises:
        FieldError: if it is none.
    """
    try:
        return FieldTissue(
            int(document["code"]),
            TissueKind(document["kind"]),
            str(document["name"]),
            float(document["confidence"]),
            str(document["source"]),
        )
    except (LookupError, TypeError, ValueError) as error:
        raise FieldError(f"not a tissue of a field: {document!r}"[:200]) from error
