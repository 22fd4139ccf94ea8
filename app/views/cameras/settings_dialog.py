"""Which source is the left camera and which the right one, their exposure and live pictures."""

from __future__ import annotations

from collections.abc import Callable, Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import QTimer, Signal
from PySide6.QtWidgets import (
    QDialogButtonBox,
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
from app.views.kit.form import Form
from app.views.kit.parts import PlainLabel
from app.views.kit.settings_dialog import SettingsDialog
from app.views.kit.text import tr, translated

if TYPE_CHECKING:
    from app.core.progress import Progress
    from app.views.shell.services import RobotPort, Services


class SideEditor(Form):
    """Source, exposure and live picture of one camera.

    Signals:
        changed(): the user chose something.
    """

    changed = Signal()

    def __init__(
        self, title: str, camera: OneCamera, sources: Sequence[RobotPort], parent: QWidget
    ) -> None:
        super().__init__(OneCamera, parent)
        heading = PlainLabel(title)
        heading.setStyleSheet("font-weight: 600;")
        self.rows.insertWidget(0, heading)
        self.source = box = SourceBox(sources, self)
        self.add(("source",), tr("Source"), box, box.show_source, box.source)
        self.exposure = self.number(
            "exposure_ms",
            title=tr("Exposure"),
            unit="ms",
            within=(0.0, 500.0, 0.0),
            decimals=1,
            lowest=tr("as the camera finds it, then held"),
        )
        self.preview = LivePreview(self)
        self.rows.addWidget(self.preview, 1)
        self.show_camera(camera)
        self.source.currentTextChanged.connect(lambda _: self.changed.emit())
        self.edited.connect(lambda *_: self.changed.emit())

    def show_camera(self, camera: OneCamera) -> None:
        """Show a camera's settings."""
        self._camera = camera
        self.show_values(dict(camera))

    def camera(self) -> OneCamera:
        """Return what is chosen; what was measured stays with the same source only.

        Raises:
            CameraError: if the source cannot be read.
        """
        found = self.values()
        source = found["source"]
        base = self._camera if source == self._camera.source else OneCamera(source=source)
        return base.model_copy(update={"exposure_ms": found.get("exposure_ms")})


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
        self.common = Form(CameraSettings, self)
        with self.common.together(title=tr("Size")) as line:
            self.size_box = SizeBox(settings.size, self)
            line.addWidget(self.size_box)
            line.addWidget(PlainLabel(tr("Pictures")))
            self.rate = self.common.number(
                "rate_hz",
                title=tr("Pictures"),
                unit=tr(" per second").strip(),
                within=(1.0, 240.0, settings.rate_hz),
                decimals=0,
            )
            line.addStretch(1)
            self.swap = QPushButton(tr("Exchange left and right"))
            line.addWidget(self.swap)
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
        pair = QHBoxLayout()
        pair.setSpacing(theme.MARGIN)
        for side in self.sides:
            pair.addWidget(side, 1)
            side.changed.connect(self._quiet.start)
        self.swap.clicked.connect(lambda _=False: self._exchange())
        self.size_box.currentTextChanged.connect(lambda _: self._quiet.start())
        self.common.edited.connect(lambda *_: self._quiet.start())
        column = QVBoxLayout(self)
        column.setSpacing(theme.MARGIN)
        column.addWidget(explanation)
        column.addWidget(self.common)
        column.addLayout(pair, 1)
        column.addWidget(self.note)
        column.addWidget(self.buttons)
