"""Curves for paper: plain vector drawing in points, dark on white."""

from collections.abc import Sequence
from math import floor, log10
from typing import Final

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen, QPolygonF

from app.core.arrays import FloatArray
from app.session.timeline import Span, TimeMark
from app.views.debrief.curves import Curve, time_end, value_range
from app.views.debrief.print_style import DIM, INK, LINE, font
from app.views.exercise.state_words import state_word

_BUCKETS: Final = 800
"""A curve of more points is drawn by the least and the largest of each bucket."""

_SHADES: Final = {
    "aligning": "#eaf1f8",
    "inserting": "#fbf1e1",
    "holding": "#e6f4ec",
    "paused": "#efe8f4",
}
_LEFT, _TITLE = 34.0, 13.0


def paint_plot(
    painter: QPainter,
    box: QRectF,
    curve: Curve,
    time: FloatArray,
    spans: Sequence[Span],
    marks: Sequence[TimeMark],
    labelled: bool,
) -> None:
    """Draw one curve into `box` [pt]; `labelled` adds the time axis and the names of the states."""
    area = box.adjusted(_LEFT, _TITLE, 0.0, -24.0 if labelled else -6.0)
    low, high = value_range(curve)
    end = time_end(time)
    _paint_spans(painter, area, spans, end, labelled)
    _paint_grid(painter, area, (low, high), end, labelled)
    painter.setFont(font(8.5, bold=True))
    painter.setPen(QColor(INK))
    painter.drawText(QPointF(box.left(), box.top() + 9.0), curve.title)
    if curve.line is not None:
        y = _y(area, curve.line, low, high)
        painter.setPen(QPen(QColor("#a03070"), 0.9, Qt.PenStyle.DashLine))
        painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y))
        painter.setFont(font(7.5))
        name = QRectF(area.left(), y - 11.0, area.width() - 3.0, 10.0)
        painter.drawText(name, Qt.AlignmentFlag.AlignRight, curve.line_name)
    _paint_marks(painter, area, marks, end)
    painter.setPen(QPen(QColor(LINE), 1.0))
    for polyline in polylines(time, curve.values):
        points = [QPointF(_x(area, t, end), _y(area, v, low, high)) for t, v in polyline]
        painter.drawPolyline(QPolygonF(points))


def polylines(time: FloatArray, values: FloatArray) -> list[FloatArray]:
    """Split a curve at its gaps and thin it without losing a peak; each part has shape (m, 2)."""
    known = np.flatnonzero(np.isfinite(values))
    if len(known) == 0:
        return []
    parts = np.split(known, np.flatnonzero(np.diff(known) > 1) + 1)
    return [_thinned(np.column_stack([time[part], values[part]])) for part in parts]


def ticks(low: float, high: float, about: int = 4) -> list[float]:
    """Round numbers between two values: steps of 1, 2 or 5 times a power of ten."""
    span = high - low
    if not (np.isfinite(span) and span > 0.0):
        return [low] if np.isfinite(low) else []
    raw = span / about
    power = 10.0 ** floor(log10(raw))
    step = next((m * power for m in (1.0, 2.0, 5.0) if m * power >= raw), 10.0 * power)
    first, last = int(np.ceil(low / step)), int(np.floor(high / step))
    return [step * i for i in range(first, last + 1)]


def _thinned(points: FloatArray) -> FloatArray:
    if len(points) <= 2 * _BUCKETS:
        return points
    kept = {0, len(points) - 1}
    for bucket in np.array_split(np.arange(len(points)), _BUCKETS):
        values = points[bucket, 1]
        kept.update((int(bucket[values.argmin()]), int(bucket[values.argmax()])))
    result: FloatArray = points[sorted(kept)]
    return result


def _paint_spans(
    painter: QPainter, area: QRectF, spans: Sequence[Span], end: float, labelled: bool
) -> None:
    painter.setFont(font(7.5))
    for span in spans:
        left, right = _x(area, span.start, end), _x(area, span.end, end)
        box = QRectF(left, area.top(), right - left, area.height())
        painter.fillRect(box, QColor(_SHADES.get(span.state, "#ffffff")))
        if labelled and box.width() > 45.0:
            below = QRectF(left, area.bottom() + 11.0, box.width(), 11.0)
            painter.setPen(QColor(DIM))
            painter.drawText(below, Qt.AlignmentFlag.AlignHCenter, state_word(span.state))


def _paint_grid(
    painter: QPainter, area: QRectF, span: tuple[float, float], end: float, labelled: bool
) -> None:
    low, high = span
    painter.setFont(font(7.5))
    for value in ticks(low, high):
        y = _y(area, value, low, high)
        painter.setPen(QPen(QColor("#cccccc"), 0.4))
        painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y))
        painter.setPen(QColor(DIM))
        label = QRectF(area.left() - _LEFT, y - 5.0, _LEFT - 4.0, 10.0)
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        painter.drawText(label, right, f"{value:g}")
    for value in ticks(0.0, end, 8) if labelled else ():
        label = QRectF(_x(area, value, end) - 20.0, area.bottom() + 1.0, 40.0, 10.0)
        painter.drawText(label, Qt.AlignmentFlag.AlignHCenter, f"{value:g} s")
    painter.setPen(QPen(QColor(DIM), 0.6))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawRect(area)


def _paint_marks(painter: QPainter, area: QRectF, marks: Sequence[TimeMark], end: float) -> None:
    painter.setFont(font(7.5))
    for mark in marks:
        x = _x(area, mark.time, end)
        pen = QPen(QColor(INK), 0.6)
        pen.setDashPattern([4.0, 4.0])
        painter.setPen(pen)
        painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()))
        width = painter.fontMetrics().horizontalAdvance(mark.sign)
        left = min(x - 4.0, area.right() - width)  # nothing of it is cut at the edge
        painter.drawText(QPointF(left, area.top() - 1.5), mark.sign)


def _x(area: QRectF, time: float, end: float) -> float:
    return area.left() + area.width() * min(1.0, max(0.0, time / end))


def _y(area: QRectF, value: float, low: float, high: float) -> float:
    return area.bottom() - area.height() * (value - low) / (high - low)
