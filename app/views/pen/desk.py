"""What the menu Pen does: a pen before a webcam in place of the robot, and back."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QWidget

from app.core.errors import AcusError
from app.views.cameras.desk import CamerasDesk
from app.views.exercise.conductor import Conductor
from app.views.exercise.runs import Runs
from app.views.kit.text import tr
from app.views.robot.desk import RobotDesk
from app.views.shell.services import Services

if TYPE_CHECKING:
    from app.tracking.pen.settings import PenSettings
    from app.views.pen.dialog import PenDialog


class PenDesk(QObject):
    """Opens the page of the pen; lets the run have its webcam back afterwards.

    Which pen and webcam stands in `pen.yaml` (`tracking.pen.settings`); whether they are used, in
    the window's settings (`RobotDesk`).

    Signals:
        failed(object): an error to show.
        noted(str): something worked.
        changed(): pen or robot was chosen.
    """

    failed = Signal(object)
    noted = Signal(str)
    changed = Signal()

    def __init__(
        self,
        services: Services,
        robot: RobotDesk,
        cameras: CamerasDesk,
        conductor: Conductor,
        runs: Runs,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self._services, self._robot, self._cameras = services, robot, cameras
        self._conductor, self._runs, self._window = conductor, runs, parent
        self.dialog: PenDialog | None = None
        self._last = robot.pen
        robot.changed.connect(self._note_change)

    @property
    def used(self) -> bool:
        """Whether a pen stands in for the robot."""
        return bool(self._robot.pen)

    @property
    def source(self) -> str:
        """Source of the webcam's pictures, the one used last; empty before there was one."""
        return self._last

    def open(self) -> None:
        """Show the page."""
        if self._cameras.refused():
            return
        from app.views.pen.dialog import PenDialog  # OpenCV: not before the window

        dialog = PenDialog(self._settings(), self._services, self._free(), self.used, self._window)
        dialog.left.connect(self._left)
        dialog.finished.connect(lambda _: self._closed())
        self.dialog = dialog
        self._cameras.show(dialog)

    def use_last(self) -> None:
        """Use the pen of last time; without one the page asks."""
        if not self._last:
            self.changed.emit()
            self.open()
        elif self._robot.use_pen(self._last):
            self._conductor.take_again()  # one that failed before may be plugged in now
            self._tell_used()
        else:
            self.changed.emit()

    def use_robot(self) -> None:
        """Let the robot hold the needle again."""
        if self._robot.use_pen(""):
            self._conductor.take_again()
        else:
            self.changed.emit()

    # --- inside -----------------------------------------------------------------------------------
    def _free(self) -> Callable[[], object]:
        """Let the run go if it may have the webcam; return what waits until it has."""
        if not self.used and not self._cameras.real:
            return lambda: None
        self._conductor.let_go()
        return self._runs.closed()

    def _settings(self) -> PenSettings:
        from app.tracking.pen.settings import PenSettings, load_settings, with_source

        try:
            settings = load_settings()
            return with_source(settings, self._robot.pen) if self.used else settings
        except AcusError as error:
            self.failed.emit(error)
            return PenSettings()

    def _left(self, settings: PenSettings, use: bool) -> None:
        """Remember what the page chose, and use it if that was wanted."""
        from app.tracking.pen.settings import save_settings

        try:
            save_settings(settings)
        except (AcusError, OSError) as error:
            self.failed.emit(error)
        if not use and not self.used:
            return
        self._conductor.let_go()  # until the page's webcam is closed: `CamerasDesk.show`
        news = use and settings.source != self._robot.pen
        if self._robot.use_pen(settings.source if use else "") and news:
            self._tell_used()

    def _tell_used(self) -> None:
        patient = self._conductor.patient is not None and self._conductor.exercise is not None
        self.noted.emit(
            tr("The pen is the needle now: {source}", source=self._robot.pen)
            if patient
            else tr("The pen is the needle now. Choose an exercise: it runs on the pen")
        )

    def _closed(self) -> None:
        self.dialog = None

    def _note_change(self) -> None:
        self._last = self._robot.pen or self._last
        self.changed.emit()
