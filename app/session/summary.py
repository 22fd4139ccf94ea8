"""What a list of sessions shows of each: kept beside the record, or derived from it."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from types import MappingProxyType
from typing import Any, Final

import numpy as np

from app import __version__
from app.core.disclaimer import DISCLAIMER
from app.core.files import write_atomically
from app.session.errors import BrokenRecordingError
from app.session.machine import FINAL, State
from app.session.recording import Recording, read_recording
from app.session.sample import finite
from app.session.schemas import SCORE, conforms

SCORE_FILE: Final = "score.json"
"""Name of the attachment that holds the score."""

UNFINISHED: Final = "unfinished"
"""State of a record whose attempt was neither ended nor aborted (the program was killed)."""

BROKEN: Final = "broken"
"""State of a file that cannot be read."""

_VERSION: Final = 1


@dataclass(frozen=True, slots=True)
class Summary:
    """One line of the list.

    Attributes:
        id: session id.
        started: wall-clock time, ISO 8601, UTC.
        student: pseudonym.
        exercise_id: exercise.
        exercise_title: its title.
        state: `ended`, `aborted`, `unfinished` or `broken`.
        reason: why it was aborted or is broken; empty otherwise.
        duration: of the attempt [s].
        scans: control scans taken.
        score: as `result.score_document` gives it, or None if it was not scored.
        problems: what the record lacks, one line each.
        software: version that recorded it.
        calibration: id of the cameras' calibration; empty for simulated or uncalibrated ones.
    """

    id: str
    started: str
    student: str = ""
    exercise_id: str = ""
    exercise_title: str = ""
    state: str = UNFINISHED
    reason: str = ""
    duration: float = 0.0
    scans: int = 0
    score: Mapping[str, Any] | None = None
    problems: tuple[str, ...] = ()
    software: str = field(default=__version__)
    calibration: str = ""

    def document(self) -> dict[str, Any]:
        """JSON-ready mapping; the keys stand in docs/json.md."""
        return {
            "version": _VERSION,
            "id": self.id,
            "started": self.started,
            "student": self.student,
            "exercise": {"id": self.exercise_id, "title": self.exercise_title},
            "state": self.state,
            "reason": self.reason,
            "duration_s": finite(self.duration),
            "scans": self.scans,
            "score": finite(self.score),
            "problems": list(self.problems),
            "software": self.software,
            "calibration": self.calibration,
            "note": DISCLAIMER,
        }


def sidecar(path: Path) -> Path:
    """Return the summary's file beside a record."""
    return path.with_suffix(".json")


def write_summary(path: Path, summary: Summary) -> None:
    """Write the summary beside the record `path`, whole or not at all."""
    text = json.dumps(summary.document(), indent=1, allow_nan=False, ensure_ascii=False)
    write_atomically(sidecar(path), text + "\n")


def read_summary(path: Path) -> Summary:
    """Return the summary of a record: from its sidecar, else from the record itself; never raises.

    A record that cannot be read gives a summary of state `broken` with the reason.
    """
    try:
        return _parse(json.loads(sidecar(path).read_text(encoding="utf-8")), path.stem)
    except (OSError, ValueError, LookupError, TypeError, ArithmeticError, RecursionError):
        pass  # no sidecar, or not one of ours: the record knows
    try:
        return derive(read_recording(path))
    except BrokenRecordingError as error:
        return Summary(path.stem, _modified(path), state=BROKEN, reason=str(error), software="")


def derive(recording: Recording) -> Summary:
    """Summary of a record that has no sidecar."""
    session = recording.metadata["session"]
    exercise = recording.metadata.get("exercise", {})
    result = recording.metadata.get("result", {})
    time = recording.samples.time
    measured = float(time[-1] - time[0]) - _paused(recording) if len(time) else 0.0
    return Summary(
        id=recording.path.stem,  # what `find` takes, also of a record that was renamed
        started=session.get("started", ""),
        student=session.get("student", ""),
        exercise_id=exercise.get("id", ""),
        exercise_title=exercise.get("title", ""),
        state=_state(recording, result),
        reason=result.get("reason", ""),
        duration=_number(result.get("duration_s"), measured),
        scans=sum(event.kind == "scan" for event in recording.events),
        score=_score(recording),
        problems=recording.problems,
        software=recording.metadata.get("software", {}).get("version", ""),
        calibration=recording.metadata.get("cameras", {}).get("calibration", ""),
    )


def _parse(document: dict[str, Any], name: str) -> Summary:
    if document["version"] != _VERSION:
        raise ValueError(f"version {document['version']!r}; only {_VERSION} is known")
    json.dumps(document, ensure_ascii=False).encode()  # text that cannot be printed is not ours
    exercise = document["exercise"]
    score = document["score"]
    return Summary(
        id=name,
        started=str(document["started"]),
        student=str(document["student"]),
        exercise_id=str(exercise["id"]),
        exercise_title=str(exercise["title"]),
        state=str(document["state"]),
        reason=str(document["reason"]),
        duration=float(document["duration_s"] or 0.0),
        scans=int(document["scans"]),
        score=_checked_score(score) if score is not None else None,
        problems=tuple(str(problem) for problem in document["problems"]),
        software=str(document["software"]),
        calibration=str(document.get("calibration", "")),  # older ones have none
    )


def _state(recording: Recording, result: dict[str, str]) -> str:
    if result.get("state") in {state.value for state in FINAL}:
        return result["state"]
    states = recording.samples.state
    last = str(states[-1]) if len(states) else ""
    return last if last in {state.value for state in FINAL} else UNFINISHED


def _score(recording: Recording) -> Mapping[str, Any] | None:
    try:
        return _checked_score(json.loads(recording.attachments[SCORE_FILE]))
    except (KeyError, ValueError, RecursionError):
        return None


def _checked_score(document: Any) -> Mapping[str, Any]:
    """Return a score that lists and tables can be made of; raises ValueError if it is none."""
    if not conforms(document, SCORE):
        raise ValueError("not a stored score")
    return MappingProxyType(document)


def _paused(recording: Recording) -> float:
    """Time that the attempt waited for the cameras [s], which is no part of its duration."""
    samples = recording.samples
    paused = samples.state[:-1] == State.PAUSED.value
    return float(np.sum(np.diff(samples.time)[paused]))


def _number(text: str | None, otherwise: float) -> float:
    try:
        return float(text) if text is not None else otherwise
    except ValueError:
        return otherwise


def _modified(path: Path) -> str:
    try:
        seconds = path.stat().st_mtime
    except OSError:
        seconds = 0.0
    return datetime.fromtimestamp(seconds, UTC).isoformat(timespec="milliseconds")
