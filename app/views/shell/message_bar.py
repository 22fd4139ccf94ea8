"""Errors and notes over the free end of the menu bar: they stop nothing and go when closed.

A bar that pushed the panes down would move the image under the mouse, in the middle of a drag.
Where the next step is said they keep clear of it: what needs more than the menus' line lies below.
Notes go by themselves after a while. What belongs to a state stands as long as the state does
(`message_topics` says which): another message covers it, and it is back when that one goes.
"""

from __future__ import annotations

import traceback

from PySide6.QtCore import QEvent, QObject, Qt, QTimer
from PySide6.QtWidgets import (
    QHBoxLayout,
    QMainWindow,
    QToolButton,
    QVBoxLayout,
    QWidget,
)

from app.core.errors import AcusError
from app.views.kit import theme
from app.views.kit.names import NAMES
from app.views.kit.parts import PlainLabel, message_box
from app.views.kit.text import tr, translated

GAP_PX = 12
CLEAR_CHANGES = (
    QEvent.Type.Show,
    QEvent.Type.Hide,
    QEvent.Type.Move,
    QEvent.Type.Resize,
)

MENU_CHANGES = (
    QEvent.Type.ActionAdded,
    QEvent.Type.ActionChanged,
    QEvent.Type.ActionRemoved,
    QEvent.Type.Resize,
    QEvent.Type.LayoutRequest,
)

NARROWEST_PX = 340
"""Where the menus leave less room the notices lie over them."""


class Notices(QWidget):
    """Stacks its parts from the top of the window and is there only while one of them is.

    Args:
        window: whose menus they lie beside.
        parts: from the top.
        clear: what they never cover while it is seen, below the menus.
    """

    def __init__(
        self, window: QMainWindow, parts: tuple[QWidget, ...], clear: QWidget | None = None
    ) -> None:
        super().__init__(window)
        self._window, self._parts, self._clear = window, parts, clear
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self._column = column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        for part in parts:
            column.addWidget(part)
            part.installEventFilter(self)
        window.installEventFilter(self)
        self._settling = QTimer(self, interval=0, singleShot=True)
        self._settling.timeout.connect(self.place)
        self._menus = window.menuBar()
        self._menus.installEventFilter(self)
        if clear is not None:
            clear.installEventFilter(self)
        self.place()

    def place(self) -> None:
        """Take the room right of the menus, or below them, as high as the notices need."""
        shown = [part for part in self._parts if not part.isHidden()]
        self.setVisible(bool(shown))
        if not shown:
            return
        bar = self._window.menuBar()
        ends = [bar.actionGeometry(action).right() for action in bar.actions()]
        left = max(ends, default=0) + GAP_PX
        corner = bar.cornerWidget()
        width = self._window.width() - left - (0 if corner is None else corner.width())
        top = 0
        if width < NARROWEST_PX:
            left, top, width = 0, bar.height(), self._window.width()
        needed = self._needed(width)
        if self._clear is not None and self._clear.isVisible() and needed > bar.height():
            below = self._clear.mapTo(self._window, self._clear.rect().bottomLeft())
            left, top, width = below.x(), below.y() + 1, self._window.width() - below.x()
            needed = self._needed(width)
        self.setGeometry(left, top, width, max(bar.height(), needed))
        self.raise_()

    def _needed(self, width: int) -> int:
        """Return the height [px] that the notices need at a width [px]."""
        column = self._column
        wraps = column.hasHeightForWidth()
        return column.totalHeightForWidth(width) if wraps else self.sizeHint().height()

    def event(self, event: QEvent) -> bool:
        """Follow the size that the parts ask for."""
        if event.type() is QEvent.Type.LayoutRequest:
            self.place()
        return super().event(event)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Follow the window's size, and parts that come and go."""
        resized = watched is self._window and event.type() is QEvent.Type.Resize
        if watched is self._menus:
            if event.type() in MENU_CHANGES:
                self._settling.start()  # the menu bar lays its menus out later
            return False
        changed = event.type() in (QEvent.Type.ShowToParent, QEvent.Type.HideToParent)
        seen = watched is self._clear and event.type() in CLEAR_CHANGES
        if resized or seen or (changed and watched not in (self._window, self._clear)):
            self.place()
        return False


NOTE_MS = 6000
"""A note that something worked is shown this long."""

REFUSAL, ROBOT, PAUSE, START = "refusal", "robot", "pause", "start"
ATTEMPT_RUNS = "attempt_runs"
"""Topics: the user's last change was refused; no robot can be had; the attempt waits; none can be
begun now; something has to wait until the attempt that runs is over."""

LONGEST = 260
"""Characters shown in the bar; the rest stands in the details."""


class MessageBar(QWidget):
    """One line with a symbol, details on request, and a button to close it."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_StyledBackground)
        self._line = self._details = ""
        self._topic = ""
        self._standing: dict[str, tuple[Exception | str, str]] = {}
        self._note = QTimer(self, interval=NOTE_MS, singleShot=True)
        self._note.timeout.connect(self._uncover)
        self._symbol, self._text = PlainLabel(self), PlainLabel(self)
        self._text.setWordWrap(True)
        self._text.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._more, self._close = QToolButton(self), QToolButton(self)
        self._more.setText(tr("Details"))
        self._close.setText("✕")
        for button in (self._more, self._close):
            button.setProperty("role", "notice")
        self._close.setAccessibleName(tr("Close message"))
        self._more.clicked.connect(self.show_details)
        self._close.clicked.connect(self.close_message)
        row = QHBoxLayout(self)
        row.setContentsMargins(theme.MARGIN, 1, theme.SPACING, 2)  # above the line of 2 px
        row.addWidget(self._symbol)
        row.addWidget(self._text, 1)
        row.addWidget(self._more)
        row.addWidget(self._close)
        NAMES.changed.connect(self._write)
        self.hide()

    @property
    def text(self) -> str:
        """Message that is shown."""
        return self._text.text()

    def show_error(self, error: Exception | str, verdict: str = "bad") -> None:
        """Tell what happened and, where the error says so, what to do; `verdict` of the theme."""
        details = ""
        if isinstance(error, Exception):
            details = "".join(traceback.format_exception(error))
        known = isinstance(error, AcusError | str)
        text = translated(error) if known else tr("Something went wrong: {what}", what=repr(error))
        self._show(verdict, text, details)

    def show_note(self, text: str) -> None:
        """Tell that something worked."""
        self._show("good", text, "")
        self._note.start()

    def show_until(self, topic: str, error: Exception | str, verdict: str = "bad") -> None:
        """Tell what happened, until `forget` says that it is true no more.

        Args:
            topic: what it is about, e.g. `REFUSAL`.
            error: what happened.
            verdict: of the theme: `warning` for what is only to be waited for.
        """
        self._standing.pop(topic, None)  # the newest stands last
        self._standing[topic] = error, verdict
        self.show_error(error, verdict)
        self._topic = topic

    def forget(self, topic: str) -> None:
        """Take a topic's message away: it is true no more."""
        self._standing.pop(topic, None)
        if self._topic == topic:
            self._uncover()

    def close_message(self) -> None:
        """Take away what is shown; what it covered is shown again."""
        self.forget(self._topic)

    def clear(self) -> None:
        """Take everything away, but for an attempt that waits."""
        for topic in [topic for topic in self._standing if topic != PAUSE]:
            del self._standing[topic]
        if self._topic != PAUSE:
            self._uncover()

    def show_details(self) -> None:
        """Open a window with the whole message and where it comes from."""
        box = message_box(self, tr("Details"), self._text.text())
        box.setDetailedText(NAMES.without_names(self._details))
        box.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        box.open()

    def _uncover(self) -> None:
        """Show the newest message that is still true, or nothing."""
        if self._standing:
            topic, (error, verdict) = list(self._standing.items())[-1]
            self.show_until(topic, error, verdict)
        else:
            self._note.stop()
            self._topic = ""
            self.hide()

    def _show(self, verdict: str, text: str, details: str) -> None:
        self._note.stop()
        self._topic = ""
        colour, symbol = theme.VERDICTS[verdict]
        self._symbol.setText(symbol)
        self._symbol.setStyleSheet(f"color: {colour}; font-size: {theme.FONT_PX}px;")
        self.setStyleSheet(
            f"MessageBar {{ background: {theme.RAISED}; border-bottom: 2px solid {colour}; }}"
        )
        self._line = " ".join(text.split())
        self._details = details or (text if len(self._line) > LONGEST else "")
        self._more.setVisible(bool(self._details))
        self._write()
        self.show()

    def _write(self) -> None:
        """Write the message, without names while they are hidden."""
        line = NAMES.without_names(self._line)
        self._text.setText(line if len(line) <= LONGEST else line[: LONGEST - 1] + "…")
