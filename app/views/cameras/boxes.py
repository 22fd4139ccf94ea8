"""Boxes in which a camera's source and the size of its pictures are chosen."""

from __future__ import annotations

from collections.abc import Sequence
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QComboBox, QWidget

from app.tracking.cameras.source import SourceKind, parse_source
from app.views.kit.text import tr

if TYPE_CHECKING:
    from app.views.shell.services import RobotPort

SIZES = ("640x480", "800x600", "1280x720", "1920x1080")


class SourceBox(QComboBox):
    """A camera that is plugged in, a simulated one, or what is typed."""

    def __init__(self, sources: Sequence[RobotPort], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setEditable(True)
        for port in sources:
            self.addItem(port.title, port.port)
        self.addItem(tr("Simulated"), SourceKind.SIMULATED.value)
        self.setToolTip(
            tr("A camera that is plugged in, or typed: usb:PORT, folder:PATH, video:PATH")
        )

    def show_source(self, source: str) -> None:
        """Show a source, listed or not."""
        index = self.findData(source)
        if index >= 0:
            self.setCurrentIndex(index)
        else:
            self.setEditText(source)

    def source(self) -> str:
        """Return what is chosen or typed.

        Raises:
            CameraError: if it cannot be read.
        """
        text = self.currentText()
        known = self.findText(text)
        return str(parse_source(self.itemData(known) if known >= 0 else text))


class SizeBox(QComboBox):
    """Usual sizes of pictures, and the present one."""

    def __init__(self, present: tuple[int, int], parent: QWidget | None = None) -> None:
        super().__init__(parent)
        shown = "x".join(str(side) for side in present)
        self.addItems([size for size in SIZES if size != shown] + [shown])
        self.setCurrentText(shown)

    def size_px(self) -> tuple[int, int]:
        """Width and height [px]."""
        width, height = (int(part) for part in self.currentText().split("x"))
        return width, height
