"""One camera in the settings: source, exposure, live picture."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QDoubleSpinBox, QFormLayout, QLabel, QVBoxLayout, QWidget

from app.tracking.cameras.settings import OneCamera
from app.views.cameras.boxes import SourceBox
from app.views.cameras.live import LivePreview
from app.views.kit.text import tr

if TYPE_CHECKING:
    from app.views.shell.services import RobotPort


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
        heading = QLabel(title)
        heading.setStyleSheet("font-weight: 600;")
        form = QFormLayout()
        form.addRow(tr("Source"), self.source)
        form.addRow(tr("Exposure"), self.exposure)
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
