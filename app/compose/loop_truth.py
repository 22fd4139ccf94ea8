"""What the needle met as the loop itself had it: the tissue under the tip in its state.

The judgement walks the recorded tip through the patient's field (`session.tissues`); the loop
looked that tissue up when it made the forces, with code of its own, its own breathing and bend.
Where one of the two is wrong, they disagree: so a wrong judge is seen beside a wrong needle.
"""

from __future__ import annotations

from collections.abc import Collection, Sequence
from typing import TYPE_CHECKING, Final

import numpy as np
from numpy.typing import NDArray

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.imaging.field.tissue_field import TissueKind
from app.imaging.field.walking import holding
from app.scoring.met import BY_TIP, Met

if TYPE_CHECKING:
    from app.imaging.field import TissueField
    from app.planning.placement import PlacedPlan

TOLERANCE_MM: Final = 2.0
"""Of less than this of a tissue the two may differ: the loop is looked at every 20 ms only."""

_NOT_MET = (TissueKind.UNKNOWN, TissueKind.AIR)


def met_in_loop(
    rows: FloatArray, field: TissueField | None, placed: PlacedPlan
) -> tuple[Met, ...] | None:
    """Return what the tip met by the loop's own state, each tissue once with all of its way.

    Args:
        rows: states of the loop at each look, shape (n, slots).
        field: whose codes the loop tells; None where it looked nothing up.
        placed: the plan, for where the target lies.

    Returns:
        What was met; None where the loop told no tissue: its exercise had layers.
    """
    depth = rows[:, sv.PLANT_DEPTH] / MILLIMETRE
    inside = depth > 0.0
    codes = np.where(inside, rows[:, sv.TISSUE], 0.0).astype(np.intp)
    bone = inside & (rows[:, sv.BONE_CONTACT] > 0.0)
    if not (codes.any() or bone.any()):
        return None
    tips = (placed.T_world_patient.inverse() @ rows[:, sv.TIP]) / MILLIMETRE
    forwards = np.maximum(np.diff(depth, prepend=depth[0]), 0.0)
    target = placed.T_world_patient.inverse() @ placed.p_target / MILLIMETRE
    held = set() if field is None else set(holding(field, target).tolist())
    found = []
    for code in sorted(set(codes.tolist()) - {0}):
        tissue = None if field is None else field.tissues[code]
        if tissue is None or tissue.kind in _NOT_MET:
            continue
        within = codes == code
        if tissue.kind == TissueKind.BONE:
            bone |= within
            continue
        facts = tissue.kind.value, tissue.name, tissue.confidence, code in held
        found.append(_met(facts, within, rows, depth, tips, float(forwards[within].sum())))
    if bone.any():
        name, confidence = _bone(rows[bone], field)
        crossed = float(rows[bone, sv.BONE_CROSSED].max()) / MILLIMETRE
        facts = TissueKind.BONE.value, name, confidence, False
        found.append(_met(facts, bone, rows, depth, tips, max(crossed, 0.0)))
    return tuple(sorted(found, key=lambda met: met.time))


def disagreements(walked: Collection[Met], looped: Sequence[Met] | None) -> tuple[str, ...]:
    """Say where the walk of the judgement and the loop differ about what the tip met."""
    if looped is None:
        return ()
    judge, loop = _ways(walked), _ways(looped)
    lines = []
    for key in sorted(judge.keys() | loop.keys()):
        by_judge, by_loop = judge.get(key), loop.get(key)
        if by_judge is None and by_loop is not None and _matters(by_loop):
            lines.append(
                sentence("{tissue}: the loop had it, the walk had not", tissue=by_loop.words)
            )
        if by_loop is None and by_judge is not None and by_judge.length_mm >= TOLERANCE_MM:
            lines.append(
                sentence("{tissue}: the walk had it, the loop had not", tissue=by_judge.words)
            )
    return tuple(lines)


def _matters(met: Met) -> bool:
    return met.is_bone or met.length_mm >= TOLERANCE_MM


def _ways(met: Collection[Met]) -> dict[tuple[str, str], Met]:
    """Return the longest of each tissue that the tip met."""
    longest: dict[tuple[str, str], Met] = {}
    for item in met:
        if item.by != BY_TIP:
            continue
        key = tissue_key(item)
        if key not in longest or item.length_mm > longest[key].length_mm:
            longest[key] = item
    return longest


def tissue_key(met: Met) -> tuple[str, str]:
    """Return kind and name of a tissue; of bone no name: the loop stands before it, not in it."""
    return met.kind, "" if met.is_bone else met.name


def _bone(rows: FloatArray, field: TissueField | None) -> tuple[str, float]:
    """Return the name of the bone at the tip or before it, and how sure its label is."""
    if field is not None:
        for code in np.concatenate([rows[:, sv.TISSUE], rows[:, sv.TISSUE_AHEAD]]).tolist():
            tissue = field.tissues[int(code)] if 0 <= code < len(field.tissues) else None
            if tissue is not None and tissue.kind == TissueKind.BONE:
                return tissue.name, tissue.confidence
    return "", 1.0


def _met(
    facts: tuple[str, str, float, bool],
    within: NDArray[np.bool_],
    rows: FloatArray,
    depth: FloatArray,
    tips: FloatArray,
    length_mm: float,
) -> Met:
    kind, name, confidence, holds = facts
    first, last = np.flatnonzero(within)[[0, -1]].tolist()
    (a, b, c), (d, e, f) = tips[first].tolist(), tips[last].tolist()
    return Met(
        kind,
        name,
        entered_mm=float(depth[first]),
        length_mm=length_mm,
        points=((a, b, c), (d, e, f)),
        time=float(rows[first, sv.TIME]),
        confidence=confidence,
        holds_target=holds,
    )
