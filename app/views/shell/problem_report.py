"""Help, Report a problem: what a developer needs, without identifiers, for the user to look at."""

from __future__ import annotations

import os
import platform
import sys
from importlib import metadata
from pathlib import Path

from PySide6.QtCore import qVersion
from PySide6.QtGui import QFontDatabase, QGuiApplication
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFileDialog,
    QLabel,
    QPlainTextEdit,
    QVBoxLayout,
    QWidget,
)

from app import __version__
from app.core.files import write_atomically
from app.core.identifiers import without_identifiers
from app.core.log_file import crash_text, tail
from app.views.kit.names import NAMES
from app.views.kit.text import tr

_PARTS = (
    "PySide6-Essentials",
    "vtk",
    "numpy",
    "numba",
    "opencv-contrib-python-headless",
    "pydicom",
)


def report_text() -> str:
    """Return program, system, screens, the last crash and the end of the log, nobody named."""
    parts = [
        f"Acus {__version__}, Python {sys.version.split()[0]}, Qt {qVersion()}",
        f"{platform.system()} {platform.release()} {platform.machine()}",
        f"{os.cpu_count()} processors",
        ", ".join(f"{name} {_version(name)}" for name in _PARTS),
        "; ".join(_screens()),
    ]
    crash = crash_text()
    if crash:
        parts += ["", "--- the last crash ---", crash]
    parts += ["", "--- the log ---", tail() or "(empty)"]
    return without_identifiers("\n".join(parts), NAMES.known)


def _screens() -> list[str]:
    return [
        f"screen {screen.size().width()}x{screen.size().height()} at {screen.devicePixelRatio():g}"
        for screen in QGuiApplication.screens()
    ]


def _version(name: str) -> str:
    try:
        return metadata.version(name)
    except metadata.PackageNotFoundError:
        return "-"


class ProblemReport(QDialog):
    """Shows the report as it would leave the computer; it is copied or saved, never sent."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("Report a problem"))
        self.resize(760, 520)
        words = QLabel(
            tr(
                "This is all that a report holds: no names, no pictures, no paths. Look through "
                "it, say above it what you did and what you expected, and send it to whoever looks "
                "after this computer. The program sends nothing by itself."
            ),
            self,
        )
        words.setWordWrap(True)
        self.text = QPlainTextEdit(report_text(), self)
        self.text.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self.text.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close, self)
        self.copy = self.buttons.addButton(tr("Copy"), QDialogButtonBox.ButtonRole.ActionRole)
        self.save = self.buttons.addButton(tr("Save as…"), QDialogButtonBox.ButtonRole.ActionRole)
        self.said = QLabel(self)
        column = QVBoxLayout(self)
        for part in (words, self.text, self.said, self.buttons):
            column.addWidget(part)
        self.copy.clicked.connect(self._copy)
        self.save.clicked.connect(self._ask)
        self.buttons.rejected.connect(self.reject)

    def _copy(self) -> None:
        QGuiApplication.clipboard().setText(self.text.toPlainText())
        self.said.setText(tr("✔ copied"))

    def _ask(self) -> None:
        name, _ = QFileDialog.getSaveFileName(self, tr("Save the report"), "acus-problem.txt")
        if name:
            self.save_as(name)

    def save_as(self, name: str) -> None:
        """Write the report; says if that does not work."""
        try:
            write_atomically(Path(name), self.text.toPlainText().encode())
        except OSError as error:
            self.said.setText(tr("✖ not saved: {why}", why=error.strerror or ""))
        else:
            self.said.setText(tr("✔ saved"))
