"""The status strip, each part's health as symbol, words and colour; and events as lines with their
time.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import cos, pi, sin
from typing import Final

from PySide6.QtCore import QEvent, QObject, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFont,
    QFontMetrics,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
)
from PySide6.QtWidgets import (
    QAbstractButton,
    QHBoxLayout,
    QListWidget,
    QListWidgetItem,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from app.core.events import Event
from app.session.attempt_clock import AttemptClock
from app.views.exercise.readouts import clock_text
from app.views.kit import theme
from app.views.kit.names import NAMES
from app.views.kit.progress_strip import ElidedLabel
from app.views.kit.text import literal, tr, translated
from app.views.kit.verdict import StatusItem, Verdict

LONGEST: Final = 200
"""Lines kept; older ones are in the record."""

TITLE_PX: Final = 170
"""Width [px] up to which a title is whole, whatever is left for the values."""

_LINE: Final = Qt.ItemDataRole.UserRole
_COLOUR: Final = Qt.ItemDataRole.UserRole + 1
"""The line as it came, names and all, and its colour in any theme."""

_LIGHT: Final = 26
"""Size of the robot's light [px]."""

_LOOKS: Final = {
    "state": (theme.TEXT, "•"),
    "scan": (theme.ACCENT, "▼"),
    "breath": (theme.ACCENT, "•"),
    "taken_over": (theme.ACCENT, "◇"),
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
        self._clock = AttemptClock()
        self.setWordWrap(True)
        self.setAccessibleName(tr("Messages"))
        NAMES.changed.connect(self.suit_room)

    def start_clock(self) -> None:
        """Begin to count anew: until the attempt's own clock starts, times are left out."""
        self._clock = AttemptClock()

    def add_event(self, event: Event) -> None:
        """Append an event; the list keeps its last `LONGEST` lines and stays at its end."""
        colour, symbol = _LOOKS.get(event.kind, (theme.TEXT_DIM, "•"))
        self._clock = self._clock.after(event)
        known = self._clock.began is not None and event.time >= self._clock.began
        when = clock_text(self._clock.at(event.time)) + "  " if known else ""
        line = f"{symbol} {when}{translated(event.message)}"
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


class RobotLight(QAbstractButton):
    """One light with a word for everything of the robot, told apart by shape as well as by colour.

    A disc with a tick: ready; a triangle: held back; an octagon with a cross: stopped; a ring: no
    robot. A click shows what it stands for, and hides it again.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._item: StatusItem | None = None
        self.setCheckable(True)
        self.setFocusPolicy(Qt.FocusPolicy.TabFocus)
        self.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Preferred)
        self.toggled.connect(lambda _: self.updateGeometry())
        self.toggled.connect(lambda _: self._explain())

    @property
    def item(self) -> StatusItem | None:
        """Return what is shown."""
        return self._item

    @property
    def _words(self) -> str:
        """Return what is said beside the light, as far as there is room: no text of a button, whose
        whole is to be seen.
        """
        return "" if self._item is None else self._item.title

    def show_item(self, item: StatusItem) -> None:
        """Show how the robot is; does nothing when that is shown."""
        if item == self._item:
            return
        self._item = item
        self.setAccessibleName(item.title)
        self._explain()
        self.updateGeometry()
        self.update()

    def _explain(self) -> None:
        """Say to whoever points there what the light stands for: all of it with the details."""
        if self._item is None:
            return
        help_text = f"{self._item.help}\n\n" if self.isChecked() else ""
        click = tr("Click: with details, or without")
        self.setToolTip(literal(f"{self._item.title}\n\n{help_text}{click}"))

    def sizeHint(self) -> QSize:
        """Room for light and words; for the light alone beside the details."""
        words = 0 if self.isChecked() else self._metrics().horizontalAdvance(self._words) + 10
        return QSize(_LIGHT + 8 + words, _LIGHT + 8)

    def minimumSizeHint(self) -> QSize:
        """Room for the light; where there is little the words end in an ellipsis."""
        words = 0 if self.isChecked() else 8 * theme.FONT_PX
        return QSize(_LIGHT + 8 + words, _LIGHT + 8)

    def _metrics(self) -> QFontMetrics:
        font = QFont(self.font())
        font.setPixelSize(theme.FONT_PX)
        font.setBold(True)
        return QFontMetrics(font)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw shape and words."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        verdict = Verdict.IDLE if self._item is None else self._item.verdict
        colour = QColor(verdict.colour_and_symbol[0])
        centre = QPointF(4 + _LIGHT / 2, self.height() / 2)
        painter.setPen(QPen(colour, 2.0))
        painter.setBrush(Qt.BrushStyle.NoBrush if verdict is Verdict.IDLE else colour)
        reach = _LIGHT / 2 - 1
        if verdict in (Verdict.GOOD, Verdict.IDLE):
            painter.drawEllipse(centre, reach, reach)
        else:
            painter.drawPolygon(_corners(centre, reach, 3 if verdict is Verdict.WARNING else 8))
        ground = QColor(theme.now(theme.BACKGROUND))
        font = QFont(self.font())
        font.setBold(True)
        font.setPixelSize(_LIGHT - 8)
        painter.setFont(font)
        painter.setPen(ground)
        sign = {Verdict.GOOD: "✔", Verdict.WARNING: "!", Verdict.BAD: "✖"}.get(verdict, "")
        box = QRectF(centre.x() - reach, centre.y() - reach, 2 * reach, 2 * reach)
        below = 2.0 if verdict is Verdict.WARNING else 0.0
        painter.drawText(box.translated(0.0, below), Qt.AlignmentFlag.AlignCenter, sign)
        if self.hasFocus():
            painter.setPen(QPen(QColor(theme.now(theme.ACCENT)), 1.0))
            painter.setBrush(Qt.BrushStyle.NoBrush)
            painter.drawRect(self.rect().adjusted(0, 0, -1, -1))
        if self.isChecked():
            return
        font.setPixelSize(theme.FONT_PX)
        painter.setFont(font)
        painter.setPen(QColor(theme.now(theme.TEXT)))
        room = self.rect().adjusted(_LIGHT + 10, 0, 0, 0)
        words = self._metrics().elidedText(self._words, Qt.TextElideMode.ElideRight, room.width())
        painter.drawText(room, Qt.AlignmentFlag.AlignVCenter | Qt.AlignmentFlag.AlignLeft, words)


def _corners(centre: QPointF, reach: float, count: int) -> QPolygonF:
    """Regular polygon; a triangle on its base, an octagon on its side."""
    first = -pi / 2 if count == 3 else pi / count
    turns = (first + 2.0 * pi * i / count for i in range(count))
    return QPolygonF([centre + QPointF(reach * cos(turn), reach * sin(turn)) for turn in turns])


class StatusStrip(QWidget):
    """Cells beside each other; their tooltips say what the value means and what to do.

    A student sees one light for the robot, and of the rest what concerns a hand; the whole strip
    is one click on the light away.

    Signals:
        detailed(bool): the user wants all details, or no longer.
        shown(items, robot): what is shown now, of the parts and of the robot (None: no light).
    """

    detailed = Signal(bool)
    shown = Signal(object, object)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._cells: list[StatusCell] = []
        self._items: tuple[StatusItem, ...] = ()
        self.light = RobotLight(self)
        self.light.setChecked(True)
        self.light.hide()
        self.light.toggled.connect(self._show_details)
        self._row = QHBoxLayout(self)
        self._row.setContentsMargins(theme.MARGIN, 3, theme.MARGIN, 3)
        self._row.setSpacing(2 * theme.SPACING)
        self._row.addWidget(self.light)
        self._row.addStretch(1)
        # Its height is kept while there is nothing to say, so that the panes stay where they are.
        cell = StatusCell(self)
        cell.show_item(StatusItem(Verdict.IDLE, tr("Status"), tr("Status"), ""))
        cell.ensurePolished()
        self.setMinimumHeight(cell.sizeHint().height() + 6)
        self._keep(cell)
        cell.hide()
        self.setAccessibleName(tr("Status"))

    def show_items(self, items: Sequence[StatusItem], robot: StatusItem | None = None) -> None:
        """Show these items in this order, and how the robot is, if there is an answer to that."""
        self._items = tuple(items)
        self.light.setVisible(robot is not None)
        if robot is not None:
            self.light.show_item(robot)
        self._show()
        items = (
            self._items if self.is_detailed else tuple(item.for_student() for item in self._items)
        )
        self.shown.emit(items, robot)

    @property
    def is_detailed(self) -> bool:
        """Return whether all details are shown."""
        return self.light.isChecked()

    def set_detailed(self, detailed: bool) -> None:
        """Show all details, or what concerns a student."""
        self.light.setChecked(detailed)

    def _show_details(self, detailed: bool) -> None:
        self._show()
        self.detailed.emit(detailed)

    def _show(self) -> None:
        detailed = self.is_detailed
        shown = [
            item
            for item in self._items
            if detailed or not (item.detail or item.verdict is Verdict.IDLE)
        ]
        while len(self._cells) < len(shown):
            self._keep(StatusCell(self))
        for i, cell in enumerate(self._cells):
            cell.setVisible(i < len(shown))
            if i < len(shown):
                cell.show_item(shown[i], plain=not detailed)

    def _keep(self, cell: StatusCell) -> None:
        self._row.insertWidget(1 + len(self._cells), cell)
        self._cells.append(cell)


class StatusCell(QWidget):
    """Symbol and title above the value."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._item: StatusItem | None = None
        self._plain = False
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

    def show_item(self, item: StatusItem, plain: bool = False) -> None:
        """Show an item, in plain words if wanted; does nothing when it is the one shown."""
        if item == self._item and plain == self._plain:
            return
        if self._item is None or self._item.title != item.title or plain != self._plain:
            self._widest = 0  # of what stood here
        self._plain = plain
        colour, symbol = item.verdict.colour_and_symbol
        if self._item is None or self._item.verdict is not item.verdict:
            self._title.setStyleSheet(
                f"color: {colour}; font-size: {theme.SMALL_PX}px; font-weight: 600;"
            )
        self._item = item
        self._title.set_whole(f"{symbol} {item.title}")
        text = item.for_student().text if plain else item.text
        self._text.set_whole(text)
        self._grow()
        self.setToolTip(literal(f"{item.title}: {text}\n\n{item.help}"))
        self.setAccessibleName(f"{item.title}: {text}")

    @property
    def item(self) -> StatusItem | None:
        """Return what is shown."""
        return self._item
