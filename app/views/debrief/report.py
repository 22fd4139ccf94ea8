"""The report of an attempt: A4, vector text and curves, a pseudonym and nothing about a patient.

Dark ink on white, and a symbol beside every colour.
"""

from collections.abc import Sequence
from math import atan2, floor, log10, radians
from pathlib import Path
from typing import Final

import numpy as np
from PySide6.QtCore import QBuffer, QByteArray, QIODevice, QMarginsF, QPointF, QRectF, Qt
from PySide6.QtGui import (
    QColor,
    QFont,
    QPageLayout,
    QPageSize,
    QPainter,
    QPdfWriter,
    QPen,
    QPolygonF,
)

from app import __version__
from app.core.arrays import FloatArray
from app.core.files import write_atomically
from app.imaging.scan_order import Seen
from app.scoring.result import Score
from app.scoring.rows import Row
from app.scoring.tolerance import Band
from app.session.control_scan import TEACHING_ESTIMATE
from app.session.review import Review
from app.session.timeline import Span, TimeMark
from app.views.debrief.curves import Curve, curves_of, time_end, value_range
from app.views.debrief.path_view import paint_track
from app.views.debrief.score_words import (
    counting,
    facts_of,
    met_lines,
    risk_lines,
    row_texts,
    shown_only,
    total_text,
    verdict,
    whose_words,
)
from app.views.exercise.pad_canvas import PadArea
from app.views.exercise.readouts import clock_text
from app.views.exercise.stages import phase_word, state_word
from app.views.kit.access import ACCESS
from app.views.kit.text import date_text, declared, disclaimer, number, tr, translated


def paint_path(painter: QPainter, box: QRectF, review: Review) -> None:
    """Draw pad and track into a square `box` [pt]."""
    radius = 0.5 * min(box.width(), box.height()) - 14.0
    area = PadArea(box.center(), radius)
    painter.setBrush(Qt.BrushStyle.NoBrush)
    rings = [(r, tr("{mm:g} mm", mm=1e3 * r), INK) for r in review.rings]
    angles = [(review.scale.offset_of_angle(radians(a)), f"{a}°", DIM) for a in (10, 30)]
    for offset, label, ink in (*rings, *angles):
        size = radius * review.scale.radius(atan2(offset, review.scale.length))
        painter.setPen(QPen(QColor(ink), 0.9 if ink == INK else 0.5))
        painter.drawEllipse(area.centre, size, size)
        painter.setFont(font(7.0))
        painter.drawText(area.centre + QPointF(0.71 * size + 1.5, -0.71 * size - 1.5), label)
    painter.setPen(QPen(QColor(DIM), 0.8))
    painter.drawEllipse(area.centre, radius, radius)
    for x, y in ((1.0, 0.0), (0.0, 1.0)):
        painter.drawLine(area.point((-x, -y)), area.point((x, y)))
    _letters(painter, area, review.frame.letters)
    track = np.asarray(review.track())
    paint_track(painter, area, track, LINE, 1.0, mark=4.0, ground="#ffffff")


def _letters(painter: QPainter, area: PadArea, letters: tuple[str, ...]) -> None:
    painter.setFont(font(9.0, bold=True))
    painter.setPen(QColor(INK))
    for text, (x, y) in zip(letters, ((-1, 0), (1, 0), (0, -1), (0, 1)), strict=True):
        at = area.centre + QPointF(x, y) * (area.radius + 8.0)
        box = QRectF(at.x() - 14.0, at.y() - 7.0, 28.0, 14.0)
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)


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
    review: Review,
    labelled: bool,
) -> None:
    """Draw one curve into `box` [pt]; `labelled` adds the time axis and the names of the states."""
    time, spans, marks = review.curves.time, review.spans, review.marks
    area = box.adjusted(_LEFT, _TITLE, 0.0, -24.0 if labelled else -6.0)
    low, high = value_range(curve)
    end = time_end(time)
    _paint_spans(painter, area, spans, end, labelled)
    _paint_grid(painter, area, (low, high))
    if labelled:
        _paint_times(painter, area, review, end)
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
        name = phase_word(span.state)
        if labelled and painter.fontMetrics().horizontalAdvance(name) <= box.width():
            below = QRectF(left, area.bottom() + 11.0, box.width(), 11.0)
            painter.setPen(QColor(DIM))
            painter.drawText(below, Qt.AlignmentFlag.AlignHCenter, name)


def _paint_grid(painter: QPainter, area: QRectF, span: tuple[float, float]) -> None:
    low, high = span
    painter.setFont(font(7.5))
    for value in ticks(low, high):
        y = _y(area, value, low, high)
        painter.setPen(QPen(QColor("#cccccc"), 0.4))
        painter.drawLine(QPointF(area.left(), y), QPointF(area.right(), y))
        painter.setPen(QColor(DIM))
        label = QRectF(area.left() - _LEFT, y - 5.0, _LEFT - 4.0, 10.0)
        right = Qt.AlignmentFlag.AlignRight | Qt.AlignmentFlag.AlignVCenter
        painter.drawText(label, right, number(value, "g"))
    painter.setPen(QPen(QColor(DIM), 0.6))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.drawRect(area)


def _paint_times(painter: QPainter, area: QRectF, review: Review, end: float) -> None:
    """Write round numbers of the student's clock below the plot."""
    painter.setPen(QColor(DIM))
    painter.setFont(font(7.5))
    for shown in ticks(0.0, review.shown_time(end), 8):
        x = _x(area, review.curve_time(shown), end)
        label = QRectF(x - 20.0, area.bottom() + 1.0, 40.0, 10.0)
        painter.drawText(label, Qt.AlignmentFlag.AlignHCenter, number(shown, "g") + " s")


def _paint_marks(painter: QPainter, area: QRectF, marks: Sequence[TimeMark], end: float) -> None:
    painter.setFont(font(7.5))
    for mark in marks:
        x = _x(area, mark.time, end)
        pen = QPen(QColor(INK), 0.6)
        pen.setDashPattern([4.0, 4.0])
        painter.setPen(pen)
        painter.drawLine(QPointF(x, area.top()), QPointF(x, area.bottom()))
        sign = mark.sign_of(translated(mark.label))
        width = painter.fontMetrics().horizontalAdvance(sign)
        left = min(x - 4.0, area.right() - width)  # nothing of it is cut at the edge
        painter.drawText(QPointF(left, area.top() - 1.5), sign)


def _x(area: QRectF, time: float, end: float) -> float:
    return area.left() + area.width() * min(1.0, max(0.0, time / end))


def _y(area: QRectF, value: float, low: float, high: float) -> float:
    return area.bottom() - area.height() * (value - low) / (high - low)


INK: Final = "#111111"
DIM: Final = "#555555"
LINE: Final = "#0b5394"
RULE: Final = "#999999"
BAND_INKS: Final = {
    Band.EXPERT: "#1b6e43",
    Band.GOOD: "#1b6e43",
    Band.PASS: "#8a5a00",
    Band.FAIL: "#b3261e",
}


def font(points: float, bold: bool = False) -> QFont:
    """Font of a size in points of the page, without hinting: paper has no pixels."""
    result = QFont("DejaVu Sans")
    result.setStyleHint(QFont.StyleHint.SansSerif)
    result.setHintingPreference(QFont.HintingPreference.PreferNoHinting)
    result.setPointSizeF(points)
    result.setBold(bold)
    return result


WIDTH: Final = 595.0
HEIGHT: Final = 842.0
MARGIN: Final = 48.0
_RESOLUTION: Final = 72
"""One unit of the painter is one point; a PDF has no pixels that this could coarsen."""
_COLUMNS: Final = (0.0, 205.0, 295.0, 375.0, 455.0)
"""Left edges of the table's columns [pt]."""
_ROW: Final = 15.5
_LINE: Final = 13.5


def write_report(review: Review, path: Path) -> None:
    """Write the report as a PDF, whole or not at all.

    Raises:
        OSError: if the file cannot be written.
    """
    write_atomically(path, report_bytes(review))


def report_bytes(review: Review) -> bytes:
    """Render the report as the bytes of a PDF."""
    data = QByteArray()
    buffer = QBuffer(data)
    buffer.open(QIODevice.OpenModeFlag.WriteOnly)
    writer = _writer(buffer, review)
    painter = QPainter(writer)
    _first_page(painter, review)
    _footer(painter, review, 1)
    writer.newPage()
    _second_page(painter, review)
    _footer(painter, review, 2)
    painter.end()
    buffer.close()
    return bytes(data.data())


def _writer(buffer: QBuffer, review: Review) -> QPdfWriter:
    writer = QPdfWriter(buffer)
    writer.setResolution(_RESOLUTION)
    writer.setPageLayout(
        QPageLayout(
            QPageSize(QPageSize.PageSizeId.A4),
            QPageLayout.Orientation.Portrait,
            QMarginsF(0, 0, 0, 0),
        )
    )
    writer.setTitle(tr("Acus attempt {id}", id=review.id))
    writer.setCreator(f"Acus {__version__}")
    return writer


def _first_page(painter: QPainter, review: Review) -> None:
    y = _heading(painter, review)
    y = _facts(painter, review, y)
    y = _verdict(painter, review, y)
    if review.score is not None:
        y = _table(painter, review.score, y)
    painter.setFont(font(8.5))
    painter.setPen(QColor(DIM))
    y = _risks(painter, review, y)
    for problem in review.problems:
        _paragraph(painter, f"▲ {problem}", y, 24.0)
        y += 24.0


_MOST_MET = 8  # lines of a page


def _risks(painter: QPainter, review: Review, y: float) -> float:
    """Say how near the needle came to risks, and what it met; return where the page goes on."""
    y = _list(painter, tr("Closest to structures of risk"), risk_lines(review), y)
    return _list(
        painter,
        tr("What the needle met, with the force along the needle"),
        met_lines(review)[:_MOST_MET],
        y,
    )


def _list(painter: QPainter, title: str, lines: tuple[str, ...], y: float) -> float:
    if not lines:
        return y
    _text(painter, MARGIN, y + 6.0, title, font(9.0, bold=True), DIM)
    for n, line in enumerate(lines, 1):
        _text(painter, MARGIN, y + 6.0 + 14.0 * n, line, font(9.5))
    painter.setFont(font(8.5))
    painter.setPen(QColor(DIM))
    return y + 20.0 + 14.0 * len(lines)


def _heading(painter: QPainter, review: Review) -> float:
    whose = whose_words(review.conditions)
    _text(painter, MARGIN, MARGIN + 14.0, declared(review.exercise), font(17.0, bold=True))
    _text(painter, MARGIN, MARGIN + 31.0, whose or tr("Report of an attempt"), font(10.0), DIM)
    painter.setPen(QPen(QColor(RULE), 0.8))
    painter.drawLine(QPointF(MARGIN, MARGIN + 40.0), QPointF(WIDTH - MARGIN, MARGIN + 40.0))
    return MARGIN + 60.0


def _facts(painter: QPainter, review: Review, y: float) -> float:
    watched = bool(whose_words(review.conditions))
    who = tr("Watched by (pseudonym)") if watched else tr("Student (pseudonym)")
    facts = (
        (who, ACCESS.shown(review.student)),
        (tr("Date"), date_text(review.started)),
        (tr("Session"), review.id),
        (
            tr("State"),
            state_word(review.state) + (f": {translated(review.reason)}" if review.reason else ""),
        ),
        (tr("Duration"), clock_text(review.duration)),
        (tr("Control scans"), scans_text(review)),
        (tr("Path"), tr("{mm:.1f} mm from entry to target", mm=1e3 * review.placed.length)),
        (tr("Tip measured to"), radius_text(review.tip_radius)),
    )
    y = _lines(painter, facts, y)
    if review.conditions is None:
        return _lines(painter, ((tr("Recorded with"), f"Acus {review.software}"),), y) + 16.0
    _text(painter, MARGIN, y + 6.0, tr("Made under"), font(9.5, bold=True), DIM)
    return _lines(painter, facts_of(review.conditions), y + 21.0) + 16.0


def _lines(painter: QPainter, facts: Sequence[tuple[str, str]], y: float) -> float:
    """Names and values under each other; returns where the page goes on."""
    for name, value in facts:
        _text(painter, MARGIN, y, name, font(9.5), DIM)
        _text(painter, MARGIN + 130.0, y, value, font(9.5))
        y += _LINE
    return y


def scans_text(review: Review) -> str:
    """Say how many control scans there were, how many showed the tip, and their notional dose."""
    scans = review.control_scans
    if not scans:
        return str(review.scans)
    tips = sum(scan.seen is Seen.TIP for scan in scans)
    return tr(
        "{n}, {tips} of them with the tip; {dose:.1f} mGy·cm ({estimate})",
        n=review.scans,
        tips=tips,
        dose=sum(scan.dose for scan in scans),
        estimate=tr(TEACHING_ESTIMATE),
    )


def radius_text(radius: float | None) -> str:
    """Say how well the tip was known [m]."""
    if radius is None:
        return tr("not recorded")
    return tr("± {mm:.1f} mm (95 %), median", mm=1e3 * radius)


_COMMENT_HIGH: Final = 90.0
"""A comment takes no more of the page than this [pt]."""


def _verdict(painter: QPainter, review: Review, y: float) -> float:
    _, word, reason = verdict(review)
    _text(painter, MARGIN, y, word, font(17.0, bold=True))
    total = QRectF(MARGIN, y - 15.0, WIDTH - 2 * MARGIN, 20.0)
    painter.setFont(font(14.0, bold=True))
    painter.drawText(total, Qt.AlignmentFlag.AlignRight, total_text(review.score, review.said.void))
    if reason:
        painter.setFont(font(9.5))
        _paragraph(painter, reason, y + 8.0, 26.0)
        y += 26.0
    if review.said.comment:
        words = tr("The instructor says: {words}", words=review.said.comment)
        painter.setFont(font(9.5))
        room = QRectF(MARGIN, y + 8.0, WIDTH - 2 * MARGIN, _COMMENT_HIGH)
        wraps = Qt.TextFlag.TextWordWrap
        needed = painter.boundingRect(room, int(wraps), words).height()
        _paragraph(painter, words, y + 8.0, min(needed, _COMMENT_HIGH))
        y += min(needed, _COMMENT_HIGH) + 6.0
    return y + 28.0


def _table(painter: QPainter, score: Score, y: float) -> float:
    titles = (tr("Metric"), tr("Value"), tr("Band"), tr("Points"), tr("Weight"))
    for left, title in zip(_COLUMNS, titles, strict=True):
        _text(painter, MARGIN + left, y, title, font(9.0, bold=True), DIM)
    painter.setPen(QPen(QColor(RULE), 0.6))
    painter.drawLine(QPointF(MARGIN, y + 5.0), QPointF(WIDTH - MARGIN, y + 5.0))
    y += 7.0
    for row in counting(score):
        y += _ROW
        _table_row(painter, row, score, y)
    if any(row.tolerance and row.tolerance.required for row in score.rows):
        y += _ROW
        _text(painter, MARGIN, y, tr("* required to pass"), font(8.0), DIM)
    for row in shown_only(score):
        y += _ROW
        _table_row(painter, row, score, y)
    return y + 2 * _ROW


def _table_row(painter: QPainter, row: Row, score: Score, y: float) -> None:
    texts = row_texts(row, score)
    ink = DIM if row.tolerance is None else INK
    for i, text in enumerate((texts.label, texts.value, texts.band, texts.points, texts.weight)):
        judged = i == 2 and row.band is not None and score.total is not None
        colour = BAND_INKS[row.band] if judged and row.band else ink
        _text(painter, MARGIN + _COLUMNS[i], y, text, font(9.5), colour)


def _second_page(painter: QPainter, review: Review) -> None:
    _text(painter, MARGIN, MARGIN + 8.0, tr("Course of the attempt"), font(13.0, bold=True))
    curves, top, width = curves_of(review), MARGIN + 22.0, WIDTH - 2 * MARGIN
    for i, curve in enumerate(curves):
        last = i == len(curves) - 1
        height = 118.0 if last else 100.0
        box = QRectF(MARGIN, top, width, height)
        paint_plot(painter, box, curve, review, last)
        top += height + 6.0
    caption = tr("Track of the tip, seen along the planned path")
    _text(painter, MARGIN, top + 16.0, caption, font(9.5, bold=True))
    painter.setFont(font(8.5))
    painter.setPen(QColor(DIM))
    legend = QRectF(MARGIN, top + 24.0, 190.0, 120.0)
    note = tr(
        "□ where it began   ◆ where it ended\nRings: {expert:g} mm expert, {passing:g} mm pass\n"
        "Letters: directions of the patient\n▼ control scan",
        expert=1e3 * review.rings[0],
        passing=1e3 * review.rings[1],
    )
    painter.drawText(legend, Qt.TextFlag.TextWordWrap, note)
    paint_path(painter, QRectF(WIDTH - MARGIN - 265.0, top + 4.0, 265.0, 265.0), review)


def _footer(painter: QPainter, review: Review, page: int) -> None:
    y = HEIGHT - MARGIN + 8.0
    painter.setPen(QPen(QColor(RULE), 0.6))
    painter.drawLine(QPointF(MARGIN, y - 12.0), QPointF(WIDTH - MARGIN, y - 12.0))
    _text(painter, MARGIN, y, disclaimer(), font(8.5, bold=True))
    right = QRectF(MARGIN, y - 9.0, WIDTH - 2 * MARGIN, 12.0)
    painter.setFont(font(8.0))
    painter.setPen(QColor(DIM))
    painter.drawText(right, Qt.AlignmentFlag.AlignRight, tr("page {page} of 2", page=page))


def _text(painter: QPainter, x: float, y: float, text: str, used: QFont, colour: str = INK) -> None:
    painter.setFont(used)
    painter.setPen(QColor(colour))
    painter.drawText(QPointF(x, y), text)


def _paragraph(painter: QPainter, text: str, y: float, height: float) -> None:
    box = QRectF(MARGIN, y, WIDTH - 2 * MARGIN, height)
    painter.drawText(box, Qt.TextFlag.TextWordWrap, text)
