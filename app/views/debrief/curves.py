"""Curves of an attempt: depth, distance from the path, angle and force over one time axis.

States are shaded behind the curves, events stand upon them, and the pointer reads all at once.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np
import pyqtgraph as pg
from pyqtgraph.GraphicsScene.mouseEvents import MouseClickEvent
from PySide6.QtCore import QEvent, QObject, QPointF, Qt, QTimer, Signal
from PySide6.QtGui import QColor, QPen
from PySide6.QtWidgets import QGraphicsRectItem, QSizePolicy, QVBoxLayout, QWidget

from app.core.arrays import FloatArray
from app.session.review import Review
from app.session.timeline import Span, TimeMark
from app.views.debrief.path_view import FORCE_COLOUR
from app.views.exercise.felt import origin_word
from app.views.exercise.stages import phase_word
from app.views.kit import theme
from app.views.kit.parts import PlainLabel
from app.views.kit.text import literal, number, tr, translated
from app.views.kit.themes import DARK

SHORTEST_S: Final = 0.05
"""Shortest time axis [s]."""


@dataclass(frozen=True, slots=True, eq=False)
class Curve:
    """One plot.

    Attributes:
        title: what it shows, with the unit.
        values: shape (n,), in the unit of the title.
        colour: of the line.
        line: level drawn across the plot; None for none.
        line_name: what that level is.
        unit: for the read-out.
        name: for the read-out.
    """

    title: str
    values: FloatArray
    colour: str
    line: float | None
    line_name: str
    unit: str
    name: str


def curves_of(review: Review) -> tuple[Curve, ...]:
    """Return the plots of an attempt: depth, two errors, and the force if something could push."""
    c = review.curves
    # Where many targets are touched, each has a depth of its own: no line is the target's.
    target_mm = None if review.touches else 1e3 * review.placed.length
    return (
        Curve(
            tr("Depth [mm]"),
            1e3 * c.depth,
            theme.NEEDLE.colour,
            target_mm,
            "" if target_mm is None else tr("target {mm:.0f} mm", mm=target_mm),
            "mm",
            tr("depth"),
        ),
        Curve(
            tr("Off the path [mm]"),
            1e3 * c.lateral,
            theme.NEEDLE_TIP.colour,
            None,
            "",
            "mm",
            tr("off the path"),
        ),
        Curve(
            tr("Angle error [°]"),
            np.degrees(c.angle),
            theme.PATH.colour,
            None,
            "",
            "°",
            tr("angle"),
        ),
        *([_force_curve(review)] if review.renders else []),
    )


def _force_curve(review: Review) -> Curve:
    """Curve of the force, as the gauge measured it where there was one, else estimated."""
    force, origin = review.measured_force, origin_word(review.measured_force is not None)
    return Curve(
        tr("Force felt, {origin} [N]", origin=origin),
        review.curves.felt if force is None else np.abs(force),
        FORCE_COLOUR,
        review.force_limit,
        tr("limit {n:g} N", n=review.force_limit),
        "N",
        tr("{origin} force", origin=origin),
    )


def time_end(time: FloatArray) -> float:
    """End of the time axis [s]: the last sample, however short the attempt was."""
    return max(SHORTEST_S, float(time[-1]) if len(time) else 1.0)


def value_range(curve: Curve) -> tuple[float, float]:
    """Range of a plot: all values and the line, with room for the title above."""
    values = curve.values[np.isfinite(curve.values)]
    low = min(0.0, float(values.min(initial=0.0)))
    high = max(float(values.max(initial=0.0)), curve.line or 0.0, low + 1e-3)
    return low - 0.2 * (high - low), high + 0.28 * (high - low)


NEAREST_S: Final = 0.5
"""Curves are zoomed no nearer than this [s] or a tenth of the attempt, and no farther than all."""

_STRETCHES: Final = 1000
"""A long curve is drawn as the extremes of so many stretches: about one a pixel."""

LAST_SHARE: Final = 0.65
"""From this share of the time axis on the name of a level stands over it."""

PHASE_SHADES: Final = {
    "ready": "#1b1f23",
    "withdrawing": "#1b1f23",
    "aligning": "#1d2a38",
    "inserting": "#33291b",
    "holding": "#1d3127",
    "paused": "#2b2233",
    "ended": "#1b1f23",
    "aborted": "#3a1f1f",
}
"""Background of each state, dark enough for any curve on it."""


def prepare(plot: pg.PlotItem, curve: Curve, last: bool) -> None:
    """Set up an empty plot; the last one carries the time axis."""
    plot.setTitle(None)
    plot.hideButtons()
    plot.setMenuEnabled(False)
    plot.setMouseEnabled(x=True, y=False)
    left = plot.getAxis("left")
    left.setWidth(52)
    for axis in (left, plot.getAxis("bottom")):
        axis.setPen(theme.IMAGE_LINE)
        axis.setTextPen(theme.IMAGE_DIM)
        axis.enableAutoSIPrefix(False)  # or a short attempt's seconds become thousandths "(x0.001)"
    plot.showGrid(x=True, y=True, alpha=0.15)
    plot.getAxis("bottom").setStyle(showValues=last)
    if last:
        plot.setLabel("bottom", tr("Time [s]"), color=theme.IMAGE_DIM)
    title = pg.TextItem(curve.title, color=curve.colour, anchor=(0, 0))
    title.setParentItem(plot.getViewBox())
    title.setPos(6, 2)


def peaks(time: FloatArray, values: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Thin a long curve for drawing: of each of `_STRETCHES` stretches the lowest and the highest.

    No peak is lost, and a gap stays where a stretch holds nothing else. A short curve stays whole.

    Args:
        time: of the samples, shape (n,).
        values: shape (n,), NaN where there is none.
    """
    size = len(time) // _STRETCHES
    if size < 4:
        return time, values
    whole = len(time) // size * size
    table = values[:whole].reshape(-1, size)
    low = np.argmin(np.where(np.isnan(table), np.inf, table), axis=1)
    high = np.argmax(np.where(np.isnan(table), -np.inf, table), axis=1)
    rows = np.arange(len(table))[:, None] * size
    picked = (np.sort(np.column_stack((low, high)), axis=1) + rows).ravel()
    keep = np.concatenate(([0], picked, np.arange(whole, len(time))))
    return time[keep], values[keep]


def draw(plot: pg.PlotItem, review: Review, curve: Curve, names: bool) -> None:
    """Draw a curve, its level and the times of the events.

    The level's name stands at the right, away from the curve's; in the middle where the names of
    events are written there, which `names` says.
    """
    if curve.line is not None:
        pen = pg.mkPen(theme.TARGET.colour, width=1.5, style=Qt.PenStyle.DashLine)
        end = time_end(review.curves.time)
        named = names and any(mark.time > LAST_SHARE * end for mark in review.marks)
        place = 0.72 if named else 0.99
        options = {"position": place, "color": theme.TARGET.colour, "anchors": [(1, 1), (1, 1)]}
        line = pg.InfiniteLine(
            curve.line, angle=0, pen=pen, label=curve.line_name, labelOpts=options
        )
        plot.addItem(line)
    time, values = peaks(review.curves.time, curve.values)
    plot.plot(time, values, pen=pg.mkPen(curve.colour, width=2), connect="finite")
    for mark in review.marks:
        pen = pg.mkPen(theme.IMAGE_TEXT, width=1.2, style=Qt.PenStyle.DotLine)
        plot.addItem(pg.InfiniteLine(mark.time, angle=90, pen=pen))
    low, high = value_range(curve)
    plot.setYRange(low, high, padding=0.0)
    if len(review.curves.time):
        end = time_end(review.curves.time)
        room = 0.02 * end
        plot.setLimits(xMin=-room, xMax=end + room, minXRange=min(NEAREST_S, 0.1 * end))
        plot.setXRange(0.0, end, padding=0.01)


def shade(plot: pg.PlotItem, review: Review, curve: Curve, names: bool) -> None:
    """Colour the states behind a curve; `names` names them and the events."""
    low, high = value_range(curve)
    for span in review.spans:
        region = QGraphicsRectItem(span.start, low, span.end - span.start, high - low)
        region.setPen(QPen(Qt.PenStyle.NoPen))
        region.setBrush(QColor(PHASE_SHADES.get(span.state, theme.IMAGE_GROUND)))
        region.setZValue(-20)
        plot.addItem(region, ignoreBounds=True)
    if names:
        _name(plot, review, low, high)


def _name(plot: pg.PlotItem, review: Review, low: float, high: float) -> None:
    """Name the states below and the events above the first curve."""
    total = time_end(review.curves.time)
    for span in review.spans:
        plot.addItem(PhaseLabel(span, low), ignoreBounds=True)
    for mark in review.marks:
        text = _mark_text(mark, mark.time / total)
        text.setPos(mark.time, high if mark.kind == "scan" else low)
        plot.addItem(text, ignoreBounds=True)


class LocalAxis(pg.AxisItem):
    """An axis whose numbers have the decimal sign of the user's language."""

    review: Review | None = None
    """Whose clock its numbers are told by; None for an axis of no times."""

    def tickValues(
        self, minVal: float, maxVal: float, size: float
    ) -> list[tuple[float, list[float]]]:
        """Return the places of its ticks: round numbers of the student's clock."""
        review = self.review
        if review is None:
            return list(super().tickValues(minVal, maxVal, size))
        low, high = review.shown_time(minVal), review.shown_time(maxVal)
        if not high > low:
            return []
        levels = super().tickValues(low, high, size * (high - low) / (maxVal - minVal))
        return [(step, [review.curve_time(value) for value in values]) for step, values in levels]

    def tickStrings(self, values: list[float], scale: float, spacing: float) -> list[str]:
        """Return what stands at its ticks."""
        if self.review is not None:
            values = [self.review.shown_time(value) for value in values]
        sign = number(0.5, ".1f").strip("05")
        return [text.replace(".", sign) for text in super().tickStrings(values, scale, spacing)]


class PhaseLabel(pg.TextItem):
    """The name of a phase, in the middle of what is seen of it; hidden where it has no room.

    Args:
        span: of the phase.
        low: where its lower edge stands, in the unit of the plot.
    """

    def __init__(self, span: Span, low: float) -> None:
        super().__init__(phase_word(span.state), color=theme.IMAGE_DIM, anchor=(0.5, 1))
        self._span, self._low = span, low

    def viewTransformChanged(self) -> None:
        """Find the middle of what is seen, and whether the name has room there."""
        super().viewTransformChanged()
        box = self.getViewBox()
        if not isinstance(box, pg.ViewBox):  # not yet in its plot
            return
        first, last = box.viewRange()[0]
        start, end = max(first, self._span.start), min(last, self._span.end)
        wide = box.width() * (end - start) / max(last - first, 1e-12)
        self.setVisible(wide >= self.boundingRect().width())
        self.setPos(0.5 * (start + end), self._low)


def _mark_text(mark: TimeMark, share: float) -> pg.TextItem:
    """Name an event at a share of the time axis, so that nothing of it is cut at the edges.

    Numbers of scans stand on the uppermost line, words of other events above the states' names.
    """
    sign = mark.sign_of(translated(mark.label))
    across = 0.0 if share < 1.0 / 3.0 else 0.5 if share < 2.0 / 3.0 else 1.0
    if mark.kind == "scan":
        return pg.TextItem(sign, color=theme.IMAGE_TEXT, anchor=(min(0.9, max(0.1, across)), 0))
    fill = QColor(theme.IMAGE_GROUND)
    text = pg.TextItem(sign, color=theme.IMAGE_TEXT, anchor=(across, 2.1), fill=fill)
    text.setZValue(5)
    text.setToolTip(literal(translated(mark.label)))
    return text


def cursor_of(plot: pg.PlotItem) -> pg.InfiniteLine:
    """Return the line that follows the pointer, hidden."""
    cursor = pg.InfiniteLine(0.0, angle=90, pen=pg.mkPen(DARK.accent, width=1.0))
    cursor.hide()
    plot.addItem(cursor, ignoreBounds=True)
    return cursor


def now_of(plot: pg.PlotItem) -> pg.InfiniteLine:
    """Return the line at the moment that is replayed, hidden."""
    line = pg.InfiniteLine(0.0, angle=90, pen=pg.mkPen(theme.IMAGE_TEXT, width=2.0))
    line.setZValue(10)
    line.hide()
    plot.addItem(line, ignoreBounds=True)
    return line


Line = tuple[FloatArray, FloatArray]
"""Times [s] and values of a curve, shapes (n,)."""

_BETWEEN: Final = "   ·   "
"""Between two figures that are read out."""

SHORT_S: Final = 2.0
"""Times of an attempt up to this are read out in milliseconds."""


class CurvesView(QWidget):
    """Four plots under each other with one time axis; the pointer reads all of them at once.

    A click goes to that moment; a line through all plots stands where the replay does. A ghost's
    curves are dotted.

    The plots are drawn one after the other, each in its own turn of the event loop: the page is
    there at once and a robot that is on does not miss the window's sign of life.

    Signals:
        drawn(): all plots show the attempt.
        sought(float): a click on a curve: go to that time [s].
    """

    drawn = Signal()
    sought = Signal(float)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._review: Review | None = None
        self._curves: tuple[Curve, ...] = ()
        self._plots: list[pg.PlotItem] = []
        self._cursors: list[pg.InfiniteLine] = []
        self._nows: list[pg.InfiniteLine] = []
        self._ghost: tuple[Line | None, ...] = ()
        self._dotted: list[tuple[pg.PlotItem, pg.PlotDataItem]] = []
        self._time: float | None = None
        self._turn = QTimer(self, interval=0)
        self._turn.timeout.connect(self._draw_next)
        self.readout = PlainLabel(self)
        self.readout.setProperty("role", "dim")
        self.readout.setWordWrap(True)
        self.readout.setMinimumHeight(2 * self.readout.fontMetrics().lineSpacing())
        self.readout.setSizePolicy(QSizePolicy.Policy.Ignored, QSizePolicy.Policy.Minimum)
        self.graphics = pg.GraphicsLayoutWidget(self)
        self.graphics.setBackground(theme.IMAGE_GROUND)
        self.graphics.ci.layout.setSpacing(2)
        self.graphics.scene().sigMouseMoved.connect(self._hover)
        self.graphics.scene().sigMouseClicked.connect(self._clicked)
        self.graphics.installEventFilter(self)
        column = QVBoxLayout(self)
        column.setContentsMargins(0, 0, 0, 0)
        column.addWidget(self.readout)
        column.addWidget(self.graphics, 1)

    def show_review(self, review: Review) -> None:
        """Draw an attempt, from the next turn of the event loop on."""
        self._review, self._curves = review, curves_of(review)
        self._cursors, self._nows, self._ghost, self._dotted = [], [], (), []
        self._time = None
        if len(self._plots) != len(self._curves):  # the last one alone has a time axis
            self.graphics.clear()
            self._plots = []
        for plot in self._plots:
            plot.clear()
        self.readout.setText(
            tr("Point to read, click to go there; the wheel zooms, a double click shows all.")
        )
        self._turn.start()

    def _draw_next(self) -> None:
        """Draw the plot whose turn it is."""
        row, review = len(self._cursors), self._review
        if review is None or row >= len(self._curves):
            self._turn.stop()
            self._draw_ghost()
            self.drawn.emit()
            return
        curve = self._curves[row]
        if row == len(self._plots):
            self._plots.append(self._new_plot(row, curve))
        plot = self._plots[row]
        plot.getAxis("bottom").review = review
        shade(plot, review, curve, names=row == 0)
        draw(plot, review, curve, names=row == 0)
        self._cursors.append(cursor_of(plot))
        self._nows.append(now_of(plot))
        self._stand(self._nows[-1])

    def _new_plot(self, row: int, curve: Curve) -> pg.PlotItem:
        box = pg.ViewBox(enableMenu=False)  # the menus that nobody opens take most of the time
        axes = {side: LocalAxis(side) for side in ("left", "bottom")}
        plot = self.graphics.addPlot(row=row, col=0, viewBox=box, enableMenu=False, axisItems=axes)
        prepare(plot, curve, last=row == len(self._curves) - 1)
        box.sigXRangeChanged.connect(self._follow)
        return plot

    def _follow(self, moved: pg.ViewBox, span: tuple[float, float]) -> None:
        """Give all plots the time axis of the one that was moved.

        Not `setXLink`: it aligns by pixels, and shifts the axis while the plots are not laid out.
        """
        for plot in self._plots:
            if plot.getViewBox() is not moved:
                plot.setXRange(*span, padding=0.0)

    def show_all(self) -> None:
        """Show the whole attempt again."""
        if self._review is not None and self._plots and len(self._review.curves.time):
            self._plots[0].setXRange(0.0, time_end(self._review.curves.time), padding=0.01)

    def show_time(self, time: float) -> None:
        """Stand at a moment [s], and read it while nobody points elsewhere."""
        self._time = time
        for line in self._nows:
            self._stand(line)
        if not any(cursor.isVisible() for cursor in self._cursors):
            self._read_at(time)

    def show_ghost(self, lines: tuple[Line | None, ...]) -> None:
        """Draw dotted curves of another attempt into the plots, in their order; none if empty."""
        self._ghost = lines
        if not self._turn.isActive():
            self._draw_ghost()

    def _stand(self, line: pg.InfiniteLine) -> None:
        if self._time is not None:
            line.setPos(self._time)
            line.show()

    def _draw_ghost(self) -> None:
        for plot, item in self._dotted:
            plot.removeItem(item)
        self._dotted = []
        pen = pg.mkPen(theme.GHOST.colour, width=2, style=Qt.PenStyle.DotLine)
        for plot, line in zip(self._plots, self._ghost, strict=False):
            if line is not None:
                item = pg.PlotDataItem(*peaks(*line), pen=pen, connect="finite")
                plot.addItem(item, ignoreBounds=True)
                self._dotted.append((plot, item))

    def _clicked(self, event: MouseClickEvent) -> None:
        if event.double():
            self.show_all()
        elif event.button() is Qt.MouseButton.LeftButton and self._nows and self._review:
            time = float(self._nows[0].getViewBox().mapSceneToView(event.scenePos()).x())
            self.sought.emit(min(max(time, 0.0), time_end(self._review.curves.time)))

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Read the moment of the replay again when the pointer leaves."""
        if event.type() == QEvent.Type.Leave:
            for cursor in self._cursors:
                cursor.hide()
            if self._time is not None:
                self._read_at(self._time)
        return super().eventFilter(watched, event)

    def read_out(self, time: float) -> str:
        """Say all figures at a time [s]."""
        review = self._review
        if review is None or len(review.curves.time) == 0:
            return ""
        i = int(np.argmin(np.abs(review.curves.time - time)))
        digits = 1 if time_end(review.curves.time) > SHORT_S else 3
        shown = review.shown_time(float(review.curves.time[i]))
        parts = [f"{number(shown, f'.{digits}f')} s", _state_at(review.spans, time)]
        for curve in self._curves:
            value = curve.values[i]
            text = f"{number(value, '.1f')} {curve.unit}" if np.isfinite(value) else "–"
            parts.append(f"{curve.name} {text}")
        return _BETWEEN.join(part for part in parts if part)

    def _hover(self, at: QPointF) -> None:
        if not self._cursors:
            return
        time = self._cursors[0].getViewBox().mapSceneToView(at).x()
        for cursor in self._cursors:
            cursor.setPos(time)
            cursor.show()
        self._read_at(time)

    def _read_at(self, time: float) -> None:
        """Write all figures at a time [s]; a line breaks between two of them only."""
        parts = self.read_out(time).split(_BETWEEN)
        self.readout.setText(" · ".join(part.replace(" ", "\u00a0") for part in parts))


def _state_at(spans: tuple[Span, ...], time: float) -> str:
    for span in spans:
        if span.start <= time <= span.end:
            return phase_word(span.state)
    return ""
