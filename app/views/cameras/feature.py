"""The cameras in the window: which ones, how they are set up, aimed and measured."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, ClassVar

from PySide6.QtCore import SignalInstance
from PySide6.QtGui import QAction, QActionGroup
from PySide6.QtWidgets import QMenu

from app.core.errors import AcusError
from app.tracking.cameras.settings import (
    SIDES,
    CameraSettings,
    with_latency,
)
from app.views.cameras.aim_dialog import AimDialog
from app.views.cameras.latency_dialog import LatencyDialog
from app.views.cameras.settings_dialog import CameraSettingsDialog
from app.views.kit.text import tr
from app.views.shell.feature import Context, Feature

if TYPE_CHECKING:
    from app.core.progress import Progress
    from app.tracking.calibration.camera_pair import OpenCamera
    from app.tracking.cameras.latency import CameraLatency
    from app.views.cameras.wizard import CalibrationWizard

_BOARD = "cameras/board"
DEVICE = "icube"
"""Device whose fulcrum is aimed at before an exercise names one."""


class CamerasFeature(Feature):
    """Menu and dialogs of the cameras."""

    topic: ClassVar[str] = "cameras"

    def __init__(self, context: Context) -> None:
        super().__init__(context)
        self._equipment, self._conductor = context.equipment, context.conductor
        self._services, self._window = context.services, context.shell.dialog_parent
        self._settings = context.shell.settings
        self.menu = CamerasMenu(context.shell.menu(tr("&Cameras")), self)

    def over(self) -> tuple[SignalInstance, ...]:
        """Return what ends a message of this feature."""
        return (self._equipment.accepted, self._conductor.controller.finished)

    @property
    def chosen(self) -> CameraSettings:
        """The sources that were chosen, used or not."""
        return self._equipment.cameras

    def use_real(self, wanted: bool) -> None:
        """Use the chosen cameras, or the simulated ones. Refused while an attempt runs."""
        equipment = self._equipment
        if equipment.refused(tr("the cameras")):
            self.menu.refresh()
        elif wanted and self.chosen.simulated:
            self.menu.refresh()
            self.set_up()  # there is nothing to use yet
            if equipment.unreadable is not None:
                self.failed.emit(equipment.unreadable)
        else:
            equipment.use_real_cameras(wanted)

    # --- dialogs ------------------------------------------------------------------------------
    def set_up(self) -> None:
        """Choose the sources, with their live pictures."""
        if self._equipment.is_lent():
            return
        dialog = CameraSettingsDialog(
            self.chosen, self._services, self._equipment.lend(), self._window
        )
        dialog.chosen.connect(self._equipment.keep_cameras)
        self._equipment.show(dialog)

    def aim(self) -> None:
        """Show the needle's cone in both pictures."""
        if self._equipment.is_lent() or self._without_real():
            return
        profile = self._conductor.profile
        device = DEVICE if profile is None else profile.name
        self._equipment.show(
            AimDialog(self.chosen, device, self._services, self._equipment.lend(), self._window)
        )

    def measure_latency(self, side: str) -> None:
        """Measure the latency of the `left` or `right` camera."""
        if self._equipment.is_lent() or self._without_real():
            return
        dialog = LatencyDialog(
            self.chosen, side, self._services, self._equipment.lend(), self._window
        )
        dialog.measured.connect(self._keep_latency)
        self._equipment.show(dialog)

    def calibrate(self) -> None:
        """Calibrate both cameras; without real ones from folders of pictures."""
        if self._equipment.is_lent():
            return
        try:
            dialog = self._wizard(self.chosen)
        except AcusError as error:
            self.failed.emit(error)
            return
        dialog.used.connect(self._equipment.use_again)
        dialog.board_page.chosen.connect(lambda spec: self._settings.setValue(_BOARD, spec))
        self._equipment.show(dialog)

    # --- inside -------------------------------------------------------------------------------
    def _wizard(self, chosen: CameraSettings) -> CalibrationWizard:
        # OpenCV and kernels: only for whom the wizard is opened, not with the window.
        from app.mechanisms.profile import load_profile
        from app.tracking.calibration.camera_pair import open_both
        from app.tracking.calibration.job import CalibrationJob, last_board
        from app.tracking.optics.rig import load_rig
        from app.views.cameras.wizard import CalibrationWizard

        profile, rig = self._conductor.profile, load_rig(chosen.rig)
        left, right = (camera.name for camera in rig.cameras)
        fulcrum = (load_profile(DEVICE) if profile is None else profile).pantograph.fulcrum
        job = CalibrationJob(
            board=last_board(str(self._settings.value(_BOARD, ""))),
            names=(left, right),
            watched=fulcrum[None, :],
            expected=rig.models[0].T_world_camera,
        )
        if chosen.simulated:
            return CalibrationWizard(job, None, self._window)
        free, services = self._equipment.lend(), self._services

        def open_side(side: str, progress: Progress) -> OpenCamera:
            free()
            return services.open_camera(chosen, side, progress)

        return CalibrationWizard(job, open_both(open_side, SIDES), self._window)

    def _keep_latency(self, side: str, latency: CameraLatency) -> None:
        self._equipment.keep_cameras(with_latency(self.chosen, side, latency.median, latency.sd))

    def _without_real(self) -> bool:
        if not self.chosen.simulated:
            return False
        self.failed.emit(tr(
            "Only simulated cameras are chosen, which need no aiming and have no latency: choose "
            "real ones in the menu Cameras, Set up."
        ))  # fmt: skip
        return True


class CamerasMenu:
    """Fills a menu with what the feature does."""

    def __init__(self, menu: QMenu, cameras: CamerasFeature) -> None:
        self._cameras, self._equipment = cameras, cameras.context.equipment
        group = QActionGroup(menu)
        self.simulated = self._choice(menu, group, tr("Simulated cameras"), False)
        self.real = self._choice(menu, group, "", True)
        menu.addSeparator()
        self.set_up = self._add(menu, tr("Set up…"), cameras.set_up)
        self.aim = self._add(menu, tr("Aim…"), cameras.aim)
        self.calibrate = self._add(menu, tr("Calibrate…"), cameras.calibrate)
        latency = menu.addMenu(tr("Latency"))
        menu.setToolTipsVisible(True)
        latency.menuAction().setToolTip(tr(
            "How late a picture comes: a patch blinks, the camera looks at it, the delay is kept"
        ))  # fmt: skip
        for action, help_ in (
            (self.set_up, tr("Which cameras there are: size, rate, exposure, live pictures")),
            (self.aim, tr("Where the needle can be, drawn into both live pictures")),
            (self.calibrate, tr("Lenses and places of the cameras, from pictures of a board")),
        ):
            action.setToolTip(help_)
        self._add(latency, tr("Left camera…"), lambda: cameras.measure_latency("left"))
        self._add(latency, tr("Right camera…"), lambda: cameras.measure_latency("right"))
        self._equipment.changed.connect(self.refresh)
        self.refresh()

    def refresh(self) -> None:
        """Show what is chosen."""
        chosen = self._cameras.chosen
        text = tr("Real cameras: choose…")
        if not chosen.simulated:
            left, right = (camera.source for camera in chosen.cameras)
            text = tr("Real cameras: {left}, {right}", left=_short(left), right=_short(right))
        self.real.setText(text)
        self.real.setChecked(self._equipment.uses_real_cameras)
        self.simulated.setChecked(not self._equipment.uses_real_cameras)

    def _choice(self, menu: QMenu, group: QActionGroup, text: str, real: bool) -> QAction:
        action = menu.addAction(text)
        action.setCheckable(True)
        group.addAction(action)
        action.triggered.connect(lambda _=False: self._cameras.use_real(real))
        return action

    @staticmethod
    def _add(menu: QMenu, text: str, command: Callable[[], object]) -> QAction:
        action = menu.addAction(text)
        action.triggered.connect(lambda _=False: command())
        return action


def _short(source: str) -> str:
    """Return a source without the folders of its path, to fit into a menu."""
    kind, colon, place = source.partition(":")
    return f"{kind}{colon}{place.rsplit('/', 1)[-1]}"
