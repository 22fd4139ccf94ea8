"""What lies on a planned way that no needle should meet: bone, lung, vessels, gut, the heart."""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.imaging.field.tissue_field import TissueField, TissueKind
from app.imaging.field.walking import holding, walk
from app.planning.judged import WEIGHTS, WayHindrance
from app.planning.tissues import SMALL_VESSELS

MOST_MM: Final = {
    TissueKind.BONE: WEIGHTS.most_bone_mm,
    TissueKind.LUNG: WEIGHTS.most_lung_mm,
    TissueKind.VESSEL: WEIGHTS.most_vessel_mm,
    TissueKind.GUT: WEIGHTS.most_gut_mm,
    TissueKind.HEART: WEIGHTS.most_heart_mm,
}
"""So much of a way may lie in these without a word [mm]: as the map of entries blocks a path."""

LEAST_CONFIDENCE: Final = 0.5
"""A label less sure than this is named all the same, as one that may be there."""


def hindrances(
    field: TissueField, entry_mm: ArrayLike, target_mm: ArrayLike
) -> tuple[WayHindrance, ...]:
    """Return what is on the way, the first that the needle meets first.

    What holds the target is none: there the needle has to go. Nor are small vessels, which the map
    of entries lets a needle meet.

    Args:
        field: of the patient.
        entry_mm: on the skin, LPS, shape (3,).
        target_mm: LPS, shape (3,).
    """
    wanted = set(holding(field, target_mm).tolist())
    wanted |= {tissue.code for tissue in field.tissues if tissue.name in SMALL_VESSELS}
    begins: dict[int, float] = {}
    lengths: dict[int, float] = {}
    for part in walk(field, np.array([entry_mm, target_mm], np.float64)):
        if part.code not in wanted and field.tissues[part.code].kind in MOST_MM:
            begins.setdefault(part.code, part.begin_mm)
            lengths[part.code] = lengths.get(part.code, 0.0) + part.length_mm
    met = [
        WayHindrance(
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
