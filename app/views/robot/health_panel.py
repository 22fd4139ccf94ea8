"""The technician's panel: every part of the robot as a line, two running curves, a report."""

from __future__ import annotations

from collections import deque
from collections.abc import Sequence
from datetime import datetime
from math import isfinite
from typing import Final

from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFont, QGuiApplication, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import (
    QFrame,
    QHBoxLayout,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from app import __version__
from app.device.wire_watch import WireWatch
from app.session.snapshot import Snapshot
from app.views.exercise.run import ExerciseRun
from app.views.kit import theme
from app.views.kit.parts import PlainLabel
from app.views.kit.text import literal, moment, tr
from app.views.kit.verdict import StatusItem
from app.views.robot.health import HealthGroup, Rates, health

SPAN: Final = 10.0
"""Time that is shown [s]."""

_TITLE: Final = 20
_LOOKS: Final = ((theme.NEEDLE_TIP.colour, ()), (theme.NEEDLE.colour, (4.0, 2.0)))
_SMALLEST: Final = 1e-9


class Trace(QWidget):
    """The scale grows with the values and shrinks when they have left; dashes tell right apart."""

    def __init__(self, title: str, unit: str, smallest: float, parent: QWidget) -> None:
        """Name the curve; its scale is never finer than ±`smallest` [unit]."""
        super().__init__(parent)
        self._title, self._unit = title, unit
        self._smallest = max(smallest, _SMALLEST)
        self._points: deque[tuple[float, float, float]] = deque()
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Fixed)

    def sizeHint(self) -> QSize:
        """Preferred size."""
        return QSize(240, 84)

    def add(self, time: float, left: float, right: float) -> None:
        """Add a moment [s]; values that are not finite leave a gap, going back in time clears."""
        if self._points and time < self._points[-1][0]:
            self._points.clear()
        self._points.append((time, left, right))
        while self._points[0][0] < time - SPAN:
            self._points.popleft()
        self.update()

    @property
    def scale(self) -> float:
        """Value at the upper edge."""
        sizes = [abs(v) for point in self._points for v in point[1:] if isfinite(v)]
        return max(self._smallest, *sizes) if sizes else self._smallest

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw frame, zero line, both curves and the words."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        font = QFont(painter.font())
        font.setPixelSize(theme.SMALL_PX)
        painter.setFont(font)
        box = QRectF(0, _TITLE, self.width() - 1, self.height() - _TITLE - 2)
        painter.fillRect(box, QColor("#0e1114"))
        painter.setPen(QPen(QColor(theme.IMAGE_LINE), 1.0))
        painter.drawRect(box)
        painter.drawLine(
            QPointF(box.left(), box.center().y()), QPointF(box.right(), box.center().y())
        )
        scale = self.scale
        for side, (colour, dashes) in enumerate(_LOOKS):
            pen = QPen(QColor(colour), 1.5)
            if dashes:
                pen.setDashPattern(list(dashes))
            painter.setPen(pen)
            for line in self._lines(box, side, scale):
                painter.drawPolyline(line)
        title = QRectF(0, 0, self.width(), _TITLE)
        painter.setPen(QColor(theme.TEXT))
        painter.drawText(title, Qt.AlignmentFlag.AlignLeft, self._title)
        painter.setPen(QColor(theme.TEXT_DIM))
        words = tr("— left  - - right   ±{scale:.3g} {unit}", scale=scale, unit=self._unit)
        painter.drawText(title, Qt.AlignmentFlag.AlignRight, words)

    def _lines(self, box: QRectF, side: int, scale: float) -> list[QPolygonF]:
        """Unbroken stretches of one side's curve."""
        lines = [QPolygonF()]
        if not self._points:
            return lines
        newest = self._points[-1][0]
        for point in self._points:
            value = point[1 + side]
            if not isfinite(value):
                lines.append(QPolygonF())
                continue
            x = box.right() - (newest - point[0]) / SPAN * box.width()
            y = box.center().y() - 0.48 * box.height() * value / scale
            lines[-1].append(QPointF(x, y))
        return [line for line in lines if line.count() > 1]


PERIOD = 0.25
"""Words are refreshed this often [s]; curves at every poll."""

TITLE_WIDTH = 144


class HealthPanel(QWidget):
    """Shows nothing by itself: `show_snapshot` is called at every poll.

    Signals:
        commissioning_wanted(): the technician asks for the wizard.
    """

    commissioning_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.groups: tuple[HealthGroup, ...] = ()
        self._watch = WireWatch()
        self._shown = -1e9
        self._sections: list[_Section] = []
        self.torque = Trace(tr("Torque"), "N·m", 0.05, self)
        self.speed = Trace(tr("Speed"), "rad/s", 0.5, self)
        self.copy = QPushButton(tr("Copy report"), self)
        self.copy.setToolTip(tr("Copies everything on this page as plain text"))
        self.commission = QPushButton(tr("Commissioning…"), self)
        self._empty = PlainLabel(self)
        self._empty.setWordWrap(True)
        self._lay_out()
        self.copy.clicked.connect(self.copy_report)
        self.commission.clicked.connect(self.commissioning_wanted)
        self.set_starting(False)
        self.clear()

    def show_snapshot(
        self, run: ExerciseRun, snapshot: Snapshot, rates: tuple[float, float], now: float
    ) -> None:
        """Show a moment.

        Args:
            run: of the robot.
            snapshot: newest.
            rates: of the loop [Hz], and share of deadlines missed of late.
            now: [s].
        """
        device = snapshot.device
        wire = self._watch.read(device.row, now) if device is not None else None
        if not self.isVisible():
            return
        if device is not None:
            self.torque.add(now, *device.torque.tolist())
            self.speed.add(now, *device.qd.tolist())
        if now - self._shown >= PERIOD:
            self._shown = now
            self._fill(health(run, snapshot, Rates(*rates, wire)))

    def clear(self) -> None:
        """Say that there is no robot."""
        self._watch, self._shown = WireWatch(), -1e9
        self._fill(())

    def set_starting(self, starting: bool) -> None:
        """Say, while there is no robot, whether one is on its way."""
        none = tr("No robot is running: open a patient with a plan.")
        self._empty.setText(tr("The robot is starting…") if starting else none)

    def report(self, when: datetime) -> str:
        """Everything on the page as plain text."""
        lines = [
            tr("Acus {version}: health of the robot", version=__version__),
            moment(when),
        ]
        for group in self.groups:
            lines += ["", group.title]
            lines += [
                f"  {i.verdict.colour_and_symbol[1]} {i.title}: {i.text}" for i in group.items
            ]
        return "\n".join(lines) + "\n"

    def copy_report(self) -> None:
        """Put the report on the clipboard."""
        QGuiApplication.clipboard().setText(self.report(datetime.now().astimezone()))

    def _fill(self, groups: Sequence[HealthGroup]) -> None:
        self.groups = tuple(groups)
        while len(self._sections) < len(groups):
            section = _Section(self)
            self._column.insertWidget(len(self._sections), section)
            self._sections.append(section)
        for i, section in enumerate(self._sections):
            section.setVisible(i < len(groups))
            if i < len(groups):
                section.show_group(groups[i])
        for widget in (self.torque, self.speed):
            widget.setVisible(bool(groups))
        self._empty.setVisible(not groups)
        self.copy.setEnabled(bool(groups))

    def _lay_out(self) -> None:
        content = _Content(self)
        self._column = QVBoxLayout(content)
        self._column.setContentsMargins(theme.MARGIN, theme.SPACING, theme.MARGIN, theme.SPACING)
        self._column.setSpacing(theme.SPACING)
        for widget in (self._empty, self.torque, self.speed):
            self._column.addWidget(widget)
        self._column.addStretch(1)
        area = QScrollArea(self)
        area.setFrameShape(QFrame.Shape.NoFrame)
        area.setWidgetResizable(True)
        area.setHorizontalScrollBarPolicy(Qt.ScrollBarPolicy.ScrollBarAlwaysOff)
        area.setWidget(content)
        buttons = QHBoxLayout()
        buttons.setContentsMargins(theme.MARGIN, 0, theme.MARGIN, theme.SPACING)
        buttons.addWidget(self.copy)
        buttons.addWidget(self.commission)
        page = QVBoxLayout(self)
        page.setContentsMargins(0, 0, 0, 0)
        page.addWidget(area, 1)
        page.addLayout(buttons)


class _Content(QWidget):
    """As high as its wrapped words need at its width: a scroll area alone would squeeze them."""

    def event(self, event: QEvent) -> bool:
        """Follow another width and other words."""
        done = super().event(event)
        layout = self.layout()
        if layout is not None and event.type() in (QEvent.Type.Resize, QEvent.Type.LayoutRequest):
            self.setMinimumHeight(layout.heightForWidth(self.width()))
        return done


class _Section(QFrame):
    """Title and lines of one group."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._title = PlainLabel(self)
        self._title.setProperty("role", "heading")
        self._lines: list[_Line] = []
        self._column = QVBoxLayout(self)
        self._column.setContentsMargins(0, 0, 0, 0)
        self._column.setSpacing(2)
        self._column.addWidget(self._title)

    def show_group(self, group: HealthGroup) -> None:
        """Show a group."""
        self._title.setText(group.title)
        while len(self._lines) < len(group.items):
            line = _Line(self)
            self._lines.append(line)
            self._column.addWidget(line)
        for i, line in enumerate(self._lines):
            line.setVisible(i < len(group.items))
            if i < len(group.items):
                line.show_item(group.items[i])


class _Line(QWidget):
    """Symbol and title to the left, value to the right; what to do as a tooltip and, if it is not
    well, below.
    """

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent)
        self._item: StatusItem | None = None
        self._title, self._text, self._help = PlainLabel(self), PlainLabel(self), PlainLabel(self)
        self._title.setFixedWidth(theme.px(TITLE_WIDTH))
        self._title.setAlignment(Qt.AlignmentFlag.AlignTop)
        for label in (self._title, self._text, self._help):
            label.setWordWrap(True)
        self._text.setTextInteractionFlags(Qt.TextInteractionFlag.TextSelectableByMouse)
        self._help.setProperty("role", "dim")
        row = QHBoxLayout()
        row.setContentsMargins(0, 0, 0, 0)
        row.addWidget(self._title)
        row.addWidget(self._text, 1)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.setSpacing(0)
        column.addLayout(row)
        column.addWidget(self._help)

    def changeEvent(self, event: QEvent) -> None:
        """Follow another size of the text."""
        super().changeEvent(event)
        if event.type() is QEvent.Type.StyleChange:
            self._title.setFixedWidth(theme.px(TITLE_WIDTH))

    def show_item(self, item: StatusItem) -> None:
        """Show an item; does nothing when it is the one shown."""
        if item == self._item:
            return
        self._item = item
        colour, symbol = item.verdict.colour_and_symbol
        self._title.setText(f"{symbol} {item.title}")
        self._title.setStyleSheet(f"color: {colour}; font-size: {theme.SMALL_PX}px;")
        self._text.setText(item.text)
        self._text.setStyleSheet(f"font-size: {theme.SMALL_PX}px;")
        self._help.setText(item.help)
        self._help.setVisible(item.verdict.value in ("warning", "bad"))
        self.setToolTip(literal(item.help))
        self.setAccessibleName(f"{item.title}: {item.text}")
