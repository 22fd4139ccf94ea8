"""Which way the patient lies in the 3D view: six letters on three axes, drawn in the corner."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFont, QPainter, QPen

from app.core.arrays import FloatArray
from app.views.kit import theme
from app.views.scene.orbit import Orbit

LENGTH_PX = 26.0
_ENDS = (
    ("L", (1, 0, 0)),
    ("R", (-1, 0, 0)),
    ("P", (0, 1, 0)),
    ("A", (0, -1, 0)),
    ("S", (0, 0, 1)),
    ("I", (0, 0, -1)),
)


def compass_ends(orbit: Orbit) -> list[tuple[str, FloatArray]]:
    """Letters and screen vectors (right, down, towards the eye) of the six ends, farthest first."""
    screen = np.array([orbit.right, -np.asarray(orbit.up), orbit.backwards])
    ends = [(letter, screen @ np.asarray(axis, dtype=np.float64)) for letter, axis in _ENDS]
    return sorted(ends, key=lambda end: float(end[1][2]))


def draw_compass(painter: QPainter, orbit: Orbit, middle: QPointF) -> None:
    """Draw the axes around `middle`; what points at the viewer is bright and on top."""
    painter.save()
    painter.setRenderHint(QPainter.RenderHint.Antialiasing)
    font = QFont(painter.font())
    font.setPixelSize(theme.SMALL_PX)
    font.setBold(True)
    painter.setFont(font)
    for letter, (right, down, near) in compass_ends(orbit):
        colour = QColor(theme.IMAGE_WARNING)
        colour.setAlphaF(0.62 + 0.38 * float(np.clip(near, -1.0, 1.0)))
        painter.setPen(QPen(colour, 1.5))
        tip = middle + QPointF(right, down) * LENGTH_PX
        painter.drawLine(middle, tip)
        place = middle + QPointF(right, down) * (LENGTH_PX + 9.0)
        box = QRectF(place.x() - 10, place.y() - 10, 20, 20)
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, letter)
    painter.restore()
