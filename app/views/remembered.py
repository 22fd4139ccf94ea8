"""What the window remembers of itself: size, place, grey values of the slices."""

from __future__ import annotations

from PySide6.QtCore import QSettings, QSize
from PySide6.QtWidgets import QMainWindow

from app.core.errors import AcusError
from app.imaging.window import WindowLevel
from app.views.slices.viewing import Viewing

SMALLEST = (1180, 700)
PREFERRED = (1400, 900)


def restore(window: QMainWindow, viewing: Viewing, settings: QSettings) -> None:
    """Give window and slices what was remembered; what cannot be used is left."""
    window.setMinimumSize(*SMALLEST)
    wanted, available = QSize(*PREFERRED), window.screen().availableGeometry().size()
    window.resize(wanted.boundedTo(available))
    geometry = settings.value("window/geometry")
    if geometry is not None:
        window.restoreGeometry(geometry)
    try:
        width = float(str(settings.value("slices/width")))
        level = float(str(settings.value("slices/level")))
        viewing.set_window(WindowLevel(width, level))
    except (ValueError, AcusError):  # nothing was remembered, or nothing usable
        return


def remember(window: QMainWindow, viewing: Viewing, settings: QSettings) -> None:
    """Remember them."""
    settings.setValue("window/geometry", window.saveGeometry())
    settings.setValue("slices/width", viewing.window.width)
    settings.setValue("slices/level", viewing.window.level)
    settings.sync()
