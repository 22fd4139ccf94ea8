"""What an attempt came to: the value behind the debrief page."""

from collections.abc import Mapping
from dataclasses import dataclass
from pathlib import Path

from app.core.events import Event
from app.scoring.result import Score
from app.scoring.trajectory import Trajectory
from app.session.curves import Curves
from app.session.machine import State
from app.session.recording import Recording
from app.session.summary import Summary


@dataclass(frozen=True, slots=True, eq=False)
class AttemptResult:
    """Result of one attempt.

    Attributes:
        summary: what the list of sessions shows.
        state: `ended` or `aborted`.
        reason: why it was aborted; empty otherwise.
        duration: from begin to end [s].
        phases: time spent per state [s].
        scans: control scans taken.
        score: the score, void where the attempt counts for nothing; None if it cannot be scored.
        unscored: why there is no score; empty if there is one.
        curves: figures over time.
        trajectory: what was scored; None if the samples make none.
        events: events in order.
        record: the record's file; None if nothing was recorded.
        recording: what the record holds, as it is in memory: nothing is read back to show it.
    """

    summary: Summary
    state: State
    reason: str
    duration: float
    phases: Mapping[State, float]
    scans: int
    score: Score | None
    unscored: str
    curves: Curves
    trajectory: Trajectory | None
    events: tuple[Event, ...]
    record: Path | None
    recording: Recording | None = None
