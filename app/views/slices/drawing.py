"""What is drawn over a slice: shapes in plane millimetres that one painter draws in one pass.

Straight lines are numbers: those of all shapes are drawn together, by a compiled kernel, into the
pixels of the picture before it is copied to the pane.
"""

from __future__ import annotations

from bisect import insort
from collections.abc import Callable
from typing import Any, NamedTuple

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QPainter, QPolygonF, QTransform

from app.views.kit.theme import Mark
from app.views.slices.pictures import Picture, Screen, image_of

RIM = 0.55
"""Opacity of the dark rim of a line."""


class Ink(NamedTuple):
    """How a stroke looks; sizes in px that do not zoom.

    Attributes:
        width: of the line.
        colour: red, green and blue, 0 to 255.
        opacity: 0 to 1.
        smooth: whether its edges are.
        dashes: length of the dashes and of the gaps; (0, 0) for a solid line.
    """

    width: float
    colour: tuple[float, float, float]
    opacity: float = 1.0
    smooth: bool = True
    dashes: tuple[float, float] = (0.0, 0.0)

    @classmethod
    def of(
        cls,
        mark: Mark,
        opacity: float = 1.0,
        smooth: bool = True,
        dash: tuple[float, ...] | None = None,
    ) -> Ink:
        """Take a mark's line; `dash` [widths] in place of the mark's own."""
        on, off = (dash if dash is not None else mark.dash) or (0.0, 0.0)
        colour, width = mark.qcolor(), mark.width
        rgb = (float(colour.red()), float(colour.green()), float(colour.blue()))
        return cls(width, rgb, opacity, smooth, (on * width, off * width))

    @property
    def rim(self) -> Ink:
        """The dark line below it, so that it shows on bone."""
        return Ink(self.width + 2.0, (0.0, 0.0, 0.0), RIM, self.smooth)


def stroke(
    start: tuple[float, float],
    end: tuple[float, float],
    ink: Ink,
    alphas: tuple[float, float] = (1.0, 1.0),
) -> tuple[float, ...]:
    """Return a line [mm] as `imaging.screen.draw_strokes` has it.

    Args:
        start: one end.
        end: the other.
        ink: how it looks.
        alphas: opacity at either end, besides that of the ink.
    """
    width, colour, opacity, smooth, dashes = ink
    return (
        *start,
        *end,
        width,
        *colour,
        opacity * alphas[0],
        opacity * alphas[1],
        float(smooth),
        *dashes,
    )


def ellipse(
    at: tuple[float, float], axes: tuple[float, float], ink: Ink, angle: float
) -> tuple[float, ...]:
    """Return an ellipse [mm] as `imaging.screen.draw_strokes` has it.

    Args:
        at: its middle.
        axes: its half axes.
        ink: how it looks.
        angle: of the first axis [rad], from the right downwards.
    """
    width, colour, opacity, _, dashes = ink
    return (*at, *axes, width, *colour, opacity, angle, _ELLIPSE, *dashes)


_ELLIPSE = 2.0
"""`imaging.screen.ELLIPSE`, which is compiled and loaded later."""

_NOTHING = stroke((0.0, 0.0), (0.0, 0.0), Ink(0.0, (0.0, 0.0, 0.0)))


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
        """Return whether it is drawn."""
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


class Strokes(Shape):
    """A shape of straight lines, or of ellipses, only.

    Attributes:
        rows: the numbers of all its lines, see `stroke` and `ellipse`; changed by `set_rows`.
    """

    def __init__(self, z: float, visible: bool = True) -> None:
        super().__init__(z, visible)
        self.rows: list[float] = []

    def set_rows(self, rows: list[float]) -> None:
        """Draw these lines."""
        self.rows = rows
        self.touch()

    @property
    def lines(self) -> tuple[tuple[QPointF, QPointF], ...]:
        """Ends of all lines [mm]."""
        at = range(0, len(self.rows), len(_NOTHING))
        ends = (self.rows[n : n + 4] for n in at)
        return tuple((QPointF(*row[:2]), QPointF(*row[2:])) for row in ends)

    def boundingRect(self) -> QRectF:
        """Return the rectangle between the ends of all lines [mm]."""
        corners = [point for line in self.lines for point in line]
        return QPolygonF(corners).boundingRect() if corners else QRectF()


class Drawing:
    """The shapes over one slice.

    Attributes:
        shapes: what is drawn, the lowest first.
        is_new: whether any of them has changed since all were painted last.
    """

    def __init__(self, changed: Callable[[], None]) -> None:
        self._changed = changed
        self.shapes: list[Shape] = []
        self.is_new = False
        self._drawn_on: Picture | None = None

    def add(self, shape: Shape) -> None:
        """Draw a shape more, over those of the same z."""
        shape.drawing = self
        insort(self.shapes, shape, key=_height)
        self.touch()

    def remove(self, shape: Shape) -> None:
        """Draw it no more."""
        shape.drawing = None
        self.shapes.remove(shape)
        self.touch()

    def touch(self) -> None:
        """Have all painted anew, together, when the event loop comes round."""
        if not self.is_new:
            self.is_new = True
            self._changed()

    def paint(
        self,
        painter: QPainter,
        to_pixels: QTransform,
        screen: Screen,
        picture: Picture | None,
    ) -> None:
        """Draw the picture and all that is visible over it.

        Args:
            painter: of the pane.
            to_pixels: takes plane millimetres to the pane's pixels.
            screen: the pane's own pixels.
            picture: on the screen's pixels; None where it has been painted already, or there is
                none.
        """
        self.is_new = False
        if picture is None:
            self._draw(painter, painter, to_pixels, screen, None)
            return
        sheet = picture.sheet
        if picture is self._drawn_on:  # else nobody has drawn on it yet
            np.copyto(sheet, picture.pixels)
        self._drawn_on = picture
        image = image_of(sheet, screen.ratio)
        with QPainter(image) as over:
            over.setFont(painter.font())
            self._draw(painter, over, to_pixels, screen, sheet)
        painter.drawImage(0, 0, image)

    def _draw(
        self,
        painter: QPainter,
        over: QPainter,
        to_pixels: QTransform,
        screen: Screen,
        sheet: NDArray[np.uint32] | None,
    ) -> None:
        """Draw all that is visible, the lowest first.

        Args:
            painter: of the pane.
            over: draws on `sheet`, or on the pane.
            to_pixels: takes plane millimetres to the pane's pixels.
            screen: the pane's own pixels.
            sheet: what strokes are drawn on; None to lay them over the pane as a picture.
        """
        smooth = False
        hint = QPainter.RenderHint.Antialiasing
        rows: list[float] = []
        for shape in self.shapes:
            if not shape.visible:
                continue
            if isinstance(shape, Strokes):
                rows += shape.rows
                continue
            if rows:
                _lay(painter, screen, rows, sheet)
                rows = []
            over.setTransform(to_pixels)
            over.setBrush(Qt.BrushStyle.NoBrush)
            if shape.smooth is not smooth:
                smooth = shape.smooth
                over.setRenderHint(hint, smooth)
            shape.paint(over)
        over.resetTransform()
        if rows:
            _lay(painter, screen, rows, sheet)


def _lay(
    painter: QPainter, screen: Screen, rows: list[float], sheet: NDArray[np.uint32] | None
) -> None:
    """Draw strokes on a picture; without one, over what the pane shows."""
    from app.imaging.screen import STROKE, draw_strokes  # compiled: since there is a volume

    drawn = np.zeros((screen.height, screen.width), np.uint32) if sheet is None else sheet
    strokes: NDArray[Any] = np.array(rows).reshape(-1, STROKE)
    draw_strokes(drawn, strokes, (screen.left, screen.top), screen.scale, screen.ratio)
    if sheet is None:
        painter.resetTransform()
        painter.drawImage(0, 0, image_of(drawn, screen.ratio, opaque=False))


def _height(shape: Shape) -> float:
    return shape.z
