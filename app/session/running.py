"""The present attempt: its state, its log, and the events that the window drains."""

from __future__ import annotations

from dataclasses import replace
from typing import Final

from app.core.arrays import FloatArray, read_only
from app.core.events import Event, EventQueue
from app.core.messages import sentence
from app.core.staleness import TRACKER_HOLD
from app.imaging.field import TissueField
from app.session import control_scan, machine, procedure
from app.session.abort_reasons import abort_words
from app.session.attempt_log import AttemptLog
from app.session.control_scan import Taking
from app.session.errors import IllegalTransitionError, ProcedureNotPossibleError
from app.session.inputs import LoopInputs
from app.session.machine import Attempt
from app.session.needle import DepthSource, NeedlePose
from app.session.needle_now import NeedleNow
from app.session.observation import Observation
from app.session.procedure import ProcedureState, Step
from app.session.result import AttemptResult
from app.session.sample import Sample
from app.session.snapshot import DRAWN_LATE
from app.session.transitions import (
    DEFAULT,
    KIND,
    RESUMED_WORDS,
    UNSEEN,
    Classifier,
    PauseCause,
    Pauses,
    Thresholds,
    classify,
    paused_words,
)
from app.session.withdrawal import OutsideBy

STEADY: Final = 1.0
"""Time for which the depth is measured without a break before a loss is told again [s]."""


class DepthLoss:
    """Says once that the cameras lost the needle, and once that they have found it again.

    A needle that the cameras have not seen yet is no loss; at the edge of their view, where fixes
    come and go, a loss is told once.
    """

    def __init__(self) -> None:
        self._since: float | None = None
        self._lost = False

    def message(self, pose: NeedlePose, drawn_late: bool = False) -> str:
        """Return what is to be told of this pose; empty for nothing.

        `drawn_late`: whether the cameras are simulated, and none of their pictures says that it
        does not show the needle: this computer does not come to draw them.
        """
        if pose.measured:
            self._since = pose.time if self._since is None else self._since
            if self._lost and pose.time - self._since >= STEADY:
                self._lost = False
                return sentence("the cameras see the needle again: the depth is measured")
            return ""
        was_measured, self._since = self._since is not None, None
        if pose.depth_source is DepthSource.MODEL and was_measured and not self._lost:
            self._lost = True
            unseen = sentence(
                "the cameras have not seen the needle for {tracker_hold:.0f} ms",
                tracker_hold=TRACKER_HOLD * 1e3,
            )
            why = pose.doubt or (DRAWN_LATE if drawn_late else unseen)
            return sentence(
                "{reason}: from now on the depth is not measured, and the force is held back "
                "as if the needle could be anywhere",
                reason=why,
            )
        return ""


_OUT_WORDS = {
    OutsideBy.SIMULATED: "the needle is out of the skin: the attempt begins",
    OutsideBy.MEASURED: "the needle is out of the skin, as measured: the attempt begins",
    OutsideBy.CONFIRMED: (
        "the needle is out of the skin, as the student says and nothing measures: it begins"
    ),
}


class RunningAttempt:
    """Moves one attempt after the other; not thread-safe, the trainer holds the lock.

    Attributes:
        attempt: the present one, or the last.
        log: what it leaves behind; None before the first.
        aside: from the plan's target to the one at hand [m], shape (3,), which the record does
            without, as it has one plan; None where that is the same, or targets are touched.
        events: for the window.
    """

    def __init__(
        self, events: EventQueue, thresholds: Thresholds = DEFAULT, simulated: bool = False
    ) -> None:
        """Begin idle; `simulated`: whether the cameras are, which show whatever there is to see."""
        self.attempt = Attempt()
        self.log: AttemptLog | None = None
        self.aside: FloatArray | None = None
        self.events = events
        self._thresholds, self._simulated = thresholds, simulated
        self._classifier = Classifier()
        self._depth = DepthLoss()
        self._pauses = Pauses()

    @property
    def paused(self) -> bool:
        """Return whether the attempt waits."""
        return self.attempt.state is machine.State.PAUSED

    @property
    def withdrawing(self) -> bool:
        """Return whether the needle is being brought out before the attempt."""
        return self.attempt.state is machine.State.WITHDRAWING

    @property
    def counts(self) -> bool:
        """Return whether an attempt has begun and not ended."""
        return self.attempt.running and not self.withdrawing

    @property
    def acts(self) -> bool:
        """Return whether something can be done in an attempt: it runs and does not wait."""
        return self.counts and not self.paused

    @property
    def pause_words(self) -> str:
        """Return why the attempt waits; empty if it does not."""
        cause = self.pause_cause
        return "" if cause is None else paused_words(cause, self._simulated)

    @property
    def pause_cause(self) -> PauseCause | None:
        """Return what the attempt waits for; None if it does not."""
        return (self._pauses.cause or PauseCause.CAMERAS) if self.paused else None

    def require_idle(self, what: str) -> None:
        """Refuse what is not possible during an attempt.

        Raises:
            IllegalTransitionError: naming the state.
        """
        if self.attempt.running:
            raise IllegalTransitionError(
                sentence(
                    "{refusal} while {attempt_state}: end the attempt first",
                    refusal=what,
                    attempt_state=self.attempt.state,
                )
            )

    def begin(
        self,
        log: AttemptLog,
        now: float,
        failure: str = "",
        out: OutsideBy | None = OutsideBy.SIMULATED,
    ) -> None:
        """Begin a new attempt at `now` [s], or, while the needle is not out, what goes before it.

        `failure` says why its log, which is open, is not recorded.

        Raises:
            IllegalTransitionError: if one is running.
        """
        self.require_idle("an attempt cannot begin")
        event = machine.AttemptEvent.PREPARE if out is None else machine.AttemptEvent.BEGIN
        self.attempt = machine.advance(Attempt(), event, now)
        self._classifier, self._depth, self.log = Classifier(), DepthLoss(), log
        self._pauses = Pauses()
        if failure:
            self.say("recorder", f"this attempt is not recorded: {failure}", now)
        self._say_state(now)

    def release(self, known: OutsideBy, now: float) -> None:
        """Begin the attempt, with the needle out of the skin; `known` says how that is known."""
        waited = now - self.attempt.since
        self._advance(machine.AttemptEvent.BEGIN, now)
        data: dict[str, object] = {"how": known.value, "duration_s": waited}
        self.say("withdrawal", _OUT_WORDS[known], now, data)

    def take(
        self,
        seen: Observation,
        inputs: LoopInputs,
        held_arming: bool = False,
        simulated: bool = False,
    ) -> str:
        """Classify and record one observation; returns why the attempt cannot go on, or nothing.

        `held_arming`: whether a person can arm again after a fault. `simulated`: whether the hand
        is, so that the state says whether it holds the needle.
        """
        log, attempt = self.log, self.attempt
        if log is None or not attempt.running:
            return ""
        began = attempt.since if attempt.began is None else attempt.began
        reason = seen.fatal(began, held_arming, simulated)
        if reason:
            return reason
        pose, away = seen.pose, seen.offset.distance
        depth = pose.depth if pose.measured else None
        self._classifier, event = classify(
            self._classifier, attempt.state, pose.time, depth, away, self._thresholds
        )
        silence = inputs.silence(seen.time)
        pause = self._pauses.judge(
            attempt.state,
            seen.pose,
            seen.fix_status,
            silence,
            simulated and seen.swings,
            self._simulated,
        )
        event = pause or event
        if event is not None:
            self._change(event, seen.time)
        late = self._simulated and seen.fix_status not in UNSEEN
        lost_or_found = self._depth.message(seen.pose, late)
        if lost_or_found:
            self.say("depth", lost_or_found, seen.time, {"source": seen.pose.depth_source.value})
        log.sample(self._sample(seen, inputs))
        return ""

    def scan(self, seen: Observation | None, now: float, taking: Taking | None = None) -> int:
        """Take a control scan at `now` [s]; without one to be taken it is only counted.

        Raises:
            IllegalTransitionError: if no attempt is running.
            ScanNotPossibleError: if nobody knows where the needle is.
        """
        log = self.require_scannable()
        number = log.scans + 1
        data: dict[str, object] = {"number": number}
        if taking is not None:
            data |= control_scan.take(number, taking, now, seen, log.placed).data()
        log.scans = number
        if seen is not None and seen.pose.valid:
            data["tip_m"] = seen.pose.p_tip.tolist()
        self.say("scan", f"control scan {log.scans}", now, data)
        return log.scans

    def require_scannable(self) -> AttemptLog:
        """Refuse a control scan where no attempt runs; returns the log of the one that does.

        Raises:
            IllegalTransitionError: naming the state.
        """
        if self.log is None or not self.attempt.running or self.withdrawing:
            raise IllegalTransitionError(
                sentence(
                    "a control scan is not possible while {attempt_state}: begin an attempt first",
                    attempt_state=self.attempt.state,
                )
            )
        return self.log

    def perform(
        self,
        state: ProcedureState | None,
        step: Step,
        seen: Observation | None,
        now: float,
        field: TissueField | None,
        throw: int = 0,
        notch_deg: float = 0.0,
        fallen_mm: FloatArray | None = None,
    ) -> ProcedureState:
        """Do a step of the procedure at `now` [s]; see `procedure.perform`.

        `fallen_mm`: how far the last control scan showed the target displaced, LPS.

        Raises:
            ProcedureNotPossibleError: says why; nothing has changed then.
        """
        if state is None or self.log is None or not self.acts:
            raise ProcedureNotPossibleError(
                sentence(
                    "no step of a procedure is possible now: begin an attempt at an exercise that "
                    "asks for it"
                )
            )
        needle = NeedleNow.of(seen, fallen_mm)
        state, words, data = procedure.perform(
            state, step, needle, self.log.placed, field, throw, notch_deg, now
        )
        self.say(procedure.KIND, words, now, data)
        return state

    def finish(
        self,
        event: machine.AttemptEvent,
        seen: Observation | None,
        inputs: LoopInputs,
        now: float,
        reason: str = "",
    ) -> AttemptResult:
        """End or abort the attempt at `now` [s], score it and finish its record.

        Raises:
            IllegalTransitionError: if no attempt is running.
        """
        paused = self.paused
        self._advance(event, now, reason)
        if paused:
            self._tell_pause("the attempt ended while it was paused", now, over=True)
        if self.log is None:
            raise IllegalTransitionError(sentence("no attempt has begun"))
        if seen is not None and seen.time >= (self.attempt.began or 0.0):
            self.log.sample(self._sample(seen, inputs))
        return self.log.finish(self.attempt)

    def _sample(self, seen: Observation, inputs: LoopInputs) -> Sample:
        sample = seen.sample(self.attempt.state, inputs)
        if self.aside is None:
            return sample
        return replace(sample, p_target=read_only(sample.p_target - self.aside))

    def say(
        self, kind: str, message: str, now: float, data: dict[str, object] | None = None
    ) -> None:
        """Tell the window and the record that something happened."""
        event = Event(now, kind, message, data or {})
        self.events.put(event)
        if self.log is not None:
            self.log.event(event)

    def keep(self, kind: str, message: str, now: float, data: dict[str, object]) -> None:
        """Record that something happened of which nobody is told now."""
        if self.log is not None:
            self.log.event(Event(now, kind, message, data))

    def _change(self, event: machine.AttemptEvent, now: float) -> None:
        paused, cause = self.paused, self._pauses.cause or PauseCause.CAMERAS
        self._advance(event, now)
        if self.paused:
            self._tell_pause(paused_words(cause, self._simulated), now, over=False)
        elif paused:
            self._classifier = Classifier()
            self._tell_pause(RESUMED_WORDS[cause], now, over=True)

    def _tell_pause(self, words: str, now: float, over: bool) -> None:
        data: dict[str, object] = {"cause": str(self._pauses.cause or PauseCause.CAMERAS)}
        if over:
            data["duration_s"] = self._pauses.lasted(now)
        self.say(KIND, words, now, data)

    def _advance(self, event: machine.AttemptEvent, now: float, reason: str = "") -> None:
        # The caller's time may have been read just before another thread's last transition.
        time = max(now, self.attempt.since)
        self.attempt = machine.advance(self.attempt, event, time, reason)
        self._say_state(time)

    def _say_state(self, now: float) -> None:
        attempt = self.attempt
        aborted = attempt.state is machine.State.ABORTED
        message = abort_words(attempt.reason) if aborted else attempt.state.value
        self.say("abort" if aborted else "state", message, now, {"state": attempt.state.value})
