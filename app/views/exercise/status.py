"""The status strip, each part's health as symbol, words and colour; and events as lines with their
time.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from PySide6.QtCore import QEvent, QObject, QSize, Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import (
    QHBoxLayout,
    QListWidget,
    QListWidgetItem,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from app.core.events import Event
from app.views.exercise.readouts import clock_text
from app.views.kit import theme
from app.views.kit.names import NAMES
from app.views.kit.progress_strip import ElidedLabel
from app.views.kit.text import tr
from app.views.kit.verdict import StatusItem, Verdict

LONGEST: Final = 200
"""Lines kept; older ones are in the record."""

TITLE_PX: Final = 170
"""Width [px] up to which a title is whole, whatever is left for the values."""

_LINE: Final = Qt.ItemDataRole.UserRole
_COLOUR: Final = Qt.ItemDataRole.UserRole + 1
"""The line as it came, names and all, and its colour in any theme."""

_LOOKS: Final = {
    "state": (theme.TEXT, "•"),
    "scan": (theme.ACCENT, "▼"),
    "abort": (theme.BAD, "✖"),
    "fault": (theme.BAD, "✖"),
    "recorder": (theme.WARNING, "▲"),
    "error": (theme.BAD, "✖"),
    "breach": (theme.WARNING, "▲"),
}


class MessageList(QListWidget):
    """Lines with symbol, time since the attempt began, and words."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._origin: float | None = None
        self.setWordWrap(True)
        self.setAccessibleName(tr("Messages"))
        NAMES.changed.connect(self.suit_room)

    def start_clock(self, origin: float) -> None:
        """Count times from `origin` [s]; before that they are left out."""
        self._origin = origin

    def add_event(self, event: Event) -> None:
        """Append an event; the list keeps its last `LONGEST` lines and stays at its end."""
        colour, symbol = _LOOKS.get(event.kind, (theme.TEXT_DIM, "•"))
        known = self._origin is not None and event.time >= self._origin
        when = clock_text(event.time - (self._origin or 0.0)) + "  " if known else ""
        line = f"{symbol} {when}{event.message}"
        item = QListWidgetItem(NAMES.without_names(line))
        item.setData(_LINE, line)
        item.setData(_COLOUR, colour)
        item.setForeground(QColor(theme.now(colour)))
        self.addItem(item)
        while self.count() > LONGEST:
            self.takeItem(0)
        self.scrollToBottom()

    def suit_room(self) -> None:
        """Write all lines anew in the present colours, without names while they are hidden."""
        for item in (self.item(row) for row in range(self.count())):
            item.setText(NAMES.without_names(str(item.data(_LINE))))
            item.setForeground(QColor(theme.now(str(item.data(_COLOUR)))))


class StatusStrip(QWidget):
    """Cells beside each other; their tooltips say what the value means and what to do."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._cells: list[StatusCell] = []
        self._row = QHBoxLayout(self)
        self._row.setContentsMargins(theme.MARGIN, 3, theme.MARGIN, 3)
        self._row.setSpacing(2 * theme.SPACING)
        self._row.addStretch(1)
        # Its height is kept while there is nothing to say, so that the panes stay where they are.
        cell = StatusCell(self)
        cell.show_item(StatusItem(Verdict.IDLE, tr("Status"), tr("Status"), ""))
        cell.ensurePolished()
        self.setMinimumHeight(cell.sizeHint().height() + 6)
        self._keep(cell)
        cell.hide()
        self.setAccessibleName(tr("Status"))

    def show_items(self, items: Sequence[StatusItem]) -> None:
        """Show these items in this order."""
        while len(self._cells) < len(items):
            self._keep(StatusCell(self))
        for i, cell in enumerate(self._cells):
            cell.setVisible(i < len(items))
            if i < len(items):
                cell.show_item(items[i])

    def _keep(self, cell: StatusCell) -> None:
        self._row.insertWidget(len(self._cells), cell)
        self._cells.append(cell)


class StatusCell(QWidget):
    """Symbol and title above the value."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._item: StatusItem | None = None
        self._widest = 0
        self._title = ElidedLabel(parent=self, narrowest=TITLE_PX)
        self._text = ElidedLabel(parent=self)
        for label in (self._title, self._text):  # neither holds the other to its own width
            label.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Preferred)
        self._text.setStyleSheet(f"font-size: {theme.SMALL_PX}px;")
        self._text.installEventFilter(self)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addWidget(self._title)
        column.addWidget(self._text)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Take the room that the text needs in another size."""
        if watched is self._text and event.type() == QEvent.Type.FontChange:
            self._widest = 0
            self._grow()
        return False

    def sizeHint(self) -> QSize:
        """Return the room for title and text; where there is less, they end in an ellipsis."""
        return super().sizeHint().expandedTo(QSize(self._widest, 0))

    def _grow(self) -> None:
        """Want no less room than before, so that the neighbours do not dance with the digits."""
        self._widest = max(self._widest, self._text.sizeHint().width())
        self.updateGeometry()

    def show_item(self, item: StatusItem) -> None:
        """Show an item; does nothing when it is the one shown."""
        if item == self._item:
            return
        colour, symbol = item.verdict.colour_and_symbol
        if self._item is None or self._item.verdict is not item.verdict:
            self._title.setStyleSheet(
                f"color: {colour}; font-size: {theme.SMALL_PX}px; font-weight: 600;"
            )
        self._item = item
        self._title.set_whole(f"{symbol} {item.title}")
        self._text.set_whole(item.text)
        self._grow()
        self.setToolTip(f"{item.title}: {item.text}\n\n{item.help}")
        self.setAccessibleName(f"{item.title}: {item.text}")

    @property
    def item(self) -> StatusItem | None:
        """What is shown."""
        return self._item
