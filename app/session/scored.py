"""The bridge to scoring: samples become a `Trajectory`, a score becomes a JSON document."""

from __future__ import annotations

import json
from collections.abc import Callable, Mapping
from typing import TYPE_CHECKING, Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.planning.judged import JudgedPlan
from app.planning.placement import PlacedPlan
from app.scoring.met import Met
from app.scoring.procedure import ProcedureMarks
from app.scoring.result import Score
from app.scoring.risks import RiskMark
from app.scoring.scans import ScanMark
from app.scoring.score import score
from app.scoring.touches import Touches
from app.scoring.trajectory import Trajectory
from app.session.abort_reasons import known_reason
from app.session.conditions import AGREEMENT
from app.session.errors import SessionError
from app.session.machine import State
from app.session.needle import FROM_CAMERAS
from app.session.samples import Samples

if TYPE_CHECKING:
    from app.exercises.schema import Exercise


def renders_force(metadata: Mapping[str, Mapping[str, str]]) -> bool:
    """Tell from a record's head whether something could push the hand: a pen cannot."""
    return "pen" not in metadata.get("device", {})


def agreement_of(metadata: Mapping[str, Mapping[str, str]]) -> float:
    """Distance within which screen and needle agreed at the target with 95 % [m], by the head.

    0 where nobody had checked: nothing is known then, and nothing is allowed for.
    """
    said = metadata.get(AGREEMENT, {}).get("radius_mm", "0")
    try:
        radius = float(said) * MILLIMETRE
    except ValueError:
        return 0.0
    return radius if 0.0 <= radius < 1.0 else 0.0


def seen_from(attachments: Mapping[str, bytes]) -> float:
    """Return from which depth of the tip on a record's cameras see the marker [m], by its head.

    Wherever the needle leans, as the rig is meant, and no tube hides the marker; infinite where the
    record does not say it.
    """
    try:
        rig = json.loads(attachments["cameras.json"])
        needle, depths_mm = rig["needle"], [float(rig["range"]["depth_min_mm"])]
        if needle.get("hidden_mm") is not None:
            depths_mm.append(float(needle["hidden_mm"][1]) + float(needle["marker_offset_mm"]))
    except (LookupError, TypeError, ValueError, AttributeError):
        return np.inf
    return max(depths_mm) * MILLIMETRE if np.isfinite(depths_mm).all() else np.inf


def trajectory(
    samples: Samples,
    placed: PlacedPlan,
    aborted: str = "",
    renders: bool = True,
    scans: tuple[ScanMark, ...] = (),
    risks: tuple[RiskMark, ...] = (),
    excused: float = 0.0,
    agreement: float = 0.0,
    touches: Touches | None = None,
    met: tuple[Met, ...] | None = None,
    computer: float = 0.0,
    seen_from: float = np.inf,
    planned: JudgedPlan | None = None,
    procedure: ProcedureMarks | None = None,
) -> Trajectory:
    """Turn samples into what scoring wants.

    Where no camera vouches for the depth, tip and depth stay as they were measured last, and
    `depth_valid` says so: the force of such a moment counts, its place does not. A force that the
    robot did not report counts as zero; hub point and fixture are given only if
    the robot reported them throughout.

    Args:
        samples: the attempt over time.
        placed: its plan.
        aborted: why it was aborted; empty if it was not.
        renders: whether something could push the hand; see `renders_force`.
        scans: control scans, in order.
        risks: structures of risk, and how near the needle came.
        excused: time of pauses that cost nothing [s], see `pauses.excused`.
        agreement: see `agreement_of` [m].
        touches: targets that were to be touched; None where there were none.
        met: what the needle met; None where nothing could tell.
        computer: time of pauses for simulated pictures that came late [s].
        seen_from: depth from which on the cameras can see the marker, as the record has it [m].
        planned: what a planner says of the student's own path; None where it was given.
        procedure: steps of the intervention; None without. While another needle than the
            exercise's own is held, the attempt counts as aligning, and what that one met as its.

    Raises:
        SessionError: if no sample has a direction of the needle.
    """
    rising: NDArray[np.bool_] = np.diff(samples.time, prepend=-np.inf) > 0.0
    placed_at: NDArray[np.bool_] = (
        samples.valid & np.isfinite(samples.tip).all(axis=1) & np.isfinite(samples.depth)
    )
    pointed: NDArray[np.bool_] = np.asarray(np.isfinite(samples.axis).all(axis=1))
    if not (rising & pointed).any():
        raise SessionError(sentence("no sample of this attempt has a direction of the needle"))
    tip, depth = samples.tip, samples.depth
    if not placed_at.any():
        tip, depth = np.broadcast_to(placed.p_entry, tip.shape), np.zeros(len(depth))
    place, direction = _last(placed_at)[rising], _last(pointed)[rising]
    hub, guide, target = samples.hub[rising], samples.guide[rising], samples.target[rising]
    return Trajectory(
        placed=placed,
        time=samples.time[rising],
        tip=tip[place],
        axis=samples.axis[direction],
        depth=depth[place],
        felt=np.nan_to_num(samples.felt[rising], nan=0.0) if renders else None,
        phase=_own(_phases(samples.state[rising]), samples.time[rising], procedure),  # type: ignore[arg-type]  # names are taken as well as codes
        depth_valid=np.isin(samples.depth_source[rising], FROM_CAMERAS) & samples.valid[rising],
        hub=hub if np.isfinite(hub).all() else None,
        guide=guide if np.isfinite(guide).all() else None,
        target_shift=target - placed.p_target if np.isfinite(target).all() else None,
        aborted=known_reason(aborted),
        scans=scans,
        risks=risks,
        excused=excused,
        spread=None if samples.spread is None else samples.spread[rising],
        agreement=agreement,
        touches=touches,
        met=_met_by_own(met, procedure),
        planned=planned,
        procedure=procedure,
        computer=computer,
        seen_from=seen_from,
        clamped=samples.clamped[rising] if renders and samples.clamped is not None else None,
    )


def _last(known: NDArray[np.bool_]) -> NDArray[np.intp]:
    """Find the newest sample up to each where something is known, else the first such, (n,)."""
    newest = np.maximum.accumulate(np.where(known, np.arange(len(known)), -1))
    rows: NDArray[np.intp] = np.where(newest < 0, int(np.argmax(known)), newest)
    return rows


def _phases(states: NDArray[np.str_]) -> NDArray[np.str_]:
    """States as scoring knows them: what went before the attempt is no part of it."""
    return np.where(states == State.WITHDRAWING.value, State.READY.value, states)


def _own(
    states: NDArray[np.str_], time: FloatArray, procedure: ProcedureMarks | None
) -> NDArray[np.str_]:
    """States of the exercise's own needle: until it is held, none is in the body."""
    if procedure is None or procedure.needle_from is None:
        return states
    other = (time < procedure.needle_from) & np.isin(
        states, (State.INSERTING.value, State.HOLDING.value)
    )
    return np.where(other, State.ALIGNING.value, states)


def _met_by_own(
    met: tuple[Met, ...] | None, procedure: ProcedureMarks | None
) -> tuple[Met, ...] | None:
    if met is None or procedure is None or procedure.needle_from is None:
        return met
    return tuple(one for one in met if one.time >= procedure.needle_from)


def scorer(exercise: Exercise, hand: str = "") -> Callable[[Trajectory], Score]:
    """Return the scorer of an exercise: its tolerances, by the bands of a hand, and its rules."""
    tolerances = exercise.tolerances_for(hand)
    return lambda path: score(path, tolerances, exercise.rules)


def score_document(score: Score) -> dict[str, Any]:
    """Return the score as a JSON-ready mapping, in scoring's own stored form."""
    document: dict[str, Any] = json.loads(score.to_json())
    return document
