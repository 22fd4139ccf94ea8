"""The running trainer: composes loop, tracker, plan, exercise and record into attempts."""

import threading
from collections.abc import Callable
from math import inf
from typing import Any, Final

from app.core.clock import Clock, SystemClock
from app.core.errors import AcusError
from app.core.events import EventQueue
from app.core.latest import Latest
from app.planning.placement import PlacedPlan
from app.session.attempt_log import AttemptLog
from app.session.context import RunContext
from app.session.errors import NotReadyError
from app.session.fixes import Fixes
from app.session.inputs import LoopInputs
from app.session.machine import Event
from app.session.observation import Observation, observe
from app.session.ports import ExercisePort, FixPort, LoopPort, TrackerPort
from app.session.result import AttemptResult
from app.session.running import Running
from app.session.scored import scorer
from app.session.snapshot import Snapshot, take
from app.session.ticker import Ticker

TICK_PERIOD: Final = 0.02
"""The trainer looks at everything this often [s]."""

STATISTICS_PERIOD: Final = 0.25
"""Statistics of loop and tracker are taken this often [s]; they cost more than a tick."""

Advance = Callable[[float], None]
"""Lets simulated parts other than the loop catch up with virtual time [s]."""


class Trainer:
    """One robot, one tracker, one plan, any number of attempts one after the other.

    In real time `open` starts loop, tracker and a 50 Hz ticker. In virtual time nobody calls
    `open`; `step` lets time pass. Both run the same `tick`. All methods may be called from any
    thread; `end` and `abort` write files, the others only take a lock for a moment.

    Attributes:
        events: for the window to drain: `state`, `abort`, `scan`, `recorder`, and the tracker's.
        result: of the attempt that finished last; None before the first.
    """

    def __init__(
        self,
        loop: LoopPort,
        tracker: TrackerPort | None,
        placed: PlacedPlan,
        exercise: ExercisePort,
        context: RunContext | None = None,
        clock: Clock | None = None,
        advance: Advance | None = None,
    ) -> None:
        """Keep the parts; `advance` is for virtual time only."""
        self.events = EventQueue()
        self.result: AttemptResult | None = None
        self._loop = loop
        self._tracker = tracker
        self._placed = placed
        self._exercise = exercise
        self._scorer = scorer(exercise)
        self._context = context or RunContext()
        self._clock = clock or SystemClock()
        self._advance = advance
        self._inputs = LoopInputs(loop.inbox)
        self._fixes = Fixes(loop, self._inputs)
        self._running = Running(self.events)
        self._seen: Observation | None = None
        self._latest: Latest[Snapshot] = Latest()
        self._lock = threading.RLock()
        self._ticker: Ticker | None = None
        self._prepared = False
        self._measured = -inf
        self._timing: Any = None
        self._statistics: Any = None

    # --- life -------------------------------------------------------------------------------------
    def open(self) -> None:
        """Start loop, tracker and ticker; idempotent.

        Raises:
            AcusError: whatever keeps loop or tracker from starting; nothing stays open then.
        """
        if self._ticker is not None:
            return
        try:
            self._prepare()
            self._loop.open()
            if self._tracker is not None:
                self._tracker.open()
        except BaseException:
            self._close_parts()
            raise
        self._ticker = Ticker(lambda: self.tick(self._clock.now()), TICK_PERIOD, self._crashed)
        self._ticker.open()

    def close(self) -> None:
        """Abort a running attempt, stop everything at zero force; idempotent."""
        if self._ticker is not None:
            self._ticker.close()
        self.abort("the trainer was closed")
        self._ticker = None
        self.disarm()
        self._close_parts()

    def step(self, ticks: int = 20) -> Snapshot:
        """Let virtual time pass: `ticks` of the loop, the simulated cameras, then one tick."""
        self._prepare()
        self.heartbeat()
        self._loop.step(ticks)
        now = self._clock.now()
        if self._advance is not None:
            self._advance(now)
        return self.tick(now)

    # --- the attempt ------------------------------------------------------------------------------
    def begin(self, student: str = "") -> str:
        """Begin an attempt: forces armed, everything recorded; returns the session id.

        A record that cannot be written is told in an event, in the messages and in the summary;
        the attempt goes on.

        Raises:
            IllegalTransitionError: if an attempt is running.
            NotReadyError: if loop and ticker were opened but the loop has not run its first tick,
                or the ticker has ended with a fault of the program.
        """
        with self._lock:
            self._running.require_idle("an attempt cannot begin")
            if self._ticker is not None and self._loop.latest().tick == 0:
                raise NotReadyError("the robot is still starting: begin once it reports its pose")
            if self._ticker is not None and self._ticker.failed:
                raise NotReadyError(
                    "the program has had a fault: close the exercise, open it again"
                )
            self._prepare()
            now = self._clock.now()
            log = self._new_log(student, now)
            self._running.begin(log, now, threaded=self._ticker is not None)
            self.heartbeat()
            self.arm()
            self._publish(now)
            return log.recorder.header.id

    def end(self) -> AttemptResult:
        """End the attempt: forces off, scored, record finished.

        Raises:
            IllegalTransitionError: if no attempt is running.
        """
        with self._lock:
            return self._finish(Event.END)

    def abort(self, reason: str = "by the user") -> AttemptResult | None:
        """Break a running attempt off, with the reason; nothing happens if none is running."""
        with self._lock:
            if not self._running.attempt.running:
                return None
            return self._finish(Event.ABORT, reason)

    def scan(self) -> int:
        """Take a control scan; returns how many were taken.

        Raises:
            IllegalTransitionError: if no attempt is running.
        """
        with self._lock:
            return self._running.scan(self._seen, self._clock.now())

    # --- intents ----------------------------------------------------------------------------------
    def hand(self, x: float, y: float, depth: float, holds: bool = True) -> None:
        """Move the simulated hand: needle direction (x, y), depth [m], whether it holds."""
        self._inputs.hand(x, y, depth, holds)

    def assistance(self, value: float) -> None:
        """Set the assistance: 1 full guidance, 0 nothing, -1 full repulsion."""
        self._inputs.assist(value)

    def arm(self) -> None:
        """Arm the forces; `begin` does."""
        self._inputs.arm(True)

    def disarm(self) -> None:
        """Switch the forces off; `end` and `abort` do."""
        self._inputs.arm(False)

    def heartbeat(self) -> None:
        """Tell the loop that the window lives."""
        self._inputs.heartbeat(self._clock.now())

    def place(self, placed: PlacedPlan) -> None:
        """Take another plan or placement.

        Raises:
            IllegalTransitionError: if an attempt is running.
        """
        with self._lock:
            self._running.require_idle("the plan cannot change")
            self._placed = placed
            self._inputs.path(placed.axis, placed.p_target)

    def on_fix(self, fix: FixPort) -> None:
        """Take a fix at once, as the tracker's callback; without it the ticker takes it."""
        self._fixes.take(fix, self._placed.p_entry)

    def snapshot(self) -> Snapshot:
        """Return everything as of the last tick; never waits for a running one."""
        stamped = self._latest.read()
        return stamped.value if stamped is not None else self.tick(self._clock.now())

    # --- one tick ---------------------------------------------------------------------------------
    def tick(self, now: float) -> Snapshot:
        """Pull the latest values, move the attempt, record, publish; `now` is the time [s]."""
        with self._lock:
            try:
                self._seen = self._observe(now)
                reason = self._running.look(self._seen, self._inputs) or self._tracker_fault()
            except AcusError as error:
                reason = str(error)
                last = self._seen.pose if self._seen is not None else None
                self._seen = observe(None, self._fixes, self._placed, now, last, reason)
            if reason:
                self.abort(reason)
            elif self._ticker is None and self._running.log is not None:
                self._running.log.recorder.drain()
            return self._publish(now)

    def _observe(self, now: float) -> Observation:
        stamped = self._tracker.latest.read() if self._tracker is not None else None
        if stamped is not None:
            self.on_fix(stamped.value)
        last = self._seen.pose if self._seen is not None else None
        return observe(self._loop.latest(), self._fixes, self._placed, now, last)

    def _tracker_fault(self) -> str:
        """Pass on what the tracker tells; returns its fault, if there is one."""
        if self._tracker is None or self._tracker.events is self.events:
            return ""  # a queue of one's own is drained by the window already
        reason = ""
        for event in self._tracker.events.drain():
            self._running.say(event.kind, event.message, event.time, dict(event.data))
            reason = reason or (event.message if event.kind == "fault" else "")
        return reason

    def _publish(self, now: float) -> Snapshot:
        """Publish what the last look saw, with the attempt as it is now."""
        seen = self._seen or observe(None, self._fixes, self._placed, now, None)
        if abs(now - self._measured) >= STATISTICS_PERIOD:
            self._measured = now
            self._timing = self._loop.timing()
            self._statistics = self._tracker.statistics() if self._tracker is not None else None
        snapshot = take(now, seen, self._running, self._inputs, self._timing, self._statistics)
        self._latest.publish(snapshot, now)
        return snapshot

    def _prepare(self) -> None:
        """Write path, target and the exercise's assistance, once."""
        if not self._prepared:
            self._prepared = True
            self._inputs.path(self._placed.axis, self._placed.p_target)
            self._inputs.assist(self._exercise.assistance)

    def _new_log(self, student: str, now: float) -> AttemptLog:
        header = self._context.header(self._exercise, self._placed, student, now)
        recorder = self._context.recorder(header, self._loop, self._placed, self._clock)
        return AttemptLog(recorder, self._placed, self._scorer)

    def _finish(self, event: Event, reason: str = "") -> AttemptResult:
        self.disarm()
        now = self._clock.now()
        result = self._running.finish(event, self._seen, self._inputs, now, reason)
        self.result = result
        self._publish(now)
        return result

    def _crashed(self, error: Exception) -> None:
        """Switch the forces off and keep the record after a fault of the program itself."""
        self.disarm()
        self.abort(f"fault of the program: {type(error).__name__}: {error}")

    def _close_parts(self) -> None:
        if self._tracker is not None:
            self._tracker.close()
        self._loop.close()
