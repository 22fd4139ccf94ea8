"""Why a metric cost points: sentences about what the needle did, of what was recorded alone.

Every number in them is read off the samples, events or marks of the attempt; where these hold
nothing, nothing is stated. Sides are the patient's.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass, field
from math import isfinite
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.exercises.parts import OF_OWN_PLANS
from app.imaging.field.tissue_field import TissueKind
from app.planning.judged import JudgedPlan
from app.scoring.defaults import DEFAULT_TOLERANCES
from app.scoring.met import Met
from app.scoring.procedure import ProcedureMarks
from app.scoring.risks import RiskMark
from app.scoring.tolerance import Bands
from app.session.along_path import GAP_S, RUNS, AlongPath
from app.session.attempt_clock import AttemptClock
from app.session.machine import State
from app.session.planned import plan_sentences
from app.session.procedure_reasons import procedure_reasons

LEAST_MM: Final = 0.3
"""Less than this towards a side, or along the path, is not spoken of [mm]: no camera knows it."""

LEAST_DEG: Final = 0.3
"""A smaller tilt at the skin is none [°]."""

BESIDE: Final = 0.6
"""A second side is named if it has this share of the first."""

SAME_SIDE: Final = 0.5
"""A tilt led the needle aside if it leans within 60° of where the needle ended: its cosine."""

ROUNDED_MM: Final = 0.05
"""A depth is told with one decimal: so much is no difference [mm]."""

LEAST_OUTSIDE: Final = 0.2
"""The breath is spoken of from this share of the way on that was pushed outside its gate."""

MOST_MET: Final = 2
"""So many tissues are named."""

ACROSS: Final = frozenset(
    {
        *("lateral_error", "planned_target_error", "target_error", "angle_error"),
        *("angle_in_plane", "angle_out_of_plane", "path_ratio", "frechet_distance"),
        *("dtw_distance", "redirects", "economy_of_motion"),
    }
)
"""Metrics of the line."""

ALONG: Final = frozenset({"depth_error", "planned_target_error", "target_error"})
"""Metrics of the depth."""

ENDED_ASIDE: Final = frozenset({"lateral_error", "planned_target_error", "target_error"})
"""Metrics of the place in which the needle ended."""

FORCE: Final = frozenset({"peak_force", "mean_force", "guidance_work", "saturation"})
RISKS: Final = frozenset({"risk_breach", "risk_distance", "risk_time"})
STAGES: Final = {
    "aligning_time": State.ALIGNING,
    "insertion_time": State.INSERTING,
    "holding_time": State.HOLDING,
}
TISSUES: Final[Mapping[str, tuple[str, ...]]] = {
    "bone_contacts": (TissueKind.BONE,),
    "bone_force": (TissueKind.BONE,),
    "gut_touched": (TissueKind.GUT,),
    "vessels_touched": (TissueKind.VESSEL,),
    "organ_crossed": (TissueKind.ORGAN,),
    "capsule_passes": (TissueKind.ORGAN,),
    "lung_crossed": (TissueKind.LUNG,),
    "pleural_crossings": (TissueKind.LUNG,),
    "pleural_angle": (TissueKind.LUNG,),
}


@dataclass(frozen=True, slots=True, eq=False)
class AttemptEvidence:
    """What the record of an attempt holds that a reason may rest on.

    Attributes:
        way: the samples along the path.
        tolerances: of the exercise, by metric.
        gate_mm: so far from its place in the CT the target may be while the needle is pushed.
        unsure_mm: radius round the tip that holds the true one with 95 %; 0 where not known.
        origin: monotonic time of the first sample [s].
        clock: of the attempt, by which moments are told; None counts them from `origin`.
        met: what the needle met.
        risks: how near it came to structures of risk.
        planned: what a planner says of the student's own path; None where it was given.
        steps: of the procedure; None without.
        scans: moments of the control scans [s], monotonic.
        depth_error_mm: the score's own, positive beyond the target; None where it has none.
        depth_sd_mm: its standard deviation; 0 where not known.
    """

    way: AlongPath
    tolerances: Mapping[str, Bands] = field(default_factory=dict)
    gate_mm: float = 2.0
    unsure_mm: float = 0.0
    origin: float = 0.0
    clock: AttemptClock | None = None
    met: Sequence[Met] = ()
    risks: Sequence[RiskMark] = ()
    planned: JudgedPlan | None = None
    steps: ProcedureMarks | None = None
    scans: Sequence[float] = ()
    depth_error_mm: float | None = None
    depth_sd_mm: float = 0.0

    def moment(self, time: float) -> str:
        """Return a time since the first sample [s] as the student's clock showed it."""
        return moment(time if self.clock is None else self.clock.at(self.origin + time))

    @property
    def line_mm(self) -> float:
        """Farther off the line than this the needle has left it [mm]: past what is good."""
        bands = self.tolerances.get("lateral_error", DEFAULT_TOLERANCES["lateral_error"])
        return max(bands.good, self.unsure_mm)


def reasons(metric: str, past: AttemptEvidence) -> tuple[str, ...]:
    """Say why a metric cost points; empty where the record does not tell.

    Args:
        metric: its name.
        past: what the record holds.
    """
    parts: list[Callable[[AttemptEvidence], tuple[str, ...]]] = []
    if metric == "angle_at_skin":
        parts.append(_skin)
    if metric in ALONG:
        parts.append(_depth)
    if metric in ACROSS:
        parts += [_line, _skin_aside if metric in ENDED_ASIDE else _skin]
    if metric in ALONG | ACROSS or metric == "breath_offset":
        parts.append(_breath)
    if metric == "total_time" or metric in STAGES:
        parts.append(_stage)
    if metric in FORCE:
        parts.append(_force)
    if metric in RISKS:
        parts.append(_risk)
    if metric in ("control_scans", "notional_dose", "hand_dose"):
        parts.append(_scans)
    if metric in OF_OWN_PLANS and past.planned is not None:
        return plan_sentences(past.planned)
    steps = procedure_reasons(metric, past.steps, lambda time: past.moment(time - past.origin))
    kinds = TISSUES.get(metric, ())
    tissues = _tissues(past, kinds) if kinds else ()
    return (*(text for part in parts for text in part(past)), *tissues, *steps)


def moment(seconds: float) -> str:
    """Return a time since the beginning [s] as minutes and seconds: `1:07`."""
    whole = int(max(0.0, seconds))
    return f"{whole // 60}:{whole % 60:02d}"


def side(towards: FloatArray) -> str:
    """Name the side of the patient that a vector (LPS), shape (3,), points to; empty for none."""
    names = (
        (sentence("to the patient's left"), sentence("to the patient's right")),
        (sentence("towards the back"), sentence("towards the front")),
        (sentence("towards the head"), sentence("towards the feet")),
    )
    if not np.isfinite(towards).all():
        return ""
    ranked = sorted(
        (
            (abs(float(value)), pair[0 if value > 0.0 else 1])
            for value, pair in zip(towards, names, strict=True)
        ),
        key=lambda one: -one[0],
    )
    (first, name), (second, other) = ranked[:2]
    if not first > 0.0:
        return ""
    if second >= BESIDE * first:
        return sentence("{side} and {other_side}", side=name, other_side=other)
    return name


def _line(past: AttemptEvidence) -> tuple[str, ...]:
    """Say between which depths the needle was off the line, how far, and to which side."""
    way, rows = past.way, past.way.worst_stretch(past.line_mm)
    if not len(rows):
        return ()
    depths, off = way.depth_mm[rows], way.off_mm[rows]
    low, high, most = float(depths.min()), float(depths.max()), float(off.max())
    where = side(way.across_mm[rows[int(np.argmax(off))]])
    stay = way.measured_stay()
    last = rows[-1] == stay[-1] and high >= float(way.depth_mm[stay].max())
    if high - low < 1.0:
        text = sentence(
            "At {depth:.0f} mm depth you were {mm:.1f} mm off the line {where}.",
            depth=high,
            mm=most,
            where=where,
        )
    elif last:
        text = sentence(
            "From {depth:.0f} mm depth on you were off the line {where}, by up to {mm:.1f} mm.",
            depth=low,
            mm=most,
            where=where,
        )
    else:
        text = sentence(
            "You left the line between {low:.0f} and {high:.0f} mm depth {where}, by up to "
            "{mm:.1f} mm.",
            low=low,
            high=high,
            mm=most,
            where=where,
        )
    return (text,)


def _skin(past: AttemptEvidence) -> tuple[str, ...]:
    """Say how the needle was tilted when it went through the skin."""
    way, row = past.way, past.way.at_skin()
    if row is None:
        return ()
    tilt = float(way.tilt_deg[row])
    if tilt < LEAST_DEG:
        return (sentence("At the skin the needle was in line: {tilt:.1f}° off.", tilt=tilt),)
    return (
        sentence(
            "The tilt at the skin was {tilt:.1f}° off: the tip pointed too far {where}.",
            tilt=tilt,
            where=side(way.lean[row]),
        ),
    )


def _skin_aside(past: AttemptEvidence) -> tuple[str, ...]:
    """Say how the needle was tilted at the skin, unless it ended on another side than that."""
    way, row, rows = past.way, past.way.at_skin(), past.way.measured_to_end()
    if row is not None and len(rows) and float(way.tilt_deg[row]) >= LEAST_DEG:
        lean, ended = way.lean[row], way.across_mm[rows[-1]]
        if lean @ ended < SAME_SIDE * np.linalg.norm(lean) * np.linalg.norm(ended):
            return ()
    return _skin(past)


def _depth(past: AttemptEvidence) -> tuple[str, ...]:
    """Say how far short or too deep the tip ended, and since when it was there.

    It is the score's own depth error; where the last place that the cameras measured is another
    one, nobody knows how the needle came there. No moment is told that lies in a gap.
    """
    way, rows, error = past.way, past.way.measured_to_end(), past.depth_error_mm
    if not len(rows) or error is None:
        return ()
    left, time = way.remaining_mm[rows], way.time[rows]
    if not abs(float(left[-1]) + error) <= max(past.depth_sd_mm, ROUNDED_MM):
        return ()
    if error > LEAST_MM:
        before = np.flatnonzero(left >= 0.0)[-1:]
        if not len(before) or time[before[0] + 1] - time[before[0]] > GAP_S:
            return (sentence("The tip ended {mm:.1f} mm too deep.", mm=error),)
        return (
            sentence(
                "The tip ended {mm:.1f} mm too deep: it passed the target's depth at {clock}.",
                mm=error,
                clock=past.moment(float(time[before[0] + 1])),
            ),
        )
    if -error <= LEAST_MM:
        return ()
    deepest = float(left.min())
    if deepest < -LEAST_MM:
        return (
            sentence(
                "The tip was {mm:.1f} mm too deep at {clock}, then drawn back to {short:.1f} mm "
                "short of the target.",
                mm=-deepest,
                clock=past.moment(float(time[int(np.argmin(left))])),
                short=-error,
            ),
        )
    at = int(np.argmax(left <= deepest + LEAST_MM))
    if (np.diff(time[at:]) > GAP_S).any():
        return (sentence("The tip ended {mm:.1f} mm short of the target.", mm=-error),)
    return (
        sentence(
            "The tip stopped {mm:.1f} mm short of the target; it came no deeper after {clock}.",
            mm=-error,
            clock=past.moment(float(time[at])),
        ),
    )


def pushed_outside(past: AttemptEvidence) -> tuple[float, float] | None:
    """Return how far the needle was pushed outside the gate of the breath, and in all [mm].

    None where hardly any of it was outside, or nothing was pushed.
    """
    steps, shift = past.way.pushed()
    outside, whole = float(steps[shift > past.gate_mm].sum()), float(steps.sum())
    return (outside, whole) if whole > 1.0 and outside > LEAST_OUTSIDE * whole else None


def _breath(past: AttemptEvidence) -> tuple[str, ...]:
    """Say how much of the way was pushed while the breath had moved the target."""
    ways = pushed_outside(past)
    if ways is None:
        return ()
    return (
        sentence(
            "You pushed {outside:.0f} of {whole:.0f} mm while the breath had moved the target by "
            "more than {gate:.1f} mm.",
            outside=ways[0],
            whole=ways[1],
            gate=past.gate_mm,
        ),
    )


def _stage(past: AttemptEvidence) -> tuple[str, ...]:
    """Say which stage took longest: against its band where it has one, else of all."""
    lasted = {State(name): seconds for name, seconds in past.way.lasted().items()}
    whole = sum(lasted.values())
    if not whole > 0.0:
        return ()
    against = {
        stage: lasted[stage] / past.tolerances[metric].good
        for metric, stage in STAGES.items()
        if metric in past.tolerances and past.tolerances[metric].good > 0.0
    }
    worst = max(against, key=lambda stage: against[stage], default=None)
    if worst is not None and against[worst] > 1.0:
        good = lasted[worst] / against[worst]
        return (
            sentence(
                "{stage} took longest against its band: {seconds:.0f} s, of which {good:.0f} s are "
                "good.",
                stage=_stage_word(worst),
                seconds=lasted[worst],
                good=good,
            ),
        )
    longest = max(lasted, key=lambda stage: lasted[stage])
    return (
        sentence(
            "{stage} took longest: {seconds:.0f} of {whole:.0f} s.",
            stage=_stage_word(longest),
            seconds=lasted[longest],
            whole=whole,
        ),
    )


def _stage_word(stage: State) -> str:
    return {
        State.ALIGNING: sentence("Aligning"),
        State.INSERTING: sentence("Inserting"),
        State.HOLDING: sentence("Holding still"),
    }[stage]


def _force(past: AttemptEvidence) -> tuple[str, ...]:
    """Say where the force at the hand was largest."""
    way = past.way
    force = np.where(np.isin(way.state, RUNS), way.force_n, np.nan)
    if not np.isfinite(force).any() or not np.nanmax(force) > 0.0:
        return ()
    at = int(np.nanargmax(force))
    newton, clock, depth = (
        float(force[at]),
        past.moment(float(way.time[at])),
        float(way.depth_mm[at]),
    )
    if not isfinite(depth) or depth < 0.0:
        return (
            sentence(
                "The force was largest at {clock}: {newton:.1f} N.", clock=clock, newton=newton
            ),
        )
    return (
        sentence(
            "The force was largest at {depth:.0f} mm depth, at {clock}: {newton:.1f} N.",
            depth=depth,
            clock=clock,
            newton=newton,
        ),
    )


def _tissues(past: AttemptEvidence, kinds: Sequence[str]) -> tuple[str, ...]:
    """Say what of some kinds was met, where and when."""
    return tuple(
        sentence("{met}, at {clock}.", met=met.sentence, clock=past.moment(met.time - past.origin))
        for met in [met for met in past.met if met.kind in kinds and met.counts][:MOST_MET]
    )


def _risk(past: AttemptEvidence) -> tuple[str, ...]:
    """Say to which structure the needle came nearest, where and when."""
    if not past.risks:
        return ()
    mark = min(past.risks, key=lambda one: one.closest_mm - one.limit_mm)
    clock, depth = past.moment(mark.time - past.origin), mark.depth_mm
    if mark.closest_mm <= 0.0:
        return (
            sentence(
                "The needle was inside {name} at {clock}, with its tip at {depth:.0f} mm depth.",
                name=mark.name,
                clock=clock,
                depth=depth,
            ),
        )
    return (
        sentence(
            "The needle came within {mm:.1f} mm of {name} at {clock}, with its tip at "
            "{depth:.0f} mm depth.",
            mm=mark.closest_mm,
            name=mark.name,
            clock=clock,
            depth=depth,
        ),
    )


def _scans(past: AttemptEvidence) -> tuple[str, ...]:
    """Say how many control scans were taken with the needle outside and in the body."""
    way = past.way
    if not past.scans or not len(way.time):
        return ()
    rows = np.searchsorted(way.time, np.asarray(past.scans) - past.origin).clip(
        0, len(way.time) - 1
    )
    outside = int((way.state[rows] == State.ALIGNING.value).sum())
    return (
        sentence(
            "{outside} of {n} control scans were taken before the needle was in the skin.",
            outside=outside,
            n=len(past.scans),
        ),
    )
