"""A plane through two clicked points, without any needle."""

from __future__ import annotations

import numpy as np
from PySide6.QtCore import QObject

from app.core.arrays import FloatArray
from app.views.kit import theme
from app.views.kit.text import tr
from app.views.kit.theme import Mark, Symbol
from app.views.slices.drawing import Drawing
from app.views.slices.items import MarkItem
from app.views.slices.layers import SegmentLayer, place_mark
from app.views.slices.needle_source import Along, NeedlePlanes
from app.views.slices.pane import SlicePane
from app.views.slices.plane import SlicePlane
from app.views.slices.viewing import Tool, Viewing

POINT = Mark(theme.IN_PLANE.colour, symbol=Symbol.RING, width=2.0)
LINE = Mark(theme.IN_PLANE.colour, width=1.5)


class TwoPoints(QObject):
    """Takes two points of `Tool.PLANE` and lays the needle's panes through them.

    Attributes:
        points: chosen so far, LPS [mm]; two once the plane stands.
    """

    def __init__(self, viewing: Viewing, planes: NeedlePlanes, parent: QObject) -> None:
        super().__init__(parent)
        self._viewing, self._planes = viewing, planes
        self.points: list[FloatArray] = []
        self._panes: list[SlicePane] = []
        viewing.point_placed.connect(self._take)
        viewing.tool_changed.connect(self._start)
        viewing.volume_changed.connect(self._forget)
        planes.changed.connect(self._follow)

    def show_in(self, pane: SlicePane) -> None:
        """Draw the points in a pane."""
        layer = PointsLayer(pane.canvas.drawing, self)
        pane.canvas.add_layer(layer, layer.marks)
        self._panes.append(pane)

    def _start(self) -> None:
        if self._viewing.tool is Tool.PLANE or len(self.points) == 1:
            self._forget()

    def _take(self, tool: Tool, point: tuple[float, float, float], first: bool) -> None:
        if tool is not Tool.PLANE:
            return
        at = np.asarray(point)
        if first:
            self.points = [*self.points[:1], at]
        else:
            self.points[-1] = at
        if len(self.points) == 1:
            self._viewing.refuse_point()  # the tool stays for the second point
        else:
            self._lay()
        self._draw()

    def _lay(self) -> None:
        pane = self._viewing.clicked_pane
        plane = None if pane is None else self._viewing.plane(pane)
        if plane is not None:
            self._planes.show_points(self.points[0], self.points[1], plane.ahead)

    def _follow(self) -> None:
        """Forget the points once the panes show something else."""
        if len(self.points) == 2 and self._planes.along is not Along.POINTS:
            self._forget()

    def _forget(self) -> None:
        self.points = []
        self._draw()

    def _draw(self) -> None:
        for pane in self._panes:
            pane.canvas.refresh()


class PointsLayer:
    """Both points and the line between them."""

    def __init__(self, drawing: Drawing, source: TwoPoints) -> None:
        self._source = source
        self._line = SegmentLayer(drawing, LINE, 2)
        self.marks = (MarkItem(POINT, 4), MarkItem(POINT, 4))
        for mark in self.marks:
            mark.setVisible(False)
            drawing.add(mark)

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Show what has been chosen."""
        places = [plane.point(point, index) for point in self._source.points]
        names = (tr("1st point"), tr("2nd point"))
        for number, mark in enumerate(self.marks):
            at = places[number] if number < len(places) else None
            place_mark(mark, at, names[number], plane)
        if len(places) == 2:
            self._line.place(places[0], places[1], plane.half_slab_mm)
        else:
            self._line.hide()

    def hide(self) -> None:
        """Show nothing."""
        self._line.hide()
        for mark in self.marks:
            mark.setVisible(False)
