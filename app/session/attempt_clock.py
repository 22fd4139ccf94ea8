"""The clock that the student sees in an attempt: from its first movement, without its pauses.

A record begins earlier, while the needle is still brought out, and goes on through pauses. Whatever
a student reads of a moment of his attempt is told by this clock, live and in the debrief.
"""

from __future__ import annotations

from collections.abc import Iterable
from dataclasses import dataclass, replace
from math import inf

from app.core.events import Event
from app.session.machine import COUNTING, FINAL, State

__all__ = ["AttemptClock"]

_KINDS = ("state", "abort")


@dataclass(frozen=True, slots=True)
class AttemptClock:
    """Moments [s, monotonic] of an attempt that start, hold and stop its clock.

    Attributes:
        began: when it started; None before.
        pauses: begin and end of each, in order; the end of one that lasts is inf.
        ended: when it stopped; inf before.
    """

    began: float | None = None
    pauses: tuple[tuple[float, float], ...] = ()
    ended: float = inf

    @classmethod
    def of(cls, events: Iterable[Event]) -> AttemptClock:
        """Read the clock off the events of an attempt, in order."""
        clock = cls()
        for event in events:
            clock = clock.after(event)
        return clock

    def after(self, event: Event) -> AttemptClock:
        """Return the clock after one more event."""
        state = event.data.get("state") if event.kind in _KINDS else None
        if state is None:
            return self
        clock = self
        if clock.pauses and clock.pauses[-1][1] == inf and state != State.PAUSED:
            clock = replace(clock, pauses=(*clock.pauses[:-1], (clock.pauses[-1][0], event.time)))
        if clock.began is None:
            return replace(clock, began=event.time) if state in COUNTING else clock
        if state == State.PAUSED and not (clock.pauses and clock.pauses[-1][1] == inf):
            return replace(clock, pauses=(*clock.pauses, (event.time, inf)))
        return replace(clock, ended=event.time) if state in FINAL else clock

    def at(self, moment: float) -> float:
        """Return what the clock shows at a moment [s]: 0 before it started."""
        if self.began is None:
            return 0.0
        now = min(moment, self.ended)
        waited = sum(max(0.0, min(now, end) - begin) for begin, end in self.pauses)
        return max(0.0, now - self.began - waited)

    def moment(self, shown: float) -> float:
        """Return the first moment [s] at which the clock shows so many seconds, or would."""
        moment = (self.began or 0.0) + shown
        for begin, end in self.pauses:
            if moment > begin and end < inf:
                moment += end - begin
        return moment
