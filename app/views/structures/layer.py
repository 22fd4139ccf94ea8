"""Outlines of structures over a slice: line, hatching and name, in whatever plane the pane has.

A structure has a colour of its own, hatching and dash are of its kind, so that neither stands
alone.
"""

from __future__ import annotations

from collections.abc import Sequence
from math import floor

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import (
    QBrush,
    QColor,
    QFontMetrics,
    QImage,
    QPainter,
    QPainterPath,
    QPen,
    QPolygonF,
    QTransform,
)

from app.core.arrays import FloatArray
from app.imaging.field.tissue_words import tissue_words
from app.imaging.structures.structure import Mask, Structure, StructureKind, contours
from app.planning.clearance import Nearness
from app.views.kit import theme
from app.views.kit.text import tr, translated
from app.views.slices.canvas import SliceCanvas
from app.views.slices.drawing import Drawing, Shape
from app.views.slices.items import label_font
from app.views.slices.pace import RestingLayer
from app.views.slices.plane import SlicePlane
from app.views.structures.book import StructureBook

HATCHES = {
    StructureKind.RISK: Qt.BrushStyle.DiagCrossPattern,
    StructureKind.VESSEL: Qt.BrushStyle.BDiagPattern,
    StructureKind.BONE: Qt.BrushStyle.Dense6Pattern,
    StructureKind.TARGET: Qt.BrushStyle.NoBrush,
    StructureKind.OTHER: Qt.BrushStyle.NoBrush,
}
DASHES: dict[StructureKind, tuple[float, ...]] = {
    StructureKind.OTHER: (2.0, 2.0),
    StructureKind.TARGET: (6.0, 3.0),
}
SIGNS = {
    StructureKind.RISK: "▩",
    StructureKind.VESSEL: "▨",
    StructureKind.BONE: "▒",
    StructureKind.TARGET: "◎",
    StructureKind.OTHER: "□",
}

NEARNESS_STYLES = {
    Nearness.FREE: (theme.TEXT, "✔"),
    Nearness.NEAR: (theme.WARNING, "▲"),
    Nearness.HIT: (theme.BAD, "✖"),
}
"""Colour and sign of a distance."""


def kind_names() -> dict[StructureKind, str]:
    """Names of the kinds for people."""
    return {
        StructureKind.RISK: tr("risk"),
        StructureKind.VESSEL: tr("vessel"),
        StructureKind.BONE: tr("bone"),
        StructureKind.TARGET: tr("target"),
        StructureKind.OTHER: tr("other"),
    }


def colour(structure: Structure, alpha: float = 1.0) -> QColor:
    """Return its colour as Qt's."""
    result = QColor(*structure.colour)
    result.setAlphaF(alpha)
    return result


def pen(structure: Structure, width: float = 2.0) -> QPen:
    """Return the pen of its outline, of the same width at every zoom."""
    result = QPen(colour(structure), width)
    result.setCosmetic(True)
    if structure.kind in DASHES:
        result.setDashPattern(list(DASHES[structure.kind]))
    return result


def named(structure: Structure) -> str:
    """Return its name with the sign of its kind."""
    return f"{SIGNS[structure.kind]} {name_words(structure)}"


def name_words(structure: Structure) -> str:
    """Return its name in the user's language, where it is one of ours."""
    return translated(tissue_words(structure.name))


HATCH_ALPHA = 0.55
SMALLEST_NAMED_PX = 14.0
"""Outlines smaller than this carry no name."""
MOST_KEPT_PX = 4e6
"""Pictures of outlines with more pixels than this, far zoomed in, are not kept."""


class StructureOutline(Shape):
    """One structure in one slice; its picture is kept until outline, style or zoom change."""

    def __init__(self, z: float) -> None:
        super().__init__(z)
        self._path, self._top = QPainterPath(), QPointF()
        self._picture = QImage()
        self._drawn_for: tuple[float, ...] = ()
        self._structure: Structure | None = None
        self._scale, self._bold = 1.0, False

    def set_lines(self, structure: Structure, lines: Sequence[FloatArray]) -> None:
        """Show closed lines of plane points [mm]."""
        self._structure = structure
        path = QPainterPath()
        path.setFillRule(Qt.FillRule.OddEvenFill)
        for line in lines:
            path.addPolygon(QPolygonF([QPointF(x, y) for x, y in line.tolist()]))
            path.closeSubpath()
        self._path = path
        if len(lines):
            points = np.vstack(list(lines))
            x, y = points[int(np.argmin(points[:, 1]))].tolist()
            self._top = QPointF(x, y)
        self.setVisible(bool(len(lines)))
        self.touch()

    def touch(self) -> None:
        """Have it painted anew, with another picture."""
        self._drawn_for = ()
        super().touch()

    def set_style(self, structure: Structure, scale: float, bold: bool) -> None:
        """Take the colours of `structure` and the zoom [px/mm]."""
        if (structure, scale, bold) != (self._structure, self._scale, self._bold):
            self._structure, self._scale, self._bold = structure, scale, bold
            self.touch()

    def boundingRect(self) -> QRectF:
        """Return the outline with its name."""
        margin = 4.0 / self._scale
        rect = self._path.boundingRect().adjusted(-margin, -margin, margin, margin)
        return rect.united(self.name_rect())

    @property
    def is_named(self) -> bool:
        """Return whether its name is written: it is large enough."""
        size = self._path.boundingRect()
        return max(size.width(), size.height()) * self._scale >= SMALLEST_NAMED_PX

    def name_rect(self) -> QRectF:
        """Return the place of its name [mm]."""
        if self._structure is None:
            return QRectF()
        metrics = QFontMetrics(label_font())
        width = metrics.horizontalAdvance(name_words(self._structure)) + 6.0
        height = metrics.height()
        return QRectF(
            self._top.x() - 0.5 * width / self._scale,
            self._top.y() - (height + 3.0) / self._scale,
            width / self._scale,
            height / self._scale,
        )

    def paint(self, painter: QPainter) -> None:
        """Draw its picture: moved by whole pixels, as a needle or a hand moves panes, the same."""
        to_pixels, ratio = painter.transform(), painter.device().devicePixelRatioF()
        place = to_pixels.mapRect(self.boundingRect()).toAlignedRect()
        if ratio**2 * place.width() * place.height() > MOST_KEPT_PX:
            self._draw(painter)
            return
        dx, dy = ratio * to_pixels.dx(), ratio * to_pixels.dy()
        drawn_for = (
            to_pixels.m11(),
            to_pixels.m12(),
            to_pixels.m21(),
            to_pixels.m22(),
            ratio,
            round(dx - floor(dx), 2),
            round(dy - floor(dy), 2),
        )
        if drawn_for != self._drawn_for:
            picture = QImage(place.size() * ratio, QImage.Format.Format_ARGB32_Premultiplied)
            picture.setDevicePixelRatio(ratio)
            picture.fill(0)
            with QPainter(picture) as over:
                over.setRenderHints(painter.renderHints())
                over.setTransform(to_pixels * QTransform.fromTranslate(-place.x(), -place.y()))
                self._draw(over)
            self._picture, self._drawn_for = picture, drawn_for
        painter.resetTransform()
        painter.drawImage(place.topLeft(), self._picture)
        painter.setTransform(to_pixels)

    def _draw(self, painter: QPainter) -> None:
        """Draw hatching, a dark rim, the line and the name."""
        structure = self._structure
        if structure is None:
            return
        style = HATCHES[structure.kind]
        if style is not Qt.BrushStyle.NoBrush:
            brush = QBrush(colour(structure, HATCH_ALPHA), style)
            brush.setTransform(QTransform.fromScale(1.0 / self._scale, 1.0 / self._scale))
            painter.fillPath(self._path, brush)
        line = pen(structure, 3.0 if self._bold else 2.0)
        rim = QPen(Qt.GlobalColor.black, line.widthF() + 2.0)
        rim.setCosmetic(True)
        painter.setOpacity(0.5)
        painter.strokePath(self._path, rim)
        painter.setOpacity(1.0)
        painter.strokePath(self._path, line)
        if self.is_named:
            self._draw_name(painter, structure)

    def _draw_name(self, painter: QPainter, structure: Structure) -> None:
        rect, name = self.name_rect(), name_words(structure)
        painter.save()
        painter.translate(rect.topLeft())
        painter.scale(1.0 / self._scale, 1.0 / self._scale)
        place = QRectF(0.0, 0.0, rect.width() * self._scale, rect.height() * self._scale)
        painter.setFont(label_font())
        flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextDontClip
        painter.setPen(Qt.GlobalColor.black)
        for dx, dy in ((-1, 0), (1, 0), (0, -1), (0, 1)):
            painter.drawText(place.translated(dx, dy), flags, name)
        painter.setPen(colour(structure).lighter(125))
        painter.drawText(place, flags, name)
        painter.restore()


class StructureLayer:
    """The outlines in one pane; computed anew only where mask or plane changed."""

    def __init__(self, drawing: Drawing, book: StructureBook) -> None:
        self._drawing, self._book = drawing, book
        self._items: dict[str, StructureOutline] = {}
        self._shown: dict[str, tuple[Mask, SlicePlane, float]] = {}

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Show the visible structures in this slice."""
        visible = self._book.visible
        self._drop({one.name for one in visible})
        axes: tuple[FloatArray, FloatArray, FloatArray] | None = None
        for structure in visible:
            item = self._items.get(structure.name)
            if item is None:
                item = self._items[structure.name] = StructureOutline(1.5)
                self._drawing.add(item)
            known = self._shown.get(structure.name)
            if (
                known is None
                or known[0] is not structure.mask
                or known[1] is not plane
                or known[2] != index
            ):
                if axes is None:
                    origin = plane.lps_mm(0.0, 0.0, index)
                    axes = (
                        origin,
                        plane.lps_mm(1.0, 0.0, index) - origin,
                        plane.lps_mm(0.0, 1.0, index) - origin,
                    )
                item.set_lines(structure, contours(structure, *axes))
                self._shown[structure.name] = (structure.mask, plane, index)
            item.set_style(structure, scale, structure.name == self._book.chosen)

    def names(self) -> list[QRectF]:
        """Return the places of the names that are written [mm]."""
        shown = (item for item in self._items.values() if item.isVisible() and item.is_named)
        return [item.name_rect() for item in shown]

    def hide(self) -> None:
        """Show nothing."""
        self._drop(set())

    def _drop(self, stored: set[str]) -> None:
        for name in set(self._items) - stored:
            self._drawing.remove(self._items.pop(name))
            self._shown.pop(name, None)


def draw_in(canvas: SliceCanvas, book: StructureBook) -> None:
    """Draw the structures in a pane; in a needle's only at rest: they cannot follow it live."""
    layer = StructureLayer(canvas.drawing, book)
    shown = RestingLayer(layer, canvas) if canvas.pane.is_needle else layer
    canvas.add_layer(shown, names=layer.names)
