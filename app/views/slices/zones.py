"""Ablated zones over a slice: where they are cut, the electrodes left in place, the margins.

What is planned is dashed, what was reached solid. A margin has a colour and a shape, so that
neither stands alone, and the least one is written beside its place.
"""

from __future__ import annotations

from typing import Final

import numpy as np
from PySide6.QtCore import QObject, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetrics, QPainter, QPainterPath, QPen, QPolygonF, QTransform

from app.core.arrays import FloatArray
from app.planning.ablation.zone import Zone
from app.session.ablation_shown import AblationShown, MarginsShown
from app.views.kit.text import literal, tr
from app.views.kit.theme import Mark, Symbol
from app.views.slices.canvas import SliceCanvas
from app.views.slices.drawing import Shape
from app.views.slices.items import draw_symbol, label_font
from app.views.slices.plane import SlicePlane
from app.views.slices.words import PLATE

ENOUGH: Final = Mark("#56b4e9", symbol=Symbol.RING, width=1.6)
"""A margin as wanted or more."""
LITTLE: Final = Mark("#f0e442", symbol=Symbol.TRIANGLE, width=1.8)
"""A margin, but less than wanted."""
BARE: Final = Mark("#ff8a66", symbol=Symbol.CROSS, width=2.2)
"""Lesion that was not covered."""

ZONE: Final = "#ffb0e0"
SHAFT: Final = "#ffffff"
SMALL: Final = 0.45
"""Size of a margin's mark, of that of other marks."""

SPACED_PX: Final = 11.0
"""Marks nearer to each other than this are left out, the larger margin first."""

_TURNS: Final = np.linspace(0.0, 2.0 * np.pi, 73)


def mark_of(margin_mm: float, wanted_mm: float) -> Mark:
    """Return how a margin is marked."""
    if margin_mm < 0.0:
        return BARE
    return LITTLE if margin_mm < wanted_mm else ENOUGH


def cut(zone: Zone, plane: SlicePlane, index: float) -> FloatArray:
    """Return the outline of a zone in a slice [mm], shape (n, 2); empty where it is not cut."""
    origin = plane.lps_mm(0.0, 0.0, index)
    basis = np.column_stack(
        [plane.lps_mm(1.0, 0.0, index) - origin, plane.lps_mm(0.0, 1.0, index) - origin]
    )
    along = np.outer(zone.axis, zone.axis)
    form = along / zone.half_long_mm**2 + (np.eye(3) - along) / zone.half_short_mm**2
    away = origin - zone.centre_mm
    square, linear = basis.T @ form @ basis, basis.T @ form @ away
    middle = -np.linalg.solve(square, linear)
    left = 1.0 - float(away @ form @ away) + float(linear @ np.linalg.solve(square, linear))
    if left <= 0.0:
        return np.empty((0, 2))
    lower = np.linalg.cholesky(square)
    circle = np.stack([np.cos(_TURNS), np.sin(_TURNS)])
    return np.asarray(middle + np.sqrt(left) * np.linalg.solve(lower.T, circle).T)


class _Zones(Shape):
    """All of it as one shape; painted in pixels, so that nothing zooms."""

    def __init__(self) -> None:
        super().__init__(3.1, visible=False)
        self.planned: list[FloatArray] = []
        self.reached: list[FloatArray] = []
        self.shafts: list[tuple[FloatArray, bool]] = []
        self.margins: list[tuple[float, float, float]] = []
        self.least: tuple[float, float, float] | None = None
        self.wanted = 0.0

    def paint(self, painter: QPainter) -> None:
        """Draw outlines, shafts, margins and the least one's number."""
        to_pixels = painter.transform()
        painter.resetTransform()
        for outlines, dashed in ((self.planned, True), (self.reached, False)):
            self._outline(painter, to_pixels, outlines, dashed)
        for ends, in_slice in self.shafts:
            a, b = (to_pixels.map(QPointF(float(x), float(y))) for x, y in ends)
            for colour, width in (("#000000", 4.5), (SHAFT, 2.2)):
                pen = QPen(QColor(colour), width)
                if not in_slice:
                    pen.setDashPattern([3.0, 2.0])
                painter.setPen(pen)
                painter.drawLine(a, b)
        self._margins(painter, to_pixels)

    def _outline(
        self, painter: QPainter, to_pixels: QTransform, outlines: list[FloatArray], dashed: bool
    ) -> None:
        path = QPainterPath()
        for outline in outlines:
            one = QPainterPath()
            one.addPolygon(QPolygonF([QPointF(float(x), float(y)) for x, y in outline]))
            path = path.united(one)
        painter.setBrush(Qt.BrushStyle.NoBrush)
        for colour, width in (("#000000", 3.6), (ZONE, 1.8)):
            pen = QPen(QColor(colour), width)
            if dashed:
                pen.setDashPattern([5.0, 3.5])
            painter.setPen(pen)
            painter.drawPath(to_pixels.map(path))

    def _margins(self, painter: QPainter, to_pixels: QTransform) -> None:
        taken: list[QPointF] = []
        for x, y, margin in sorted(self.margins, key=lambda one: one[2]):
            at = to_pixels.map(QPointF(x, y))
            if any((at - other).manhattanLength() < SPACED_PX for other in taken):
                continue
            taken.append(at)
            mark = mark_of(margin, self.wanted)
            painter.save()
            painter.translate(at)
            painter.scale(SMALL, SMALL)
            for colour, width in (("#000000", 2.5 * mark.width), (mark.colour, 1.5 * mark.width)):
                painter.setPen(QPen(QColor(colour), width))
                draw_symbol(painter, mark, False)
            painter.restore()
        if self.least is None:
            return
        x, y, margin = self.least
        words = tr("least {mm:.1f} mm", mm=margin)
        painter.setFont(label_font())
        letters = QFontMetrics(painter.font())
        at = to_pixels.map(QPointF(x, y)) + QPointF(8.0, 6.0)
        box = QRectF(at.x(), at.y(), letters.horizontalAdvance(words) + 6.0, letters.height())
        painter.fillRect(box, PLATE)
        painter.setPen(QColor(mark_of(margin, self.wanted).colour))
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, words)


class ZonesLayer(QObject):
    """What an ablation shows over one slice."""

    def __init__(self, canvas: SliceCanvas) -> None:
        super().__init__(canvas)
        self._canvas, self._shape = canvas, _Zones()
        self._shown: AblationShown | None = None
        canvas.drawing.add(self._shape)
        canvas.add_layer(self)

    def set_shown(self, shown: AblationShown | None) -> None:
        """Show another state, or nothing."""
        if shown is not self._shown:
            self._shown = shown
            self._canvas.refresh()

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Cut zones and lesion by a slice."""
        shape, shown = self._shape, self._shown
        shape.setVisible(shown is not None)
        if shown is None:
            return
        shape.planned = [cut(zone, plane, index) for zone in shown.planned.zones]
        zones = () if shown.reached is None else shown.reached.zones
        shape.reached = [cut(zone, plane, index) for zone in zones]
        shape.planned, shape.reached = (
            [one for one in row if len(one)] for row in (shape.planned, shape.reached)
        )
        shape.shafts = [_shaft(ends, plane, index) for ends in shown.shafts_mm]
        shape.wanted = shown.wanted_mm
        shape.margins = _in_slice(shown.newest, plane, index)
        least = shown.newest.least_at
        at = plane.point(shown.newest.at_mm[least], index)
        near = abs(at.distance) <= plane.half_slab_mm
        shape.least = (at.x, at.y, shown.newest.least_mm) if near else None
        shape.touch()

    def hide(self) -> None:
        """Show nothing."""
        self._shape.setVisible(False)


def _shaft(ends: FloatArray, plane: SlicePlane, index: float) -> tuple[FloatArray, bool]:
    begin, end = (plane.point(point, index) for point in ends)
    crosses = (begin.distance > 0.0) != (end.distance > 0.0)
    near = min(abs(begin.distance), abs(end.distance)) <= plane.half_slab_mm
    return np.array([[begin.x, begin.y], [end.x, end.y]]), crosses or near


def _in_slice(
    margins: MarginsShown, plane: SlicePlane, index: float
) -> list[tuple[float, float, float]]:
    found = []
    for place, margin in zip(margins.at_mm, margins.margin_mm.tolist(), strict=True):
        at = plane.point(place, index)
        if abs(at.distance) <= 0.5 * plane.half_slab_mm:
            found.append((at.x, at.y, margin))
    return found


def legend() -> str:
    """Say what the marks mean."""
    return literal(
        tr(
            "Dashed: planned zone; solid: ablated zone. On the lesion's edge: ○ margin as wanted, "
            "△ less, ✕ not covered"
        )
    )
