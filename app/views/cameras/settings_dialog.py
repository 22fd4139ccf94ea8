"""Which source is the left camera and which the right one, their exposure and live pictures."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QTimer, Signal
from PySide6.QtWidgets import (
    QDialogButtonBox,
    QDoubleSpinBox,
    QFormLayout,
    QHBoxLayout,
    QPushButton,
    QVBoxLayout,
    QWidget,
)

from app.core.errors import AcusError
from app.tracking.cameras.settings import SIDES, CameraSettings, OneCamera
from app.tracking.cameras.source import SourceKind
from app.views.cameras.boxes import SizeBox, SourceBox
from app.views.cameras.live import LiveCamera, LivePreview
from app.views.kit import theme
from app.views.kit.parts import PlainLabel, add_row
from app.views.kit.settings_dialog import SettingsDialog
from app.views.kit.text import tr, translated

if TYPE_CHECKING:
    from app.core.progress import Progress
    from app.views.shell.services import RobotPort, Services


class SideEditor(QWidget):
    """Source, exposure and live picture of one camera.

    Signals:
        changed(): the user chose something.
    """

    changed = Signal()

    def __init__(
        self, title: str, camera: OneCamera, sources: Sequence[RobotPort], parent: QWidget
    ) -> None:
        super().__init__(parent)
        self._camera = camera
        self.source, self.exposure = SourceBox(sources, self), QDoubleSpinBox(self)
        self.preview = LivePreview(self)
        self.exposure.setRange(0.0, 500.0)
        self.exposure.setDecimals(1)
        self.exposure.setSuffix(tr(" ms"))
        self.exposure.setSpecialValueText(tr("as the camera finds it, then held"))
        self.show_camera(camera)
        heading = PlainLabel(title)
        heading.setStyleSheet("font-weight: 600;")
        form = QFormLayout()
        add_row(form, tr("Source"), self.source)
        add_row(form, tr("Exposure"), self.exposure)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(heading)
        column.addLayout(form)
        column.addWidget(self.preview, 1)
        self.source.currentTextChanged.connect(lambda _: self.changed.emit())
        self.exposure.valueChanged.connect(lambda _: self.changed.emit())

    def show_camera(self, camera: OneCamera) -> None:
        """Show a camera's settings."""
        self._camera = camera
        self.source.show_source(camera.source)
        self.exposure.setValue(camera.exposure_ms or 0.0)

    def camera(self) -> OneCamera:
        """Return what is chosen; what was measured stays with the same source only.

        Raises:
            CameraError: if the source cannot be read.
        """
        source = self.source.source()
        base = self._camera if source == self._camera.source else OneCamera(source=source)
        return base.model_copy(update={"exposure_ms": self.exposure.value() or None})


QUIET_MS = 500
"""This long after the last change the cameras are opened anew."""


class CameraSettingsDialog(SettingsDialog):
    """Chooses both cameras.

    Args:
        settings: the present ones.
        services: lists and opens cameras.
        free: waits, in another thread, until nobody else has the cameras.
        parent: the window.

    Signals:
        chosen(CameraSettings): the user confirmed.
    """

    chosen = Signal(object)

    def __init__(
        self,
        settings: CameraSettings,
        services: Services,
        free: Callable[[], object],
        parent: QWidget | None = None,
    ) -> None:
        confirm = QDialogButtonBox.StandardButton.Ok
        super().__init__(tr("Cameras"), (980, 640), confirm, parent)
        self._settings, self._services, self._free = settings, services, free
        sources = services.camera_sources()
        titles = (tr("Left camera"), tr("Right camera"))
        self.sides = tuple(
            SideEditor(title, camera, sources, self)
            for title, camera in zip(titles, settings.cameras, strict=True)
        )
        self.size_box, self.rate = SizeBox(settings.size, self), QDoubleSpinBox(self)
        self.swap = QPushButton(tr("Exchange left and right"))
        self._quiet = QTimer(self, interval=QUIET_MS, singleShot=True)
        self._quiet.timeout.connect(self.reopen)
        self._lay_out(not sources)
        self._quiet.start()

    def settings(self) -> CameraSettings:
        """Return what is chosen.

        Raises:
            CameraError: if it cannot be used; says why.
        """
        left, right = (side.camera() for side in self.sides)
        changed = self._settings.model_copy(
            update={
                "left": left,
                "right": right,
                "size": self.size_box.size_px(),
                "rate_hz": self.rate.value(),
            }
        )
        changed.check()
        return changed

    def reopen(self) -> None:
        """Show the pictures of what is chosen now."""
        for side, editor in zip(SIDES, self.sides, strict=True):
            editor.preview.stop()
            try:
                settings = self._settings.model_copy(
                    update={
                        side: editor.camera(),
                        "size": self.size_box.size_px(),
                        "rate_hz": self.rate.value(),
                    }
                )
                if editor.camera().origin.kind is SourceKind.SIMULATED:
                    editor.preview.say(tr("simulated: nothing to set up"))
                    continue
            except AcusError as error:
                editor.preview.say(translated(error), bad=True)
                continue
            self._open(editor, settings, side)
        self.show_check()

    def closed(self) -> Callable[[], object]:
        """Return what waits until the cameras are closed; for other threads."""
        waits = [side.preview.closed() for side in self.sides]
        return lambda: [wait() for wait in waits]

    def done(self, result: int) -> None:
        """Let go of the cameras, whichever way it ends."""
        self._quiet.stop()
        for side in self.sides:
            side.preview.stop()
        super().done(result)

    def _open(self, editor: SideEditor, settings: CameraSettings, side: str) -> None:
        free, services = self._free, self._services

        def operation(progress: Progress) -> LiveCamera:
            free()
            return services.open_camera(settings, side, progress)

        editor.preview.open(operation)

    def check(self) -> None:
        """Do nothing where the cameras can be used; else say why not (`CameraError`)."""
        self.settings()

    def keep(self) -> None:
        """Tell which cameras are chosen, once their pictures have been let go."""
        settings = self.settings()
        self.accepted.connect(lambda: self.chosen.emit(settings))

    def _exchange(self) -> None:
        try:
            left, right = (side.camera() for side in self.sides)
        except AcusError:
            self.show_check()
            return
        for side in self.sides:
            side.preview.stop()
        self.sides[0].show_camera(right)
        self.sides[1].show_camera(left)
        self._quiet.start()

    def _lay_out(self, empty: bool) -> None:
        self.rate.setRange(1.0, 240.0)
        self.rate.setDecimals(0)
        self.rate.setSuffix(tr(" per second"))
        self.rate.setValue(self._settings.rate_hz)
        words = tr(
            "Left and right are as seen from the side on which the cameras stand. Hold a hand "
            "before one camera: its picture must be the one below its name."
        )
        if empty:
            words = tr(
                "No camera is plugged in. Plug both in, then open this dialog again; a folder or "
                "a video can be typed as source: folder:PATH, video:PATH."
            )
        explanation = PlainLabel(words)
        explanation.setWordWrap(True)
        common = QHBoxLayout()
        for title, widget in ((tr("Size"), self.size_box), (tr("Pictures"), self.rate)):
            common.addWidget(PlainLabel(title))
            common.addWidget(widget)
        common.addStretch(1)
        common.addWidget(self.swap)
        pair = QHBoxLayout()
        pair.setSpacing(theme.MARGIN)
        for side in self.sides:
            pair.addWidget(side, 1)
            side.changed.connect(self._quiet.start)
        self.swap.clicked.connect(lambda _=False: self._exchange())
        self.size_box.currentTextChanged.connect(lambda _: self._quiet.start())
        self.rate.valueChanged.connect(lambda _: self._quiet.start())
        column = QVBoxLayout(self)
        column.setSpacing(theme.MARGIN)
        column.addWidget(explanation)
        column.addLayout(common)
        column.addLayout(pair, 1)
        column.addWidget(self.note)
        column.addWidget(self.buttons)
