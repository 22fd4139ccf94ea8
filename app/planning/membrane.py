"""The membrane that a local anaesthetic goes up to and not through: parietal pleura or capsule."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray
from app.imaging.field.tissue_field import TissueField, TissueKind
from app.imaging.field.walking import holding, walk

AHEAD_MM: Final = 150.0
"""The membrane is looked for so far beyond the skin."""


@dataclass(frozen=True, slots=True, eq=False)
class Membrane:
    """Where a line through the skin meets the membrane of what holds the target.

    Attributes:
        depth_mm: from the skin along the line.
        place_mm: LPS, shape (3,).
        is_pleura: whether it is the parietal pleura; else an organ's capsule.
        angle_deg: between the line and the membrane's normal, 0 straight in.
    """

    depth_mm: float
    place_mm: FloatArray
    is_pleura: bool
    angle_deg: float


def membrane_on(
    field: TissueField, entry_mm: ArrayLike, way: ArrayLike, target_mm: ArrayLike
) -> Membrane | None:
    """Return the membrane on a line, the first of the lung or of the organ that holds the target.

    None where the line meets neither, or nobody labelled them.

    Args:
        field: of the patient.
        entry_mm: where the line passes the skin, LPS, shape (3,).
        way: its unit direction, shape (3,).
        target_mm: LPS, shape (3,).
    """
    entry, direction = np.asarray(entry_mm, np.float64), np.asarray(way, np.float64)
    held = set(holding(field, target_mm).tolist())
    lung = {tissue.code for tissue in field.of_kind(TissueKind.LUNG)}
    for part in walk(field, np.stack([entry, entry + AHEAD_MM * direction])):
        if part.code in held | lung and part.begin_mm > 0.0:
            is_pleura = part.code in lung
            return Membrane(part.begin_mm, part.begin, is_pleura, part.angle_deg)
    return None
