"""A whole exercise shown in the window by itself: patient, plan, attempt, debrief.

It presses what a user would press. With a folder for pictures it leaves one of each moment there,
and the report, when it is over.
"""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass
from pathlib import Path
from time import process_time
from typing import Final, Protocol, TypeVar

import numpy as np
from PySide6.QtCore import QCoreApplication, QEvent, QObject, QTimer, Signal, SignalInstance
from PySide6.QtGui import QPixmap
from PySide6.QtWidgets import QWidget

from app.core import state_vector as sv
from app.core.errors import AcusError
from app.planning.paths import demonstration_plan
from app.planning.patient import Patient
from app.planning.placement import Placement
from app.session.machine import State
from app.session.needle import DepthSource
from app.session.result import AttemptResult
from app.session.review import review_of_result
from app.session.snapshot import Snapshot
from app.views.debrief.feature import DebriefFeature
from app.views.debrief.report import write_report
from app.views.exercise.beginning import TRAINEE_DONE
from app.views.exercise.feature import ExerciseFeature
from app.views.kit.text import translated
from app.views.shell.feature import Feature
from app.views.shell.window import MainWindow
from app.views.slices.canvas import SliceCanvas
from app.views.slices.slab import as_point
from app.views.slices.viewing import Tool

F = TypeVar("F", bound=Feature)


class PictureError(AcusError, OSError):
    """A picture cannot be written."""


class StillPictures:
    """Takes a picture of each name once; without a folder none.

    Args:
        window: is pictured where nothing smaller is named.
        folder: where they are written.
    """

    def __init__(self, window: QWidget, folder: Path | None) -> None:
        self._window, self._folder = window, folder
        self._taken: dict[str, QPixmap] = {}

    def __contains__(self, name: str) -> bool:
        """Tell whether a picture was taken."""
        return name in self._taken

    def take(self, name: str, widget: QWidget | None = None) -> None:
        """Picture the window or a part of it, unless that moment has its picture."""
        if self._folder is not None and name not in self._taken:
            widget = widget or self._window
            _draw_what_is_due(widget)
            self._taken[name] = widget.grab()

    def write(self, result: AttemptResult | None) -> None:
        """Write all, and the report; at the end: compressing them would disturb the cameras.

        Raises:
            PictureError: if one cannot be written.
        """
        if self._folder is None:
            return
        self._folder.mkdir(parents=True, exist_ok=True)
        for name, picture in self._taken.items():
            file = self._folder / f"{name}.png"
            if not picture.save(str(file)):
                raise PictureError(f"cannot write {file}; is there room on the disk?")
        if result is not None:
            write_report(review_of_result(result), self._folder / "report.pdf")


def _draw_what_is_due(widget: QWidget) -> None:
    """Let slices and words catch up with the numbers: a picture is taken between two drawings."""
    for canvas in widget.findChildren(SliceCanvas):
        if canvas.isVisible():
            canvas.flush()
    QCoreApplication.sendPostedEvents(None, QEvent.Type.LayoutRequest)


PERIOD_MS: Final = 50
PATIENCE_S: Final = 300.0
"""A step that takes more processor time than this has failed (a first start compiles every kernel).
The clock counts a quarter: beside other programs it says little of what this one could do."""

SETTLE_S: Final = 1.5
"""Time for the first picture in 3D after everything stands [s]."""

FRESH_S: Final = 0.1
"""Pictures on the way wait until the cameras' last fix is no older [s]: drawing disturbs them."""


class DemonstrationError(AcusError):
    """An exercise cannot be shown by itself."""


class Leader(Protocol):
    """What leads the needle of a demonstration in place of the scripted trainee.

    Attributes:
        words: what it does first.
        failed: emitted with why it cannot.
    """

    words: str

    @property
    def failed(self) -> SignalInstance:
        """Emitted with why it cannot."""
        ...

    def begin(self) -> None:
        """Begin, as soon as patient and robot are there."""
        ...

    def follow(
        self,
        waited: float,
        snapshot: Snapshot | None,
        pictures: StillPictures,
        tell: Callable[[str], None],
    ) -> bool:
        """Go on until the attempt is over; called many times a second.

        Args:
            waited: since something happened [s].
            snapshot: of the attempt.
            pictures: takes pictures of what is to be seen.
            tell: is told what goes on, a line.

        Returns:
            Whether something has happened: the patience begins anew.
        """
        ...


MakesLeader = Callable[["FeatureOf"], Leader]
"""Makes a leader from the function that returns the window's feature of a kind."""


class FeatureOf(Protocol):
    """Return the window's feature of a kind."""

    def __call__(self, kind: type[F], /) -> F:
        """Return it."""
        ...


@dataclass(frozen=True, slots=True)
class DemonstrationScript:
    """What is demonstrated.

    Attributes:
        exercise: identifier of the exercise.
        ct: folder of another CT; None for the exercise's own patient.
        student: pseudonym.
        pictures: folder for pictures and report; None for none.
        leader: makes what leads the needle in place of a scripted trainee; None for the trainee.
    """

    exercise: str = "first-insertion"
    ct: Path | None = None
    student: str = "demo"
    pictures: Path | None = None
    leader: MakesLeader | None = None


def has_fresh_fix(snapshot: Snapshot) -> bool:
    """Return whether the cameras' newest fix is no older than `FRESH_S`; not before the first."""
    age = snapshot.tracker.age if snapshot.tracker is not None else None
    return age is not None and age <= FRESH_S


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

    def __init__(
        self, window: MainWindow, script: DemonstrationScript, parent: QObject | None = None
    ) -> None:
        super().__init__(parent)
        self._window, self._script = window, script
        self._timer = QTimer(self, interval=PERIOD_MS)
        self._timer.timeout.connect(self._poll)
        self._step: Callable[[], bool] = self._patient_is_open
        self._waited = self._settled_at = 0.0
        self._begun = process_time()
        self._pictures = StillPictures(window, script.pictures)
        self._result: AttemptResult | None = None
        self._debrief = window.feature(DebriefFeature)
        self._drawn = False
        self._leader = None if script.leader is None else script.leader(window.feature)
        self._debrief.page.curves.drawn.connect(self._note_drawn)
        window.conductor.controller.finished.connect(self._take_result)
        for failure in (
            window.open_ct.failed,
            window.conductor.failed,
            window.runs.failed,
            window.conductor.controller.failed,
            *(() if self._leader is None else (self._leader.failed,)),
        ):
            failure.connect(self._stop)

    def start(self) -> None:
        """Begin; the rest follows by itself."""
        self.told.emit("opening the patient")
        if self._script.ct is None:
            self._window.begin_exercise(self._script.exercise)
        else:
            self._window.conductor.set_exercise(
                self._window.feature(ExerciseFeature).exercises[self._script.exercise]
            )
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
        elif not self._window.editor.edit.draft.complete:
            self._place_entry(patient)
        return self._then("waiting for robot, cameras and surfaces", self._everything_runs)

    def _place_entry(self, patient: Patient) -> None:
        """Choose the entry that an exercise leaves to the student, as a student would.

        Raises:
            DemonstrationError: if none is proposed for this target.
        """
        proposed, target = patient.proposed, self._window.editor.edit.draft.target_mm
        if proposed is None or target is None or not np.allclose(proposed.target_mm, target):
            raise DemonstrationError(
                f"exercise {self._script.exercise} leaves the entry to the student, and none is "
                "proposed for its target: show an exercise with a plan, or place the entry in the "
                "window (acus run)"
            )
        self.told.emit("the exercise leaves the entry to the student: taking the proposed one")
        self._window.editor.place(Tool.ENTRY, as_point(proposed.entry_mm), True)

    def _everything_runs(self) -> bool:
        snapshot = self._snapshot()
        if snapshot is None or snapshot.pose.depth_source is not DepthSource.TRACKED:
            return False
        if not self._window.conductor.settled:
            self._settled_at = self._waited
        if self._waited < self._settled_at + SETTLE_S:
            return False
        self._pictures.take("1-plan")
        panel = self._window.workspace.exercise_panel
        panel.set_student(self._script.student)
        if self._leader is not None:
            self._leader.begin()
            return self._then(self._leader.words, self._leader_is_done)
        panel.start_requested.emit(self._script.student)
        return self._then("attempt", self._needle_is_in)

    def _leader_is_done(self) -> bool:
        """Let the leader go on; it ends its attempt itself."""
        leader = self._leader
        if leader is not None and leader.follow(
            self._waited, self._snapshot(), self._pictures, self.told.emit
        ):
            self._go_on()
        if self._result is not None:
            return self._then("scoring", self._debrief_is_shown)
        return False

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
        run = self._window.conductor.controller.run
        if run is not None and not run.shown.live:
            self._window.workspace.show_exercise()
            self._window.workspace.exercise_panel.scan.here.click()
            self._window.conductor.controller.scan()
            return self._then("control scan", self._scan_is_shown)
        self._pictures_missed()
        return self._at_the_target()

    def _scan_is_shown(self) -> bool:
        scans, view = self._window.conductor.scans, self._window.workspace.scan_view
        return view.scan is not None and not scans.is_busy and self._at_the_target()

    def _at_the_target(self) -> bool:
        self._window.workspace.show_exercise()
        self._pictures.take("4-at-the-target")
        self._window.conductor.controller.end()
        return self._then("scoring", self._debrief_is_shown)

    def _debrief_is_shown(self) -> bool:
        if self._result is None or not (self._drawn and self._debrief.page.views.is_settled):
            return False
        self._pictures.take("5-debrief")
        self._debrief.show_sessions()
        return self._then("listing the sessions", self._sessions_are_listed)

    def _sessions_are_listed(self) -> bool:
        if self._result is None or not self._debrief.sessions.model.rowCount():
            return False
        self._pictures.take("6-sessions")
        self._debrief.show()
        self._timer.stop()
        self._pictures.write(self._result)
        self.finished.emit(self._result)
        return True

    def _picture_on_the_way(self, snapshot: Snapshot) -> None:
        workspace = self._window.workspace
        if snapshot.state is State.ALIGNING and snapshot.elapsed > 3.0:
            self._pictures.take("2-aligning")
        run = self._window.conductor.controller.run
        if run is not None and not run.shown.live:
            return  # there is nothing of the needle to picture on the way
        if not (snapshot.pose.measured and has_fresh_fix(snapshot)):
            return
        length = snapshot.pose.depth + snapshot.offset.remaining
        if snapshot.pose.depth > 0.7 * length and "3-inserting" in self._pictures:
            self._pictures.take("3-cameras")
            workspace.show_exercise()
        elif snapshot.pose.depth > 0.4 * length and self._script.pictures is not None:
            self._pictures.take("3-inserting")
            self._pictures.take("3-bullseye", workspace.bullseye)
            workspace.show_cameras()

    def _pictures_missed(self) -> None:
        """Take at the target what no moment on the way was good for; each picture exists."""
        if "3-cameras" in self._pictures:
            return
        workspace = self._window.workspace
        self._pictures.take("3-inserting")
        self._pictures.take("3-bullseye", workspace.bullseye)
        workspace.show_cameras()
        self._pictures.take("3-cameras")

    # --- around the steps -----------------------------------------------------------------------
    def _poll(self) -> None:
        self._waited += PERIOD_MS * 1e-3
        try:
            used = max(process_time() - self._begun, 0.25 * self._waited)
            if not self._step() and used > PATIENCE_S:
                self._stop(f"nothing has happened for {PATIENCE_S:g} s of this computer's time")
        except AcusError as error:
            self._stop(translated(error))

    def _go_on(self) -> None:
        """Note that something has happened: the patience begins anew."""
        self._waited, self._begun = 0.0, process_time()

    def _then(self, text: str, step: Callable[[], bool]) -> bool:
        self._step = step
        self._go_on()
        self.told.emit(text)
        return True

    def _stop(self, reason: str | BaseException) -> None:
        if self._timer.isActive():
            self._timer.stop()
            self._pictures.write(self._result)
            self.failed.emit(translated(reason))

    def _take_result(self, result: AttemptResult) -> None:
        self._result, self._drawn = result, False
        self._go_on()

    def _note_drawn(self) -> None:
        self._drawn = True

    def _snapshot(self) -> Snapshot | None:
        run = self._window.conductor.controller.run
        return None if run is None else run.trainer.snapshot()
