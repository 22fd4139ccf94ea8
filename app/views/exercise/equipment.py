"""Which robot, pen and cameras a run is on: chosen, remembered, lent to one dialog at a time."""

from __future__ import annotations

from collections.abc import Callable

from PySide6.QtCore import QObject, QSettings, Signal
from PySide6.QtWidgets import QDialog

from app.core.errors import AcusError
from app.session.machine import RUNNING
from app.tracking.cameras.settings import CameraSettings, load_settings, save_settings
from app.views.exercise.conductor import Conductor
from app.views.kit.background import run_in_background
from app.views.kit.text import tr
from app.views.robot.settings import RobotSettings
from app.views.shell.services import RobotChoice

_REAL_CAMERAS = "cameras/real"


class Equipment(QObject):
    """Applies what was remembered, and remembers what the user chooses.

    Which source is which camera stands in `cameras.yaml` (`tracking.cameras.settings`); whether
    these or the simulated ones are used, and which robot, in the window's settings.

    Signals:
        failed(object): why something is refused.
        accepted(): what the user wants is not refused: what was refused before is over.
        changed(): another robot, pen or pair of cameras was chosen.
        pen_wanted(): a pen is to stand in for the robot.

    Attributes:
        remembered: what the settings file says of the robot.
        dialog: which has the cameras now; None while a run may have them.
        offers_pen: whether somebody hears `pen_wanted`.
        unreadable: why the sources that were chosen cannot be read; None where they can.
    """

    failed = Signal(object)
    accepted = Signal()
    changed = Signal()
    pen_wanted = Signal()

    def __init__(self, settings: QSettings, conductor: Conductor, parent: QObject) -> None:
        super().__init__(parent)
        self._settings, self._conductor = settings, conductor
        self.remembered = RobotSettings(settings)
        self.dialog: QDialog | None = None
        self.offers_pen = False
        self.unreadable: AcusError | None = None
        self._taken: str | None = None
        self._taken_pen: str | None = None
        self._taken_cameras: CameraSettings | None = None
        self.apply()
        self._apply_cameras()

    def refused(self, what: str) -> bool:
        """Return whether nothing can be changed now because an attempt runs, which is said.

        Args:
            what: would be changed, for people.
        """
        run = self._conductor.controller.run
        if run is None or run.trainer.snapshot().state not in RUNNING:
            self.accepted.emit()
            return False
        self.failed.emit(tr("An attempt is running: end it first, then change {what}.", what=what))
        return True

    # --- robot and pen --------------------------------------------------------------------------
    @property
    def port(self) -> str:
        """Port of the robot that is used; empty for the simulated one."""
        return self.remembered.port if self._taken is None else self._taken

    @property
    def pen(self) -> str:
        """Source of the webcam of a pen that is used in place of a robot; empty without one."""
        return self.remembered.pen if self._taken_pen is None else self._taken_pen

    def take(self, port: str) -> None:
        """Take a robot until another one is chosen, without remembering it."""
        self._taken, self._taken_pen = port, ""
        self.apply()

    def take_pen(self, source: str) -> None:
        """Take a pen before a webcam in place of the robot, until a robot is chosen.

        Refused while an attempt runs.
        """
        if not self.refused(tr("the robot")):
            self._taken, self._taken_pen = "", source
            self.apply()

    def choose(self, port: str) -> bool:
        """Take another robot, and remember it.

        Args:
            port: where it is plugged in; empty for the simulated one.

        Returns whether it is done: it is refused while an attempt runs.
        """
        return self._choose(port, "")

    def use_pen(self, source: str) -> bool:
        """Use a pen before a webcam in place of the robot, and remember it.

        Args:
            source: of the webcam's pictures; empty to use the robot again.

        Returns whether it is done: it is refused while an attempt runs.
        """
        return self._choose(self.remembered.port, source)

    def _choose(self, port: str, pen: str) -> bool:
        if self.refused(tr("the robot")):
            return False
        self.remembered.port, self.remembered.pen = port, pen
        self._taken = self._taken_pen = None
        self.apply()
        return True

    def apply(self) -> None:
        """Let the next run be on the robot that is chosen."""
        held = not self.pen and (bool(self.port) or self.remembered.practise_holding)
        self._conductor.set_robot(RobotChoice("" if self.pen else self.port, held, self.pen))
        self.changed.emit()

    # --- cameras --------------------------------------------------------------------------------
    @property
    def cameras(self) -> CameraSettings:
        """The sources that were chosen, used or not."""
        if self._taken_cameras is not None and not self._taken_cameras.simulated:
            return self._taken_cameras
        try:
            self.unreadable = None
            return load_settings()
        except AcusError as error:
            self.unreadable = error
            return CameraSettings()

    @property
    def uses_real_cameras(self) -> bool:
        """Return whether real cameras are used."""
        if self._taken_cameras is not None:
            return not self._taken_cameras.simulated
        wanted = str(self._settings.value(_REAL_CAMERAS)).lower() == "true"
        return wanted and not self.cameras.simulated

    def take_cameras(self, settings: CameraSettings) -> None:
        """Use these cameras until others are chosen, without remembering them."""
        self._taken_cameras = settings
        self._apply_cameras()

    def use_real_cameras(self, wanted: bool) -> None:
        """Use the cameras that were chosen, or the simulated ones."""
        self._taken_cameras = None
        self._settings.setValue(_REAL_CAMERAS, wanted)
        self._apply_cameras()
        if self.dialog is None:
            self._conductor.take_again()  # one that failed before may be plugged in now

    def keep_cameras(self, settings: CameraSettings) -> None:
        """Write other sources down, and use them once the dialog's cameras are closed."""
        try:
            save_settings(settings)
        except (AcusError, OSError) as error:
            self.failed.emit(error)
            return
        self._taken_cameras = None
        self._settings.setValue(_REAL_CAMERAS, not settings.simulated)
        self._conductor.let_go()  # until `_ended`
        self._apply_cameras()

    def use_again(self) -> None:
        """Let the next run read what is kept of the cameras anew: their calibration is another."""
        self._apply_cameras()

    def _apply_cameras(self) -> None:
        self._conductor.set_cameras(self.cameras if self.uses_real_cameras else None)
        self.changed.emit()

    # --- who has them ---------------------------------------------------------------------------
    def lend(self, has_webcam: bool = False) -> Callable[[], object]:
        """Let the run go if it has the cameras; return what waits until it has.

        Args:
            has_webcam: whether it has one besides: that of the pen.
        """
        if not has_webcam and not self.uses_real_cameras:
            return lambda: None
        self._conductor.let_go()
        return self._conductor.runs.closed()

    def is_lent(self) -> bool:
        """Return whether a dialog has the cameras, or an attempt runs (which is said)."""
        return self.dialog is not None or self.refused(tr("the cameras"))

    def show(self, dialog: QDialog) -> None:
        """Show a dialog; when it ends and its cameras are closed, the run has them again."""
        self.dialog = dialog
        dialog.finished.connect(lambda _: self._ended(dialog))
        dialog.open()

    def close(self) -> None:
        """End the dialog that is open; idempotent."""
        if self.dialog is not None:
            self.dialog.reject()

    def _ended(self, dialog: QDialog) -> None:
        self.dialog = None
        wait = getattr(dialog, "closed", lambda: lambda: None)()
        owner = dialog.parentWidget()
        if owner is not None:  # not every window manager gives the keys back
            owner.activateWindow()
        dialog.deleteLater()
        again = self._conductor.take_again
        run_in_background(
            self, lambda _: wait(), lambda _: again(), lambda _: again(), lambda: again()
        )
