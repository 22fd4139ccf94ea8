"""The attempt as an explicit state machine: a table, a value and one pure function."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from enum import StrEnum
from math import isfinite
from types import MappingProxyType
from typing import Final

from app.core.errors import NumericalError
from app.core.messages import sentence
from app.session.errors import IllegalTransitionError


class State(StrEnum):
    """Where an attempt is."""

    READY = "ready"
    WITHDRAWING = "withdrawing"
    ALIGNING = "aligning"
    INSERTING = "inserting"
    HOLDING = "holding"
    PAUSED = "paused"
    ENDED = "ended"
    ABORTED = "aborted"


class AttemptEvent(StrEnum):
    """What moves an attempt."""

    PREPARE = "prepare"
    BEGIN = "begin"
    INSERT = "insert"
    HOLD = "hold"
    WITHDRAW = "withdraw"
    PAUSE = "pause"
    RESUME = "resume"
    END = "end"
    ABORT = "abort"


TABLE: Final[Mapping[tuple[State, AttemptEvent], State]] = MappingProxyType(
    {
        (State.READY, AttemptEvent.PREPARE): State.WITHDRAWING,
        (State.READY, AttemptEvent.BEGIN): State.ALIGNING,
        (State.READY, AttemptEvent.ABORT): State.ABORTED,
        (State.WITHDRAWING, AttemptEvent.BEGIN): State.ALIGNING,
        (State.WITHDRAWING, AttemptEvent.END): State.ENDED,
        (State.WITHDRAWING, AttemptEvent.ABORT): State.ABORTED,
        (State.ALIGNING, AttemptEvent.INSERT): State.INSERTING,
        (State.ALIGNING, AttemptEvent.PAUSE): State.PAUSED,
        (State.ALIGNING, AttemptEvent.END): State.ENDED,
        (State.ALIGNING, AttemptEvent.ABORT): State.ABORTED,
        (State.INSERTING, AttemptEvent.HOLD): State.HOLDING,
        (State.INSERTING, AttemptEvent.WITHDRAW): State.ALIGNING,
        (State.INSERTING, AttemptEvent.PAUSE): State.PAUSED,
        (State.INSERTING, AttemptEvent.END): State.ENDED,
        (State.INSERTING, AttemptEvent.ABORT): State.ABORTED,
        (State.HOLDING, AttemptEvent.INSERT): State.INSERTING,
        (State.HOLDING, AttemptEvent.WITHDRAW): State.ALIGNING,
        (State.HOLDING, AttemptEvent.PAUSE): State.PAUSED,
        (State.HOLDING, AttemptEvent.END): State.ENDED,
        (State.HOLDING, AttemptEvent.ABORT): State.ABORTED,
        (State.PAUSED, AttemptEvent.RESUME): State.INSERTING,
        (State.PAUSED, AttemptEvent.WITHDRAW): State.ALIGNING,
        (State.PAUSED, AttemptEvent.END): State.ENDED,
        (State.PAUSED, AttemptEvent.ABORT): State.ABORTED,
    }
)
"""Every legal transition; nothing else is legal."""

RUNNING: Final = frozenset(
    {State.WITHDRAWING, State.ALIGNING, State.INSERTING, State.HOLDING, State.PAUSED}
)
"""States in which the attempt is being recorded; it counts from `aligning` on."""

IN_BODY: Final = frozenset({State.INSERTING, State.HOLDING})
"""States with the needle in the body, but for a pause, which stands wherever it is."""

COUNTING: Final = IN_BODY | {State.ALIGNING}
"""States in which the time of an attempt counts."""

FINAL: Final = frozenset({State.ENDED, State.ABORTED})
"""States that nothing leaves."""


@dataclass(frozen=True, slots=True)
class Attempt:
    """One attempt at one moment.

    Attributes:
        state: where it is.
        since: when it came into this state [s].
        began: when it began [s]; None while ready, and while the needle is brought out before.
        elapsed: completed time per state [s]; the present visit is not in it yet.
        reason: why it was aborted; empty otherwise.
    """

    state: State = State.READY
    since: float = 0.0
    began: float | None = None
    elapsed: Mapping[State, float] = field(default_factory=lambda: MappingProxyType({}))
    reason: str = ""

    @property
    def running(self) -> bool:
        """Return whether it has begun and not finished."""
        return self.state in RUNNING

    @property
    def finished(self) -> bool:
        """Return whether nothing can happen to it any more."""
        return self.state in FINAL

    def phases(self, now: float) -> dict[State, float]:
        """Time spent in each running state up to `now` [s]."""
        times = dict(self.elapsed)
        if self.running:
            times[self.state] = times.get(self.state, 0.0) + max(0.0, now - self.since)
        return times

    def duration(self, now: float) -> float:
        """Time since the beginning without pauses [s]; stands still once finished, 0 before."""
        if self.began is None:
            return 0.0
        end = self.since if self.finished else max(self.since, now)
        return end - self.began - self.phases(end).get(State.PAUSED, 0.0)


def legal(state: State) -> tuple[AttemptEvent, ...]:
    """Return the events that `state` knows."""
    return tuple(event for (origin, event) in TABLE if origin is state)


def advance(attempt: Attempt, event: AttemptEvent, time: float, reason: str = "") -> Attempt:
    """Apply one event.

    Args:
        attempt: the attempt before.
        event: what happens.
        time: when [s]; may equal the last transition's time.
        reason: why, for an abort.

    Raises:
        IllegalTransitionError: if the state does not know the event.
        NumericalError: if the time is not finite or lies before the last transition.
    """
    target = TABLE.get((attempt.state, event))
    if target is None:
        names = ", ".join(legal(attempt.state)) or "none (the attempt is over: start a new one)"
        raise IllegalTransitionError(
            sentence(
                "'{event}' is not possible while {attempt_state}; possible: {names}",
                event=event,
                attempt_state=attempt.state,
                names=names,
            )
        )
    first = attempt.state is State.READY
    if not isfinite(time) or (not first and time < attempt.since):
        raise NumericalError(
            sentence(
                "'{event}' at {time} s lies before the last change at {attempt_since} s",
                event=event,
                time=time,
                attempt_since=attempt.since,
            )
        )
    return replace(
        attempt,
        state=target,
        since=time,
        began=time if event is AttemptEvent.BEGIN else attempt.began,
        elapsed=MappingProxyType(attempt.phases(time)),
        reason=reason if event is AttemptEvent.ABORT else attempt.reason,
    )
