"""Between trainer and widgets: pulls, shows, passes on. It judges nothing and stores nothing."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from time import monotonic
from typing import Final

from PySide6.QtCore import QObject, Qt, QTimer, Signal

from app.core.arrays import FloatArray
from app.core.clock import Clock, SystemClock
from app.core.errors import AcusError
from app.core.events import Event
from app.core.rate_meter import RateMeter
from app.core.units import MILLIMETRE
from app.exercises.parts import ViewName
from app.imaging.scan_order import ScanOrder
from app.planning.placement import PlacedPlan
from app.scoring.complications.answers import Reaction
from app.session.display_load import BusyWatch, WorldPace
from app.session.machine import RUNNING, State
from app.session.pad.hand import HandPose
from app.session.pad.readings import hand_pose, needle_line
from app.session.procedure import Step
from app.session.result import AttemptResult
from app.session.shown_views import without_needle
from app.session.snapshot import Snapshot, tip_inside
from app.session.trainer import Trainer
from app.session.transitions import PauseCause
from app.views.exercise.ablation_panel import of_electrodes
from app.views.exercise.axial_gauge import AxialGauge, axial_force, bone_crossed_mm
from app.views.exercise.bullseye import Bullseye
from app.views.exercise.enable_switch import enabling
from app.views.exercise.energy_gauge import energy_figures
from app.views.exercise.felt import force_limit
from app.views.exercise.panel import ExercisePanel
from app.views.exercise.readings import (
    figures,
    robot_status,
    status_items,
    tracker_figures,
)
from app.views.exercise.resting import Rester
from app.views.exercise.run import ExerciseRun
from app.views.exercise.status import MessageList, StatusStrip
from app.views.exercise.status_items import MISSED_WINDOW
from app.views.exercise.tracker_panel import TrackerPanel
from app.views.kit.background import run_in_background
from app.views.kit.text import tr, translated
from app.views.kit.verdict import StatusItem

STATUS_PERIOD: Final = 0.25
"""The status strip is refreshed this often [s]: words that flicker cannot be read."""

FIGURES_PERIOD: Final = 0.1
"""The panel's numbers are refreshed this often [s], and at once when the attempt goes on."""


@dataclass(frozen=True, slots=True, eq=False)
class ExerciseViews:
    """The widgets that the controller feeds."""

    bullseye: Bullseye
    panel: ExercisePanel
    status: StatusStrip
    tracker: TrackerPanel
    messages: MessageList
    gauge: AxialGauge


class ExerciseDisplay:
    """Fills the widgets.

    Attributes:
        rates: of the loop [Hz], and the share of deadlines it missed of late, at the last poll.
        extra_items: further lines of the status strip, by whoever else watches; none by default.
        is_led: whether a part of the window leads the needle, not the student's hand.
        is_absent: whether the needle is not there yet.
    """

    def __init__(self, views: ExerciseViews) -> None:
        self._views = views
        self._status_time = self._figures_time = -1.0
        self._figured: tuple[object, ...] = ()
        self._going: State | None = None
        self._aimed: PlacedPlan | None = None
        self.is_led = self.is_absent = self._was_paused = False
        self.rates = (0.0, 0.0)
        self.extra_items: list[Callable[[Snapshot], tuple[StatusItem, ...]]] = []
        self._rates = LoopRates()

    def begin(self) -> None:
        """Begin with another trainer."""
        self._rates, self._figured, self._going = LoopRates(), (), None
        self._was_paused = False

    def show_run(self, run: ExerciseRun) -> None:
        """Draw what stays the same during an attempt; nothing of the needle where scans guide."""
        live, shows = run.shown.live, run.shown.shows
        self._aimed = None
        self._views.bullseye.hide_needle(not shows(ViewName.BULLSEYE), beside_scan=not live)
        by_hand = run.interactive and not self.is_led
        self._views.bullseye.set_scene(run.scene(), by_hand, run.is_real, run.held_at_hub)
        self._views.panel.set_forceful(run.forceful)
        self._views.panel.set_guidance(None if live else run.guidance, run.placed.plan)
        # The phases are read from the needle, and are those of one insertion, not of many targets.
        self._views.panel.set_brief(not live or run.touches)
        self._views.panel.rail.breath.begin(run.rings[0], run.breathes)
        self._views.panel.set_offsets(shows(ViewName.BULLSEYE))

    def take_hand(self, snapshot: Snapshot) -> None:
        """Let the simulated hand go on from where the loop has it; draws nothing.

        While the needle is being brought out, the hand of the window goes with it; while the
        attempt is paused it stands with it, so that nothing given meanwhile is made up for.
        """
        bullseye = self._views.bullseye
        led = snapshot.state is State.WITHDRAWING and not snapshot.ready
        paused = snapshot.state is State.PAUSED
        # Where it may go back, the loop is not yet where a movement of this moment leads.
        stands = paused and not (snapshot.pause is PauseCause.CAMERAS and bullseye.is_moving)
        led = led or stands or (self._was_paused and not paused)
        self._was_paused = paused
        hand = hand_pose(snapshot) if led or bullseye.hand is None else None
        if hand is not None:
            bullseye.take_hand(hand)

    def show(self, run: ExerciseRun, snapshot: Snapshot, now: float, late: float) -> None:
        """Show a snapshot.

        Args:
            run: whose it is.
            snapshot: of its trainer.
            now: time of the poll [s].
            late: since the poll before [s].
        """
        self._follow(snapshot.state)
        limit = force_limit(snapshot, run.profile.limits.hand_force)
        self._show_panel(run, snapshot, limit, now)
        self._show_pad(run, snapshot)
        rate, missing = self.rates = self._rates.read(snapshot, now)
        self._show_tracker(run, snapshot, now)
        if now - self._status_time >= STATUS_PERIOD:
            self._status_time = now
            items = status_items(snapshot, rate, missing, late, stored=not run.demonstrates)
            extra = (item for more in self.extra_items for item in more(snapshot))
            self._views.status.show_items((*extra, *items), robot_status(snapshot, items))

    def _follow(self, state: State) -> None:
        """Let the hand go where the attempt begins, pauses or ends: what was held was for before.

        What is held while the needle is aligned, inserted and held still goes on.
        """
        going = State.INSERTING if state in (State.ALIGNING, State.HOLDING) else state
        if going is not self._going:
            self._going = going
            self._views.bullseye.let_go()

    def _show_panel(self, run: ExerciseRun, snapshot: Snapshot, limit: float, now: float) -> None:
        views, interactive = self._views, not run.demonstrates
        hidden = self.is_absent or not run.shown.live
        views.bullseye.source.set_locked(snapshot.state in RUNNING)
        views.panel.withdrawal.show_snapshot(snapshot)
        commands = interactive and snapshot.state in RUNNING
        views.panel.breath.show_breath(snapshot.breath, commands)
        views.panel.rail.breath.show_snapshot(snapshot)
        views.panel.bevel.show_roll(snapshot.roll, commands)
        views.panel.touch.show_touch(snapshot, run.profile.needle_length)
        inside = tip_inside(snapshot, run.shown.live)
        acts = commands and snapshot.takes_steps
        views.panel.patient.show_patient(snapshot.complications, commands)
        electrodes, other = of_electrodes(snapshot.procedure)
        steps = None if other is None or not other.part.has_steps else other
        views.panel.procedure.show_procedure(steps, acts, inside)
        views.panel.ablation.show_ablation(electrodes, acts, inside)
        views.panel.show_out(snapshot.out_of_room)
        views.bullseye.pad.rolls = commands and snapshot.roll is not None
        views.panel.enable.show_enabling(enabling(snapshot, views.panel.enable.is_held))
        figured = snapshot.state, snapshot.ready, hidden
        if figured == self._figured and 0.0 <= now - self._figures_time < FIGURES_PERIOD:
            return
        self._figured, self._figures_time = figured, now
        views.panel.show_figures(figures(snapshot, limit, hidden))
        views.panel.energy.show_energy(energy_figures(snapshot))

    def _show_pad(self, run: ExerciseRun, snapshot: Snapshot) -> None:
        bullseye = self._views.bullseye
        if snapshot.aim is not None and snapshot.aim is not self._aimed:
            self._aimed = snapshot.aim
            bullseye.retarget(run.scene(self._aimed))
        view = needle_line(snapshot)
        if view is not None:
            bullseye.show_view(view)
        if run.shown.shows(ViewName.FORCE_GAUGE):
            self._views.gauge.show_force(axial_force(snapshot), bone_crossed_mm(snapshot))

    def _show_tracker(self, run: ExerciseRun, snapshot: Snapshot, now: float) -> None:
        tracker = self._views.tracker
        if tracker.due(now):
            wanted = tracker.overlays
            may = run.inspect is not None and run.shown.shows(ViewName.CAMERAS)
            seen = run.inspect(wanted.mask, wanted.epipolar) if may and run.inspect else None
            tracker.show_tracker(seen, tracker_figures(snapshot), now)


def about_tip(run: ExerciseRun) -> ScanOrder:
    """Return a control scan of as many slices as the exercise has, the needle's tip in the middle;
    the middle of the plan where nobody knows the tip.
    """
    placed, pose = run.placed, run.trainer.snapshot().pose
    plan = placed.plan
    if pose.measured:
        middle = float((placed.T_world_patient.inverse() @ pose.p_tip)[2]) / MILLIMETRE
    else:
        middle = 0.5 * float(plan.entry_mm[2] + plan.target_mm[2])
    return run.guidance.order(middle)


class LoopRates:
    """Reads a snapshot at every poll."""

    def __init__(self) -> None:
        self._rate = RateMeter()
        self._missed, self._due = RateMeter(MISSED_WINDOW), RateMeter(MISSED_WINDOW)

    def read(self, snapshot: Snapshot, now: float) -> tuple[float, float]:
        """Ticks a second [Hz], and the share of deadlines missed in the last seconds."""
        device, timing = snapshot.device, snapshot.timing
        rate = self._rate.read(now, device.tick) if device is not None else 0.0
        if timing is None:
            return rate, 0.0
        missed = self._missed.read(now, timing.missed)
        due = self._due.read(now, timing.ticks + timing.missed)  # a missed deadline has no tick
        return rate, missed / due if due > 0.0 else 0.0


__all__ = ["PERIOD_MS", "ExerciseController", "ExerciseViews"]

PERIOD_MS: Final = 16
"""The window polls the trainer this often: 60 Hz, as screens do."""

LIGHT_MS: Final = 33
"""And so often where the computer is too busy."""

SHOWN_S: Final = 0.1
"""The simulated world of a person's attempt goes on for so long without having been shown [s]."""

REST_MS: Final = 100
"""So often while robot and cameras rest, to see whether they still do."""


class ExerciseController(QObject):
    """Feeds the exercise's widgets from a trainer, and the trainer from them.

    Signals:
        needle_moved(NeedlePose): at every poll, while the pose is valid.
        snapshot_taken(Snapshot): at every poll.
        event_seen(Event): each event of the trainer, once.
        attached(): another run, or none, is served.
        beginning(): an attempt is about to begin; everything is to be as the exercise has it.
        ending(on: bool): an attempt that was ended is being scored and written, or is so no more.
        began(str): session id of an attempt that began.
        finished(AttemptResult): an attempt ended or was aborted, once each.
        burdened(bool): the computer is too busy to draw everything in an attempt, or is no more.
        slowed(float): the simulated world goes on with this share of the wall's speed; 1 for all.
        demonstrated(): what was only shown is over: nobody's attempt, of which nothing follows.
        failed(str): something that the user asked for did not work, in one line.
        worked(): something that the user asked for did.

    Attributes:
        refusal: says why who is here may not begin this exercise; empty if nothing speaks against.
        intercepted: asked when somebody wants to begin: whether something else comes first.
        rester: lets simulated robot and cameras rest, and this look at them less meanwhile.
    """

    needle_moved = Signal(object)
    snapshot_taken = Signal(object)
    event_seen = Signal(object)
    attached = Signal()
    beginning = Signal()
    ending = Signal(bool)
    began = Signal(str)
    finished = Signal(object)
    burdened = Signal(bool)
    slowed = Signal(float)
    demonstrated = Signal()
    failed = Signal(str)
    worked = Signal()

    def __init__(
        self, views: ExerciseViews, clock: Clock | None = None, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._views = views
        self._clock = clock or SystemClock()
        self._run: ExerciseRun | None = None
        self._seen: AttemptResult | None = None
        self._ending = self._quiet = False
        self._beat, self._unreadable, self._waiting, self._led_as = 0.0, "", "", ""
        self.refusal: Callable[[], str] = str
        self.intercepted: Callable[[], bool] = bool
        self._display = ExerciseDisplay(views)
        self._timer = QTimer(self, interval=PERIOD_MS, timerType=Qt.TimerType.PreciseTimer)
        self._timer.timeout.connect(self.poll)
        self._busy, self._is_light = BusyWatch(), False
        self._world, self._share = WorldPace(), 1.0
        self.rester = Rester(self)
        self.rester.changed.connect(self._take_rest)
        self.rester.failed.connect(lambda error: self._fail(translated(error)))
        self._connect()

    # --- life -------------------------------------------------------------------------------------
    def attach(self, run: ExerciseRun) -> None:
        """Serve a running trainer; begins to poll it and to send heartbeats."""
        self.detach()
        self._run, self._seen = run, run.trainer.result
        self._beat = self._clock.now()
        trainer = run.trainer
        self._views.bullseye.pad.set_clock(lambda: trainer.time)
        self._display.begin()
        self._display.show_run(run)
        self._views.panel.set_ready(True)
        self._views.panel.enable.set_wanted(run.held_arming)
        self._views.panel.energy.begin(run.is_real)
        self._views.panel.set_assistance(run.trainer.snapshot().assistance)
        self.rester.begin(run)
        self._timer.start(PERIOD_MS)
        self.attached.emit()

    def detach(self) -> None:
        """Let go of the trainer, without closing it; idempotent."""
        self._timer.stop()
        self._weigh(False, self._clock.now(), 0.0)
        self.rester.begin(None)
        self._views.panel.enable.set_wanted(False)  # lets go before the trainer is gone
        self._run, self._ending, self._quiet = None, False, False
        self._views.bullseye.set_scene(None, False)
        self._views.bullseye.pad.set_clock(monotonic)
        self._views.panel.set_ready(False)
        self._views.panel.show_figures(None)
        self._views.status.show_items(())
        self.attached.emit()

    def replan(self, run: ExerciseRun) -> None:
        """Take another plan of the same trainer: the pad is drawn anew, the rest goes on."""
        self._run = run
        self._display.show_run(run)

    def lead(self, hand: str, is_absent: bool = False) -> None:
        """Let a part of the window lead the needle in place of the student's hand.

        Args:
            hand: as attempts that begin now are recorded, one of `session.conditions.HANDS`; empty
                gives the needle back to mouse, tablet or gamepad, where it is.
            is_absent: whether the needle is not there yet: nothing of it is shown.
        """
        self._led_as = hand
        self._display.is_led, self._display.is_absent = bool(hand), is_absent
        if self._run is not None:
            self._display.show_run(self._run)

    @property
    def is_absent(self) -> bool:
        """Return whether the needle is not there yet, and nothing of it is shown."""
        return self._display.is_absent

    def set_waiting(self, reason: str) -> None:
        """Let no attempt begin, because of `reason`; empty ends that. One that runs goes on."""
        self._waiting = reason
        self._views.panel.set_waiting(reason)

    @property
    def run(self) -> ExerciseRun | None:
        """The run being served."""
        return self._run

    @property
    def is_running(self) -> bool:
        """Return whether an attempt runs, of a student or a demonstration."""
        return self._run is not None and self._run.trainer.snapshot().state in RUNNING

    @property
    def is_running_by_hand(self) -> bool:
        """Return whether an attempt runs in which somebody's own hand leads the needle."""
        run = self._run
        return self.is_running and run is not None and not (run.demonstrates or self._led_as)

    @property
    def rates(self) -> tuple[float, float]:
        """Rate of the loop [Hz], and the share of deadlines it missed of late, at the last poll."""
        return self._display.rates

    def add_items(self, items: Callable[[Snapshot], tuple[StatusItem, ...]]) -> None:
        """Let somebody else who watches put further lines into the status strip."""
        self._display.extra_items.append(items)

    # --- one poll ---------------------------------------------------------------------------------
    def poll(self) -> None:
        """Send a heartbeat, take the newest snapshot, show it, pass it on."""
        run = self._run
        if run is None:
            return
        now = self._clock.now()
        late, self._beat = now - self._beat, now
        run.trainer.heartbeat()
        try:
            snapshot = run.trainer.snapshot()
        except AcusError as error:
            self._tell_unreadable(translated(error))
            return
        if self._unreadable:
            self._unreadable = ""
            self.worked.emit()
        if self.rester.rests(snapshot, now):
            return
        self._weigh(snapshot.state in RUNNING, now, late)
        silent = self._pace(run, snapshot, now)
        self._drain(run)
        self._display.take_hand(snapshot)
        # Nobody beyond this line knows more than may be told.
        absent = self._display.is_absent
        shown = without_needle(snapshot) if absent else run.shown.of(snapshot, run.placed)
        self.snapshot_taken.emit(shown)  # first: pictures are made while the rest is shown
        self._display.show(run, shown, now, late if silent is None else min(late, silent))
        if shown.pose.valid:
            self.needle_moved.emit(shown.pose)
        self._take_result(run)

    def _weigh(self, runs: bool, now: float, passed: float) -> None:
        """Draw less in an attempt whose looks come late; everything where none runs."""
        if not runs:
            self._busy.begin()
        else:
            self._busy.note(now, passed, 1e-3 * self._timer.interval())
        if self._busy.is_light is not self._is_light:
            self._is_light = light = self._busy.is_light
            self._timer.setInterval(LIGHT_MS if light else PERIOD_MS)
            self.burdened.emit(light)

    def _pace(self, run: ExerciseRun, snapshot: Snapshot, now: float) -> float | None:
        """Let the simulated world of a person's attempt go no farther than he is shown it.

        Returns:
            For how long the window was silent in that world's own time [s]: the loop, which waits
            for it, has missed no more; None where time goes by the wall.
        """
        by_hand = run.interactive and not (run.demonstrates or self._led_as)
        share = 1.0
        silent: float | None = None
        if by_hand and snapshot.state in RUNNING:
            silent = run.trainer.lead(SHOWN_S)
        if silent is not None:
            share = self._world.note(now, run.trainer.time)
        else:
            self._world.begin()
        if share != self._share:
            self._share = share
            self.slowed.emit(share)
        return silent

    def _take_rest(self, rests: bool) -> None:
        """Look seldom while robot and cameras rest: what is shown stays as it is."""
        self._timer.setInterval(REST_MS if rests else PERIOD_MS)
        if not rests:
            self._beat = self._clock.now()
            self._display.begin()  # no rate spans a rest

    def _tell_unreadable(self, reason: str) -> None:
        """Say once why there is no snapshot; the next poll tries again."""
        if reason != self._unreadable:
            self._unreadable = reason
            self._fail(reason)

    def _drain(self, run: ExerciseRun) -> None:
        for event in run.trainer.events.drain():
            if run.shown.tells(event.kind, event.data.get("state")):
                self._views.messages.add_event(event)
            self.event_seen.emit(event)

    def _take_result(self, run: ExerciseRun) -> None:
        """Tell of a result once, whoever finished the attempt: the user, or a fault."""
        result = run.trainer.result
        if result is not None and result is not self._seen and not self._ending:
            self._seen = result
            quiet, self._quiet = self._quiet, False
            if run.demonstrates or quiet:
                self.demonstrated.emit()
            else:
                self.finished.emit(result)

    # --- what the user asks for -------------------------------------------------------------------
    def begin(self, student: str) -> None:
        """Begin an attempt; whoever asks twice has it begun once."""
        run = self._run
        if run is None or self.is_running:
            return
        absent = tr("The needle is not there yet.") if self.is_absent else ""
        refused = absent or self._waiting or ("" if run.demonstrates else self.refusal())
        if refused:
            self._fail(refused)
            return
        if not (run.demonstrates or self._led_as) and self.intercepted():
            return
        self.rester.stir()
        self.beginning.emit()
        self._views.messages.clear()
        self._views.messages.start_clock()
        try:
            by_hand = self._views.bullseye.source.name if run.interactive else ""
            hand = self._led_as or by_hand
            session = run.trainer.begin(student, hand)
        except AcusError as error:
            self._fail(translated(error))
            return
        if run.held_arming:
            self.set_held(self._views.panel.enable.is_held)
        self._views.panel.energy.begin(run.is_real)
        self.began.emit(session)
        self._views.bullseye.pad.setFocus()

    def confirm_outside(self) -> None:
        """Pass on that the student says the needle is out of the skin."""
        if self._run is not None:
            self._run.trainer.confirm_outside()

    def hold_breath(self, held: bool) -> None:
        """Tell the patient to hold the breath, or to breathe."""
        if self._run is not None:
            try:
                self._run.trainer.hold_breath(held)
            except AcusError as error:
                self._fail(translated(error))

    def roll(self, step: float) -> None:
        """Turn the needle about itself by `step` [rad], clockwise seen from the hub."""
        if self._run is not None:
            self._run.trainer.roll(step)

    def perform(self, step: Step, throw: int, notch_deg: float) -> None:
        """Do a step of the exercise's procedure."""
        if self._run is not None:
            try:
                self._run.trainer.perform(step, throw, notch_deg)
            except AcusError as error:
                self._fail(translated(error))
                return
            self.worked.emit()

    def notice(self) -> None:
        """Say that something is wrong with the patient."""
        self._respond(lambda trainer: trainer.notice())

    def answer(self, answer: Reaction) -> None:
        """Answer a complication."""
        self._respond(lambda trainer: trainer.answer(answer))

    def _respond(self, respond: Callable[[Trainer], None]) -> None:
        if self._run is not None:
            try:
                respond(self._run.trainer)
            except AcusError as error:
                self._fail(translated(error))
                return
            self.worked.emit()

    def scan(self) -> None:
        """Take a control scan: the slices that are set, where scans guide; else about the tip."""
        run = self._run
        if run is not None:
            try:
                live = run.shown.live
                if live:
                    run.trainer.scan(about_tip(run))
                else:
                    run.trainer.scan(self._views.panel.scan.order, self._views.panel.scan.choice)
            except AcusError as error:
                self._fail(translated(error))
                return
            self.worked.emit()

    def end(self) -> None:
        """End the attempt; scoring and writing go on beside the window."""
        if self._run is not None:
            self._finish(self._run.trainer.end)

    def abort(self, quietly: bool = False) -> None:
        """Break the attempt off: forces off at once; score and record follow beside the window.

        `quietly`: it is recorded, but nobody is to look at it now: `demonstrated` follows.
        """
        if self._run is not None:
            self._quiet = quietly
            self._run.trainer.disarm()
            self._finish(self._run.trainer.abort)

    def set_held(self, held: bool) -> None:
        """Arm the forces while somebody holds the switch."""
        run = self._run
        if run is None or not run.held_arming:
            return
        if held:
            run.trainer.arm()
        else:
            run.trainer.disarm()

    def set_assistance(self, share: float) -> None:
        """Set the assistance, -1 repels … 0 off … 1 guides, unless the exercise keeps it."""
        run = self._run
        if run is None:
            return
        try:
            run.trainer.assistance(share)
        except AcusError as error:
            self._views.panel.set_assistance(run.trainer.snapshot().assistance)
            self._fail(translated(error))

    def _finish(self, finish: Callable[[], AttemptResult | None]) -> None:
        if not self._ending:
            self._ending = True
            self.ending.emit(True)
            run_in_background(self, lambda _: finish(), self._ended, self._end_failed)

    def _ended(self, result: AttemptResult | None) -> None:
        self._ending = False
        self.ending.emit(False)
        self.poll()

    def _end_failed(self, error: Exception) -> None:
        self._ending = False
        self.ending.emit(False)
        self._fail(translated(error))

    def learn_colour(self, camera: str, pixel: FloatArray) -> None:
        """Take what a click into a camera's picture shows as the marker's colour."""
        run = self._run
        if run is None or run.learn_colour is None:
            return
        try:
            run.learn_colour(camera, pixel)
        except (AcusError, OSError) as error:
            self._fail(translated(error))
            return
        self.worked.emit()

    def _move_hand(self, pose: HandPose) -> None:
        if self._run is not None:
            x, y, _ = pose.direction
            self._run.trainer.hand(float(x), float(y), pose.depth, pose.holds)

    def _fail(self, message: str) -> None:
        self._views.messages.add_event(Event(self._clock.now(), "error", message))
        self.failed.emit(message)

    def _connect(self) -> None:
        panel = self._views.panel
        panel.start_requested.connect(self.begin)
        panel.assistance_changed.connect(self.set_assistance)
        panel.enable.held.connect(self.set_held)
        panel.withdrawal.confirmed.connect(self.confirm_outside)
        panel.breath.asked.connect(self.hold_breath)
        panel.procedure.asked.connect(self.perform)
        panel.patient.noticed.connect(self.notice)
        panel.patient.answered.connect(self.answer)
        panel.ablation.asked.connect(self.perform)
        self._views.bullseye.pad.rolled.connect(self.roll)
        panel.buttons.scan_requested.connect(self.scan)
        panel.buttons.end_requested.connect(self.end)
        panel.buttons.abort_requested.connect(self.abort)
        self._views.tracker.colour_clicked.connect(self.learn_colour)
        self._views.bullseye.hand_moved.connect(self._move_hand)
        self._views.bullseye.source.refused.connect(self._fail)
