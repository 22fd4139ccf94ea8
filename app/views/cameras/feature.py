"""The cameras in the window: which ones, how they are set up, measured, and aimed.

Aiming shows the needle's cone in both live pictures, and the share of it that both see.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, ClassVar

from PySide6.QtCore import SignalInstance
from PySide6.QtGui import QAction, QActionGroup
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QHBoxLayout,
    QMenu,
    QVBoxLayout,
    QWidget,
)

from app.core.errors import AcusError
from app.core.progress import Progress
from app.tracking.cameras.settings import (
    SIDES,
    CameraSettings,
    with_latency,
)
from app.views.cameras.latency_dialog import LatencyDialog
from app.views.cameras.live import AimPort, LiveCamera, LivePreview
from app.views.cameras.settings_dialog import CameraSettingsDialog
from app.views.kit import theme
from app.views.kit.background import run_in_background
from app.views.kit.parts import PlainLabel, size_dialog
from app.views.kit.progress_strip import ProgressStrip
from app.views.kit.roles import TECHNICIANS, Role
from app.views.kit.text import literal, tr, translated
from app.views.shell.feature import Context, Feature

if TYPE_CHECKING:
    from app.core.progress import Progress
    from app.tracking.calibration.camera_pair import OpenCamera
    from app.tracking.cameras.latency import CameraLatency
    from app.views.cameras.wizard import CalibrationWizard
    from app.views.shell.services import Services


ENOUGH = 0.995


class AimDialog(QDialog):
    """Shows where the needle's marker can be in both pictures.

    Args:
        settings: the cameras.
        device: name of the device profile: where the fulcrum is.
        services: opens cameras, computes the cone.
        free: waits, in another thread, until nobody else has the cameras.
        parent: the window.
    """

    def __init__(
        self,
        settings: CameraSettings,
        device: str,
        services: Services,
        free: Callable[[], object],
        parent: QWidget | None = None,
    ) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Aim the cameras"))
        self.previews = tuple(LivePreview(self) for _ in SIDES)
        self.share, self.losses = PlainLabel(self), PlainLabel(self)
        self.waiting = ProgressStrip(self)
        self.titles = tuple(PlainLabel(title, self) for title in (tr("Left"), tr("Right")))
        self._lay_out()
        for side, preview in zip(SIDES, self.previews, strict=True):
            preview.open(_opener(services, settings, side, free))
        run_in_background(
            self,
            lambda progress: services.aim(settings, device, progress),
            self._show,
            self._fail,
            self.reject,
            title=tr("Computing the cone"),
            indicator=self.waiting,
        )

    def closed(self) -> Callable[[], object]:
        """Return what waits until the cameras are closed; for other threads."""
        waits = [preview.closed() for preview in self.previews]
        return lambda: [wait() for wait in waits]

    def done(self, result: int) -> None:
        """Let go of the cameras."""
        for preview in self.previews:
            preview.stop()
        super().done(result)

    def _show(self, aim: AimPort) -> None:
        cone = aim.cone
        for preview, outline in zip(self.previews, cone.outlines, strict=True):
            preview.picture.set_outline(outline, aim.image_size)
        good = cone.share >= ENOUGH and not aim.assumed
        colour, symbol = theme.VERDICTS["good" if good else "warning"]
        self.share.setStyleSheet(f"color: {colour}; font-size: {theme.TITLE_PX}px;")
        seen = {"symbol": symbol, "share": 100.0 * cone.share}
        self.share.setText(
            tr(
                "{symbol} Standing as designed, both cameras would see {share:.0f} % of the cone",
                **seen,
            )
            if aim.assumed
            else tr("{symbol} Both cameras see {share:.0f} % of the needle's cone", **seen)
        )
        names = (tr("Left"), tr("Right"))
        for title, name, share in zip(self.titles, names, cone.shares, strict=True):
            values = {"name": name, "share": 100.0 * share}
            title.setText(
                tr("{name}: would see {share:.0f} %", **values)
                if aim.assumed
                else tr("{name}: sees {share:.0f} %", **values)
            )
        lines = [tr("Cone of: {basis}.", basis=aim.basis), *cone.losses()]
        self.losses.setText("\n".join(lines))

    def _fail(self, error: Exception) -> None:
        colour, symbol = theme.VERDICTS["bad"]
        self.share.setStyleSheet(f"color: {colour};")
        self.share.setText(f"{symbol} {translated(error)}")

    def _lay_out(self) -> None:
        words = PlainLabel(
            tr(
                "The green line surrounds every place the marker can be at. It should lie within "
                "both pictures. The line follows from the calibration, not from the picture: after "
                "moving a camera, calibrate again."
            )
        )
        for label in (words, self.losses, self.share):
            label.setWordWrap(True)
        self.losses.setStyleSheet(f"color: {theme.TEXT_DIM};")
        pair = QHBoxLayout()
        pair.setSpacing(theme.MARGIN)
        for title, preview in zip(self.titles, self.previews, strict=True):
            side = QVBoxLayout()
            side.addWidget(title)
            side.addWidget(preview, 1)
            pair.addLayout(side, 1)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close, parent=self)
        buttons.rejected.connect(self.reject)
        column = QVBoxLayout(self)
        column.setSpacing(theme.MARGIN)
        column.addWidget(self.waiting)
        column.addWidget(self.share)
        column.addLayout(pair, 1)
        column.addWidget(self.losses)
        column.addWidget(words)
        column.addWidget(buttons)
        size_dialog(self, 1060, 620)


def _opener(
    services: Services, settings: CameraSettings, side: str, free: Callable[[], object]
) -> Callable[[Progress], LiveCamera]:
    def operation(progress: Progress) -> LiveCamera:
        free()
        return services.open_camera(settings, side, progress)

    return operation


_BOARD = "cameras/board"
DEVICE = "icube"
"""Device whose fulcrum is aimed at before an exercise names one."""


class CamerasFeature(Feature):
    """Menu and dialogs of the cameras."""

    topic: ClassVar[str] = "cameras"
    place: ClassVar[int] = 80
    roles: ClassVar[frozenset[Role]] = TECHNICIANS

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
        fulcrum = (load_profile(DEVICE) if profile is None else profile).fulcrum
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
        self.failed.emit(
            tr(
                "Only simulated cameras are chosen, which need no aiming and have no latency: "
                "choose real ones in the menu Cameras, Set up."
            )
        )
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
        latency.menuAction().setToolTip(
            tr(
                "Measure how late a picture arrives: a patch blinks, the camera watches "
                "it, the delay is saved"
            )
        )
        for action, help_ in (
            (self.set_up, tr("Which cameras there are: size, rate, exposure, live pictures")),
            (self.aim, tr("Where the needle can be, drawn into both live pictures")),
            (self.calibrate, tr("Lenses and places of the cameras, from pictures of a board")),
        ):
            action.setToolTip(literal(help_))
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
