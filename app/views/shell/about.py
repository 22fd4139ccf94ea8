"""What this is and what it is not."""

from __future__ import annotations

from PySide6.QtWidgets import QMessageBox, QWidget

from app import __version__
from app.views.kit.text import disclaimer, tr


def about(parent: QWidget) -> QMessageBox:
    """Return the box that says what this is and what it is not."""
    text = tr("Acus {version}", version=__version__)
    box = QMessageBox(QMessageBox.Icon.NoIcon, tr("About Acus"), text, parent=parent)
    box.setInformativeText(disclaimer())
    box.finished.connect(box.deleteLater)
    return box
