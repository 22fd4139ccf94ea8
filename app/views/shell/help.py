"""Help: the user guide at the page about the part of the window that is in use."""

from __future__ import annotations

import re
from pathlib import Path
from typing import Final

from PySide6.QtCore import QByteArray, Qt, QUrl
from PySide6.QtGui import QDesktopServices, QImage, QShowEvent, QTextBlock, QTextDocument
from PySide6.QtWidgets import QDialog, QDialogButtonBox, QLabel, QTextBrowser, QVBoxLayout, QWidget

from app.views.kit.text import tr

_PACKAGE: Final = Path(__file__).resolve().parents[2]
SITE: Final = _PACKAGE / "site"
"""The built user guide (`make docs`); in an installed program it is always there."""

SOURCES: Final = _PACKAGE.parent / "docs"
"""Its pages as they are written; in a checkout only."""

_MARGIN_PX: Final = 40

HOME: Final = "index.md"
PAGES: Final = {
    "cameras": "cameras.md#in-the-trainer",
    "checks": "user-guide.md#every-morning",
    "debrief": "user-guide.md#4-debrief",
    "exercise": "user-guide.md#the-students-path",
    "measure": "planning.md#measuring",
    "pen": "pen.md#in-the-window",
    "plan": "planning.md",
    "reading": "reading.md",
    "robot": "hardware.md#in-the-trainer",
    "scene": "reading.md#layouts",
    "series": "reading.md#opening-a-ct",
    "slices": "reading.md#mouse-and-keys",
    "structures": "structures.md#in-the-window",
}
"""Page and heading about the widgets of each folder of `app.views`."""


def page_of(widget: QWidget | None) -> str:
    """Return the page about a widget: of the feature that it, or what holds it, belongs to."""
    while widget is not None:
        module = type(widget).__module__.split(".")
        if module[:2] == ["app", "views"] and module[2] in PAGES:
            return PAGES[module[2]]
        widget = widget.parentWidget()
    return HOME


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
        self.asked, self._heading = (name, heading), heading
        self.setWindowTitle(tr("User guide"))
        self.resize(900, 700)
        layout = QVBoxLayout(self)
        self.browser = _Pages()
        self.browser.setOpenExternalLinks(True)
        self.browser.setSearchPaths([str(SOURCES)])
        missing = QLabel(self._missing(name))
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
