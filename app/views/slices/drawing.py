"""What is drawn over a slice: shapes in plane millimetres that one painter draws in one pass."""

from __future__ import annotations

from bisect import insort
from collections.abc import Callable

from PySide6.QtCore import QRectF, Qt
from PySide6.QtGui import QPainter, QTransform


class Shape:
    """Something that stands over a slice, in plane millimetres.

    Whoever changes what it shows calls `touch`; `paint` is called with a painter in millimetres.

    Attributes:
        z: shapes of higher z are drawn over those of lower z.
        smooth: whether its lines are drawn without steps.
        visible: whether it is drawn; changed by `setVisible`.
        drawing: what it belongs to.
    """

    smooth = True

    def __init__(self, z: float, visible: bool = True) -> None:
        self.z = z
        self.visible = visible
        self.drawing: Drawing | None = None

    def isVisible(self) -> bool:
        """Whether it is drawn."""
        return self.visible

    def setVisible(self, visible: bool) -> None:
        """Draw it from now on, or not."""
        if visible is not self.visible:
            self.visible = visible
            self.touch()

    def touch(self) -> None:
        """Have it painted anew, because it has changed."""
        if self.drawing is not None:
            self.drawing.touch()

    def x(self) -> float:
        """Place of a shape that stands at a point [mm]; 0 for others."""
        return 0.0

    def y(self) -> float:
        """Place of a shape that stands at a point [mm]; 0 for others."""
        return 0.0

    def boundingRect(self) -> QRectF:
        """Rectangle of what is drawn [mm]; empty where it is not known."""
        return QRectF()

    def paint(self, painter: QPainter) -> None:
        """Draw it with a painter in millimetres, without brush and opaque."""
        raise NotImplementedError


class Drawing:
    """The shapes over one slice."""

    def __init__(self, changed: Callable[[], None]) -> None:
        self._changed = changed
        self.shapes: list[Shape] = []

    def add(self, shape: Shape) -> None:
        """Draw a shape more, over those of the same z."""
        shape.drawing = self
        insort(self.shapes, shape, key=_height)
        self._changed()

    def remove(self, shape: Shape) -> None:
        """Draw it no more."""
        shape.drawing = None
        self.shapes.remove(shape)
        self._changed()

    def touch(self) -> None:
        """Have all painted anew, together, when the event loop comes round."""
        self._changed()

    def paint(self, painter: QPainter, to_pixels: QTransform) -> None:
        """Draw all that is visible; `to_pixels` takes plane millimetres to the pane's pixels."""
        smooth = False
        hint = QPainter.RenderHint.Antialiasing
        for shape in self.shapes:
            if not shape.visible:
                continue
            painter.setTransform(to_pixels)
            painter.setBrush(Qt.BrushStyle.NoBrush)
            if shape.smooth is not smooth:
                smooth = shape.smooth
                painter.setRenderHint(hint, smooth)
            shape.paint(painter)
        painter.resetTransform()


def _height(shape: Shape) -> float:
    return shape.z
