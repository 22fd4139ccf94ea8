"""Plays what the arm did on the run of the exercise: fetching, then an attempt led by the arm.

While the arm fetches the needle guide there is no needle to be seen but in 3D. From the moment at
which the shaft stands over the entry, an attempt runs whose hand is the arm: loop, tissue, cameras,
record and score are those of a student's attempt. Nothing here drives a real arm or robot.
"""

from __future__ import annotations

from collections.abc import Callable
from enum import Enum, auto
from time import monotonic
from typing import TYPE_CHECKING, Final

import numpy as np
from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtWidgets import QApplication

from app.arm.views.shape import arm_shape
from app.core.errors import AcusError
from app.planning.placement import PlacedPlan
from app.session.machine import RUNNING, State
from app.session.pad.hand import HandPose
from app.session.snapshot import Snapshot
from app.views.exercise.conductor import Conductor
from app.views.exercise.run import ExerciseRun
from app.views.kit.text import tr
from app.views.scene.orbit import Orbit
from app.views.scene.shape import SceneShape
from app.views.scene.view import SceneView

if TYPE_CHECKING:
    from app.arm.scene.performance import ArmPerformance

PERIOD_MS: Final = 20
LEADS_S: Final = 0.04
"""In an attempt whose time is paced, time waits for the arm's next step after this [s]."""

LONGEST_S: Final = 0.1
"""A window that was busy makes up for no more than this [s]: nothing leaps."""

STEP_S: Final = 0.5
"""A step goes on for so long [s]."""

WAITS: Final = -0.010
"""Depth at which the simulated needle waits until the arm has the shaft over the entry [m]."""

STILL_S: Final = 2.5
"""So long the needle is held still at the target before the attempt ends [s]."""

PATIENCE_S: Final = 8.0
"""An attempt that does not come to be held still ends after this long at the target [s]."""

AFTER_S: Final = 2.0
"""So long the word is waited for that an attempt is over which has stopped running [s]."""

SCANS_AT: Final = (0.45, 1.0)
"""Where control scans guide, one is taken at these shares of the way in."""

PICTURE_S, ATTEMPT_PICTURE_S = 0.08, 0.2
"""The arm is drawn anew at most this often while it fetches, and in an attempt [s]: slices, loop
and cameras must not wait for it."""

LEAST_MM: Final = 0.3
"""It is drawn anew where a point of it has moved by more than this."""

NEAR_MM: Final = 240.0
"""What is no farther from the entry is looked at while the needle is inserted."""

FASTEST: Final = 0.02
"""The needle goes along its path no faster than in an ordinary insertion [m/s]; the arm could."""

PIVOT: Final = "pivot"
"""Phase from which on the shaft stands over the entry."""


class PlayState(Enum):
    """What is going on."""

    WAITING = auto()  # for a simulated robot
    FETCHING = auto()
    INSERTING = auto()
    HOLDING = auto()
    TAKEN = auto()  # the student has the needle
    STOPPING = auto()
    OVER = auto()


def pace_of(performance: ArmPerformance) -> float:
    """Seconds of a performance per second, at most 1, at which its tip is no faster than FASTEST
    from the moment on at which the shaft stands over the entry.
    """
    line = performance.timeline
    times = np.arange(line.begin(PIVOT), line.duration, 1e-3 * PERIOD_MS)
    depths = np.array([performance.needle(float(t))[1] for t in times])
    fastest = float(np.abs(np.diff(depths)).max(initial=0.0)) / (1e-3 * PERIOD_MS)
    return min(1.0, FASTEST / max(fastest, 1e-9))


class ArmPlay(QObject):
    """Leads the needle of one attempt as a performance says.

    Args:
        conductor: of the window.
        scene: where the arm is drawn.
        performance: what the arm did.
        placed: the plan that it carried out.
        student: who watches, as the record names him.
        clock: time [s].

    Attributes:
        state: what is going on.
        t: time in the performance [s].
        playing: whether it goes on.

    Signals:
        changed(): something else goes on, or time has gone on.
        taken(): the student has the needle.
        over(str): everything is as it was before; why it ended early, empty where it did not.
    """

    changed = Signal()
    taken = Signal()
    over = Signal(str)

    def __init__(
        self,
        conductor: Conductor,
        scene: SceneView,
        performance: ArmPerformance,
        placed: PlacedPlan,
        student: str,
        parent: QObject,
        clock: Callable[[], float] = monotonic,
    ) -> None:
        super().__init__(parent)
        self._conductor, self._controller, self._scene = conductor, conductor.controller, scene
        self.performance, self._placed, self._student = performance, placed, student
        self._clock, self._last, self._drawn = clock, clock(), -np.inf
        self.state, self.t, self.playing = PlayState.WAITING, 0.0, True
        self._until = np.inf
        self._begins = performance.timeline.begin(PIVOT)
        self._pace = pace_of(performance)
        self._trainer: object = None
        self._pose: HandPose | None = None
        self._held = self._waited = 0.0
        self._scans = 0
        self._shape: SceneShape | None = None
        self._before: Orbit | None = None
        self._why, self._looks, self._waits = "", False, False
        self._timer = QTimer(self, interval=PERIOD_MS)
        self._timer.timeout.connect(self.tick)
        self._links = [
            (self._controller.finished, self._finished),
            (self._controller.demonstrated, self._demonstrated),
        ]
        for signal, slot in self._links:
            signal.connect(slot)

    @property
    def duration(self) -> float:
        """Time of the whole [s]."""
        return self.performance.timeline.duration

    @property
    def phase(self) -> str:
        """Name of the arm's phase now."""
        return self.performance.timeline.at(self.t).phase

    @property
    def share(self) -> float:
        """Return how far the phase is, 0 to 1."""
        line = self.performance.timeline
        times = line.time[line.phase == line.names.index(self.phase)]
        return float((self.t - times[0]) / max(times[-1] - times[0], 1e-9))

    @property
    def may_take_over(self) -> bool:
        """Return whether there is a needle that the student can go on with."""
        return (
            self.state in (PlayState.INSERTING, PlayState.HOLDING) and self._controller.is_running
        )

    # --- what the user asks for ---------------------------------------------------------------
    def start(self) -> None:
        """Begin, as soon as there is a simulated robot."""
        self._conductor.lend(True)
        self._waits = True
        self._controller.set_waiting(tr("Start waits: the arm has the needle. Esc stops it."))
        self._last = self._clock()
        self._timer.start()
        self.tick()

    def pause(self) -> None:
        """Stand still, the needle where it is, or go on."""
        self.playing, self._until = not self.playing, np.inf
        self.changed.emit()

    def step(self) -> None:
        """Go on for `STEP_S` as they are watched, then stand still."""
        pace = 1.0 if self.state is PlayState.FETCHING else self._pace
        self.playing, self._until = True, self.t + pace * STEP_S
        self.changed.emit()

    def skip(self) -> None:
        """Leave out what is left of the fetching."""
        if self.state is PlayState.FETCHING:
            self.t = max(self.t, self._begins)
            self.playing, self._until = True, np.inf
            self.changed.emit()

    def take_over(self) -> None:
        """Let the student's hand go on from exactly where the needle is."""
        run = self._controller.run
        if not self.may_take_over or run is None or self._pose is None:
            return
        bullseye = self._conductor.views.bullseye
        try:
            run.trainer.take_over(bullseye.source.name)
        except AcusError as error:  # it has just ended
            self._conductor.failed.emit(error)
            return
        run.trainer.lead(np.inf)
        self.state = PlayState.TAKEN
        self._timer.stop()
        self._controller.lead("")
        bullseye.take_hand(self._pose)
        self._show_nothing()
        bullseye.pad.setFocus()
        self.taken.emit()

    def stop(self, reason: str = "") -> None:
        """End it; an attempt of the arm is broken off. One that was taken over is the student's."""
        if self.state in (PlayState.OVER, PlayState.STOPPING, PlayState.TAKEN):
            return
        if self._runs():
            self.state, self._why, self._waited = PlayState.STOPPING, reason, 0.0
            self._controller.abort(quietly=True)  # `demonstrated` follows
            self.changed.emit()
        else:
            self._end(reason)

    def forget(self) -> None:
        """Let go of everything at once: the patient or the window goes; idempotent."""
        self._end("")

    # --- one tick -----------------------------------------------------------------------------
    def tick(self) -> None:
        """Go on by the time since the last tick."""
        now = self._clock()
        passed, self._last = min(max(now - self._last, 0.0), LONGEST_S), now
        if QApplication.activeModalWidget() is not None:
            passed = 0.0  # a question stands over it: nothing goes on behind it
        run = self._controller.run
        if self.state is PlayState.WAITING:
            if run is not None and run.interactive and not (run.is_real or run.demonstrates):
                self._fetch(run)
            self.changed.emit()
            return
        if self.state is PlayState.STOPPING:
            self._waited += 0.0 if self._controller.is_running else passed
            if self._waited >= AFTER_S:  # nobody has told of its end
                self._end(self._why)
            return
        why = self._why_gone(run)
        if run is None or why:
            self.stop(why)
            return
        snapshot = run.trainer.snapshot()
        if self.state in (PlayState.INSERTING, PlayState.HOLDING):
            led = run.trainer.lead(LEADS_S)
            passed = passed if led is None else led
        if self.state is PlayState.FETCHING:
            self._bring(run, snapshot, passed)
        elif self.state in (PlayState.INSERTING, PlayState.HOLDING):
            self._insert(run, snapshot, passed)
        self._draw(now)
        self.changed.emit()

    def _why_gone(self, run: ExerciseRun | None) -> str:
        """Say why the run that was begun on is not there as it was; empty while it is."""
        if run is None or run.trainer is not self._trainer:
            return tr("The arm stopped: another robot or exercise was taken.")
        if run.placed.plan != self._placed.plan or run.placed.placement != self._placed.placement:
            return tr("The arm stopped: the plan was changed. Ask again for the new one.")
        return ""

    def _fetch(self, run: ExerciseRun) -> None:
        """Begin with the fetching: the 3D view has the room, nothing else shows a needle."""
        self.state, self._trainer = PlayState.FETCHING, run.trainer
        self._controller.lead("arm", is_absent=True)
        self._conductor.show_scene_alone(True)
        self._before = None if self._scene.is_home else self._scene.orbit
        self._looks = True
        shapes = [self._shape_at(t) for t in np.linspace(0.0, self._begins, 5)]
        points = np.vstack([shape.points_mm for shape in shapes])
        self._scene.look_at(np.vstack([points, self._scene.body_mm]))
        self._draw(self._clock())

    def _bring(self, run: ExerciseRun, snapshot: Snapshot, passed: float) -> None:
        """Let time go on until the shaft stands over the entry, and the simulated needle waits."""
        self._go_on(passed, self._begins)
        direction, depth = self.performance.needle(self._begins)
        self._feed(run, direction, min(depth, WAITS))
        if self.t < self._begins or not self.playing:
            return
        out = snapshot.device is not None and snapshot.state not in RUNNING
        if not out or not snapshot.pose.valid:
            return
        self._let_start()
        self._controller.lead("arm")
        self._controller.begin(self._student)
        if not self._controller.is_running:
            self._end("")  # whoever refused has said why
            return
        self.state = PlayState.INSERTING
        self._conductor.show_scene_alone(False)
        self._look_near()

    def _insert(self, run: ExerciseRun, snapshot: Snapshot, passed: float) -> None:
        if snapshot.state not in RUNNING:
            return  # it has ended; `finished` follows
        if snapshot.state not in (State.WITHDRAWING, State.PAUSED):
            self._go_on(self._pace * passed, self.duration)
        self._feed(run, *self.performance.needle(self.t))
        if not run.shown.live:
            self._take_scans(run, snapshot)
        if self.state is PlayState.INSERTING and self.t >= self.duration:
            self.state, self._held, self._waited = PlayState.HOLDING, 0.0, 0.0
        if self.state is PlayState.HOLDING and self.playing:
            self._waited += passed
            self._held = self._held + passed if snapshot.state is State.HOLDING else 0.0
            if self._held >= STILL_S or self._waited >= PATIENCE_S:
                self._waited = -np.inf  # asked once
                self._controller.end()

    def _go_on(self, passed: float, end: float) -> None:
        if not self.playing:
            return
        self.t = min(self.t + passed, self._until, max(end, self.t))
        if self.t >= self._until:
            self.playing, self._until = False, np.inf

    def _feed(self, run: ExerciseRun, direction: np.ndarray, depth: float) -> None:
        """Let the simulated hand want the needle there, within what the robot allows."""
        low, high = run.profile.depth_range
        self._pose = HandPose(direction, min(max(depth, low), high), True)
        run.trainer.hand(float(direction[0]), float(direction[1]), self._pose.depth)

    def _take_scans(self, run: ExerciseRun, snapshot: Snapshot) -> None:
        """Take control scans as who is guided by them would."""
        if self._scans >= len(SCANS_AT):
            return
        way = 1.0 - snapshot.offset.remaining / run.placed.length
        share = SCANS_AT[self._scans]
        if way >= share or (self.state is PlayState.HOLDING and self._held > 0.0):
            self._scans += 1
            self._conductor.views.panel.scan.here.click()
            self._controller.scan()

    # --- 3D -----------------------------------------------------------------------------------
    def _shape_at(self, t: float) -> SceneShape:
        return arm_shape(self.performance, t, self._placed.T_world_patient.inverse())

    def _draw(self, now: float) -> None:
        pause = PICTURE_S if self.state is PlayState.FETCHING else ATTEMPT_PICTURE_S
        if now - self._drawn < pause or self.state in (PlayState.WAITING, PlayState.OVER):
            return
        shape = self._shape_at(self.t)
        if shape.moved_mm(self._shape) > LEAST_MM:
            self._shape, self._drawn = shape, now
            self._scene.set_shape(shape, often=self.state is PlayState.FETCHING)

    def _look_near(self) -> None:
        """Look at hand, entry and target."""
        plan = self._placed.plan
        shape = self._shape_at(self._begins)
        near = shape.near_mm(shape.hoops[0].centre_mm, NEAR_MM)
        self._scene.look_at(np.vstack([near, plan.entry_mm, plan.target_mm]))

    def _show_nothing(self) -> None:
        """Take the arm out of the picture, and look from where one looked before."""
        self._scene.set_shape(None)
        if self._looks:
            self._looks = False
            if self._before is None:
                self._scene.view_home()
            else:
                self._scene.set_orbit(self._before)
        self._conductor.show_leader(None)

    # --- the end ------------------------------------------------------------------------------
    def _runs(self) -> bool:
        began = self.state in (PlayState.INSERTING, PlayState.HOLDING)
        return began and self._controller.is_running

    def _let_start(self) -> None:
        if self._waits:
            self._waits = False
            self._controller.set_waiting("")

    def _finished(self, _: object) -> None:
        """Give everything back: the attempt is over, whoever ended it."""
        if self.state is not PlayState.WAITING:
            self._end("")

    def _demonstrated(self) -> None:
        if self.state is PlayState.STOPPING:
            self._end(self._why)

    def _end(self, reason: str) -> None:
        if self.state is PlayState.OVER:
            return
        taken, self.state = self.state is PlayState.TAKEN, PlayState.OVER
        self._timer.stop()
        for signal, slot in self._links:
            signal.disconnect(slot)
        self._let_start()
        if not taken:
            self._controller.lead("")
            self._conductor.show_scene_alone(False)
            self._show_nothing()
        self._conductor.lend(False)
        self.over.emit(reason)
