"""What lies on a planned way that no needle should meet: bone, lung, vessels, gut, the heart."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.imaging.field.tissue_field import TissueField, TissueKind
from app.imaging.field.walking import holding, walk
from app.planning.paths import Weights

_WEIGHTS: Final = Weights()

MOST_MM: Final = {
    TissueKind.BONE: _WEIGHTS.most_bone_mm,
    TissueKind.LUNG: _WEIGHTS.most_lung_mm,
    TissueKind.VESSEL: _WEIGHTS.most_vessel_mm,
    TissueKind.GUT: _WEIGHTS.most_gut_mm,
    TissueKind.HEART: _WEIGHTS.most_heart_mm,
}
"""So much of a way may lie in these without a word [mm]: as the map of entries blocks a path."""

LEAST_CONFIDENCE: Final = 0.5
"""A label less sure than this is named all the same, as one that may be there."""


@dataclass(frozen=True, slots=True)
class Hindrance:
    """One tissue on the way.

    Attributes:
        name: of the tissue, as its field calls it.
        kind: what it is.
        depth_mm: along the way, from the entry to where it begins.
        length_mm: of the way in it, all its stretches together.
        is_sure: whether the field is.
    """

    name: str
    kind: TissueKind
    depth_mm: float
    length_mm: float
    is_sure: bool = True


def hindrances(
    field: TissueField, entry_mm: ArrayLike, target_mm: ArrayLike
) -> tuple[Hindrance, ...]:
    """Return what is on the way, the first that the needle meets first.

    What holds the target is none: there the needle has to go.

    Args:
        field: of the patient.
        entry_mm: on the skin, LPS, shape (3,).
        target_mm: LPS, shape (3,).
    """
    wanted = set(holding(field, target_mm).tolist())
    begins: dict[int, float] = {}
    lengths: dict[int, float] = {}
    for part in walk(field, np.array([entry_mm, target_mm], np.float64)):
        if part.code not in wanted and field.tissues[part.code].kind in MOST_MM:
            begins.setdefault(part.code, part.begin_mm)
            lengths[part.code] = lengths.get(part.code, 0.0) + part.length_mm
    met = [
        Hindrance(
            field.tissues[code].words,
            field.tissues[code].kind,
            begin,
            lengths[code],
            field.tissues[code].confidence >= LEAST_CONFIDENCE,
        )
        for code, begin in begins.items()
    ]
    total = {kind: sum(one.length_mm for one in met if one.kind is kind) for kind in MOST_MM}
    return tuple(one for one in met if total[one.kind] > MOST_MM[one.kind])
