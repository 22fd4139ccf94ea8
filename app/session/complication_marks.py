"""What happened to the patient and what was done about it, read back from the record."""

from __future__ import annotations

from collections.abc import Iterable
from contextlib import suppress
from typing import Any

import numpy as np

from app.core.errors import AcusError
from app.core.events import Event
from app.core.units import MILLIMETRE
from app.imaging.inside import Inside
from app.planning.placement import PlacedPlan
from app.scoring.complications.answers import ROWS, AnswerWorth, Kind
from app.scoring.complications.marks import ComplicationMarks, Demand, Given
from app.scoring.errors import TrajectoryError
from app.session.complication_case import KIND


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
    found = [event for event in events if event.kind in (KIND, "scan")]
    if not any(event.kind == KIND for event in found):
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
