"""Measurements over a slice: drawn with their values where they lie in it, taken and changed with
the left button.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from math import hypot

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QFontMetricsF, QMouseEvent, QPainter, QPolygonF

from app.planning.measurements import Angle, Distance, Measurement, Point, Probe, Region
from app.views.kit.theme import Mark
from app.views.measure.editor import MeasureEditor, MeasureTool
from app.views.slices.canvas import SliceCanvas
from app.views.slices.drawing import Drawing, Shape
from app.views.slices.items import label_font
from app.views.slices.plane import SlicePlane
from app.views.slices.slab import as_point

GRAB_PX = 9.0
CLICK_PX = 3.0
"""A drag shorter than this is a click."""


class MeasureGrip:
    """A grip of the slices' gestures: draws with a tool in hand, else moves handles.

    Distance and region are one drag. An angle is a drag along one side, from its end to the
    vertex, and a second drag, or a click, for the end of the other.
    """

    def __init__(self, canvas: SliceCanvas, editor: MeasureEditor) -> None:
        self._canvas, self._editor = canvas, editor
        self._pressed = QPointF()
        self._handle: tuple[int, int] | None = None

    def grab(self, position: QPointF, event: QMouseEvent) -> bool:
        """Begin to draw, or take hold of a handle."""
        self._pressed, self._handle = position, None
        if self._editor.tool is not MeasureTool.NONE:
            self._draw(position)
            return True
        self._handle = self._at(position)
        self._editor.begin_move()
        return self._handle is not None

    def drag(self, position: QPointF) -> None:
        """Draw on, or move the handle."""
        if self._handle is None:
            self._draw(position)
            return
        number, handle = self._handle
        items = self._editor.items
        if number < len(items):
            self._editor.move(number, items[number].moved(handle, self._lps(position)))

    def drop(self, position: QPointF) -> None:
        """Take what was drawn."""
        if self._handle is not None:
            self._handle = None
            return
        draft, clicked = self._editor.draft, self._length(position) < CLICK_PX
        if isinstance(draft, Angle):
            if draft.b_mm != draft.vertex_mm:
                self._editor.add(draft)
            elif draft.a_mm == draft.vertex_mm:
                self._editor.set_draft(None)  # a click draws no side
        elif draft is not None and (isinstance(draft, Probe) or not clicked):
            self._editor.add(draft)
        else:
            self._editor.set_draft(None)

    def hover(self, position: QPointF) -> bool:
        """Say whether there is something to take hold of."""
        return self._editor.tool is not MeasureTool.NONE or self._at(position) is not None

    # --- inside -----------------------------------------------------------------------------------
    def _draw(self, position: QPointF) -> None:
        self._editor.set_draft(self._drawn(position))

    def _drawn(self, position: QPointF) -> Measurement:
        start, here = self._lps(self._pressed), self._lps(position)
        tool, draft = self._editor.tool, self._editor.draft
        if tool is MeasureTool.DISTANCE:
            return Distance(start, here)
        if tool is MeasureTool.PROBE:
            return Probe(here)
        if tool is MeasureTool.REGION:
            return self._ellipse(position)
        if isinstance(draft, Angle) and self._is_second(draft, start):
            return Angle(draft.a_mm, draft.vertex_mm, here)
        return Angle(start, here, here)

    def _is_second(self, draft: Angle, start: Point) -> bool:
        """Return whether the present drag is for the other side: it did not begin the angle."""
        return draft.a_mm != start

    def _ellipse(self, position: QPointF) -> Region:
        """Return the ellipse in the rectangle from where the drag began."""
        (x0, y0), (x1, y1) = (self._canvas.plane_at(p) for p in (self._pressed, position))
        x, y = (x0 + x1) / 2, (y0 + y1) / 2
        centre = self._plane_point(x, y)
        right, down = self._plane_point(max(x0, x1), y), self._plane_point(x, max(y0, y1))
        return Region(centre, _minus(right, centre), _minus(down, centre))

    def _plane_point(self, x: float, y: float) -> Point:
        plane = self._canvas.plane
        if plane is None:
            return as_point(self._canvas.viewing.cursor_mm)
        return as_point(plane.lps_mm(x, y, self._canvas.index))

    def _at(self, position: QPointF) -> tuple[int, int] | None:
        """Measurement and handle under a pixel, if it lies in this slice; the newest first."""
        plane, index = self._canvas.plane, self._canvas.index
        if plane is None:
            return None
        for number in reversed(range(len(self._editor.items))):
            for handle, point in enumerate(self._editor.items[number].points):
                at = plane.point(point, index)
                pixel = self._canvas.pixel_at(at.x, at.y)
                away = hypot(pixel.x() - position.x(), pixel.y() - position.y())
                if is_near(at.distance, plane) and away <= GRAB_PX:
                    return number, handle
        return None

    def _length(self, position: QPointF) -> float:
        return hypot(position.x() - self._pressed.x(), position.y() - self._pressed.y())

    def _lps(self, position: QPointF) -> Point:
        return as_point(self._canvas.lps_at(position))


def _minus(a: Point, b: Point) -> Point:
    return (a[0] - b[0], a[1] - b[1], a[2] - b[2])


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
        """Return what is shown in this slice."""
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
    """Return whether it lies in no axial, sagittal or coronal slice: then any slice may show a
    part.
    """
    return bool((np.ptp(np.array(item.points), axis=0) > FLAT_MM).all())


def is_near(distance_mm: float, plane: SlicePlane) -> bool:
    """Return whether something so far from the slice's middle counts as in it: half a slice."""
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
