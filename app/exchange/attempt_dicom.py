"""A finished attempt as it is told in DICOM objects on its CT (`imaging.results`)."""

from __future__ import annotations

from contextlib import suppress
from datetime import UTC, datetime

import numpy as np

from app.core.messages import sentence
from app.core.progress import Progress
from app.core.units import MILLIMETRE
from app.exchange.errors import ExportError
from app.exercises.errors import ExerciseError
from app.exercises.library import load_exercise
from app.exercises.schema import Exercise
from app.imaging.results import AttemptFacts, MeasuredValue
from app.imaging.structures.structure import StructureSet
from app.imaging.volume import Volume
from app.session.recording import Recording
from app.session.summary import Summary


def attempt_facts(recording: Recording, summary: Summary) -> AttemptFacts:
    """Return what is told of an attempt: plan, tip at the end, values and verdict; no person.

    Raises:
        ExportError: if it is not finished, or has no usable time.
        BrokenRecordingError: if the record holds no usable plan.
    """
    if summary.state != "ended":
        raise ExportError(
            sentence(
                "{id} was not ended ({state}): it has no result", id=summary.id, state=summary.state
            )
        )
    placed, samples = recording.placed_plan(), recording.samples
    tips = samples.tip[np.isfinite(samples.tip).all(axis=1)]
    tip = None
    if len(tips):
        lps = placed.T_world_patient.inverse() @ tips[-1]
        x, y, z = (float(value) / MILLIMETRE for value in lps)
        tip = (x, y, z)
    return AttemptFacts(
        id=summary.id,
        moment=_moment(summary),
        title=summary.exercise_title or summary.exercise_id,
        entry_mm=_point(placed.plan.entry_mm),
        target_mm=_point(placed.plan.target_mm),
        tip_mm=tip,
        measured=_measured(summary),
        passed=None if _total(summary) is None else bool((summary.score or {}).get("passed")),
    )


def exercise_of(recording: Recording) -> Exercise | None:
    """Return the exercise of an attempt as this station has it; None where it has it no more.

    The record itself names neither folder nor file of a CT.
    """
    told = recording.metadata.get("exercise", {})
    for name in (f"{told.get('id')}@{told.get('version')}", str(told.get("id"))):
        with suppress(ExerciseError):
            return load_exercise(name)
    return None


def ct_of(recording: Recording, volume: Volume, progress: Progress | None = None) -> Volume:
    """Return the CT of an attempt, read as it was then.

    Raises:
        ExportError: if this is another CT.
        AcusError: if it cannot be read as it was then.
        Cancelled: if that was asked for.
    """
    facts = recording.ct
    if facts.is_of(volume):
        return volume
    if facts.recipe is not None and facts.recipe != volume.recipe:
        from app.imaging.reading import read_again

        again = read_again(volume.series, facts.recipe, progress)
        if facts.is_of(again):
            return again
    raise ExportError(
        sentence(
            "{id} was made on another CT ({pseudonym}): give its folder by --ct",
            id=recording.id,
            pseudonym=facts.pseudonym or "?",
        )
    )


def structures_of(
    exercise: Exercise | None, volume: Volume, progress: Progress | None = None
) -> StructureSet:
    """Return the structures of an exercise on its CT; none where it names none.

    Raises:
        AcusError: if a file of structures cannot be read, or belongs to another CT.
        Cancelled: if that was asked for.
    """
    from app.imaging.structures.files import read_structures

    found = StructureSet()
    for part in exercise.structures if exercise is not None else ():
        found = found.united(read_structures(part.file, volume, progress))
    return found


def _point(values: np.ndarray) -> tuple[float, float, float]:
    x, y, z = (float(value) for value in values)
    return x, y, z


def _total(summary: Summary) -> float | None:
    total = (summary.score or {}).get("total")
    return None if total is None else float(total)


def _measured(summary: Summary) -> tuple[MeasuredValue, ...]:
    total = _total(summary)
    found = [] if total is None else [MeasuredValue("score_total", "Score", total, "")]
    for row in (summary.score or {}).get("rows", ()):
        if row["value"] is not None:
            told = row["name"], str(row["label"]), float(row["value"]), row["unit"]
            found.append(MeasuredValue(*told))
    return tuple(found)


def _moment(summary: Summary) -> str:
    try:
        return datetime.fromisoformat(summary.started).astimezone(UTC).strftime("%Y%m%d%H%M%S")
    except ValueError as error:
        raise ExportError(
            sentence("{id} does not say when it began: its objects have no date", id=summary.id)
        ) from error
