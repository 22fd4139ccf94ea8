"""The steps of an intervention, read back from the record for scoring and for the time axis."""

from __future__ import annotations

from collections.abc import Iterable, Sequence
from contextlib import suppress
from typing import Any

import numpy as np

from app.core.errors import AcusError
from app.core.events import Event
from app.core.units import MILLIMETRE
from app.imaging.inside import Inside
from app.planning.placement import PlacedPlan
from app.scoring.ablation import AblationMark
from app.scoring.complications.answers import ROWS, AnswerWorth, Kind
from app.scoring.complications.marks import ComplicationMarks, Demand, Given
from app.scoring.errors import TrajectoryError
from app.scoring.met import Met
from app.scoring.procedure import Deposit, ProcedureMarks, SampleMark, TurningMark
from app.session import ablation as ablating
from app.session import complication_case
from app.session.procedure import CHECKS, KIND, MARKED, Step, ToolInHand
from app.session.samples import Samples


def marks_of_complications(
    events: Iterable[Event], placed: PlacedPlan, until: float
) -> ComplicationMarks | None:
    """Return what scoring sees of complications; None where the record says that none can happen.

    Damaged events are left out.

    Args:
        events: of the record.
        placed: its plan, for where the patient lies.
        until: end of the attempt [s].
    """
    found = [event for event in events if event.kind in (complication_case.KIND, "scan")]
    if not any(event.kind == complication_case.KIND for event in found):
        return None
    begun: list[tuple[Kind, float]] = []
    demands: list[Demand] = []
    noticed: list[float] = []
    given: list[Given] = []
    shown: list[tuple[float, tuple[float, float, float]]] = []
    for event in found:
        data: dict[str, Any] = dict(event.data)
        with suppress(AcusError, LookupError, TypeError, ValueError):
            if event.kind == "scan":
                shown.append((event.time, _displaced(data, placed)))
            elif data["step"] == "onset":
                begun.append((Kind(data["kind"]), event.time))
            elif data["step"] == "stage":
                row = ROWS[data["row"]]
                demands.append(Demand(row.kind, row.name, row.severity, event.time))
            elif data["step"] == "notice":
                noticed.append(event.time)
            elif data["step"] == "answer":
                given += _given(event.time, data)
                noticed.append(event.time)
    with suppress(TrajectoryError):
        return ComplicationMarks(
            tuple(begun), tuple(demands), tuple(noticed), tuple(given), tuple(shown), until
        )
    return ComplicationMarks(until=until if np.isfinite(until) else 0.0)


def _given(time: float, data: dict[str, Any]) -> list[Given]:
    """Return an answer once for each complication that it answers: the first is judged by."""
    answer, verdict = str(data["answer"]), AnswerWorth(data["verdict"])
    kinds = [Kind(kind) for kind in data["kinds"]]
    if not kinds:
        return [Given(time, answer, verdict)]
    first, *others = kinds
    right = [Given(time, answer, AnswerWorth.RIGHT, kind) for kind in others]
    return [Given(time, answer, verdict, first), *right]


def _displaced(data: dict[str, Any], placed: PlacedPlan) -> tuple[float, float, float]:
    """Return how far a scan showed the target displaced, world [m]."""
    document = data.get("inside")
    if document is None:
        return 0.0, 0.0, 0.0
    shift = placed.T_world_patient.rotate(Inside.of(document).displacement_mm * MILLIMETRE)
    x, y, z = shift.tolist()
    return x, y, z


def marks_of(
    events: Sequence[Event],
    samples: Samples,
    met: tuple[Met, ...] | None,
    placed: PlacedPlan | None = None,
) -> ProcedureMarks | None:
    """Return what scoring sees of the steps; None where the record has none.

    Damaged events are left out; without `placed`, complications are.
    """
    steps = [(event, _step(event)) for event in events if event.kind == KIND]
    if not steps:
        return None
    deposits: list[Deposit] = []
    taken: list[SampleMark] = []
    needle_from: float | None = None
    open_from: float | None = None
    ablated: AblationMark | None = None
    opened: list[tuple[float, float]] = []
    error: float | None = None
    checked: dict[Step, float] = {}
    rolled: float | None = None
    for event, step in steps:
        data: dict[str, Any] = dict(event.data)
        with suppress(LookupError, TypeError, ValueError, TrajectoryError):
            if event.data.get("step") == MARKED:
                error = float(data["error_mm"])
            if step is Step.INJECT:
                gap = data["gap_mm"]
                deposits.append(
                    Deposit(
                        event.time, float(data["depth_mm"]), None if gap is None else float(gap)
                    )
                )
            elif step is Step.FIRE:
                taken.append(_mark(event.time, data))
            elif step is Step.ABLATE:
                ablated = ablating.mark_of(data)
        if step is Step.TAKE_NEEDLE:
            needle_from = event.time
        elif step is Step.ROLL_OVER:
            rolled = event.time
        elif step in CHECKS:
            checked.setdefault(step, event.time)
        if step in (Step.STYLET_OUT, Step.GUN_OUT) and open_from is None:
            open_from = event.time
        elif step in (Step.STYLET_IN, Step.GUN_IN) and open_from is not None:
            opened.append((open_from, event.time))
            open_from = None
    if open_from is not None:
        opened.append((open_from, np.inf))
    begins = any(event.data.get("tool") == ToolInHand.ANAESTHETIC.value for event, _ in steps)
    if begins and needle_from is None:
        needle_from = np.inf  # it was never taken
    before = tuple(one for one in met or () if needle_from is not None and one.time < needle_from)
    happened = None
    if placed is not None and len(samples.time):
        happened = marks_of_complications(events, placed, float(samples.time[-1]))
    return ProcedureMarks(
        tuple(deposits),
        tuple(taken),
        _open_time(opened, samples),
        needle_from,
        before,
        happened,
        ablated,
        error,
        _turning(steps, samples, rolled),
        _checked_before(checked, samples),
    )


def _turning(
    steps: Sequence[tuple[Event, Step | None]], samples: Samples, rolled: float | None
) -> TurningMark | None:
    """Return when the patient was turned; None where the exercise does not ask for it."""
    if not any(event.data.get("rollover") is True for event, _ in steps):
        return None
    last = [event.time for event, step in steps if step in (Step.FIRE, Step.ABLATE)]
    inside = np.flatnonzero(samples.depth > 0.0)
    out = None
    if len(inside) and inside[-1] + 1 < len(samples.time):
        out = float(samples.time[inside[-1] + 1])
    return TurningMark(last[-1] if last else None, out, rolled)


def _checked_before(checked: dict[Step, float], samples: Samples) -> float:
    """Return which share of the checklist was done before any needle was in the body."""
    inside = samples.time[samples.depth > 0.0]
    first = float(inside[0]) if len(inside) else np.inf
    return sum(time <= first for time in checked.values()) / len(CHECKS)


def shown_events(events: Iterable[Event]) -> tuple[Event, ...]:
    """Leave out the steps that a time axis has no room for: those without tissue."""
    shown = (Step.INJECT.value, Step.FIRE.value)
    return tuple(one for one in events if one.kind != KIND or one.data.get("step") in shown)


def _step(event: Event) -> Step | None:
    with suppress(ValueError):
        return Step(str(event.data.get("step", "")))
    return None


def _mark(time: float, data: dict[str, Any]) -> SampleMark:
    return SampleMark(
        time,
        float(data["lesion_mm"]),
        data["is_diagnostic"] is True,
        tuple(str(hit) for hit in data["hits"]),
        float(data["aside_mm"]) if "aside_mm" in data else None,
    )


def _open_time(opened: Iterable[tuple[float, float]], samples: Samples) -> float:
    """Return for how long the hub was open with the tip in the body [s]."""
    spans = np.diff(samples.time, append=samples.time[-1:]) if len(samples.time) else np.empty(0)
    inside = samples.depth > 0.0
    total = 0.0
    for begin, end in opened:
        total += float(spans[inside & (samples.time >= begin) & (samples.time < end)].sum())
    return total
