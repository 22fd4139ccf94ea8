"""Stored attempts scored anew under the bands and rules that an exercise has now.

Metrics are computed again from the record's samples by this program's rules, then judged by the
bands of the hand that made the attempt. A record is named by its path and its digest: workers on
other computers read it from a folder that all share.
"""

from __future__ import annotations

import time
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from app.cohort.errors import CohortError
from app.cohort.running import Crew, Made, RunOutcome, WorkPart, run
from app.cohort.table import Columns, Row
from app.core.errors import AcusError
from app.core.messages import sentence
from app.core.progress import Progress
from app.exercises.library import library
from app.exercises.schema import Exercise
from app.scoring.metrics import available
from app.scoring.score import score
from app.session.machine import FINAL
from app.session.recording import open_recording
from app.session.sidecar import file_digest
from app.session.store import SUFFIX, list_sessions
from app.session.verify import conditions, state_of, written_score

if TYPE_CHECKING:
    from app.session.summary import Summary

RECORDS: Final = 32
"""In one part: half a second of one processor."""

_COLUMNS: Final[Columns] = {
    "id": str,
    "started": str,
    "student": str,
    "signature": str,
    "record_sha256": str,
    "exercise": str,
    "version": int,
    "rubric_version": int,
    "hand": str,
    "scripted": str,
    "device": str,
    "seed": int,
    "state": str,
    "duration_s": float,
    "written_total": float,
    "written_passed": bool,
    "written_scoring": int,
    "total": float,
    "total_sd": float,
    "passed": bool,
    "void_reason": str,
    "not_scored": str,
}


def rescore(
    folder: Path,
    out: Path,
    crew: Crew,
    exercise: Exercise | None = None,
    progress: Progress | None = None,
) -> RunOutcome:
    """Score the attempts of a folder anew and write their table, the oldest first.

    Attempts that cannot be scored have a row that says why.

    Args:
        folder: of the records.
        out: table to write.
        crew: who works.
        exercise: whose attempts are scored, by its bands and rules; None takes every attempt, each
            by its exercise as the library has it now.
        progress: of the work.

    Raises:
        CohortError: if there is no such attempt, the table not be written, or nobody works.
        SessionError: if the folder cannot be read.
        Cancelled: if `progress` was cancelled.
    """
    every = sorted(list_sessions(folder), key=lambda one: one.id)
    chosen = [one for one in every if exercise is None or one.exercise_id == exercise.id]
    if not chosen:
        whose = "" if exercise is None else sentence(" of exercise {id}", id=exercise.id)
        raise CohortError(
            sentence("there is no attempt{whose} in {folder}", whose=whose, folder=folder)
        )
    rubrics = {} if exercise is None else {exercise.id: _rubric(exercise)}
    if exercise is None:
        known = library()
        named = {one.exercise_id for one in chosen}
        rubrics = {one.id: _rubric(one) for one in known if one.id in named}
    parts = [
        _part(folder, chosen[begin : begin + RECORDS], rubrics)
        for begin in range(0, len(chosen), RECORDS)
    ]
    return run(parts, columns(), out, crew, progress)


def columns() -> Columns:
    """Return the columns of the table: the attempt, both scores, then every metric's value."""
    own = [name for name, metric in available().items() if metric.is_own]
    return {**_COLUMNS, **{f"value_{name}": float for name in own}}


def _rubric(exercise: Exercise) -> dict[str, Any]:
    """Return what judges: the exercise without what decides about its course alone."""
    return exercise.model_dump(mode="json", by_alias=True)


def _part(
    folder: Path, chosen: Sequence[Summary], rubrics: Mapping[str, dict[str, Any]]
) -> WorkPart:
    named = {one.exercise_id for one in chosen}
    records = [_listed(folder / f"{one.id}{SUFFIX}", one) for one in chosen]
    own = {name: rubric for name, rubric in sorted(rubrics.items()) if name in named}
    return WorkPart(_scores, {"records": records, "rubrics": own}, len(records))


def _listed(path: Path, summary: Summary) -> dict[str, Any]:
    """Return what this computer knows of a record; its digest is empty where it cannot be read."""
    try:
        digest = file_digest(path)
    except OSError:
        digest = ""
    return {
        "path": str(path.absolute()),
        "id": summary.id,
        "started": summary.started,
        "student": summary.student,
        "signature": summary.signature,
        "record_sha256": digest,
        "exercise": summary.exercise_id,
        "state": summary.state,
        "duration_s": summary.duration,
        "reason": str(summary.reason),
    }


def _scores(given: dict[str, Any]) -> Made:
    """Score some records."""
    begin = time.process_time()
    rubrics = {
        name: Exercise.model_validate(document) for name, document in given["rubrics"].items()
    }
    ready = time.process_time()
    rows = [_row(record, rubrics.get(record["exercise"])) for record in given["records"]]
    return rows, ready - begin, time.process_time() - ready


def _row(record: dict[str, Any], rubric: Exercise | None) -> Row:
    row = {name: value for name, value in record.items() if name not in ("path", "reason")}
    path = Path(record["path"])
    if not record["record_sha256"]:
        return row | {"not_scored": record["reason"] or sentence("the record cannot be read")}
    try:
        same = file_digest(path) == record["record_sha256"]
    except OSError as error:
        raise CohortError(
            sentence(
                "a worker cannot read {path} ({reason}): give --folder a folder that all computers "
                "see under one name",
                path=path,
                reason=error.strerror or error,
            )
        ) from error
    if not same:
        raise CohortError(
            sentence(
                "{path} is another file for a worker, or was changed meanwhile: start again",
                path=path,
            )
        )
    try:
        return row | _scored(path, rubric)
    except AcusError as error:
        return row | {"not_scored": str(error)}


def _scored(path: Path, rubric: Exercise | None) -> Row:
    recording = open_recording(path)
    written, _ = written_score(recording)
    made = conditions(recording, written)
    row: Row = {
        "version": made.version,
        "hand": made.hand,
        "scripted": made.scripted,
        "device": made.device,
        "seed": made.seed,
    }
    if written is not None:
        row |= {
            "written_total": written.total,
            "written_passed": written.passed,
            "written_scoring": written.version,
        }
    if rubric is None:
        return row | {"not_scored": sentence("its exercise is not in the library")}
    row["rubric_version"] = rubric.version
    if state_of(recording) not in {state.value for state in FINAL}:
        return row | {"not_scored": sentence("the attempt was not finished")}
    new = score(recording.trajectory(), rubric.tolerances_for(made.hand), rubric.rules)
    return (
        row
        | {f"value_{one.name}": one.value for one in new.rows}
        | {
            "total": new.total,
            "total_sd": new.total_sd,
            "passed": new.passed,
            "void_reason": str(new.void_reason),
        }
    )
