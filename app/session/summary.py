"""What a list of sessions shows of an attempt, as a value; `sidecar` keeps it by the record."""

import json
from collections.abc import Mapping
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any, Final

import numpy as np

from app import __version__
from app.core.disclaimer import DISCLAIMER
from app.core.json_values import finite
from app.core.messages import sentence
from app.scoring.conditions import Conditions
from app.scoring.result import Score
from app.session.abort_reasons import known_reason
from app.session.machine import FINAL, State
from app.session.recording import Recording
from app.session.schemas import SCORE, conforms
from app.session.verify import Verification, conditions, state_of, verify

UNFINISHED: Final = "unfinished"
"""State of a record whose attempt was neither ended nor aborted (the program was killed)."""

BROKEN: Final = "broken"
"""State of a file that cannot be read."""

_VERSION: Final = 2


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
        conditions: what the score was made under; None where nothing is known.
        signature: `verified`, `altered` or `unsigned` where a list has looked, else empty; no part
            of the attempt, and kept nowhere.
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
    conditions: Conditions | None = None
    signature: str = field(default="", compare=False)

    @property
    def calibration(self) -> str:
        """Id of the cameras' calibration; empty for simulated or uncalibrated ones."""
        return self.conditions.calibration if self.conditions is not None else ""

    def document(self) -> dict[str, Any]:
        """JSON-ready mapping; the keys stand in docs/json.md."""
        document: dict[str, Any] = {
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
            "conditions": None if self.conditions is None else finite(self.conditions.document()),
            "note": DISCLAIMER,
        }
        return document | {"signature": self.signature} if self.signature else document

    @classmethod
    def of(cls, document: Mapping[str, Any], name: str) -> "Summary":
        """Read what `document` wrote, for the record of that name.

        Raises:
            ValueError, LookupError, TypeError, ArithmeticError, RecursionError: if it is no such
                document.
        """
        if document["version"] != _VERSION:
            raise ValueError(
                sentence(
                    "version {version!r}; only {known_version} is known",
                    version=document["version"],
                    known_version=_VERSION,
                )
            )
        exercise, score, known = document["exercise"], document["score"], document["conditions"]
        return cls(
            id=name,
            started=str(document["started"]),
            student=str(document["student"]),
            exercise_id=str(exercise["id"]),
            exercise_title=str(exercise["title"]),
            state=str(document["state"]),
            reason=str(document["reason"]),
            duration=float(document["duration_s"] or 0.0),
            scans=int(document["scans"]),
            score=checked_score(score) if score is not None else None,
            problems=tuple(str(problem) for problem in document["problems"]),
            software=str(document["software"]),
            conditions=None if known is None else Conditions.of(known),
        )


def derive(recording: Recording, outcome: Verification | None = None) -> Summary:
    """Summary of a record, its score computed anew (`outcome`, where it has been already)."""
    outcome = outcome or verify(recording)
    session = recording.metadata["session"]
    exercise = recording.metadata.get("exercise", {})
    result = recording.metadata.get("result", {})
    time = recording.samples.time
    measured = float(time[-1] - time[0]) - _paused(recording) if len(time) else 0.0
    standing = outcome.standing
    return Summary(
        id=recording.path.stem,  # what `find` takes, also of a record that was renamed
        started=session.get("started", ""),
        student=session.get("student", ""),
        exercise_id=exercise.get("id", ""),
        exercise_title=exercise.get("title", ""),
        state=_state(recording),
        reason=known_reason(result.get("reason", "")),
        duration=_number(result.get("duration_s"), measured),
        scans=sum(event.kind == "scan" for event in recording.events),
        score=None if standing is None else document_of(standing),
        problems=(*recording.problems, *outcome.remarks()),
        software=recording.metadata.get("software", {}).get("version", ""),
        conditions=conditions(recording, standing),
    )


def document_of(score: Score) -> Mapping[str, Any]:
    """Return a score as it stands in files; None for what is not finite."""
    document: dict[str, Any] = json.loads(score.to_json())
    return MappingProxyType(document)


def checked_score(document: Any) -> Mapping[str, Any]:
    """Return a score that lists and tables can be made of; raises ValueError if it is none."""
    if not conforms(document, SCORE):
        raise ValueError(sentence("not a stored score"))
    return MappingProxyType(document)


def _state(recording: Recording) -> str:
    state = state_of(recording)
    return state if state in {final.value for final in FINAL} else UNFINISHED


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
