"""Measurements over a slice: drawn where they lie in it, with their values beside them."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QPainter, QPolygonF

from app.planning.measurements import Angle, Measurement, Region
from app.views.kit.theme import Mark
from app.views.measure.editor import MeasureEditor
from app.views.slices.drawing import Drawing, Shape
from app.views.slices.items import label_font
from app.views.slices.plane import SlicePlane

MEASURE = Mark("#b4f06c", width=2.0)
"""Told apart from plan and needle by its end ticks and by the value that stands beside it."""

TICK_PX = 5.0
GAP_PX = 8.0
FLAT_MM = 1.0
OUTSIDE_DASH = (3.0, 3.0)


@dataclass(frozen=True, slots=True)
class Drawn:
    """One measurement in plane millimetres.

    Attributes:
        line: what is drawn, in order.
        handles: where it can be taken hold of.
        text: its values.
        whole: whether all of it lies in the slice; dashed otherwise.
    """

    line: tuple[QPointF, ...]
    handles: tuple[QPointF, ...]
    text: str
    whole: bool


class MeasureLayer:
    """A layer of one canvas: an item that draws all measurements of an editor."""

    def __init__(self, drawing: Drawing, editor: MeasureEditor) -> None:
        self._editor = editor
        self._item = MeasureItem()
        drawing.add(self._item)

    @property
    def drawn(self) -> tuple[Drawn, ...]:
        """What is shown in this slice."""
        return self._item.drawn

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Draw what lies in the slice."""
        found = (drawn(item, self._editor, plane, index) for item in self._editor.shown)
        self._item.set_drawn(tuple(one for one in found if one is not None))

    def hide(self) -> None:
        """Show nothing."""
        self._item.set_drawn(())


class MeasureItem(Shape):
    """Draws lines with end ticks, and words that do not zoom."""

    def __init__(self) -> None:
        super().__init__(6.0)
        self.drawn: tuple[Drawn, ...] = ()

    def set_drawn(self, drawn: tuple[Drawn, ...]) -> None:
        """Draw these."""
        if drawn != self.drawn:
            self.drawn = drawn
            self.touch()

    def paint(self, painter: QPainter) -> None:
        """Draw everything in pixels."""
        to_pixel = painter.transform()
        painter.resetTransform()
        room = QRectF(painter.viewport())
        taken: list[QRectF] = []
        for one in self.drawn:
            line = [to_pixel.map(point) for point in one.line]
            handles = [to_pixel.map(point) for point in one.handles]
            for rim in (True, False):
                pen = MEASURE.pen(MEASURE.width + 2.0 if rim else None)
                if rim:
                    pen.setColor(Qt.GlobalColor.black)
                elif not one.whole:
                    pen.setDashPattern(list(OUTSIDE_DASH))
                painter.setPen(pen)
                painter.setBrush(Qt.BrushStyle.NoBrush)
                painter.drawPolyline(QPolygonF(line))
                for handle in handles:
                    _tick(painter, handle)
            _write(painter, one.text, _beside(line), room, taken)


def drawn(
    item: Measurement, editor: MeasureEditor, plane: SlicePlane, index: float
) -> Drawn | None:
    """Return what a slice shows of a measurement; None if it lies elsewhere."""
    points = item.outline() if isinstance(item, Region) else item.points
    places = [plane.point(point, index) for point in points]
    near = [is_near(place.distance, plane) for place in places]
    if not all(near) and not (any(near) and is_free(item)):
        return None
    line = [QPointF(place.x, place.y) for place in places]
    if isinstance(item, Region):
        line.append(line[0])
    handles = [plane.point(point, index) for point in item.points]
    text = editor.measured(item).text
    if isinstance(item, Angle) and item.b_mm == item.vertex_mm:
        text = ""  # its second side is still to come
    named = f"{item.name}: {text}" if item.name else text
    at = tuple(QPointF(place.x, place.y) for place in handles)
    return Drawn(tuple(line), at, named, all(near))


def is_free(item: Measurement) -> bool:
    """Whether it lies in no axial, sagittal or coronal slice: then any slice may show a part."""
    return bool((np.ptp(np.array(item.points), axis=0) > FLAT_MM).all())


def is_near(distance_mm: float, plane: SlicePlane) -> bool:
    """Whether something so far from the slice's middle counts as in it: half a slice."""
    return abs(distance_mm) <= max(0.5 * plane.step_mm, 0.25) * (1.0 + 1e-6)


def _tick(painter: QPainter, at: QPointF) -> None:
    painter.drawLine(at - QPointF(TICK_PX, 0.0), at + QPointF(TICK_PX, 0.0))
    painter.drawLine(at - QPointF(0.0, TICK_PX), at + QPointF(0.0, TICK_PX))


def _beside(line: Sequence[QPointF]) -> QPointF:
    """Right of the rightmost point."""
    return max(line, key=lambda point: point.x()) + QPointF(GAP_PX, -GAP_PX)


def _write(painter: QPainter, text: str, at: QPointF, view: QRectF, taken: list[QRectF]) -> None:
    """Write beside a line, kept inside the pane and off other words, with a dark shadow."""
    if not text:
        return
    font = label_font()
    painter.setFont(font)
    metrics = QFontMetricsF(font)
    width, height = metrics.horizontalAdvance(text), metrics.height()
    x = min(max(at.x(), view.left() + 2.0), view.right() - width - 2.0)
    y = min(max(at.y(), view.top() + height), view.bottom() - 4.0)
    place = QRectF(x, y - height, width, height)
    while any(place.intersects(other) for other in taken) and place.bottom() < view.bottom():
        place.translate(0.0, 0.5 * height)
    taken.append(place)
    y = place.bottom()
    painter.setPen(Qt.GlobalColor.black)
    for dx, dy in ((-1, 0), (1, 0), (0, -1), (0, 1)):
        painter.drawText(QPointF(x + dx, y + dy), text)
    painter.setPen(MEASURE.qcolor())
    painter.drawText(QPointF(x, y), text)
