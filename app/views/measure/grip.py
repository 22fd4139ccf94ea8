"""Taking and changing measurements with the left button."""

from __future__ import annotations

from math import hypot

from PySide6.QtCore import QPointF
from PySide6.QtGui import QMouseEvent

from app.planning.measurements import Angle, Distance, Measurement, Point, Probe, Region
from app.views.measure.editor import MeasureEditor, MeasureTool
from app.views.measure.layer import is_near
from app.views.slices.canvas import SliceCanvas
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
        """Whether the present drag is for the other side: it did not begin the angle."""
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
