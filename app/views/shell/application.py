"""Starting Qt: one application, its theme and its language."""

from __future__ import annotations

import logging
import os
import signal
import sys
from typing import Final

from PySide6.QtCore import QTimer, QtMsgType, qInstallMessageHandler
from PySide6.QtGui import QIcon
from PySide6.QtWidgets import QApplication

from app import __version__
from app.core.errors import AcusError
from app.core.log_file import LogFile
from app.core.paths import resources
from app.views.kit.language import chosen, use_language
from app.views.kit.names import NAMES
from app.views.kit.theme import apply_theme
from app.views.shell.settings import open_settings

SWITCH_INTERVAL: Final = 5e-4
"""How long [s] a thread may keep the interpreter when another asks for it. Painting asks for it
hundreds of times a frame; at Python's 5 ms each, cameras and scoring would freeze the window."""


class NoDisplayError(AcusError):
    """A window was asked for where there is no screen."""


def has_display() -> bool:
    """Return whether a window can be shown: a display server, or another platform than X and
    Wayland.
    """
    if os.environ.get("QT_QPA_PLATFORM"):
        return True
    if sys.platform != "linux":
        return True
    return bool(os.environ.get("DISPLAY") or os.environ.get("WAYLAND_DISPLAY"))


def icon() -> QIcon:
    """Return the program's icon, of its windows and of the desktop entry."""
    return QIcon(str(resources() / "icons" / "acus.svg"))


def _open_log(application: QApplication) -> None:
    """Log to a file from now on, Qt's own warnings too."""
    log = LogFile(lambda: NAMES.known)
    log.open()
    application.aboutToQuit.connect(log.close)
    levels = {
        QtMsgType.QtWarningMsg: logging.WARNING,
        QtMsgType.QtCriticalMsg: logging.ERROR,
        QtMsgType.QtFatalMsg: logging.CRITICAL,
    }
    qt = logging.getLogger("qt")

    def heard(kind: QtMsgType, _: object, words: str) -> None:
        if kind in levels:
            qt.log(levels[kind], "%s", words)
            sys.stderr.write(f"{words}\n")

    qInstallMessageHandler(heard)


def start(offscreen: bool = False) -> QApplication:
    """Return the application, with theme and translation; Ctrl+C in the terminal ends it.

    Args:
        offscreen: draw into memory, without a display.

    Raises:
        NoDisplayError: if a window is wanted and there is no display.
    """
    if offscreen:
        os.environ["QT_QPA_PLATFORM"] = "offscreen"
    elif not has_display():
        raise NoDisplayError(
            "there is no display (DISPLAY is not set); start it on a desktop,"
            " or run `acus demo --headless`"
        )
    sys.setswitchinterval(SWITCH_INTERVAL)
    application = QApplication(sys.argv[:1])
    application.setApplicationName("acus")
    application.setApplicationDisplayName("Acus")
    application.setApplicationVersion(__version__)
    application.setDesktopFileName("acus")  # its desktop entry has the icon for Wayland
    application.setWindowIcon(icon())
    apply_theme(application)
    use_language(application, chosen(open_settings()))
    _open_log(application)
    signal.signal(signal.SIGINT, lambda *_: application.quit())
    awake = QTimer(application, interval=200)  # lets Python see the signal
    awake.timeout.connect(lambda: None)
    awake.start()
    return application
