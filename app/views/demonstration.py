"""A whole exercise shown in the window by itself: patient, plan, attempt, debrief.

It presses what a user would press. With a folder for pictures it leaves one of each moment there.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from typing import Final

from PySide6.QtCore import QObject, QTimer, Signal
from PySide6.QtGui import QPixmap
from PySide6.QtWidgets import QWidget

from app.core import state_vector as sv
from app.core.errors import AcusError
from app.planning.placement import Placement
from app.planning.proposal import demonstration_plan
from app.session.machine import State
from app.session.needle import DepthSource
from app.session.result import AttemptResult
from app.session.snapshot import Snapshot
from app.views.debrief.report import write_report
from app.views.debrief.review import review_of_result
from app.views.window import MainWindow

PERIOD_MS: Final = 50
PATIENCE_S: Final = 300.0
"""A step that takes longer than this has failed (a first start compiles every kernel)."""

SETTLE_S: Final = 1.5
"""Time for the first picture in 3D after everything stands [s]."""

FRESH_S: Final = 0.1
"""Pictures on the way wait until the cameras' last fix is no older [s]: drawing disturbs them."""

TRAINEE_DONE: Final = 9.0


class PictureError(AcusError, OSError):
    """A picture cannot be written."""


@dataclass(frozen=True, slots=True)
class Script:
    """What is demonstrated.

    Attributes:
        exercise: identifier of the exercise.
        ct: folder of another CT; None for the exercise's own patient.
        student: pseudonym.
        pictures: folder for pictures and report; None for none.
    """

    exercise: str = "first-insertion"
    ct: Path | None = None
    student: str = "demo"
    pictures: Path | None = None


class Demonstration(QObject):
    """Leads a window through one attempt.

    Signals:
        told(str): what is happening, one line.
        finished(AttemptResult): the debrief is on screen, everything is written.
        failed(str): why it ended early.
    """

    told = Signal(str)
    finished = Signal(object)
    failed = Signal(str)

    def __init__(self, window: MainWindow, script: Script, parent: QObject | None = None) -> None:
        super().__init__(parent)
        self._window, self._script = window, script
        self._timer = QTimer(self, interval=PERIOD_MS)
        self._timer.timeout.connect(self._look)
        self._step: Callable[[], bool] = self._patient_is_open
        self._waited = self._settled_at = 0.0
        self._taken: dict[str, QPixmap] = {}
        self._result: AttemptResult | None = None
        self._drawn = False
        window.debrief_page.curves.drawn.connect(self._note_drawn)
        window.conductor.controller.finished.connect(self._take_result)
        for failure in (
            window.open_ct.failed,
            window.conductor.failed,
            window.runs.failed,
            window.conductor.controller.failed,
        ):
            failure.connect(self._stop)

    def start(self) -> None:
        """Begin; the rest follows by itself."""
        self.told.emit("opening the patient")
        if self._script.ct is None:
            self._window.begin_exercise(self._script.exercise)
        else:
            self._window.open_ct.open_folder(self._script.ct)
        self._timer.start()

    # --- steps: each says whether it is over ----------------------------------------------------
    def _patient_is_open(self) -> bool:
        patient = self._window.conductor.patient
        if patient is None:
            return False
        if self._script.ct is not None:
            self.told.emit("no plan comes with this CT: taking a demonstration path")
            plan = demonstration_plan(patient.volume, patient.body)
            self._window.editor.start(plan, Placement())
            self._window.workspace.viewing.set_cursor(plan.target_mm)
        return self._then("waiting for robot, cameras and surfaces", self._everything_runs)

    def _everything_runs(self) -> bool:
        snapshot = self._snapshot()
        if snapshot is None or snapshot.pose.depth_source is not DepthSource.TRACKED:
            return False
        if not self._window.conductor.settled:
            self._settled_at = self._waited
        if self._waited < self._settled_at + SETTLE_S:
            return False
        self._picture("1-plan")
        panel = self._window.workspace.exercise_panel
        panel.set_student(self._script.student)
        panel.start_requested.emit(self._script.student)
        return self._then("attempt", self._needle_is_in)

    def _needle_is_in(self) -> bool:
        if self._result is not None:  # broken off, by a fault
            self._stop(f"the attempt was aborted: {self._result.reason}")
            return True
        snapshot = self._snapshot()
        if snapshot is None or snapshot.device is None:
            return False
        self._picture_on_the_way(snapshot)
        if snapshot.device.row[sv.TRAINEE_PHASE] != TRAINEE_DONE:
            return False
        self._pictures_missed()
        self._window.workspace.show_exercise()
        self._picture("4-at-the-target")
        self._window.conductor.controller.end()
        return self._then("scoring", self._debrief_is_shown)

    def _debrief_is_shown(self) -> bool:
        if self._result is None or not self._drawn:
            return False
        self._picture("5-debrief")
        self._window.show_sessions()
        return self._then("listing the sessions", self._sessions_are_listed)

    def _sessions_are_listed(self) -> bool:
        if self._result is None or not self._window.sessions_page.model.rowCount():
            return False
        self._picture("6-sessions")
        self._window.show_debrief()
        self._timer.stop()
        self._write_pictures()
        self.finished.emit(self._result)
        return True

    def _picture_on_the_way(self, snapshot: Snapshot) -> None:
        workspace = self._window.workspace
        if snapshot.state is State.ALIGNING and snapshot.elapsed > 3.0:
            self._picture("2-aligning")
        if not snapshot.pose.measured or snapshot.tracker.age > FRESH_S:
            return
        length = snapshot.pose.depth + snapshot.offset.remaining
        if snapshot.pose.depth > 0.7 * length and "3-inserting" in self._taken:
            self._picture("3-cameras")
            workspace.show_exercise()
        elif snapshot.pose.depth > 0.4 * length and self._script.pictures is not None:
            self._picture("3-inserting")
            self._picture("3-bullseye", workspace.bullseye)
            workspace.show_cameras()

    def _pictures_missed(self) -> None:
        """Take at the target what no moment on the way was good for; each picture exists."""
        if "3-cameras" in self._taken:
            return
        workspace = self._window.workspace
        self._picture("3-inserting")
        self._picture("3-bullseye", workspace.bullseye)
        workspace.show_cameras()
        self._picture("3-cameras")

    # --- around the steps -----------------------------------------------------------------------
    def _look(self) -> None:
        self._waited += PERIOD_MS * 1e-3
        try:
            if not self._step() and self._waited > PATIENCE_S:
                self._stop(f"nothing has happened for {PATIENCE_S:g} s")
        except AcusError as error:
            self._stop(str(error))

    def _then(self, text: str, step: Callable[[], bool]) -> bool:
        self._step, self._waited = step, 0.0
        self.told.emit(text)
        return True

    def _stop(self, reason: object) -> None:
        if self._timer.isActive():
            self._timer.stop()
            self._write_pictures()
            self.failed.emit(str(reason))

    def _take_result(self, result: AttemptResult) -> None:
        self._result, self._waited, self._drawn = result, 0.0, False

    def _note_drawn(self) -> None:
        self._drawn = True

    def _snapshot(self) -> Snapshot | None:
        run = self._window.conductor.controller.run
        return None if run is None else run.trainer.snapshot()

    def _picture(self, name: str, widget: QWidget | None = None) -> None:
        if self._script.pictures is None or name in self._taken:
            return
        self._taken[name] = (widget or self._window).grab()

    def _write_pictures(self) -> None:
        """Write at the end: compressing takes long enough to disturb the cameras."""
        folder = self._script.pictures
        if folder is None:
            return
        folder.mkdir(parents=True, exist_ok=True)
        for name, picture in self._taken.items():
            if not picture.save(str(folder / f"{name}.png")):
                raise PictureError(f"cannot write {folder / name}.png; is there room on the disk?")
        if self._result is not None:
            write_report(review_of_result(self._result), folder / "report.pdf")
