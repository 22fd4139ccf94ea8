"""The running trainer: composes loop, tracker, plan, exercise and record into attempts."""

import threading
from collections.abc import Callable
from typing import Final

from app.core.clock import Clock, SystemClock
from app.core.errors import AcusError
from app.core.events import EventQueue
from app.exercises.locks import Lock
from app.imaging.scan_order import ScanOrder
from app.planning.placement import PlacedPlan
from app.session.arming import Arming, ClearanceOf
from app.session.attempt_log import AttemptLog
from app.session.context import RunContext
from app.session.errors import ControlLockedError
from app.session.fixes import TRUST, DepthTrust
from app.session.inputs import LoopInputs
from app.session.machine import Event
from app.session.ports import ExercisePort, FixPort, LoopPort, TrackerPort
from app.session.result import AttemptResult
from app.session.risks import Risk
from app.session.running import Running
from app.session.scored import scorer
from app.session.sight import Sight
from app.session.sleep import Sleep, words
from app.session.snapshot import Snapshot
from app.session.ticker import Ticker
from app.session.watch import Watch
from app.session.withdrawal import KIND as WITHDRAWAL
from app.session.withdrawal import Start, Withdrawal

TICK_PERIOD: Final = 0.02
"""The trainer looks at everything this often [s]."""

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
        clearance: ClearanceOf | None = None,
        held_arming: bool = False,
        risks: tuple[Risk, ...] = (),
        dial: float | None = None,
        trust: DepthTrust = TRUST,
        start: Start = Start.ANYWHERE,
    ) -> None:
        """Keep the parts.

        `advance` is for virtual time only. `clearance` is asked in every tick how much force the
        device is cleared for; without it, whoever built the loop has written it. With
        `held_arming`, forces are on only between `arm` and `disarm` during an attempt.
        `risks` are measured and recorded when an attempt ends. `dial` is the assistance that every
        attempt begins with; None for the exercise's. `trust` says how far a depth by the cameras is
        believed, `start` how the needle comes out of the skin before an attempt.
        """
        self.events = EventQueue()
        self.result: AttemptResult | None = None
        self._loop = loop
        self._placed = placed
        self._exercise = exercise
        self._dial = exercise.assistance if dial is None else dial
        self._scorer = scorer(exercise)
        self._context = context or RunContext()
        self._clock = clock or SystemClock()
        self._advance = advance
        self._risks = risks
        self._inputs = LoopInputs(loop.inbox)
        self._arming = Arming(self._inputs, held_arming, clearance)
        self._watch = Watch(loop, tracker, self._inputs, trust)
        self._running = Running(self.events)
        self._withdrawal = Withdrawal(self._inputs, start)
        self._sight = Sight(
            self._inputs, self._arming, self._watch, self._running, self.events, self._withdrawal
        )
        self._sleep = Sleep() if isinstance(self._clock, SystemClock) else Sleep(lambda: 0.0)
        self._lock = threading.RLock()
        self._ticker: Ticker | None = None

    # --- life -------------------------------------------------------------------------------------
    def open(self) -> None:
        """Start loop, tracker and ticker; idempotent.

        Raises:
            AcusError: whatever keeps loop or tracker from starting; nothing stays open then.
        """
        if self._ticker is not None:
            return
        try:
            self._inputs.prepare(self._placed, self._dial)
            self._watch.open()
        except BaseException:
            self._watch.close()
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
        self._watch.close()

    def step(self, ticks: int = 20) -> Snapshot:
        """Let virtual time pass: `ticks` of the loop, the simulated cameras, then one tick."""
        self._inputs.prepare(self._placed, self._dial)
        self.heartbeat()
        self._loop.step(ticks)
        now = self._clock.now()
        if self._advance is not None:
            self._advance(now)
        return self.tick(now)

    # --- the attempt ------------------------------------------------------------------------------
    def begin(self, student: str = "", hand: str = "") -> str:
        """Begin an attempt: everything recorded, forces armed; returns the session id.

        While the tip is inside the skin the attempt is only prepared: recorded, without force and
        without its clock, until the needle is out (state `withdrawing`).

        With `held_arming` the forces stay off until `arm`. A record that cannot be written is told
        in an event, in the messages and in the summary; the attempt goes on.

        Args:
            student: pseudonym.
            hand: what holds the needle, one of `hands.HANDS`; a run that was built for one hand
                keeps it.

        Raises:
            IllegalTransitionError: if an attempt is running.
            NotReadyError: if loop and ticker were opened but the loop has not run its first tick,
                the ticker has ended with a fault of the program, or the device is not cleared.
            SessionError: for an unknown hand.
        """
        with self._lock:
            self._running.require_idle("an attempt cannot begin")
            if self._ticker is not None:
                self._watch.require_ticks(self._ticker.failed)
            self._arming.require()
            self._inputs.prepare(self._placed, self._dial)
            self._inputs.assist(self._dial)  # whatever the dial was turned to before
            now = self._clock.now()
            header = self._context.header(self._exercise, self._placed, student, now, hand)
            recorder = self._context.recorder(header, self._loop, self._placed, self._clock)
            log = AttemptLog(recorder, self._placed, self._scorer, risks=self._risks)
            # Head and checkpoint are on the disk before the attempt's clock starts.
            failure = log.open(threaded=self._ticker is not None)
            now = self._clock.now()
            seen = self._watch.newest(self._placed, now)
            out = self._withdrawal.begin(seen.device, seen.pose, now)
            self._running.begin(log, now, failure, out)
            self.heartbeat()
            if out is None:
                self._running.say(WITHDRAWAL, self._withdrawal.words, now)
            else:
                self._arming.begin()
            self._sight.publish(self._placed, now)
            return header.id

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

    def confirm_outside(self) -> None:
        """Take the student's word that the needle is out of the skin; see `session.withdrawal`."""
        with self._lock:
            self._withdrawal.confirm()

    def scan(self, order: ScanOrder | None = None) -> int:
        """Take a control scan; returns how many were taken. Without an order it is only counted.

        Raises:
            IllegalTransitionError: if no attempt is running.
            ScanNotPossibleError: if there is an order and nobody knows where the needle is.
        """
        guidance = self._exercise.guidance
        dose = 0.0 if order is None else guidance.dose(order)
        with self._lock:
            now = self._clock.now()
            return self._running.scan(self._watch.seen, now, order, dose, guidance.streak)

    # --- intents ----------------------------------------------------------------------------------
    def hand(self, x: float, y: float, depth: float, holds: bool = True) -> None:
        """Move the simulated hand: needle direction (x, y), depth [m], whether it holds.

        It obeys nobody while it brings the needle out before an attempt.
        """
        if not self._withdrawal.moves_hand:
            self._inputs.hand(x, y, depth, holds)

    def assistance(self, value: float) -> None:
        """Set the assistance: 1 full guidance, 0 nothing, -1 full repulsion.

        Raises:
            ControlLockedError: if the exercise keeps the dial as it is; nothing has changed then.
        """
        if Lock.ASSISTANCE in self._exercise.locked:
            raise ControlLockedError(
                f"exercise {self._exercise.id} keeps the assistance at {self._dial:g}; it can be "
                "turned in exercises that do not lock it"
            )
        self._inputs.assist(value)

    @property
    def held_arming(self) -> bool:
        """Whether the forces are on only while `arm` holds them on."""
        return self._arming.held

    def arm(self) -> None:
        """Arm the forces; `begin` does, unless a held key or pedal must. Never waits."""
        self._arming.arm(lambda: self._running.counts and not self._running.paused)

    def disarm(self) -> None:
        """Switch the forces off; `end` and `abort` do. Never waits."""
        self._arming.off()

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
        self._watch.take(fix, self._placed)

    def snapshot(self) -> Snapshot:
        """Return everything as of the last tick; never waits for a running one."""
        return self._sight.newest or self.tick(self._clock.now())

    # --- one tick ---------------------------------------------------------------------------------
    def tick(self, now: float) -> Snapshot:
        """Pull the latest values, move the attempt, record, publish; `now` is the time [s]."""
        with self._lock:
            reason = self._stood_still(now) or self._sight.look(self._placed, now)
            if reason:
                self.abort(reason)
            elif self._ticker is None and self._running.log is not None:
                self._running.log.recorder.drain()
            return self._sight.publish(self._placed, now)

    def _stood_still(self, now: float) -> str:
        """Why the attempt ends if the whole program slept; empty if it did not."""
        try:
            slept = self._sleep.look(now, int(self._loop.latest().tick))
        except AcusError:  # the loop has ended: whoever looks next says so
            return ""
        if slept <= 0.0 or not self._running.attempt.running:
            return ""
        self._running.say("slept", words(slept), now, {"seconds": slept})
        return words(slept)

    def _finish(self, event: Event, reason: str = "") -> AttemptResult:
        self.disarm()
        self._withdrawal.stop()
        now = self._clock.now()
        result = self._running.finish(event, self._watch.seen, self._inputs, now, reason)
        self.disarm()  # a key that was pressed while the attempt was ending
        self.result = result
        self._sight.publish(self._placed, now)
        return result

    def _crashed(self, error: Exception) -> None:
        """Switch the forces off and keep the record after a fault of the program itself."""
        self.disarm()
        self.abort(f"fault of the program: {type(error).__name__}: {error}")
