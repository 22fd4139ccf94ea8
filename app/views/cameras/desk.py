"""What the menu Cameras does: which cameras, how they are set up, aimed and measured."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING

from PySide6.QtCore import QObject, Signal
from PySide6.QtWidgets import QDialog, QWidget

from app.core.errors import AcusError
from app.session.machine import RUNNING
from app.tracking.cameras.settings import (
    SIDES,
    CameraSettings,
    load_settings,
    save_settings,
    with_latency,
)
from app.views.cameras.aim_dialog import AimDialog
from app.views.cameras.latency_dialog import LatencyDialog
from app.views.cameras.settings_dialog import CameraSettingsDialog
from app.views.exercise.conductor import Conductor
from app.views.exercise.runs import Runs
from app.views.kit.background import run_in_background
from app.views.kit.text import tr
from app.views.shell.services import Services

if TYPE_CHECKING:
    from PySide6.QtCore import QSettings

    from app.core.progress import Progress
    from app.tracking.cameras.latency import Latency
    from app.views.cameras.camera_pair import OpenCamera
    from app.views.cameras.wizard import CalibrationWizard

_USED = "cameras/real"
_BOARD = "cameras/board"
DEVICE = "icube"
"""Device whose fulcrum is aimed at before an exercise names one."""


class CamerasDesk(QObject):
    """Applies what was remembered, and remembers what the user chooses.

    Which source is which camera stands in `cameras.yaml` (`tracking.cameras.settings`); whether
    these are used or the simulated ones, in the window's settings.

    Signals:
        failed(object): an error to show.
        accepted(): what the user wants is not refused: what was refused before is over.
        changed(): other cameras were chosen.
    """

    failed = Signal(object)
    accepted = Signal()
    changed = Signal()

    def __init__(
        self,
        services: Services,
        settings: QSettings,
        conductor: Conductor,
        runs: Runs,
        parent: QWidget,
    ) -> None:
        super().__init__(parent)
        self._services, self._remembered = services, settings
        self._conductor, self._runs, self._window = conductor, runs, parent
        self._taken: CameraSettings | None = None
        self.dialog: QDialog | None = None
        self._unreadable: AcusError | None = None
        self._apply()

    # --- which cameras ------------------------------------------------------------------------
    @property
    def chosen(self) -> CameraSettings:
        """The sources that were chosen, used or not."""
        if self._taken is not None and not self._taken.simulated:
            return self._taken
        try:
            self._unreadable = None
            return load_settings()
        except AcusError as error:
            self._unreadable = error
            return CameraSettings()

    @property
    def real(self) -> bool:
        """Whether real cameras are used."""
        if self._taken is not None:
            return not self._taken.simulated
        wanted = str(self._remembered.value(_USED)).lower() == "true"
        return wanted and not self.chosen.simulated

    def take(self, settings: CameraSettings) -> None:
        """Use these cameras until others are chosen, without remembering them."""
        self._taken = settings
        self._apply()

    def use_real(self, wanted: bool) -> None:
        """Use the chosen cameras, or the simulated ones. Refused while an attempt runs."""
        if self._refused_in_attempt():
            self.changed.emit()
            return
        if wanted and self.chosen.simulated:
            self.changed.emit()
            self.set_up()  # there is nothing to use yet
            if self._unreadable is not None:
                self.failed.emit(self._unreadable)
            return
        self._taken = None
        self._remembered.setValue(_USED, wanted)
        self._apply()
        if self.dialog is None:
            self._conductor.take_again()  # one that failed before may be plugged in now

    # --- dialogs ------------------------------------------------------------------------------
    def set_up(self) -> None:
        """Choose the sources, with their live pictures."""
        if self.refused():
            return
        dialog = CameraSettingsDialog(self.chosen, self._services, self.free(), self._window)
        dialog.chosen.connect(self._choose)
        self.show(dialog)

    def aim(self) -> None:
        """Show the needle's cone in both pictures."""
        if self.refused() or self._without_real():
            return
        profile = self._conductor.profile
        device = DEVICE if profile is None else profile.name
        self.show(AimDialog(self.chosen, device, self._services, self.free(), self._window))

    def measure_latency(self, side: str) -> None:
        """Measure the latency of the `left` or `right` camera."""
        if self.refused() or self._without_real():
            return
        dialog = LatencyDialog(self.chosen, side, self._services, self.free(), self._window)
        dialog.measured.connect(self._keep_latency)
        self.show(dialog)

    def calibrate(self) -> None:
        """Calibrate both cameras; without real ones from folders of pictures."""
        if self.refused():
            return
        try:
            dialog = self._wizard(self.chosen)
        except AcusError as error:
            self.failed.emit(error)
            return
        dialog.used.connect(self._apply)
        dialog.board_page.chosen.connect(lambda spec: self._remembered.setValue(_BOARD, spec))
        self.show(dialog)

    def free(self) -> Callable[[], object]:
        """Let the run go if it has the cameras; return what waits until it has."""
        if not self.real:
            return lambda: None
        self._conductor.let_go()
        return self._runs.closed()

    def show(self, dialog: QDialog) -> None:
        """Show a dialog; when it ends and its cameras are closed, the run has them again."""
        self.dialog = dialog
        dialog.finished.connect(lambda _: self._ended(dialog))
        dialog.open()

    def close(self) -> None:
        """End the dialog that is open; idempotent."""
        if self.dialog is not None:
            self.dialog.reject()

    # --- inside -------------------------------------------------------------------------------
    def _apply(self) -> None:
        self._conductor.set_cameras(self.chosen if self.real else None)
        self.changed.emit()

    def _wizard(self, chosen: CameraSettings) -> CalibrationWizard:
        # OpenCV and kernels: only for whom the wizard is opened, not with the window.
        from app.mechanisms.profile import load_profile
        from app.tracking.optics.rig import load_rig
        from app.views.cameras.camera_pair import open_both
        from app.views.cameras.wizard import CalibrationWizard
        from app.views.cameras.wizard_job import CalibrationJob, last_board

        profile, rig = self._conductor.profile, load_rig(chosen.rig)
        left, right = (camera.name for camera in rig.cameras)
        fulcrum = (load_profile(DEVICE) if profile is None else profile).pantograph.fulcrum
        job = CalibrationJob(
            board=last_board(str(self._remembered.value(_BOARD, ""))),
            names=(left, right),
            watched=fulcrum[None, :],
            expected=rig.models[0].T_world_camera,
        )
        if chosen.simulated:
            return CalibrationWizard(job, None, self._window)
        free, services = self.free(), self._services

        def open_side(side: str, progress: Progress) -> OpenCamera:
            free()
            return services.open_camera(chosen, side, progress)

        return CalibrationWizard(job, open_both(open_side, SIDES), self._window)

    def _ended(self, dialog: QDialog) -> None:
        self.dialog = None
        wait = getattr(dialog, "closed", lambda: lambda: None)()
        dialog.deleteLater()
        again = self._conductor.take_again
        run_in_background(
            self, lambda _: wait(), lambda _: again(), lambda _: again(), lambda: again()
        )

    def _choose(self, settings: CameraSettings) -> None:
        try:
            save_settings(settings)
        except (AcusError, OSError) as error:
            self.failed.emit(error)
            return
        self._taken = None
        self._remembered.setValue(_USED, not settings.simulated)
        self._conductor.let_go()  # until the dialog's cameras are closed: `_ended`
        self._apply()

    def _keep_latency(self, side: str, latency: Latency) -> None:
        self._choose(with_latency(self.chosen, side, latency.median, latency.sd))

    def _without_real(self) -> bool:
        if not self.chosen.simulated:
            return False
        self.failed.emit(tr(
            "Only simulated cameras are chosen, which need no aiming and have no latency: choose "
            "real ones in the menu Cameras, Set up."
        ))  # fmt: skip
        return True

    def refused(self) -> bool:
        """Whether nothing can be opened now: a dialog is, or an attempt runs (which is said)."""
        return self.dialog is not None or self._refused_in_attempt()

    def _refused_in_attempt(self) -> bool:
        run = self._conductor.controller.run
        if run is None or run.trainer.snapshot().state not in RUNNING:
            self.accepted.emit()
            return False
        self.failed.emit(tr("An attempt is running: end it first, then change the cameras."))
        return True
