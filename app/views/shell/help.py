"""Help: the user guide at the page about the part in use, *About*, and *Report a problem*.

A report holds what a developer needs, without identifiers, for the user to read before it is sent.
*About* tells the parts that the program is built of, with their licences, as the installation says.
"""

from __future__ import annotations

import os
import platform
import re
import sys
from collections.abc import Sequence
from dataclasses import dataclass
from importlib import metadata
from importlib.metadata import Distribution, PackageNotFoundError, distribution
from pathlib import Path
from re import match
from typing import Any, Final

from PySide6.QtCore import QByteArray, QSize, Qt, QUrl, qVersion
from PySide6.QtGui import (
    QDesktopServices,
    QFontDatabase,
    QGuiApplication,
    QImage,
    QShowEvent,
    QTextBlock,
    QTextDocument,
)
from PySide6.QtWidgets import (
    QDialog,
    QDialogButtonBox,
    QFileDialog,
    QHBoxLayout,
    QHeaderView,
    QPlainTextEdit,
    QTableWidget,
    QTableWidgetItem,
    QTextBrowser,
    QVBoxLayout,
    QWidget,
)

from app import __version__
from app.core.files import write_atomically
from app.core.identifiers import without_identifiers
from app.core.log_file import crash_text, tail
from app.views.kit.background import run_in_background
from app.views.kit.names import NAMES
from app.views.kit.parts import PlainLabel, label, size_dialog
from app.views.kit.roles import EVERYBODYS
from app.views.kit.text import disclaimer, in_english, literal, tr
from app.views.shell.application import icon
from app.views.shell.feature import Feature
from app.views.shell.feature_plugins import page_of_plugin

_PROGRAM: Final = "acus"
_STATED: Final = {"vtk": "BSD-3-Clause", "python-gdcm": "BSD-3-Clause"}
"""Licences that a part's own metadata leave out."""

_LONGEST = 60


@dataclass(frozen=True, slots=True)
class Part:
    """A library: name, version and licence as its metadata have them."""

    name: str
    version: str
    licence: str


def parts() -> tuple[Part, ...]:
    """Return the installed libraries that the program needs, and those that these need, by name."""
    found: dict[str, Part] = {}
    waiting = [_PROGRAM]
    seen: set[str] = set()
    while waiting:
        name = _key(waiting.pop())
        if name in seen:
            continue
        seen.add(name)
        try:
            library = distribution(name)
        except PackageNotFoundError:
            continue
        if name != _PROGRAM:
            found[name] = Part(library.metadata["Name"], library.version, licence(library))
        waiting += [each for each in map(_needed, library.requires or ()) if each]
    return tuple(found[name] for name in sorted(found))


def licence(library: Distribution) -> str:
    """Return the licence of a library in a line; "not stated" where its metadata are silent."""
    data = library.metadata
    if text := _field(data, "License-Expression"):
        return text
    if stated := _STATED.get(_key(data["Name"])):
        return stated
    classes = [
        line.rpartition(" :: ")[2]
        for line in data.get_all("Classifier") or ()
        if line.startswith("License ::") and not line.endswith("OSI Approved")
    ]
    words = _field(data, "License").strip()
    if words and "\n" not in words and len(words) <= _LONGEST:
        return words
    return ", ".join(classes) or "not stated"


def _field(data: Any, name: str) -> str:
    """Return a field of metadata; empty without it: who reads them may raise for that."""
    return str(data[name] or "") if name in data else ""


def _key(name: str) -> str:
    return name.lower().replace("_", "-").replace(".", "-")


def _needed(requirement: str) -> str:
    """Name of what is required, "" where an extra asks for it."""
    name = match(r"[A-Za-z0-9._-]+", requirement)
    return "" if name is None or "extra ==" in requirement else name.group()


_ICON_PX = 96


def about(parent: QWidget) -> QDialog:
    """Return the dialog that says what this is and what it is not."""
    dialog = AboutDialog(parent)
    dialog.finished.connect(dialog.deleteLater)
    return dialog


class AboutDialog(QDialog):
    """Version, disclaimer, licence, and the libraries with their versions and licences."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWindowTitle(tr("About Acus"))
        layout = QVBoxLayout(self)
        head = QHBoxLayout()
        picture = PlainLabel()
        picture.setPixmap(icon().pixmap(QSize(_ICON_PX, _ICON_PX), self.devicePixelRatioF()))
        head.addWidget(picture, 0, Qt.AlignmentFlag.AlignTop)
        words = QVBoxLayout()
        words.addWidget(label(tr("Acus {version}", version=__version__), "title"))
        for text in _sentences():
            words.addWidget(label(text))
        head.addLayout(words, 1)
        layout.addLayout(head)
        self._head = PlainLabel(tr("Libraries, as installed (being read):"))
        layout.addWidget(self._head)
        self.table = _table()
        layout.addWidget(self.table, 1)
        # The metadata of every library take a good part of a second.
        run_in_background(self, lambda _: parts(), self._show_parts, self._not_read)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.rejected.connect(self.reject)
        layout.addWidget(buttons)
        size_dialog(self, 680, 620)

    def _show_parts(self, rows: Sequence[Part]) -> None:
        self._head.setText(tr("Libraries, as installed:"))
        self.table.setRowCount(len(rows))
        for row, part in enumerate(rows):
            for column, text in enumerate((part.name, part.version, part.licence)):
                item = QTableWidgetItem(text)
                item.setToolTip(literal(text))
                self.table.setItem(row, column, item)
        self.table.resizeColumnsToContents()
        self.table.horizontalHeader().setSectionResizeMode(2, QHeaderView.ResizeMode.Stretch)

    def _not_read(self, error: Exception) -> None:
        self._head.setText(tr("The libraries cannot be listed: {error}", error=error))


def unreviewed() -> tuple[str, ...]:
    """Return what is to be known of another language than English, in that language."""
    if in_english():
        return ()
    return (tr("This language was translated, and not reviewed by native radiologists."),)


def _sentences() -> tuple[str, ...]:
    return (
        disclaimer(),
        *unreviewed(),
        tr("Acus is under the Apache License 2.0 (LICENSE, NOTICE)."),
        tr(
            "Qt {version} and PySide6 are used under the GNU Lesser General Public License (LGPL), "
            "version 3: they lie beside the program as libraries of their own, and you may replace "
            "them by versions that you have changed.",
            version=qVersion(),
        ),
    )


def _table() -> QTableWidget:
    table = QTableWidget(0, 3)
    table.setTabKeyNavigation(False)
    table.setHorizontalHeaderLabels([tr("Library"), tr("Version"), tr("Licence")])
    table.setAccessibleName(tr("Library"))
    table.setEditTriggers(QTableWidget.EditTrigger.NoEditTriggers)
    table.setSelectionBehavior(QTableWidget.SelectionBehavior.SelectRows)
    table.verticalHeader().hide()
    return table


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
        size_dialog(self, 760, 520)
        words = PlainLabel(
            tr(
                "This is all that a report holds: no names, no pictures, no paths. Look through "
                "it, say above it what you did and what you expected, and send it to whoever looks "
                "after this computer. The program sends nothing by itself."
            ),
            self,
        )
        words.setWordWrap(True)
        self.text = QPlainTextEdit(report_text(), self)
        self.text.setAccessibleName(self.windowTitle())
        self.text.setFont(QFontDatabase.systemFont(QFontDatabase.SystemFont.FixedFont))
        self.text.setLineWrapMode(QPlainTextEdit.LineWrapMode.NoWrap)
        self.text.setTabChangesFocus(True)
        self.buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close, self)
        self.copy = self.buttons.addButton(tr("Copy"), QDialogButtonBox.ButtonRole.ActionRole)
        self.save = self.buttons.addButton(tr("Save as…"), QDialogButtonBox.ButtonRole.ActionRole)
        self.said = PlainLabel(self)
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


_PACKAGE: Final = Path(__file__).resolve().parents[2]
SITE: Final = _PACKAGE / "site"
"""The built user guide (`make docs`); in an installed program it is always there."""

SOURCES: Final = _PACKAGE.parent / "docs"
"""Its pages as they are written; in a checkout only."""

_MARGIN_PX: Final = 40

HOME: Final = "index.md"
PAGES: Final = {
    "cameras": "cameras.md#in-the-trainer",
    "checks": "user-guide.md#every-day",
    "debrief": "user-guide.md#4-debrief",
    "exercise": "user-guide.md#the-students-path",
    "measure": "planning.md#measuring",
    "people": "people.md",
    "sounds": "user-guide.md#what-is-heard",
    "plan": "planning.md",
    "reading": "reading.md",
    "robot": "hardware.md#in-the-trainer",
    "scene": "reading.md#3d-view",
    "series": "reading.md#opening-a-ct",
    "slices": "reading.md#mouse-and-keyboard-shortcuts",
    "structures": "structures.md#in-the-window",
}
"""Page and heading about the widgets of folders of `app.views` whose feature names none."""


def page_of(widget: QWidget | None) -> str:
    """Return the page about a widget: of the feature that it, or what holds it, belongs to."""
    while widget is not None:
        if page := page_of_plugin(type(widget).__module__):
            return page
        module = type(widget).__module__.split(".")
        if module[:2] == ["app", "views"] and (page := _page_of_folder(module[2])):
            return page
        widget = widget.parentWidget()
    return HOME


def _page_of_folder(name: str) -> str:
    """Return the page of a folder of `app.views`; empty where there is none."""
    package = f"app.views.{name}."
    features = (one for one in Feature.__subclasses__() if one.__module__.startswith(package))
    return next((one.help for one in features if one.help), PAGES.get(name, ""))


def show_help(parent: QWidget, page: str = HOME) -> QDialog | None:
    """Open a page, `file.md#heading`: of the built site in the browser, else in a window.

    There is one window: asked for again it comes to the front, for another page it is replaced.

    Returns the window, or None where a browser shows the page.
    """
    name, _, heading = page.partition("#")
    built = (SITE / name).with_suffix(".html")
    if built.is_file():
        url = QUrl.fromLocalFile(str(built))
        url.setFragment(heading)
        if QDesktopServices.openUrl(url):
            return None
    for shown in parent.findChildren(HelpWindow):
        if shown.isVisible() and shown.asked == (name, heading):
            shown.raise_()
            shown.activateWindow()
            return shown
        shown.close()
    window = HelpWindow(name, heading, parent)
    window.finished.connect(window.deleteLater)
    window.show()
    return window


class HelpWindow(QDialog):
    """A page of the sources, where there is no built site or no browser.

    Args:
        name: file in `SOURCES`.
        heading: anchor of a heading on it, "" for its beginning.
        parent: window that it belongs to.

    Attributes:
        asked: name and heading.
    """

    def __init__(self, name: str, heading: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setProperty(EVERYBODYS, True)
        self.asked, self._heading = (name, heading), heading
        self.setWindowTitle(tr("User guide"))
        size_dialog(self, 900, 700)
        layout = QVBoxLayout(self)
        self.browser = _Pages()
        self.browser.setOpenExternalLinks(True)
        self.browser.setSearchPaths([str(SOURCES)])
        missing = PlainLabel(self._missing(name))
        missing.setWordWrap(True)
        missing.setVisible(not (SOURCES / name).is_file())
        layout.addWidget(missing)
        layout.addWidget(self.browser)
        buttons = QDialogButtonBox(QDialogButtonBox.StandardButton.Close)
        buttons.rejected.connect(self.reject)
        layout.addWidget(buttons)
        self.browser.sourceChanged.connect(lambda url: self._go_to(url.fragment()))
        if (SOURCES / name).is_file():
            self.browser.setSource(QUrl.fromLocalFile(str(SOURCES / name)))

    def _missing(self, name: str) -> str:
        return tr(
            "The user guide is not installed with this program. In a checkout `make docs` builds "
            "it. The page that was asked for is docs/{name}.",
            name=name,
        )

    def _go_to(self, heading: str) -> None:
        """Scroll to a heading; Qt gives the headings of Markdown no anchors."""
        block: QTextBlock = self.browser.document().begin()
        while heading and block.isValid():
            if block.blockFormat().headingLevel() and anchor(block.text()) == heading:
                layout = self.browser.document().documentLayout()
                top = layout.blockBoundingRect(block).top()
                self.browser.verticalScrollBar().setValue(int(top))
                return
            block = block.next()

    def showEvent(self, event: QShowEvent) -> None:
        """Scroll once the page has the width of the window."""
        super().showEvent(event)
        self._go_to(self._heading)


class _Pages(QTextBrowser):
    """Pages whose pictures are no wider than the window."""

    def loadResource(self, kind: int, name: QUrl | str) -> object:
        """Read a picture at most as wide as the page."""
        found = super().loadResource(kind, name)
        if kind != QTextDocument.ResourceType.ImageResource or not isinstance(found, QByteArray):
            return found
        picture, width = QImage.fromData(found), self.viewport().width() - _MARGIN_PX
        if picture.width() <= width:
            return found
        return picture.scaledToWidth(width, Qt.TransformationMode.SmoothTransformation)


def anchor(heading: str) -> str:
    """Return the anchor of a heading, as the site and GitHub make it."""
    return re.sub(r"[^\w\- ]", "", heading.lower()).strip().replace(" ", "-")
