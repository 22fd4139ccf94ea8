"""The inside of a patient as complications have changed it, as values: how far the lung fell back.

Pictures are made of it by `imaging.fallen_lung`, which says how a lung falls back.
"""

from __future__ import annotations

from collections.abc import Mapping
from dataclasses import dataclass
from math import isfinite
from typing import Any, Final

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.core.errors import NumericalError
from app.core.messages import sentence
from app.imaging.field.tissue_field import TissueField, TissueKind

MOST: Final = 0.8
"""No lung falls back further [share of its volume]."""

COARSE_MM: Final = 3.0
"""The shape of a lung is measured in steps of about this."""

TO_HILUM, TO_LOW = 0.7, 0.6
"""Where the lung falls back to: so far from its middle towards the mediastinum, and towards the
lowest side, as shares of its extent there."""


@dataclass(frozen=True, slots=True, eq=False)
class LungShape:
    """The lung that holds a target, as it can fall back.

    Attributes:
        centre_mm: point towards which it falls, LPS, shape (3,).
        reach_mm: from there to where the chest is uppermost.
        is_left: which lung.
    """

    centre_mm: FloatArray
    reach_mm: float
    is_left: bool

    def rim_mm(self, share: float) -> float:
        """Return the largest depth of air between chest wall and lung."""
        return self.reach_mm * (1.0 - left_over(share))

    def displacement_mm(self, place_mm: ArrayLike, share: float) -> FloatArray:
        """Return how far a place in the lung is displaced, LPS, shape (3,)."""
        way = self.centre_mm - frozen(place_mm, (3,), "place_mm")
        return np.asarray((1.0 - left_over(share)) * way)


@dataclass(frozen=True, slots=True, eq=False)
class Inside:
    """What complications have changed inside the patient at a moment.

    Attributes:
        share: of the hemithorax by volume that is air.
        centre_mm: point towards which the lung falls, LPS, shape (3,).
        lesion_mm: centre of the lesion before, LPS, shape (3,).
        is_left: which lung.
        blood_mm: radius of the blood about the needle's way; 0 for none.
        way_mm: ends of that way where the tissue rested, LPS, shape (2, 3); None without blood.
        dense: whether the blood fills the lung next to the way.

    Raises:
        NumericalError: if a number is not finite or has no such value.
    """

    share: float
    centre_mm: FloatArray
    lesion_mm: FloatArray
    is_left: bool
    blood_mm: float = 0.0
    way_mm: FloatArray | None = None
    dense: bool = False

    def __post_init__(self) -> None:
        if not (isfinite(self.share) and 0.0 <= self.share <= 1.0):
            raise NumericalError(
                sentence("a share of {share} of the chest is none", share=self.share)
            )
        if not (isfinite(self.blood_mm) and 0.0 <= self.blood_mm <= 100.0):
            raise NumericalError(
                sentence("blood {radius} mm about the needle's way is none", radius=self.blood_mm)
            )
        object.__setattr__(self, "centre_mm", frozen(self.centre_mm, (3,), "centre_mm"))
        object.__setattr__(self, "lesion_mm", frozen(self.lesion_mm, (3,), "lesion_mm"))
        if self.way_mm is not None:
            object.__setattr__(self, "way_mm", frozen(self.way_mm, (2, 3), "way_mm"))

    @property
    def changes(self) -> bool:
        """Return whether a picture shows anything of it."""
        return self.share > 0.0 or (self.blood_mm > 0.0 and self.way_mm is not None)

    @property
    def displacement_mm(self) -> FloatArray:
        """Return how far the lesion's centre is displaced, LPS, shape (3,)."""
        shift = (1.0 - left_over(self.share)) * (self.centre_mm - self.lesion_mm)
        return np.asarray(shift)

    def document(self) -> dict[str, object]:
        """Return it as JSON-ready values; `of` reads them back to the last bit."""
        way = None if self.way_mm is None else self.way_mm.tolist()
        return {
            "share": self.share,
            "centre_lps_mm": self.centre_mm.tolist(),
            "lesion_lps_mm": self.lesion_mm.tolist(),
            "is_left": self.is_left,
            "blood_mm": self.blood_mm,
            "way_lps_mm": way,
            "dense": self.dense,
            "displaced_lps_mm": self.displacement_mm.tolist(),
        }

    @classmethod
    def of(cls, document: Mapping[str, Any]) -> Inside:
        """Read it back.

        Raises:
            AcusError, LookupError, TypeError, ValueError: if it is no such document.
        """
        return cls(
            float(document["share"]),
            document["centre_lps_mm"],
            document["lesion_lps_mm"],
            document["is_left"] is True,
            float(document["blood_mm"]),
            document["way_lps_mm"],
            document["dense"] is True,
        )


def left_over(share: float) -> float:
    """Return the factor by which lengths of a lung shrink that gave way to a share of air."""
    return float((1.0 - min(MOST, max(0.0, share))) ** (1.0 / 3.0))


def lung_shape(field: TissueField, place_mm: ArrayLike, down: ArrayLike) -> LungShape | None:
    """Return the lung on the side of a place; None where nobody labelled one there.

    Args:
        field: of the patient's tissue.
        place_mm: in or at the lung, LPS, shape (3,).
        down: direction in which gravity pulls, LPS, shape (3,).
    """
    place, low = frozen(place_mm, (3,), "place_mm"), _unit(down)
    step = max(1, round(COARSE_MM / float(field.spacing_mm.min())))
    codes = [tissue.code for tissue in field.of_kind(TissueKind.LUNG)]
    found = np.argwhere(np.isin(field.labels[::step, ::step, ::step], codes))[:, ::-1] * step
    points = found @ field.affine_mm[:3, :3].T + field.affine_mm[:3, 3]
    if not len(points):
        return None
    middle = middle_mm(field)
    is_left = bool(place[0] > middle)
    points = points[(points[:, 0] > middle) == is_left]
    if len(points) < 8:
        return None
    centroid = points.mean(axis=0)
    medial = np.array([-1.0 if is_left else 1.0, 0.0, 0.0])
    centre = centroid + TO_HILUM * _extent(points, centroid, medial) * medial
    centre = centre + TO_LOW * _extent(points, centroid, low) * low
    return LungShape(frozen(centre), _extent(points, centre, -low, 99.5), is_left)


def middle_mm(field: TissueField) -> float:
    """Return LPS x of the body's middle: of the vertebral canal's bones, else of the grid."""
    bones = [t.code for t in field.of_kind(TissueKind.BONE) if t.name != "rib"]
    step = max(1, round(COARSE_MM / float(field.spacing_mm.min())))
    found = np.argwhere(np.isin(field.labels[::step, ::step, ::step], bones))[:, ::-1] * step
    if len(found) < 8:
        return float(field.affine_mm[0, 3] + 0.5 * field.affine_mm[0, 0] * field.labels.shape[2])
    x = found @ field.affine_mm[0, :3] + field.affine_mm[0, 3]
    return float(np.median(x))


def _extent(points: FloatArray, start: FloatArray, way: FloatArray, percent: float = 97.0) -> float:
    return max(0.0, float(np.percentile((points - start) @ way, percent)))


def _unit(vector: ArrayLike) -> FloatArray:
    array = frozen(vector, (3,), "down")
    length = float(np.linalg.norm(array))
    if length < 1e-9:
        raise NumericalError(sentence("gravity has no direction"))
    return np.asarray(array / length)
