"""The lung as the tip went through it: pleura crossed, at which angle, and how much was aerated."""

from __future__ import annotations

from collections.abc import Sequence

from app.imaging.field.tissue_field import TissueKind
from app.scoring.met import BY_TIP, Met


def lung_met(met: Sequence[Met]) -> list[Met]:
    """Return the stretches of lung that the tip went through and that count."""
    return [one for one in met if one.kind == TissueKind.LUNG and one.by == BY_TIP and one.counts]


def crossings(met: Sequence[Met]) -> int:
    """Return how often the pleura was crossed, inwards and outwards.

    Vessels and airways within the lung are lung, as is a nodule in it that holds the target: going
    from one into the other crosses no pleura.
    """
    within = _within(met)
    sides = (side for one in lung_met(met) for side in (one.before, one.after))
    return sum(side != "" and side not in within for side in sides)


def punctures(met: Sequence[Met]) -> int:
    """Return how often the pleura was crossed inwards: entries into the lung."""
    within = _within(met)
    return sum(one.before != "" and one.before not in within for one in lung_met(met))


def flattest_deg(met: Sequence[Met]) -> float | None:
    """Return the largest angle to the pleura's normal at which it was entered; None if never."""
    outside = _within(met) | {""}
    return max((one.angle_deg for one in lung_met(met) if one.before not in outside), default=None)


def target_in_lung(met: Sequence[Met]) -> bool:
    """Tell whether the lung that was met holds the target."""
    return any(one.kind == TissueKind.LUNG and one.holds_target for one in met)


def _within(met: Sequence[Met]) -> set[str]:
    """Return the kinds of tissue within the lung: lung, and that of a target's nodule in it."""
    holding: set[str] = {one.kind for one in met if one.holds_target}
    lung: set[str] = {TissueKind.LUNG}
    return holding | lung if TissueKind.LUNG in holding else lung


def aerated_mm(met: Sequence[Met]) -> float:
    """Return the length of lung on one way forwards, the longest of them [mm]."""
    ways: dict[int, float] = {}
    way, depth = 0, 0.0
    for one in met:
        if one.by != BY_TIP:
            continue
        way += one.entered_mm < depth  # drawn back, and forwards anew
        depth = one.entered_mm
        if one.kind == TissueKind.LUNG:
            ways[way] = ways.get(way, 0.0) + one.length_mm
    return max(ways.values(), default=0.0)
