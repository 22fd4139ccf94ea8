"""Small parts that pages and dialogs are made of: title, text, button, bar, table."""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from PySide6.QtCore import QRect, QSize, Qt
from PySide6.QtGui import QPainter, QPaintEvent, QResizeEvent
from PySide6.QtWidgets import (
    QAbstractItemView,
    QHeaderView,
    QLabel,
    QMessageBox,
    QProgressBar,
    QPushButton,
    QSizePolicy,
    QStyle,
    QStyleOptionButton,
    QTableWidget,
    QVBoxLayout,
    QWidget,
)

from app.views.kit import theme
from app.views.kit.text import keys_text, literal, tr

_WRAPPED: Final = int(Qt.TextFlag.TextWordWrap)


class PlainLabel(QLabel):
    """A label that shows its text as it stands, whoever wrote it: names are no markup."""

    def __init__(self, text: str | QWidget | None = "", parent: QWidget | None = None) -> None:
        words, place = ("", text) if isinstance(text, QWidget) else (text or "", parent)
        super().__init__(words, place)
        self.setTextFormat(Qt.TextFormat.PlainText)


class BulletLabel(PlainLabel):
    """A label of plain text that wraps; a line that begins with a bullet hangs beside it.

    The words stay `text()`, one item a line, for screen readers and whoever copies them.
    """

    BULLET: Final = "•  "

    def __init__(self, text: str = "", parent: QWidget | None = None) -> None:
        super().__init__(text, parent)
        self.setWordWrap(True)

    def show_items(self, items: Sequence[str]) -> None:
        """Show lines, with a bullet each where they are several."""
        several = len(items) > 1
        self.setText("\n".join(f"{self.BULLET if several else ''}{item}" for item in items))

    def heightForWidth(self, width: int) -> int:
        """Return the height of all lines [px] at a width [px]."""
        rows = self._rows(width)
        return rows[-1][1].bottom() + 1 if rows else 0

    def minimumSizeHint(self) -> QSize:
        """Return room for the longest word."""
        metrics = self.fontMetrics()
        longest = max(map(metrics.horizontalAdvance, self.text().split() or [""]))
        return QSize(metrics.horizontalAdvance(self.BULLET) + longest, metrics.lineSpacing())

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw each line, its bullet at the edge."""
        painter = QPainter(self)
        painter.setPen(self.palette().color(self.foregroundRole()))
        for line, place in self._rows(self.width()):
            if line.startswith(self.BULLET):
                painter.drawText(0, place.top() + self.fontMetrics().ascent(), self.BULLET.strip())
            painter.drawText(place, _WRAPPED, line.removeprefix(self.BULLET))
        painter.end()

    def _rows(self, width: int) -> list[tuple[str, QRect]]:
        metrics, top, rows = self.fontMetrics(), 0, []
        for line in self.text().split("\n") if self.text() else ():
            left = metrics.horizontalAdvance(self.BULLET) if line.startswith(self.BULLET) else 0
            room = QRect(left, top, max(1, width - left), 1 << 20)
            place = metrics.boundingRect(room, _WRAPPED, line.removeprefix(self.BULLET))
            rows.append((line, QRect(left, top, room.width(), place.height())))
            top += place.height()
        return rows


def column(page: QWidget, title: str, spacing: int = theme.SPACING) -> QVBoxLayout:
    """Return a page's column, its title on top."""
    rows = QVBoxLayout(page)
    rows.setContentsMargins(theme.MARGIN, 0, 0, 0)
    rows.setSpacing(spacing)
    heading = PlainLabel(title, page)
    heading.setProperty("role", "title")
    rows.addWidget(heading)
    return rows


def label(text: str = "", role: str = "") -> PlainLabel:
    """Return a label of plain text that wraps."""
    made = PlainLabel(text)
    made.setWordWrap(True)
    if role:
        made.setProperty("role", role)
    return made


def message_box(parent: QWidget | None, title: str, words: str, more: str = "") -> QMessageBox:
    """Return a box that shows its words as they stand, without an icon or buttons."""
    box = QMessageBox(parent)
    box.setWindowTitle(title)
    box.setText(literal(words))
    box.setInformativeText(literal(more))
    return box


def button(text: str, role: str = "", kind: type[QPushButton] = QPushButton) -> QPushButton:
    """Return a button that Enter does not press by itself; `kind`: its class."""
    made = kind(text)
    made.setAutoDefault(False)
    if role:
        made.setProperty("role", role)
    return made


def ask(
    parent: QWidget | None,
    title: str,
    words: str,
    more: str,
    answers: Sequence[str],
    *,
    default: int = 0,
    escape: int,
) -> int:
    """Ask by answers that name what they do; return the number of the one given.

    Args:
        parent: over which it opens.
        title: of the box.
        words: the question, as it stands.
        more: what follows from the answers.
        answers: words of the buttons.
        default: number of the answer that Enter gives.
        escape: number of the one that Escape, or closing the box, gives.
    """
    box = message_box(parent, title, words, more)
    box.setIcon(QMessageBox.Icon.Question)
    role = QMessageBox.ButtonRole.ActionRole
    buttons = [box.addButton(name, role) for name in answers]
    box.setDefaultButton(buttons[default])
    box.setEscapeButton(buttons[escape])
    box.exec()
    clicked = box.clickedButton()
    return buttons.index(clicked) if clicked in buttons else escape


def text_room(button: QPushButton) -> int:
    """Return the width that a button has for its text [px]."""
    option = QStyleOptionButton()
    button.initStyleOption(option)
    element = QStyle.SubElement.SE_PushButtonContents
    return button.style().subElementRect(element, option, button).width()


class FittingButton(QPushButton):
    """A button that never asks for more width than there is.

    Where the text does not fit, the key in brackets at its end is shortened, then it goes, then
    letters do; a tip has all of it unless the button has another.
    """

    def __init__(self, text: str, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._whole = ""
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Fixed)
        self.setText(text)

    def setText(self, text: str) -> None:
        """Show as much of a text as there is room for."""
        self._whole = text
        self.setAccessibleName(text)
        super().setText(text)
        self.updateGeometry()
        self._fit()

    def sizeHint(self) -> QSize:
        """Return what the whole text takes."""
        metrics, hint = self.fontMetrics(), super().sizeHint()
        shown = metrics.horizontalAdvance(self.text())
        return hint + QSize(metrics.horizontalAdvance(self._whole) - shown, 0)

    @property
    def _keyless(self) -> str:
        return self._whole.rpartition(" (")[0] or self._whole

    @property
    def shortest_px(self) -> int:
        """Return the width in which no letter but those of its key goes [px]."""
        metrics = self.fontMetrics()
        key = metrics.horizontalAdvance(self._whole) - metrics.horizontalAdvance(self._keyless)
        return self.sizeHint().width() - key

    def minimumSizeHint(self) -> QSize:
        """Return what a few letters take."""
        hint = self.sizeHint()
        return QSize(min(theme.px(NARROWEST_PX), hint.width()), hint.height())

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Show more or less of it."""
        super().resizeEvent(event)
        self._fit()

    def _fit(self) -> None:
        room, metrics = text_room(self), self.fontMetrics()
        without = self._keyless
        forms = (self._whole, with_short_key(self._whole), without)
        fitting = (form for form in forms if metrics.horizontalAdvance(form) <= room)
        shown = next(fitting, "") or metrics.elidedText(without, Qt.TextElideMode.ElideRight, room)
        if shown != self.text():
            super().setText(shown)
            if not self.toolTip():
                self.setToolTip(literal(self._whole))


def with_short_key(text: str) -> str:
    """Return a text with the key in brackets at its end alone: "Abort (Esc)", "End (⏎)"."""
    words, _, key = text.rpartition(" (")
    if not words or not key.endswith(")"):
        return text
    enter = {"Enter", tr("Enter"), keys_text("Enter"), keys_text("Return")}
    if key[:-1] in enter:
        return f"{words} (⏎)"
    shown = next((one for one in key[:-1].split() if one in _KEYS), "")
    return f"{words} ({shown})" if shown else text


_KEYS = frozenset(("Esc", "Échap", "Space", *"ABCDEFGHIJKLMNOPQRSTUVWXYZ"))

NARROWEST_PX = 96
"""Of a button that gives way, at the usual size of the text."""

FRAME = QSize(16, 48)
"""About what a desktop draws round a window: border and title bar [px]."""


def size_dialog(dialog: QWidget, width: int, height: int) -> None:
    """Give a dialog a size [px], or what of it the screen has room for with a title bar."""
    dialog.resize(QSize(width, height).boundedTo(dialog.screen().availableSize() - FRAME))


def thin_bar() -> QProgressBar:
    """Return a bar of progress, 0 to 1000, without words."""
    made = QProgressBar()
    made.setRange(0, 1000)
    made.setTextVisible(False)
    made.setFixedHeight(10)
    return made


def table(titles: tuple[str, ...], selectable: bool = False) -> QTableWidget:
    """Return a table to read; `selectable` lets whole rows be chosen, one at a time."""
    made = QTableWidget(0, len(titles))
    made.setTabKeyNavigation(False)  # Tab leads on; the arrows lead from cell to cell
    made.setHorizontalHeaderLabels(titles)
    made.verticalHeader().setVisible(False)
    made.setEditTriggers(QAbstractItemView.EditTrigger.NoEditTriggers)
    mode = QAbstractItemView.SelectionMode
    made.setSelectionBehavior(QAbstractItemView.SelectionBehavior.SelectRows)
    made.setSelectionMode(mode.SingleSelection if selectable else mode.NoSelection)
    made.setShowGrid(False)
    header = made.horizontalHeader()
    header.setSectionResizeMode(QHeaderView.ResizeMode.ResizeToContents)
    header.setStretchLastSection(True)
    header.setDefaultAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
    return made
