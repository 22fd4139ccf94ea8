"""One camera in the settings: source, exposure, live picture."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtCore import Signal
from PySide6.QtWidgets import QComboBox, QDoubleSpinBox, QFormLayout, QLabel, QVBoxLayout, QWidget

from app.tracking.cameras.settings import OneCamera
from app.tracking.cameras.source import Kind, parse_source
from app.views.cameras.live import LivePreview
from app.views.text import tr

if TYPE_CHECKING:
    from app.views.services import RobotPort


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
        self.source, self.exposure = QComboBox(self), QDoubleSpinBox(self)
        self.preview = LivePreview(self)
        self.source.setEditable(True)
        for port in sources:
            self.source.addItem(port.title, port.port)
        self.source.addItem(tr("Simulated"), Kind.SIMULATED.value)
        self.source.setToolTip(tr(
            "A camera that is plugged in, or typed: usb:PORT, folder:PATH, video:PATH"
        ))  # fmt: skip
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
        index = self.source.findData(camera.source)
        if index >= 0:
            self.source.setCurrentIndex(index)
        else:
            self.source.setEditText(camera.source)
        self.exposure.setValue(camera.exposure_ms or 0.0)

    def camera(self) -> OneCamera:
        """Return what is chosen; what was measured stays with the same source only.

        Raises:
            CameraError: if the source cannot be read.
        """
        text = self.source.currentText()
        known = self.source.findText(text)
        source = str(parse_source(self.source.itemData(known) if known >= 0 else text))
        base = self._camera if source == self._camera.source else OneCamera(source=source)
        return base.model_copy(update={"exposure_ms": self.exposure.value() or None})
