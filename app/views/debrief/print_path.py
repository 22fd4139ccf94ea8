"""The tip's track on the bull's-eye pad, for paper."""

from math import atan2, radians

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from app.session.review import Review
from app.views.debrief.path_view import paint_track
from app.views.debrief.print_style import DIM, INK, LINE, font
from app.views.exercise.pad_painter import PadArea
from app.views.kit.text import tr


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
