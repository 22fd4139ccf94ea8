"""The trainer's eyes: newest observation of robot and cameras, statistics, the tracker's news."""

from __future__ import annotations

from math import inf
from typing import TYPE_CHECKING, Final

from app.core.events import EventQueue
from app.planning.placement import PlacedPlan
from app.session.errors import NotReadyError
from app.session.fixes import TRUST, DepthTrust, Fixes
from app.session.inputs import LoopInputs
from app.session.observation import Observation, observe
from app.session.ports import FixPort, LoopPort, TrackerPort
from app.session.running import Running

if TYPE_CHECKING:
    from app.device.control.timing import Timing
    from app.tracking.statistics import TrackerStatistics

STATISTICS_PERIOD: Final = 0.25
"""Statistics of loop and tracker are taken this often [s]; they cost more than a look."""


class Watch:
    """Looks at loop and tracker, and opens and closes them together.

    Attributes:
        seen: newest observation; None before the first.
        timing: lateness of the loop, as it reported it last.
        statistics: of the tracker, as it reported them last; None without one.
    """

    def __init__(
        self,
        loop: LoopPort,
        tracker: TrackerPort | None,
        inputs: LoopInputs,
        trust: DepthTrust = TRUST,
    ) -> None:
        self.seen: Observation | None = None
        self.timing: Timing | None = None
        self.statistics: TrackerStatistics | None = None
        self._loop = loop
        self._tracker = tracker
        self._fixes = Fixes(loop, inputs, trust)
        self._measured = -inf

    def open(self) -> None:
        """Start loop and tracker.

        Raises:
            AcusError: whatever keeps one from starting.
        """
        self._loop.open()
        if self._tracker is not None:
            self._tracker.open()

    def close(self) -> None:
        """Stop both; idempotent."""
        if self._tracker is not None:
            self._tracker.close()
        self._loop.close()

    def require_ticks(self, failed: bool) -> None:
        """Refuse what must not begin without a running loop, or after a `failed` ticker.

        Raises:
            NotReadyError: saying which.
        """
        if self._loop.latest().tick == 0:
            raise NotReadyError("the robot is still starting: begin once it reports its pose")
        if failed:
            raise NotReadyError("the program has had a fault: close the exercise, open it again")

    def take(self, fix: FixPort, placed: PlacedPlan) -> None:
        """Take a fix."""
        self._fixes.take(fix, placed.p_entry)

    def look(self, placed: PlacedPlan, now: float) -> Observation:
        """Observe at `now` [s].

        Raises:
            AcusError: if the loop has ended; `blind` then says why nothing is seen.
        """
        stamped = self._tracker.latest.read() if self._tracker is not None else None
        if stamped is not None:
            self.take(stamped.value, placed)
        last = self.seen.pose if self.seen is not None else None
        self.seen = observe(self._loop.latest(), self._fixes, placed, now, last)
        return self.seen

    def blind(self, placed: PlacedPlan, now: float, reason: str) -> None:
        """Observe that the robot says nothing, and why."""
        last = self.seen.pose if self.seen is not None else None
        self.seen = observe(None, self._fixes, placed, now, last, reason)

    def newest(self, placed: PlacedPlan, now: float) -> Observation:
        """Return the newest observation, with statistics that are not too old."""
        if abs(now - self._measured) >= STATISTICS_PERIOD:
            self._measured = now
            self.timing = self._loop.timing()
            self.statistics = self._tracker.statistics() if self._tracker is not None else None
        return self.seen or observe(None, self._fixes, placed, now, None)

    def news(self, running: Running, own: EventQueue) -> str:
        """Pass on what the tracker tells; returns its fault, if there is one.

        A queue that is the trainer's `own` is drained by the window already.
        """
        if self._tracker is None or self._tracker.events is own:
            return ""
        reason = ""
        for event in self._tracker.events.drain():
            running.say(event.kind, event.message, event.time, dict(event.data))
            reason = reason or (event.message if event.kind == "fault" else "")
        return reason
