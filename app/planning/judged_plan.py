"""How good one planned path is: the planner's points, and everything that they come of.

By the rule of the map of entries (`planning.paths`), from the patient's tissue field alone, so that
a record gives the same answer again; the skin's normal is the field's.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.units import DEGREE
from app.imaging.field.tissue_field import TissueField, TissueKind
from app.imaging.field.walking import directions
from app.planning.errors import PlanError
from app.planning.field_clearance import ClearField
from app.planning.judged import WEIGHTS, JudgedPlan
from app.planning.on_the_way import hindrances
from app.planning.paths import STEP_MM, crowding, points
from app.planning.tissues import along

SKIN_MM: Final = 8.0
"""The skin is looked at so far around the entry: hairs, ribs and voxels do not turn its normal."""

_AROUND: Final = 400
_MOST_UNKNOWN: Final = 0.5


def judge_plan(field: TissueField, entry_mm: ArrayLike, target_mm: ArrayLike) -> JudgedPlan:
    """Judge a straight path as the map of entries weighs.

    The device's own limits of depth and tilt are no part of it: an attempt begins only within.

    Args:
        field: of the patient.
        entry_mm: on the skin, LPS, shape (3,).
        target_mm: LPS, shape (3,).

    Raises:
        PlanError: if nobody knows what half of the path goes through, or which way the skin faces.
    """
    entry, target = np.asarray(entry_mm, np.float64), np.asarray(target_mm, np.float64)
    length = float(np.linalg.norm(target - entry))
    steps = max(2, int(np.ceil(length / STEP_MM)) + 1)
    places = entry + np.linspace(0.0, 1.0, steps)[:, None] * (target - entry)
    tissues = along(field, target, places[None], np.array([length]))
    if tissues.unknown_mm[0] > _MOST_UNKNOWN * length:
        raise PlanError(sentence("nobody labelled what most of the planned path goes through"))
    room = ClearField.about(field, target, places, WEIGHTS.free_mm)
    clear = room.of(places[None])
    clear_mm, code = float(clear.clear_mm[0]), int(clear.code[0])
    meets = hindrances(field, entry, target)
    way = (target - entry) / max(length, 1e-9)
    cosine = float(np.clip(-(way @ outward(field, entry)), -1.0, 1.0))
    angle = float(np.arccos(cosine)) / DEGREE
    pleura = tissues.pleural_deg
    score = points(
        np.array([length]),
        np.array([angle]),
        crowding(clear.clear_mm, WEIGHTS),
        pleura,
        WEIGHTS,
        WEIGHTS.longest_mm,
    )
    is_long, is_flat = length > WEIGHTS.longest_mm, angle > WEIGHTS.flattest_deg
    blocked = bool(meets) or is_long or is_flat
    return JudgedPlan(
        points=0.0 if blocked else float(score[0]),
        length_mm=length,
        angle_deg=angle,
        clear_mm=0.0 if meets else clear_mm,
        nearest=room.tissue(code).words if code >= 0 else "",
        nearest_mm=float(clear.step[0]) * length / (steps - 1),
        meets=meets,
        pleural_deg=float(pleura[0]) if np.isfinite(pleura[0]) else None,
        is_long=is_long,
        is_flat=is_flat,
    )


def outward(field: TissueField, place_mm: FloatArray) -> FloatArray:
    """Return the direction out of the body at a place on the skin, LPS, unit, shape (3,).

    The mean of all directions in which there is air, or nothing, `SKIN_MM` away.

    Raises:
        PlanError: if there is none.
    """
    around = directions(_AROUND)
    outside = [tissue.code for tissue in field.of_kind(TissueKind.AIR, TissueKind.UNKNOWN)]
    codes = field.codes_at(place_mm + SKIN_MM * around)
    out: FloatArray = around[np.isin(codes, outside)].sum(axis=0)
    length = float(np.linalg.norm(out))
    if length < 1e-6:
        raise PlanError(sentence("the entry does not lie on the skin"))
    return out / length
