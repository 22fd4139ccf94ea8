"""What straight paths meet in a tissue field: how much of what must not be, and the pleura's angle.

For many paths at once: the label of the voxel at each millimetre counts, not the place of its
boundary within. For one path there is `imaging.field.walking`.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray
from app.imaging.field.tissue_field import UNKNOWN, TissueField, TissueKind
from app.imaging.field.walking import holding

SMALL_VESSELS: Final = frozenset({"small vessel", "lung vessel"})
"""Names of vessels that a needle may meet."""

AVOIDED: Final = (
    TissueKind.BONE,
    TissueKind.LUNG,
    TissueKind.VESSEL,
    TissueKind.GUT,
    TissueKind.HEART,
)
"""What no needle should meet, unless the target lies in it."""


def avoided_codes(field: TissueField, target_mm: ArrayLike, *kinds: TissueKind) -> tuple[int, ...]:
    """Return the codes of a field that a path to a target should not meet.

    Those of the kinds, less what holds the target and vessels that are too small to matter.

    Args:
        field: of the patient.
        target_mm: LPS, shape (3,).
        kinds: all that are `AVOIDED` where none is named.
    """
    held = set(holding(field, target_mm).tolist())
    return tuple(
        tissue.code
        for tissue in field.of_kind(*(kinds or AVOIDED))
        if tissue.name not in SMALL_VESSELS and tissue.code not in held
    )


@dataclass(frozen=True, slots=True, eq=False)
class PathTissues:
    """What paths meet, arrays of shape (n,); lengths of what holds the target are 0.

    Attributes:
        bone_mm, lung_mm, vessel_mm, gut_mm, heart_mm: lengths through it.
        unknown_mm: length through what nobody labelled.
        pleural_deg: angle between path and the pleura's normal where it first enters the lung,
            0 straight in; NaN where it does not.
    """

    bone_mm: FloatArray
    lung_mm: FloatArray
    vessel_mm: FloatArray
    gut_mm: FloatArray
    heart_mm: FloatArray
    unknown_mm: FloatArray
    pleural_deg: FloatArray


def along(
    field: TissueField, target_mm: FloatArray, points_mm: FloatArray, length_mm: FloatArray
) -> PathTissues:
    """Return what straight paths to one target meet.

    Args:
        field: of the patient.
        target_mm: LPS, shape (3,).
        points_mm: places on each path, evenly from entry to target, shape (n, steps, 3).
        length_mm: of the paths, shape (n,).
    """
    count, steps, _ = points_mm.shape
    codes = _nearest(field, points_mm.reshape(-1, 3)).reshape(count, steps)

    def through(wanted: Sequence[int]) -> FloatArray:
        result: FloatArray = np.isin(codes, wanted).mean(axis=1) * length_mm
        return result

    def meets(kind: TissueKind) -> FloatArray:
        return through(avoided_codes(field, target_mm, kind))

    return PathTissues(
        bone_mm=meets(TissueKind.BONE),
        lung_mm=meets(TissueKind.LUNG),
        vessel_mm=meets(TissueKind.VESSEL),
        gut_mm=meets(TissueKind.GUT),
        heart_mm=meets(TissueKind.HEART),
        unknown_mm=through([tissue.code for tissue in field.of_kind(TissueKind.UNKNOWN)]),
        pleural_deg=_pleural(field, points_mm, codes),
    )


def _nearest(field: TissueField, points: FloatArray) -> NDArray[np.uint8]:
    """Codes of the voxels that points lie in, unknown beyond the field."""
    ijk = np.rint(points @ field.inverse_mm[:3, :3].T + field.inverse_mm[:3, 3]).astype(np.intp)
    size = np.array(field.labels.shape[::-1])
    inside = np.asarray(((ijk >= 0) & (ijk < size)).all(axis=1))
    i, j, k = np.where(inside[:, None], ijk, 0).T
    return np.where(inside, field.labels[k, j, i], np.uint8(UNKNOWN))


def _pleural(field: TissueField, points: FloatArray, codes: NDArray[np.uint8]) -> FloatArray:
    """Angle at which each path first enters the lung [degrees], NaN where it does not."""
    lung = [tissue.code for tissue in field.of_kind(TissueKind.LUNG)]
    inside = np.isin(codes, lung)
    entered = inside[:, 1:] & ~inside[:, :-1]
    rows = np.flatnonzero(entered.any(axis=1))
    result = np.full(len(points), np.nan)
    if not len(rows):
        return result
    first = entered[rows].argmax(axis=1)
    before, after = points[rows, first], points[rows, first + 1]
    way = after - before
    way = way / np.maximum(np.linalg.norm(way, axis=1), 1e-9)[:, None]
    cosines = np.zeros(len(rows))
    for share in (0.0, 0.5, 1.0):  # the wall lies in one of the voxels between
        looked = field.look_up(before + share * (after - before))
        cosines = np.maximum(cosines, np.abs((way * looked.normal).sum(axis=1)))
    known = cosines > 0.0
    result[rows[known]] = np.degrees(np.arccos(np.clip(cosines[known], 0.0, 1.0)))
    return result
