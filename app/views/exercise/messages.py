"""What happened, newest last: events of the trainer as lines with their time."""

from typing import Final

from PySide6.QtCore import Qt
from PySide6.QtGui import QColor
from PySide6.QtWidgets import QListWidget, QListWidgetItem, QWidget

from app.core.events import Event
from app.views.exercise.readouts import clock_text
from app.views.kit import theme
from app.views.kit.names import NAMES
from app.views.kit.text import tr

LONGEST: Final = 200
"""Lines kept; older ones are in the record."""

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
