"""One plot of an attempt's curves: axes, curve, states behind it, events upon it, a cursor."""

from typing import Final

import numpy as np
import pyqtgraph as pg
from PySide6.QtCore import Qt
from PySide6.QtGui import QColor, QPen
from PySide6.QtWidgets import QGraphicsRectItem

from app.core.arrays import FloatArray
from app.session.review import Review
from app.session.timeline import TimeMark
from app.views.debrief.curve_values import Curve, time_end, value_range
from app.views.exercise.state_words import state_word
from app.views.kit import theme
from app.views.kit.text import tr
from app.views.kit.themes import DARK

_STRETCHES: Final = 1000
"""A long curve is drawn as the extremes of so many stretches: about one a pixel."""

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


def draw(plot: pg.PlotItem, review: Review, curve: Curve) -> None:
    """Draw a curve, its level and the times of the events."""
    if curve.line is not None:
        pen = pg.mkPen(theme.TARGET.colour, width=1.5, style=Qt.PenStyle.DashLine)
        options = {"position": 0.5, "color": theme.TARGET.colour, "anchors": [(1, 1), (1, 1)]}
        line = pg.InfiniteLine(
            curve.line, angle=0, pen=pen, label=curve.line_name, labelOpts=options
        )  # fmt: skip
        plot.addItem(line)
    time, values = peaks(review.curves.time, curve.values)
    plot.plot(time, values, pen=pg.mkPen(curve.colour, width=2), connect="finite")
    for mark in review.marks:
        pen = pg.mkPen(theme.IMAGE_TEXT, width=1.2, style=Qt.PenStyle.DotLine)
        plot.addItem(pg.InfiniteLine(mark.time, angle=90, pen=pen))
    low, high = value_range(curve)
    plot.setYRange(low, high, padding=0.0)
    if len(review.curves.time):
        plot.setXRange(0.0, time_end(review.curves.time), padding=0.01)


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
        if span.end - span.start > 0.06 * total:  # a narrower one has no room for its name
            text = pg.TextItem(state_word(span.state), color=theme.IMAGE_DIM, anchor=(0.5, 1))
            text.setPos(0.5 * (span.start + span.end), low)
            plot.addItem(text, ignoreBounds=True)
    for mark in review.marks:
        text = _mark_text(mark, mark.time / total)
        text.setPos(mark.time, high if mark.kind == "scan" else low)
        plot.addItem(text, ignoreBounds=True)


def _mark_text(mark: TimeMark, share: float) -> pg.TextItem:
    """Name an event at a share of the time axis, so that nothing of it is cut at the edges.

    Numbers of scans stand on the uppermost line, words of other events above the states' names.
    """
    across = 0.0 if share < 1.0 / 3.0 else 0.5 if share < 2.0 / 3.0 else 1.0
    if mark.kind == "scan":
        return pg.TextItem(
            mark.sign, color=theme.IMAGE_TEXT, anchor=(min(0.9, max(0.1, across)), 0)
        )
    fill = QColor(theme.IMAGE_GROUND)
    text = pg.TextItem(mark.sign, color=theme.IMAGE_TEXT, anchor=(across, 2.1), fill=fill)
    text.setZValue(5)
    text.setToolTip(mark.label)
    return text


def cursor_of(plot: pg.PlotItem) -> pg.InfiniteLine:
    """Return the line that follows the pointer, hidden."""
    cursor = pg.InfiniteLine(0.0, angle=90, pen=pg.mkPen(DARK.accent, width=1.0))
    cursor.hide()
    plot.addItem(cursor, ignoreBounds=True)
    return cursor
