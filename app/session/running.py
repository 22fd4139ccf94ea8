"""The present attempt: its state, its log, and the events that the window drains."""

from app.core.events import Event, EventQueue
from app.imaging.scan_order import ScanOrder
from app.session import control_scan, machine
from app.session.attempt_log import AttemptLog
from app.session.depth_news import DepthNews
from app.session.errors import IllegalTransitionError
from app.session.inputs import LoopInputs
from app.session.machine import Attempt
from app.session.observation import Observation
from app.session.pauses import PAUSED_WORDS, RESUMED_WORDS, Pauses
from app.session.phases import DEFAULT, Classifier, Thresholds, classify
from app.session.result import AttemptResult


class Running:
    """Moves one attempt after the other; not thread-safe, the trainer holds the lock.

    Attributes:
        attempt: the present one, or the last.
        log: what it leaves behind; None before the first.
        events: for the window.
    """

    def __init__(self, events: EventQueue, thresholds: Thresholds = DEFAULT) -> None:
        self.attempt = Attempt()
        self.log: AttemptLog | None = None
        self.events = events
        self._thresholds = thresholds
        self._classifier = Classifier()
        self._depth = DepthNews()
        self._pauses = Pauses()

    @property
    def paused(self) -> bool:
        """Whether the attempt waits for the cameras."""
        return self.attempt.state is machine.State.PAUSED

    def require_idle(self, what: str) -> None:
        """Refuse what is not possible during an attempt.

        Raises:
            IllegalTransitionError: naming the state.
        """
        if self.attempt.running:
            raise IllegalTransitionError(
                f"{what} while {self.attempt.state}: end the attempt first"
            )

    def begin(self, log: AttemptLog, now: float, threaded: bool) -> None:
        """Begin a new attempt at `now` [s].

        Raises:
            IllegalTransitionError: if one is running.
        """
        self.require_idle("an attempt cannot begin")
        self.attempt = machine.advance(Attempt(), machine.Event.BEGIN, now)
        self._classifier, self._depth, self.log = Classifier(), DepthNews(), log
        self._pauses = Pauses()
        failure = log.open(threaded)
        if failure:
            self.say("recorder", f"this attempt is not recorded: {failure}", now)
        self._say_state(now)

    def look(self, seen: Observation, inputs: LoopInputs, held_arming: bool = False) -> str:
        """Classify and record one observation; returns why the attempt cannot go on, or nothing.

        `held_arming`: whether a person can arm again after a fault.
        """
        log, attempt = self.log, self.attempt
        if log is None or not attempt.running or attempt.began is None:
            return ""
        reason = seen.fatal(attempt.began, held_arming)
        if reason:
            return reason
        self._classifier, event = classify(
            self._classifier, attempt.state, seen.pose, seen.offset.distance, self._thresholds
        )
        event = self._pauses.look(attempt.state, seen.pose, seen.fix_status) or event
        if event is not None:
            self._change(event, seen.time)
        news = self._depth.look(seen.pose)
        if news:
            self.say("depth", news, seen.time, {"source": seen.pose.depth_source.value})
        log.sample(seen.sample(self.attempt.state, inputs))
        return ""

    def scan(
        self, seen: Observation | None, now: float, order: ScanOrder | None = None,
        dose: float = 0.0, streak: bool = False,
    ) -> int:  # fmt: skip
        """Take a control scan at `now` [s]; without an order it is only counted.

        `dose` is notional, of the whole scan [mGy·cm]; `streak` whether the metal leaves one.

        Raises:
            IllegalTransitionError: if no attempt is running.
            ScanNotPossibleError: if nobody knows where the needle is.
        """
        if self.log is None or not self.attempt.running:
            raise IllegalTransitionError(
                f"a control scan is not possible while {self.attempt.state}: begin an attempt first"
            )
        number = self.log.scans + 1
        data: dict[str, object] = {"number": number}
        if order is not None:
            data |= control_scan.take(
                number, order, dose, now, seen, self.log.placed, streak
            ).data()
        self.log.scans = number
        if seen is not None and seen.pose.valid:
            data["tip_m"] = seen.pose.p_tip.tolist()
        self.say("scan", f"control scan {self.log.scans}", now, data)
        return self.log.scans

    def finish(
        self,
        event: machine.Event,
        seen: Observation | None,
        inputs: LoopInputs,
        now: float,
        reason: str = "",
    ) -> AttemptResult:
        """End or abort the attempt at `now` [s], score it and finish its record.

        Raises:
            IllegalTransitionError: if no attempt is running.
        """
        self._advance(event, now, reason)
        if self.log is None:
            raise IllegalTransitionError("no attempt has begun")
        if seen is not None and seen.time >= (self.attempt.began or 0.0):
            self.log.sample(seen.sample(self.attempt.state, inputs))
        return self.log.finish(self.attempt)

    def say(
        self, kind: str, message: str, now: float, data: dict[str, object] | None = None
    ) -> None:
        """Tell the window and the record that something happened."""
        event = Event(now, kind, message, data or {})
        self.events.put(event)
        if self.log is not None:
            self.log.event(event)

    def _change(self, event: machine.Event, now: float) -> None:
        self._advance(event, now)
        if event is machine.Event.PAUSE:
            self.say("pause", PAUSED_WORDS, now)
        elif event is machine.Event.RESUME:
            self._classifier = Classifier()
            self.say("pause", RESUMED_WORDS, now)

    def _advance(self, event: machine.Event, now: float, reason: str = "") -> None:
        # The caller's time may have been read just before another thread's last transition.
        time = max(now, self.attempt.since)
        self.attempt = machine.advance(self.attempt, event, time, reason)
        self._say_state(time)

    def _say_state(self, now: float) -> None:
        attempt = self.attempt
        aborted = attempt.state is machine.State.ABORTED
        message = f"aborted: {attempt.reason}" if aborted else attempt.state.value
        self.say("abort" if aborted else "state", message, now, {"state": attempt.state.value})
