"""What straight paths meet in a tissue field: how much of what must not be, and the pleura's angle.

For many paths at once: the label of the voxel at each millimetre counts, not the place of its
boundary within. For one path there is `imaging.field.walking`.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.imaging.field.tissue_field import UNKNOWN, TissueField, TissueKind
from app.imaging.field.walking import holding

SMALL_VESSELS: Final = frozenset({"small vessel", "lung vessel"})
"""Names of vessels that a needle may meet."""


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
    held = set(holding(field, target_mm).tolist())

    def through(kind: TissueKind, all_of_it: bool = False) -> FloatArray:
        wanted = [
            tissue.code
            for tissue in field.of_kind(kind)
            if tissue.name not in SMALL_VESSELS and (all_of_it or tissue.code not in held)
        ]
        result: FloatArray = np.isin(codes, wanted).mean(axis=1) * length_mm
        return result

    return PathTissues(
        bone_mm=through(TissueKind.BONE),
        lung_mm=through(TissueKind.LUNG),
        vessel_mm=through(TissueKind.VESSEL),
        gut_mm=through(TissueKind.GUT),
        heart_mm=through(TissueKind.HEART),
        unknown_mm=through(TissueKind.UNKNOWN, all_of_it=True),
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
