"""The rail beside the pictures of an attempt: stage, order, time, depth, force, and its buttons.

All that is read while a needle goes in, in three sizes of type, one accent and steps of eight
pixels; everything else is put away until the attempt is over, or somebody asks for it.
"""

from __future__ import annotations

from collections.abc import Sequence
from typing import Final

from PySide6.QtCore import QPointF, QRectF, QSize, Qt, Signal
from PySide6.QtGui import QColor, QFontMetrics, QPainter, QPaintEvent, QPen, QResizeEvent
from PySide6.QtWidgets import (
    QGridLayout,
    QPushButton,
    QScrollArea,
    QSizePolicy,
    QVBoxLayout,
    QWidget,
)

from app.session.machine import State
from app.views.exercise.breath_strip import BreathStrip
from app.views.exercise.live import LiveFigures
from app.views.exercise.readouts import OFFSETS, ForceBar, figure_texts
from app.views.exercise.stages import Stages
from app.views.kit import theme
from app.views.kit.parts import FittingButton, PlainLabel
from app.views.kit.progress_strip import ElidedLabel
from app.views.kit.side_panel import scrolled
from app.views.kit.text import literal, tr
from app.views.kit.verdict import StatusItem, Verdict

WIDEST_SHARE: Final = 0.17
"""Of the window's width, at most: the pictures have the rest."""

WIDEST_PX: Final = 352
"""On large screens, with text of the usual size."""

NARROWEST_PX: Final = 200
"""In the smallest windows, which have more for the rail than its share: its words need it."""

GRID: Final = 8
"""Margins, gaps and widths are whole numbers of so many pixels."""

ORDER_LINES: Final = 5
"""Lines of the order, in the largest letters: the block below never moves."""

LONGEST: Final = "-188.8 mm"
"""What a number of the rail is as wide as."""

_DISC: Final = 8.0
_INDENT: Final = 8  # a label's own, beside its padding [px]


def rail_width(window: int) -> int:
    """Return the width of the rail in a window [px]."""
    widest = max(NARROWEST_PX, min(WIDEST_SHARE * window, WIDEST_PX * theme.scale()))
    return int(widest) // GRID * GRID


class StageLine(Stages):
    """Discs for what is done, now and to come, and the name of now below them."""

    def sizeHint(self) -> QSize:
        """Preferred size."""
        return QSize(160, 3 * GRID + theme.FONT_PX + GRID)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw discs and name."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        step = (self.width() - 2 * _DISC - 2) / max(1, len(self._order) - 1)
        y, accent, line = _DISC + 1.0, QColor(theme.ACCENT), QColor(theme.BORDER)
        painter.setPen(QPen(line, 2.0))
        painter.drawLine(QPointF(_DISC, y), QPointF(self.width() - _DISC, y))
        for number in range(len(self._order)):
            here = number == self._reached and self._state is not None
            done = number < self._reached
            painter.setPen(QPen(accent if here or done else line, 2.0))
            painter.setBrush(accent if done else QColor(theme.BACKGROUND))
            at = QPointF(_DISC + 1.0 + number * step, y)
            painter.drawEllipse(at, _DISC if here else 5.0, _DISC if here else 5.0)
            if here and self.ring.turns:
                self.ring.draw(
                    painter, QRectF(at.x() - _DISC, at.y() - _DISC, 2 * _DISC, 2 * _DISC)
                )
            elif here:
                painter.setBrush(accent)
                painter.drawEllipse(at, 4.0, 4.0)
        painter.setFont(theme.font_of(theme.FONT_PX, bold=True))
        painter.setPen(QColor(theme.WARNING if self._state is State.PAUSED else theme.TEXT))
        below = QRectF(0.0, 3.0 * GRID, self.width(), theme.FONT_PX + GRID)
        painter.drawText(below, Qt.AlignmentFlag.AlignLeft, self.word)


class OrderBlock(PlainLabel):
    """The one thing to do next, as large as fits, in the accent colour; always the same height."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.setWordWrap(True)
        self.setAlignment(Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter)
        self.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Fixed)
        self.setAccessibleName(tr("Next step"))
        self._good = False

    def say(self, words: str, good: bool = False) -> None:
        """Say what is next; `good`: that something was reached, in another colour."""
        if (words, good) == (self.text(), self._good):
            return
        self._good = good
        self.setText(words)
        self.setToolTip(literal(words))
        self.fit()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Take letters that fit the new width."""
        super().resizeEvent(event)
        self.fit()

    def fit(self) -> None:
        """Take the largest letters in which all of it can be read; if none, more height."""
        high = ORDER_LINES * QFontMetrics(theme.font_of(theme.TITLE_PX, bold=True)).lineSpacing()
        self.setFixedHeight((high + 2 * GRID) // GRID * GRID)
        room = self.width() - 2 * GRID - _INDENT
        sizes = (theme.TITLE_PX, theme.FONT_PX, theme.SMALL_PX)
        fitting = (px for px in sizes if _fits(self.text(), px, room, self.height() - 2 * GRID))
        pixels = next(fitting, theme.SMALL_PX)
        ground = theme.now(theme.GOOD if self._good else theme.ACCENT)
        style = (
            f"background: {ground}; color: {theme.now(theme.BACKGROUND)}; font-size: {pixels}px;"
            f" font-weight: 600; padding: {GRID}px; border-radius: {GRID // 2}px;"
        )
        if style != self.styleSheet():
            self.setStyleSheet(style)
        self.ensurePolished()
        tall = max(self.height(), self.heightForWidth(self.width()))
        self.setFixedHeight(-(-tall // GRID) * GRID)


def _fits(words: str, pixels: int, width: int, height: int) -> bool:
    metrics, flags = QFontMetrics(theme.font_of(pixels, bold=True)), Qt.TextFlag.TextWordWrap
    box = metrics.boundingRect(0, 0, max(1, width), 10_000, int(flags), words)
    return box.height() <= height and box.width() <= width


class RailFigures(QWidget):
    """Time, depth, the way left and the scans: small names, large numbers, two in a row where two
    have room.
    """

    SHOWN: Final = ("elapsed", "scans", "depth", "to_target")

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._titles: dict[str, PlainLabel] = {}
        self._values: dict[str, PlainLabel] = {}
        self._grid = grid = QGridLayout(self)
        grid.setContentsMargins(0, 0, 0, 0)
        grid.setHorizontalSpacing(GRID)
        grid.setVerticalSpacing(0)
        names = {
            "elapsed": tr("Time"),
            "depth": tr("Depth"),
            "to_target": tr("To target"),
            "scans": tr("Scans"),
        }
        for key in self.SHOWN:
            title, value = ElidedLabel(names[key], self), PlainLabel("–", self)
            title.setSizePolicy(QSizePolicy.Policy.Preferred, QSizePolicy.Policy.Preferred)
            self._titles[key], self._values[key] = title, value
        self.suit_width(0)

    def show_figures(self, figures: LiveFigures | None) -> None:
        """Show a moment; None empties them."""
        texts = {} if figures is None else figure_texts(figures)
        for key, label in self._values.items():
            words = texts.get(key, "–")
            if label.text() != words:
                label.setText(words)

    def set_telling(self, keys: frozenset[str] | None, offsets: bool) -> None:
        """Leave only these, None for all; `offsets`: whether the way left may be told."""
        for key, value in self._values.items():
            shown = (keys is None or key in keys) and (offsets or key not in OFFSETS)
            for label in (value, self._titles[key]):
                label.setVisible(shown)

    def suit_width(self, width: int) -> None:
        """Take the largest letters in which two numbers stand side by side in a width [px]; where
        they do in none, one stands above the other.
        """
        half = (width - GRID) // 2
        large, usual = (
            QFontMetrics(theme.font_of(pixels, bold=True)).horizontalAdvance(LONGEST) <= half
            for pixels in (theme.TITLE_PX, theme.FONT_PX)
        )
        pixels, columns = theme.TITLE_PX if large else theme.FONT_PX, 2 if usual else 1
        for number, key in enumerate(self.SHOWN):
            row, column = 2 * (number // columns), number % columns
            self._grid.addWidget(self._titles[key], row, column)
            self._grid.addWidget(self._values[key], row + 1, column)
        self._grid.setColumnStretch(0, 1)
        self._grid.setColumnStretch(1, columns - 1)
        for label in self._titles.values():
            label.setStyleSheet(f"font-size: {theme.SMALL_PX}px; color: {theme.TEXT_DIM};")
        for label in self._values.values():
            label.setStyleSheet(f"font-size: {pixels}px; font-weight: 600;")


class AttemptRail(QWidget):
    """Stands beside the pictures while an attempt runs.

    Signals:
        panel_wanted(): the side panel is to come back, or to go again.
        pictures_wanted(): the live pictures are to come back in place of a scan, or the scan again.

    Attributes:
        drill: names the drill where one is done.
        order: what is to be done next.
        breath: how the patient breathes.
    """

    panel_wanted = Signal()
    pictures_wanted = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self.drill = ElidedLabel("", self)
        self.stage, self.order = StageLine(self), OrderBlock(self)
        self.figures, self.force = RailFigures(self), ForceBar(self)
        self.breath = BreathStrip(self)
        self.pictures = _quiet()
        self.panel = _quiet()
        self._place, self._foot = QVBoxLayout(), QVBoxLayout()
        self._note, self._health, self._busy = (PlainLabel(self) for _ in range(3))
        self._light = self._slow = ""
        self._lay_out()
        for part in (self._health, self._busy, self.pictures, self.drill):
            part.hide()
        self.pictures.clicked.connect(self.pictures_wanted)
        self.panel.clicked.connect(self.panel_wanted)
        self.hide()

    def begin(self) -> None:
        """Stand at the top again: what is to be done next is said there."""
        self._area.verticalScrollBar().setValue(0)

    def take(self, tools: QWidget, buttons: QWidget) -> None:
        """Let an attempt's tools stand here, and its buttons where no scrolling hides them."""
        self._place.addWidget(tools)
        self._foot.addWidget(buttons)
        for widget in (tools, buttons):
            widget.show()

    def show_figures(self, figures: LiveFigures | None) -> None:
        """Show a moment of the attempt; None without one."""
        self.figures.show_figures(figures)
        self.stage.show_state(
            figures.state if figures else None, figures.ready if figures else False
        )
        if figures is not None:
            self.force.show_force(
                figures.force,
                figures.force_limit,
                figures.force_measured,
                at_most=figures.force_at_most,
            )

    def show_health(self, items: Sequence[StatusItem], robot: StatusItem | None) -> None:
        """Say what is not well of the robot and the other parts; nothing while all is.

        Where the simulated world is slowed that alone is said: it is why pictures come late.
        """
        if self._slow:
            items = [item for item in items if item.verdict is Verdict.BAD]
        ill = [item for item in (robot, *items) if item is not None and not item.detail]
        ill = [item for item in ill if item.verdict in (Verdict.WARNING, Verdict.BAD)]
        worst = sorted(ill, key=lambda item: item.verdict is not Verdict.BAD)[:1]
        words = "".join(_health(item) for item in worst)
        if words != self._health.text():
            self._health.setText(words)
            self._health.setToolTip(literal(worst[0].help) if worst else "")
            self._health.setVisible(bool(words))

    def set_busy(self, busy: bool, has_scene: bool = True) -> None:
        """Say quietly that less is drawn because the computer is busy, or no more.

        `has_scene`: whether there is a 3D view to be seen.
        """
        self._light = ""
        if busy and has_scene:
            self._light = tr(
                "This computer is busy: the 3D view stands still. Close other programs."
            )
        elif busy:
            self._light = tr(
                "This computer is busy: pictures come less often. Close other programs."
            )
        self._say_busy()

    def set_slowed(self, share: float) -> None:
        """Say that patient, needle and clock go on with a share of their speed; 1 for all of it."""
        self._slow = ""
        if share < 1.0:
            self._slow = tr(
                "This computer is busy: needle, patient and clock run at {percent} % of their "
                "speed. It costs you nothing. Close other programs."
            ).format(percent=round(100.0 * share))
        self._say_busy()

    def _say_busy(self) -> None:
        words = self._slow or self._light  # the slower time is what the student feels
        self._busy.setText(words)
        self._busy.setVisible(bool(words))

    def set_drill(self, words: str) -> None:
        """Name the drill that is done, above all else; empty where none is."""
        self.drill.set_whole(words)
        self.drill.setVisible(bool(words))

    def set_note(self, words: str) -> None:
        """Say at the foot what is always to be said: what this program is not for."""
        self._note.setText(words)

    def suit_window(self, width: int) -> None:
        """Take the width that belongs to a window's [px], and what depends on it."""
        self.setFixedWidth(rail_width(width))
        # As wide without a scroll bar as beside one: an order that is higher where it is narrower
        # would call the bar, and send it away, without end.
        wide = self.width() - self._area.verticalScrollBar().sizeHint().width()
        self._inner.setFixedWidth(wide)
        self.order.fit()
        self.figures.suit_width(wide - 2 * GRID)

    def _lay_out(self) -> None:
        self._inner = inner = QWidget(self)
        column = QVBoxLayout(inner)
        column.setContentsMargins(GRID, GRID, GRID, GRID)
        column.setSpacing(GRID)
        # The way back from a scan stands where it is seen without scrolling.
        top = (self.drill, self.stage, self.order, self.pictures)
        for widget in (*top, self.figures, self.force, self.breath):
            column.addWidget(widget)
        column.addLayout(self._place)
        column.addStretch(1)
        self._health.setWordWrap(True)
        column.addWidget(self._health)
        self._busy.setWordWrap(True)
        self._busy.setProperty("role", "dim")
        column.addWidget(self._busy)
        column.addWidget(self.panel)
        self._note.setWordWrap(True)
        self._note.setProperty("role", "dim")
        column.addWidget(self._note)
        self._area: QScrollArea = scrolled(inner, self)
        outer = QVBoxLayout(self)
        outer.setContentsMargins(0, 0, 0, 0)
        outer.setSpacing(0)
        outer.addWidget(self._area, 1)
        self._foot.setContentsMargins(GRID, GRID, GRID, GRID)
        outer.addLayout(self._foot)


def _health(item: StatusItem) -> str:
    symbol = item.verdict.colour_and_symbol[1]
    return f"{symbol} {item.title}: {item.text}" if item.text else f"{symbol} {item.title}"


def _quiet() -> QPushButton:
    """Return a button whose words follow what it would do now."""
    button = FittingButton("")
    # A button that keeps the focus would swallow the pad's keys.
    button.setFocusPolicy(Qt.FocusPolicy.TabFocus)
    return button
