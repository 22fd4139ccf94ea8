"""The running trainer: composes loop, tracker, plan, exercise and record into attempts."""

from __future__ import annotations

import threading
from collections.abc import Callable
from dataclasses import replace
from math import inf
from typing import TYPE_CHECKING, Final

from app.core import state_vector as sv
from app.core.arrays import read_only
from app.core.clock import Clock, SystemClock
from app.core.errors import AcusError
from app.core.events import EventQueue
from app.core.latest import Latest
from app.core.messages import sentence, sentence_of
from app.core.paced_clock import PacedClock
from app.core.units import MILLIMETRE
from app.exercises.guidance import Purpose, ScanChoice
from app.exercises.locks import Lock
from app.imaging.field import TissueField
from app.imaging.scan_look import NeedleEnds
from app.imaging.scan_order import ScanOrder
from app.planning.entry_mark import EntryMark
from app.planning.placement import PlacedPlan
from app.scoring.complications.answers import Reaction
from app.session.ablation import AblationState
from app.session.abort_reasons import BY_USER, TRAINER_CLOSED
from app.session.attempt_log import AttemptLog
from app.session.beginnings import Beginnings
from app.session.complication_case import KIND as COMPLICATION
from app.session.complication_case import ComplicationCase
from app.session.complications import (
    Complications,
    Happening,
    attempt_seed,
)
from app.session.conditions import ARM, POINTERS, TAKEN_OVER, TRAINEE, hand_of
from app.session.context import RunContext
from app.session.control_scan import ROOM, Leave, Taking, require_inside, take
from app.session.effect_models import KIND, ModelChoice
from app.session.errors import (
    ControlLockedError,
    IllegalTransitionError,
    ProcedureNotPossibleError,
    SessionError,
)
from app.session.fixes import TRUST, DepthTrust
from app.session.inputs import Arming, ClearanceOf, LoopInputs
from app.session.machine import IN_BODY, AttemptEvent
from app.session.needle_now import NeedleNow
from app.session.observation import BreathWatch, Observation, RobotAndCameras
from app.session.procedure import CHECKS, MARKED, ProcedureState, Step, ToolInHand, begin_data
from app.session.procedure import KIND as PROCEDURE
from app.session.procedure import VERSION as PROCEDURE_VERSION
from app.session.resting import Resting
from app.session.result import AttemptResult
from app.session.risks import Risk
from app.session.running import RunningAttempt
from app.session.scan_reading import ScanReading
from app.session.scored import scorer
from app.session.scripted_answers import Pictures, ScanReader, ScriptedAnswers
from app.session.snapshot import Snapshot, advice
from app.session.still_hand import StillHand
from app.session.ticker import (
    SLOWED,
    SLOWED_S,
    Standstill,
    Ticker,
    slowed_words,
    standstill_words,
)
from app.session.touching import KIND as TOUCH
from app.session.touching import TASK, Touching, begin_words, measured_at, touch_words
from app.session.withdrawal import KIND as WITHDRAWAL
from app.session.withdrawal import OutsideBy, Start, Withdrawal
from app.tracking.fix import NeedleFix

if TYPE_CHECKING:
    from app.device.control.loop import Loop
    from app.exercises.schema import Exercise
    from app.session.header import SessionHeader
    from app.session.scripted_steps import ScriptedSteps
    from app.tracking.needle_tracker import NeedleTracker

TICK_PERIOD: Final = 0.02
"""The trainer looks at everything this often [s]."""

SAME_ENTRY_MM: Final = 1.5
"""An entry so near to where one was marked is that one, moved onto the skin next to it."""

Advance = Callable[[float], None]
"""Lets simulated parts other than the loop catch up with virtual time [s]."""


class Trainer:
    """One robot, one tracker, one plan, any number of attempts one after the other.

    In real time `open` starts loop, tracker and a 50 Hz ticker. In virtual time nobody calls
    `open`; `step` lets time pass. Both run the same `tick`. All methods may be called from any
    thread; `end` and `abort` write files, the others only take a lock for a moment.

    Attributes:
        events: for the window to drain: `state`, `abort`, `scan`, `room`, `breath`, `touch`,
            `recorder`, and the tracker's.
        result: of the attempt that finished last; None before the first.
        resting: by which simulated robot and cameras rest while nobody wants them.
    """

    def __init__(
        self,
        loop: Loop,
        tracker: NeedleTracker | None,
        placed: PlacedPlan,
        exercise: Exercise,
        context: RunContext | None = None,
        clock: Clock | None = None,
        advance: Advance | None = None,
        clearance: ClearanceOf | None = None,
        held_arming: bool = False,
        risks: tuple[Risk, ...] = (),
        tissues: TissueField | None = None,
        dial: float | None = None,
        trust: DepthTrust = TRUST,
        start: Start = Start.ANYWHERE,
        beginnings: Beginnings | None = None,
        simulated: bool = False,
        by_program: bool = False,
        scripted: str = "",
        pictures: Pictures | None = None,
    ) -> None:
        """Keep the parts.

        `advance` is for virtual time only. `clearance` is asked in every tick how much force the
        device is cleared for; without it, whoever built the loop has written it. With
        `held_arming`, forces are on only between `arm` and `disarm` during an attempt.
        `risks` are measured and recorded when an attempt ends, and by `tissues` what the needle
        met. `dial` is the assistance that every attempt begins with; None for the exercise's.
        `trust` says how far a depth by the cameras is believed, `start` how the needle comes out of
        the skin before an attempt, `beginnings` where a simulated hand that a person moves begins;
        None for where scripts do. `simulated` says that robot and cameras both are: they rest while
        nobody wants them, and no pause is a real camera's fault. `by_program` says that no person
        moves the hand: by a paced clock it needs no window that lives, and never rests. `scripted`
        names the skill of a scripted hand, for what the other hand does; `pictures` makes the
        control scans that such a hand reads, without which it sees the monitor alone.
        """
        self.events = EventQueue()
        self.result: AttemptResult | None = None
        self._loop = loop
        self._placed = placed
        self._exercise = exercise
        self._touching = self._to_touch(placed)
        self._procedure: ProcedureState | None = None
        self._scripted: ScriptedSteps | None = None
        self._case = ComplicationCase.of(exercise, placed, tissues)
        self._happens: Complications | None = None
        self._skill, self._answers = scripted, ScriptedAnswers.of(scripted)
        self._pictures = pictures
        self._leave: Leave | None = None
        self._mark: EntryMark | None = None
        self._dial = exercise.assistance if dial is None else dial
        self._context = context or RunContext()
        self._clock = clock or SystemClock()
        self._advance = advance
        self._risks, self._tissues = risks, tissues
        self._ablation = AblationState.of(exercise.procedure, placed, tissues)
        self._inputs = LoopInputs(loop.inbox)
        self._arming = Arming(self._inputs, held_arming, clearance)
        self._sources = RobotAndCameras(loop, tracker, self._inputs, trust)
        longest = exercise.longest_hold
        self._breath = None if longest is None else BreathWatch(longest)
        self._running = RunningAttempt(self.events, simulated=simulated)
        self._withdrawal, self._beginnings = Withdrawal(self._inputs, start), beginnings
        self._hand = StillHand(self._inputs)
        self._latest: Latest[Snapshot] = Latest()
        real = isinstance(self._clock, SystemClock)
        paced = self._clock if isinstance(self._clock, PacedClock) else None
        self._standstill = Standstill() if real else Standstill(lambda: 0.0)
        self._simulated, self._by_program = simulated, by_program
        # Who waits for a rest waits by the wall: another time stands meanwhile.
        may_rest = simulated and (real or (paced is not None and not by_program))
        self.resting = Resting(
            may_rest,
            SystemClock() if paced is not None else self._clock,
            self._needed,
            self._stop,
            self._start,
        )
        self._lock = threading.RLock()
        self._ticker: Ticker | None = None
        self._paced, self._led_at, self._lost_before = paced, inf, 0.0
        self._leading = None if paced is None else paced.hold("hand")

    # --- life -------------------------------------------------------------------------------------
    def open(self) -> None:
        """Start loop, tracker and ticker; idempotent.

        Raises:
            AcusError: whatever keeps loop or tracker from starting; nothing stays open then.
        """
        if self._ticker is not None:
            return
        try:
            self._inputs.prepare(self._aim, self._dial)
            self._sources.open()
        except BaseException:
            self._sources.close()
            raise
        self._ticker = Ticker(self._look, TICK_PERIOD, self._crashed, self._clock)
        self._ticker.open()

    def close(self) -> None:
        """Abort a running attempt, stop everything at zero force; idempotent."""
        self.resting.end()
        if self._paced is not None:
            self._paced.stop()  # nobody waits any more for whoever holds time
        if self._ticker is not None:
            self._ticker.close()
        self.abort(TRAINER_CLOSED)
        self._ticker = None
        self.disarm()
        self._sources.close()

    def _needed(self) -> bool:
        """Return whether robot and cameras may not rest now."""
        with self._lock:
            started = self._ticker is not None and not self._ticker.failed
            return self._running.attempt.running or not started

    def _stop(self) -> None:
        """Let robot and cameras rest; what was published last stays."""
        if self._ticker is not None:
            self._ticker.close()
        self._sources.close()

    def _start(self) -> None:
        """Go on after a rest, which is no standstill of the computer."""
        self._standstill.forget()
        self.heartbeat()
        try:
            self._sources.open()
        except BaseException:
            self._sources.close()
            raise
        if self._ticker is not None:
            self._ticker.open()

    def step(self, ticks: int = 20) -> Snapshot:
        """Let virtual time pass: `ticks` of the loop, the simulated cameras, then one tick."""
        self._inputs.prepare(self._aim, self._dial)
        self.heartbeat()
        self._loop.step(ticks)
        now = self._clock.now()
        if self._advance is not None:
            self._advance(now)
        return self.tick(now)

    # --- the attempt ------------------------------------------------------------------------------
    def begin(self, student: str = "", hand: str = "") -> str:
        """Begin an attempt: everything recorded, forces armed; returns the session id.

        While the tip is inside the skin, or a simulated hand away from its start, the attempt is
        only prepared: recorded, without force and without its clock (state `withdrawing`).

        With `held_arming` the forces stay off until `arm`. A record that cannot be written is told
        in an event, in the messages and in the summary; the attempt goes on.

        Args:
            student: pseudonym.
            hand: what holds the needle, one of `conditions.HANDS`; a run that was built for one
                hand keeps it.

        Raises:
            IllegalTransitionError: if an attempt is running.
            NotReadyError: if loop and ticker were opened but the loop has not run its first tick,
                the ticker has ended with a fault of the program, or the device is not cleared.
            SessionError: for an unknown hand.
        """
        with self.resting.awake(), self._lock:
            self._running.require_idle("an attempt cannot begin")
            if self._ticker is not None:
                self._sources.require_ticks(self._ticker.failed)
            self._arming.require()
            self._inputs.prepare(self._aim, self._dial)
            self._inputs.hold_breath(False)
            self._inputs.roll(0.0)
            self._inputs.assist(self._dial)  # whatever the dial was turned to before
            now = self._clock.now()
            header = self._context.header(self._exercise, self._placed, student, now, hand)
            recorder = self._context.recorder(header, self._loop, self._placed, self._clock)
            log = AttemptLog(
                recorder,
                self._placed,
                scorer(self._exercise, header.metadata[TRAINEE]["hand"]),
                risks=self._risks,
                tissues=self._tissues,
                judges_plan=self._exercise.is_own_plan,
                asks_lung=self._exercise.asks_lung_path,
            )
            # Head and checkpoint are on the disk before the attempt's clock starts.
            failure = log.open(threaded=self._ticker is not None)
            now = self._clock.now()
            if self._touching is not None:
                self._touching.begin()
                self._take_aim()
            seen = self._sources.newest(self._aim, now)
            begins = None
            if self._beginnings is not None and hand in POINTERS:
                begins = self._beginnings.next(self._placed)
            out = self._withdrawal.begin(seen.device, seen.pose, now, hand == ARM, begins)
            self._running.begin(log, now, failure, out)
            self._hand.forget()
            self._leave = None
            self._lost_before = 0.0 if self._paced is None else self._paced.lost
            if self._touching is not None:
                words, data = begin_words(self._touching.state)
                self._running.say(TASK, words, now, data)
            if exercise_part := self._exercise.procedure:
                # Hands are compiled, and there before an attempt is: the start page has none.
                from app.session.scripted_steps import ScriptedSteps

                self._procedure = ProcedureState.at_begin(
                    exercise_part, self._placed.plan, self._tissues, self._ablation
                )
                self._scripted = ScriptedSteps(exercise_part, self._ablation)
                self._take_aim()
                data = begin_data(self._procedure)
                self._running.say(PROCEDURE, self._procedure.words, now, data)
                if (mark := self._mark_here()) is not None:
                    data = {"version": PROCEDURE_VERSION, "step": MARKED, **mark.data()}
                    self._running.say(PROCEDURE, mark.words, now, data)
            self._begin_complications(header, now)
            self.heartbeat()
            if out is None:
                self._running.say(WITHDRAWAL, self._withdrawal.words, now)
            else:
                self._arming.begin()
            self._publish(now)
            return header.id

    def end(self) -> AttemptResult:
        """End the attempt: forces off, scored, record finished.

        Raises:
            IllegalTransitionError: if no attempt is running.
        """
        with self._lock:
            return self._finish(AttemptEvent.END)

    def abort(self, reason: str = BY_USER) -> AttemptResult | None:
        """Break a running attempt off, with the reason; nothing happens if none is running."""
        with self._lock:
            if not self._running.attempt.running:
                return None
            return self._finish(AttemptEvent.ABORT, reason)

    def confirm_outside(self) -> None:
        """Take the student's word that the needle is out of the skin; see `session.withdrawal`."""
        with self._lock:
            self._withdrawal.confirm()

    def scan(self, order: ScanOrder | None = None, choice: ScanChoice | None = None) -> int:
        """Take a control scan; returns how many were taken. Without an order it is only counted.

        Who leaves the room for it (`choice.leaves`) is told of the scan by its event, half of
        `guidance.leave_room_s` later.

        Args:
            order: which slices.
            choice: tube current, and whether the student leaves; None for what is proposed, in
                the room.

        Raises:
            IllegalTransitionError: if no attempt is running, or the student is out of the room.
            ScanOrderError: for what the exercise does not offer; names what it does.
            ScanNotPossibleError: if there is an order and nobody knows where the needle is.
        """
        guidance = self._exercise.guidance
        with self._lock:
            now = self._clock.now()
            require_inside(self._leave, now)
            if order is None:
                return self._running.scan(self._sources.seen, now)
            choice = choice or replace(guidance.choice, leaves=False)
            guidance.check(order, choice)
            taking = self._taking(order, choice)
            if not choice.leaves or guidance.leave_room_s is None:
                return self._running.scan(self._sources.seen, now, self._as_it_is(taking))
            log = self._running.require_scannable()
            self._leave = Leave(taking, now, guidance.leave_room_s)
            self._running.say(
                ROOM, sentence("the student leaves the room"), now, {"seconds": self._leave.lasts}
            )
            return log.scans

    def _taking(self, order: ScanOrder, choice: ScanChoice) -> Taking:
        """Return the scan with the needle that the shaft stands for now."""
        guidance, asked, grid = self._exercise.guidance, self._exercise.procedure, None
        if asked is not None and asked.grid is not None:
            plan = self._placed.plan
            grid = asked.grid.spec(plan.target_mm, self._placed.placement)
        if guidance.needle_ends is NeedleEnds.PLAIN:
            return Taking(order, guidance, choice, grid=grid)
        needle, procedure = self._exercise.needle, self._procedure
        hollow = procedure is not None and procedure.tool is ToolInHand.OPEN
        return Taking(order, guidance, choice, needle.gauge, needle.tip, hollow, grid)

    def _as_it_is(self, taking: Taking) -> Taking:
        """Return a scan of the patient as complications have him when it is taken."""
        return taking if self._happens is None else replace(taking, inside=self._happens.scanned())

    def _be_out(self, now: float) -> None:
        """Take the scan that somebody left the room for once it is due, and let him come back."""
        leave = self._leave
        if leave is None or not self._running.attempt.running:
            self._leave = None
            return
        if not leave.taken and now >= leave.due:
            self._leave = leave = replace(leave, taken=True)
            try:
                self._running.scan(self._sources.seen, now, self._as_it_is(leave.taking))
            except AcusError as error:  # nothing was counted; the way was for nothing
                self._running.say(ROOM, sentence_of(error), now)
        if now >= leave.back:
            self._leave = None
            self._running.say(ROOM, sentence("the student is back at the patient"), now)

    def mark_entry(self, mark: EntryMark | None) -> None:
        """Take where the entry was marked on the skin; attempts that begin at it say so."""
        with self._lock:
            self._mark = mark

    def _mark_here(self) -> EntryMark | None:
        """Return the mark if the patient lies by it and the exercise has a grid."""
        mark, asked = self._mark, self._exercise.procedure
        if mark is None or asked is None or asked.grid is None:
            return None
        away = self._placed.plan.entry_mm - mark.marked_mm
        return mark if float(away @ away) <= SAME_ENTRY_MM**2 else None

    def perform(self, step: Step, throw: int = 0, notch_deg: float = 0.0) -> ProcedureState:
        """Do a step of the exercise's procedure; returns how it stands then.

        Args:
            step: what is done.
            throw: which of the biopsy gun's settings, for `Step.FIRE`; which row of the
                generator's table, for `Step.ABLATE`.
            notch_deg: direction of its notch, for `Step.FIRE`; see `planning.sampling.notch_side`.

        Raises:
            ProcedureNotPossibleError: says why, and what to do; nothing has changed then.
        """
        self.resting.want()
        with self._lock:
            now = self._clock.now()
            seen, happens = self._sources.seen, self._happens
            fallen_mm = None if happens is None else happens.fallen_mm
            require_inside(self._leave, now)
            self._begin_by(step, now)
            self._procedure = self._running.perform(
                self._procedure, step, seen, now, self._tissues, throw, notch_deg, fallen_mm
            )
            if happens is not None and step is Step.FIRE:
                happens.fired(NeedleNow.of(seen))
            if happens is not None and step is Step.ROLL_OVER:
                happens.rolled_over()
            if step is Step.PLACE_ELECTRODE:
                self._take_aim()
            return self._procedure

    def _begin_by(self, step: Step, now: float) -> None:
        """Begin an attempt that waits for its first movement by a step that needs no needle."""
        state = self._procedure
        if state is None or not (self._running.withdrawing and self._withdrawal.ready):
            return
        if step in CHECKS and not state.refusal(step):
            self._release(self._withdrawal.act(), now)

    def _release(self, known: OutsideBy, now: float) -> None:
        self._running.release(known, now)
        self._arming.begin()

    def notice(self) -> None:
        """Say that something is wrong with the patient.

        Raises:
            ProcedureNotPossibleError: if no attempt runs in which anything can happen.
        """
        self._respond(None)

    def answer(self, answer: Reaction) -> None:
        """Answer a complication; one that is not there is told, and recorded.

        Raises:
            ProcedureNotPossibleError: if no attempt runs in which anything can happen.
        """
        self._respond(answer)

    def _respond(self, answer: Reaction | None) -> None:
        self.resting.want()
        with self._lock:
            happens = self._happens
            if happens is None or not self._running.acts:
                raise ProcedureNotPossibleError(
                    sentence(
                        "no complication can be answered now: begin an attempt at an exercise in "
                        "which some can happen"
                    )
                )
            happening = happens.notice() if answer is None else happens.answer(answer)
            self._keep(happening, self._clock.now())

    def _keep(self, happening: Happening, now: float) -> None:
        keep = self._running.say if happening.is_told else self._running.keep
        keep(COMPLICATION, happening.words, now, happening.data)

    def _begin_complications(self, header: SessionHeader, now: float) -> None:
        self._happens = None
        if self._case is not None:
            is_assessment = self._exercise.purpose is Purpose.ASSESSMENT
            own = header.seed if self._skill and not is_assessment else None
            seed = attempt_seed(header.id, is_assessment) if own is None else own
            self._happens = Complications(self._case, seed)
            self._answers = ScriptedAnswers.of(self._skill, seed)
            self._keep(self._happens.begin(), now)

    def _watch_patient(self, seen: Observation, now: float) -> None:
        """Let time pass for the patient, and what the needle does have its consequences."""
        happens, running = self._happens, self._running
        if happens is None or not running.counts:
            return
        is_outer = self._procedure is None or self._procedure.tool is not ToolInHand.ANAESTHETIC
        for happening in happens.look(NeedleNow.of(seen), is_outer, now, running.paused):
            self._keep(happening, now)
        if self._answers is not None and running.acts:
            self._look_at_scans(self._answers, seen, is_outer, now)
            if self._answers.notices(happens.state.vitals, now):
                self._keep(happens.notice(), now)
            answer = self._answers.look(happens.state.vitals, now)
            if answer is not None:
                self._keep(happens.answer(answer), now)

    def _look_at_scans(
        self, answers: ScriptedAnswers, seen: Observation, is_outer: bool, now: float
    ) -> None:
        """Let a scripted hand take the scans that it answers by, and read their pictures."""
        needle, case, log = NeedleNow.of(seen), self._case, self._running.log
        if needle is None or not needle.measured or case is None or log is None:
            return
        if not answers.wants_scan(is_outer and needle.depth > 0.0, now):
            return
        guidance = self._exercise.guidance
        order = guidance.order(float(self._placed.plan.target_mm[2]))
        taking = self._as_it_is(self._taking(order, replace(guidance.choice, leaves=False)))
        number = self._running.scan(seen, now, taking)
        reading = ScanReading()
        if self._pictures is not None:
            scan = take(number, taking, now, seen, self._placed)
            reading = ScanReader(case, self._pictures).read(scan)
        answers.see(reading, now)

    # --- intents ----------------------------------------------------------------------------------
    def hand(self, x: float, y: float, depth: float, holds: bool = True) -> None:
        """Move the simulated hand: needle direction (x, y), depth [m], whether it holds.

        It obeys nobody while it brings the needle out before an attempt, nor while one is paused
        (`session.still_hand`).
        """
        self.resting.want()
        if self._leave is not None:
            return  # nobody is at the needle
        if not self._withdrawal.moves_hand and self._hand.move(x, y, depth, holds):
            self._withdrawal.follow(x, y, depth)

    def lead(self, within: float) -> float | None:
        """Hear from whoever leads the hand step by step in a run whose time is paced.

        That is a program, or the window to which a person looks: time does not go on past what it
        has shown.

        Args:
            within: time goes on for so long at most until it is heard again [s]; inf if it leaves.

        Returns:
            Time since it was heard last [s], 0 at first; None where time goes on by itself.
        """
        if self._paced is None or self._leading is None:
            return None
        now = self._paced.now()
        self._inputs.heartbeat(now)
        passed, self._led_at = max(now - self._led_at, 0.0), now
        self._leading.until(now + within)
        if not self._running.attempt.running:  # it ended meanwhile: nobody leads any more
            self._leading.release()
        return passed

    def take_over(self, hand: str) -> None:
        """Let another hand go on with the needle of a running attempt: told and recorded.

        A person's simulated hand is as unsteady from then on as one that began the attempt.

        Args:
            hand: which, one of `session.conditions.HANDS`.

        Raises:
            IllegalTransitionError: if no attempt is running.
            SessionError: for an unknown hand.
        """
        hand = hand_of({}, hand)
        with self._lock:
            now = self._clock.now()
            if not self._running.attempt.running:
                raise IllegalTransitionError(
                    sentence(
                        "nobody can take the needle over while {running_attempt_state}: no "
                        "attempt is running",
                        running_attempt_state=self._running.attempt.state,
                    )
                )
            pose = self._sources.newest(self._placed, now).pose
            depth = float(pose.depth) if pose.measured else None
            at = "" if depth is None else f" at {depth / MILLIMETRE:.0f} mm"
            words = f"taken over by {hand}{at}"
            level, seed = 0, 0  # who leads by itself brings its own steadiness
            if hand in POINTERS and self._beginnings is not None and self._withdrawal.simulated:
                level, seed = self._beginnings.goes_on()
            self._inputs.unsteady(level, seed)
            self._running.say(TAKEN_OVER, words, now, {"hand": hand, "depth_m": depth})

    def roll(self, step: float) -> None:
        """Turn the needle about its axis by `step` [rad], clockwise seen from the hub.

        Nothing turns while an attempt is paused. Who measures the roll of a real needle writes the
        same input (`LoopInputs.roll`).

        Raises:
            NumericalError: if it is not a number.
        """
        self.resting.want()
        if not self._running.paused and self._leave is None:
            self._inputs.roll(self._inputs.rolled + step)

    def assistance(self, value: float) -> None:
        """Set the assistance: 1 full guidance, 0 nothing, -1 full repulsion.

        Raises:
            ControlLockedError: if the exercise keeps the dial as it is; nothing has changed then.
        """
        if Lock.ASSISTANCE in self._exercise.locked:
            raise ControlLockedError(
                sentence(
                    "exercise {exercise_id} keeps the assistance at {dial:g}; it can be "
                    "turned in exercises that do not lock it",
                    exercise_id=self._exercise.id,
                    dial=self._dial,
                )
            )
        self.resting.want()
        self._inputs.assist(value)

    def compute_by(
        self,
        exercise: Exercise,
        effect: str,
        model: str,
        change: Callable[[Loop], int],
        answer: Callable[[RunContext], RunContext],
    ) -> None:
        """Compute an effect by another of its models from the next tick on.

        Args:
            exercise: the exercise with that model, for attempts that follow.
            effect: its name.
            model: one of its models.
            change: changes the loop; returns the first tick that computes so.
            answer: puts that exercise into the heads of the records that follow.

        Raises:
            ControlLockedError: if the exercise keeps its models; nothing has changed then.
            AcusError: whatever keeps the loop from changing; it goes on as it was.
        """
        if Lock.MODELS in self._exercise.locked:
            raise ControlLockedError(
                sentence(
                    "exercise {exercise_id} keeps the models by which its effects are computed; "
                    "they can be chosen in exercises that do not lock them",
                    exercise_id=self._exercise.id,
                )
            )
        with self.resting.awake(), self._lock:
            choice = ModelChoice(change(self._loop), effect, model)
            self._exercise, self._context = exercise, answer(self._context)
            self._running.say(KIND, choice.words(), self._clock.now(), choice.data())

    def hold_breath(self, held: bool) -> None:
        """Tell the patient to hold the breath, or to breathe; the next ticks tell how he stands.

        Raises:
            SessionError: if the exercise's patient does not hold the breath on command.
        """
        if self._breath is None:
            raise SessionError(
                sentence(
                    "the patient of exercise {exercise_id} does not hold the breath on command; "
                    "breathing with `model: on_command` does",
                    exercise_id=self._exercise.id,
                )
            )
        self.resting.want()
        self._inputs.hold_breath(held)

    @property
    def tissues(self) -> TissueField | None:
        """Return the field of the patient's tissue; None where there is none."""
        return self._tissues

    @property
    def held_arming(self) -> bool:
        """Return whether the forces are on only while `arm` holds them on."""
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

    @property
    def time(self) -> float:
        """Time of the run [s]: slower than the wall's where a busy computer slows the world."""
        return self._clock.now()

    @property
    def lost(self) -> float:
        """Time of the wall by which the run's has fallen behind in this attempt [s]."""
        return 0.0 if self._paced is None else self._paced.lost - self._lost_before

    def place(self, placed: PlacedPlan) -> None:
        """Take another plan or placement.

        Raises:
            IllegalTransitionError: if an attempt is running.
        """
        with self.resting.awake(), self._lock:
            self._running.require_idle("the plan cannot change")
            self._touching = self._to_touch(placed)
            self._case = ComplicationCase.of(self._exercise, placed, self._tissues)
            self._ablation = AblationState.of(self._exercise.procedure, placed, self._tissues)
            self._placed, self._procedure = placed, None
            self._take_aim()

    def on_fix(self, fix: NeedleFix) -> None:
        """Take a fix at once, as the tracker's callback; without it the ticker takes it."""
        self._sources.take(fix, self._placed)

    def snapshot(self) -> Snapshot:
        """Return everything as of the last tick; never waits for a running one."""
        stamped = self._latest.read()
        return stamped.value if stamped is not None else self.tick(self._clock.now())

    # --- targets to be touched ------------------------------------------------------------------
    def _to_touch(self, placed: PlacedPlan) -> Touching | None:
        task = self._exercise.touch_task(placed)
        return None if task is None else Touching(task)

    @property
    def _aim(self) -> PlacedPlan:
        """The plan whose target is the present one: of the target to be touched, if there is one.

        Everybody who asks how far the needle is off the path or from the target, the loop's force
        laws among them, asks about this one.
        """
        if self._touching is not None:
            return self._touching.state.aim
        electrodes = None if self._procedure is None else self._procedure.ablation
        return self._placed if electrodes is None else electrodes.aim

    def _take_aim(self) -> None:
        if self._ablation is not None:
            self._running.aside = read_only(self._aim.p_target - self._placed.p_target)
        self._inputs.path(self._aim.axis, self._aim.p_target)
        self._sources.aim(self._aim)

    def _touch(self, seen: Observation) -> None:
        """Judge whether the tip has touched the present target; the next one is aimed at then."""
        if self._touching is None:
            return
        inside = self._running.attempt.state in IN_BODY
        measured = measured_at(seen.pose) if inside else None
        if self._touching.take(seen.pose.p_tip, measured):
            words, data = touch_words(self._touching.state, seen.pose)
            self._running.say(TOUCH, words, seen.time, data)
            self._take_aim()

    def _look(self) -> None:
        """Do one tick; a hand that the program leads needs no window that lives."""
        if self._paced is not None and self._by_program:
            self.heartbeat()
        self.tick(self._clock.now())

    # --- one tick ---------------------------------------------------------------------------------
    def tick(self, now: float) -> Snapshot:
        """Pull the latest values, move the attempt, record, publish; `now` is the time [s]."""
        with self._lock:
            reason = self._stood_still(now) or self._observe(now)
            if reason:
                self.abort(reason)
            elif self._drill_is_over(now):
                self._finish(AttemptEvent.END)
            elif self._ticker is None and self._running.log is not None:
                self._running.log.recorder.drain()
            return self._publish(now)

    def _drill_is_over(self, now: float) -> bool:
        drill, attempt = self._exercise.drill, self._running.attempt
        if drill is None or not self._running.counts:
            return False
        in_body = attempt.state in IN_BODY
        return drill.is_over(in_body, now - attempt.since, attempt.duration(now))

    def _observe(self, now: float) -> str:
        """Pull the latest values and move the attempt; returns why it must be aborted, or nothing.

        A fault of the tracker aborts like one of the robot.
        """
        try:
            self._arming.ask()
            seen = self._sources.observe(self._aim, now)
            was_paused = self._running.paused
            reason = self._running.take(
                seen, self._inputs, self._arming.held, self._withdrawal.simulated
            )
            self._arming.pause(was_paused, self._running.paused)
            cause, simulated = self._running.pause_cause, self._withdrawal.simulated
            self._hand.follow(cause, seen.device, seen.pose, simulated, self._leave is not None)
            self._touch(seen)
            if self._scripted is not None and seen.device is not None:
                phase = float(seen.device.row[sv.TRAINEE_PHASE])
                self._scripted.look(phase, now, self.perform)
            self._watch_patient(seen, now)
            self._be_out(now)
            if self._breath is not None and (words := self._breath.observe(seen.device, now)):
                self._running.say("breath", words, now, {"held": self._breath.now.held})
            reason = reason or self._bring_out(seen)
            if reason:
                return reason
            for event in self._sources.tracker_events(self.events):
                self._running.say(event.kind, event.message, event.time, dict(event.data))
                reason = reason or (event.message if event.kind == "fault" else "")
            return reason
        except AcusError as error:
            self._sources.observe_nothing(self._aim, now, str(error))
            return str(error)

    def _bring_out(self, seen: Observation) -> str:
        """Begin an attempt once the needle is out; returns why it must be ended, or nothing."""
        running, withdrawal = self._running, self._withdrawal
        if running.withdrawing:
            step = withdrawal.advance(seen.device, seen.pose, seen.time)
            if step.known is not None:
                self._release(step.known, seen.time)
            return step.failure
        withdrawal.stop()
        return withdrawal.refuted(seen.pose, seen.time) if running.counts else ""

    def _publish(self, now: float) -> Snapshot:
        """Publish what was observed last, with the attempt as it is now."""
        seen = self._sources.newest(self._aim, now)
        attempt, log, withdrawal = self._running.attempt, self._running.log, self._withdrawal
        recording = log.recorder.status() if log is not None else None
        clearance = self._arming.clearance
        snapshot = Snapshot(
            time=now,
            state=attempt.state,
            reason=attempt.reason,
            elapsed=attempt.duration(now),
            phases=attempt.phases(now),
            pose=seen.shown,
            offset=seen.shown_offset,
            p_target=seen.p_target,
            device=seen.device,
            timing=self._sources.timing,
            tracker=self._sources.statistics,
            fix_status=seen.fix_status,
            scans=log.scans if log is not None else 0,
            assistance=self._inputs.assistance,
            armed=self._inputs.armed,
            recording=recording,
            messages=advice(
                seen.pose,
                seen.fix_status,
                seen.device_fault,
                attempt.reason,
                recording,
                clearance.reason if clearance is not None else "",
                withdrawal.words or self._running.pause_words,
                self._simulated,
            ),
            held_arming=self._arming.held,
            clearance=clearance,
            measured_pose=seen.pose,
            withdrawal=withdrawal.words,
            ready=withdrawal.ready,
            may_confirm=withdrawal.asks,
            breath=None if self._breath is None else self._breath.now,
            roll=self._inputs.rolled if "bevel" in self._exercise.effects else None,
            touch=None if self._touching is None else self._touching.state,
            procedure=self._procedure if self._exercise.procedure else None,
            complications=None if self._happens is None else self._happens.state,
            pause=self._running.pause_cause,
            simulated=self._simulated,
            out_of_room=None if self._leave is None else self._leave.left(now),
        )
        self._latest.publish(snapshot, now)
        return snapshot

    def _stood_still(self, now: float) -> str:
        """Return why the attempt ends if the whole program slept; empty if it did not."""
        try:
            slept = self._standstill.before(now, int(self._loop.latest().tick))
        except AcusError:  # the loop has ended: whoever looks next says so
            return ""
        if slept <= 0.0 or not self._running.attempt.running:
            return ""
        self._running.say("slept", standstill_words(slept), now, {"seconds": slept})
        return standstill_words(slept)

    def _finish(self, event: AttemptEvent, reason: str = "") -> AttemptResult:
        self.disarm()
        self._withdrawal.stop()
        self._hand.forget()
        self._leave = None
        self._inputs.unsteady(0, 0)
        now = self._clock.now()
        if (lost := self.lost) > SLOWED_S:
            self._running.say(SLOWED, slowed_words(lost), now, {"seconds": lost})
        result = self._running.finish(event, self._sources.seen, self._inputs, now, reason)
        self.disarm()  # a key that was pressed while the attempt was ending
        self.lead(inf)
        self.result = result
        self._publish(now)
        return result

    def _crashed(self, error: Exception) -> None:
        """Switch the forces off and keep the record after a fault of the program itself."""
        self.disarm()
        self.abort(f"fault of the program: {type(error).__name__}: {error}")
