"""The depth along the path as a bar: skin, needle, target, and the depth not to be passed."""

from __future__ import annotations

from typing import Final

from PySide6.QtCore import QPointF, QRectF, QSize, Qt
from PySide6.QtGui import QColor, QFont, QFontMetrics, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.session.pad.view import PadScene
from app.views.kit import theme
from app.views.kit.text import literal, tr

_COLUMN: Final = 26
_TOP, _BOTTOM = 18, 14
_NARROW: Final = 48
"""Width without words [px]."""


class DepthBar(QWidget):
    """Depth along the path, the skin on top; drawn to one scale, marks told apart by shape."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._scene: PadScene | None = None
        self._depth: float | None = None
        self._hand: float | None = None
        self._measured, self._narrow = True, False
        self.setSizePolicy(QSizePolicy.Policy.Fixed, QSizePolicy.Policy.Expanding)
        self.setAccessibleName(tr("Depth bar"))

    def sizeHint(self) -> QSize:
        """Preferred size: the bar with the longest of its labels, or without any."""
        if self._narrow:
            return QSize(_NARROW, 120)
        font = QFont(self.font())
        font.setPixelSize(theme.SMALL_PX)
        label = tr("Target {mm:.0f}", mm=1000)
        return QSize(24 + _COLUMN + QFontMetrics(font).horizontalAdvance(label), 300)

    def set_narrow(self, narrow: bool) -> None:
        """Draw the marks without their words: they stand in the tooltip, the depth in the rail."""
        self._narrow = narrow
        self._explain()
        self.updateGeometry()
        self.update()

    def set_scene(self, scene: PadScene | None) -> None:
        """Take a new path; None clears the bar."""
        self._scene, self._depth, self._hand = scene, None, None
        self._explain()
        self.update()

    def retarget(self, scene: PadScene) -> None:
        """Take the path to another target; the needle stays where it is."""
        self._scene = scene
        self._explain()
        self.update()

    def show_depth(self, depth: float, measured: bool, hand: float | None) -> None:
        """Draw a depth [m], whether it is a fresh measurement, and the depth the hand wants."""
        self._depth, self._measured, self._hand = depth, measured, hand
        self.update()

    def _explain(self) -> None:
        scene = self._scene
        if scene is None or not self._narrow:
            self.setToolTip("")
            return
        words = tr(
            "Skin 0 · Target {target:.0f} · Stop {stop:.0f} mm",
            target=1e3 * scene.target_depth,
            stop=1e3 * scene.stop_depth,
        )
        self.setToolTip(literal(words))

    @property
    def span(self) -> tuple[float, float]:
        """Shallowest and deepest depth on the bar [m]."""
        scene = self._scene
        if scene is None:
            return -0.03, 0.1
        return max(-0.03, scene.limits.shallowest), max(scene.stop_depth, scene.target_depth) * 1.15

    def pixel(self, depth: float) -> float:
        """Height on the widget [px] of a depth [m], kept on the bar."""
        low, high = self.span
        share = min(1.0, max(0.0, (depth - low) / (high - low)))
        return _TOP + share * (self.height() - _TOP - _BOTTOM)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw the bar."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        font = QFont(painter.font())
        font.setPixelSize(theme.SMALL_PX)
        painter.setFont(font)
        low, high = self.span
        top, bottom = self.pixel(low), self.pixel(high)
        painter.setPen(QPen(QColor(theme.BORDER), 1.0))
        painter.setBrush(QColor("#0e1114"))
        painter.drawRect(QRectF(10, top, _COLUMN, bottom - top))
        if self._scene is not None:
            self._paint_depth(painter)
            self._paint_marks(painter, self._scene)

    def _paint_depth(self, painter: QPainter) -> None:
        if self._depth is None:
            return
        if self._measured:  # a guess is never drawn as if the needle were there
            self._paint_needle(painter, self.pixel(self._depth))
        if self._hand is not None:
            self._paint_hand(painter, self.pixel(self._hand))

    def _paint_needle(self, painter: QPainter, tip: float) -> None:
        skin, top = self.pixel(0.0), self.pixel(self.span[0])
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(theme.NEEDLE.qcolor(0.35))
        painter.drawRect(QRectF(10 + _COLUMN / 2 - 2, top, 4, min(skin, tip) - top))
        painter.setBrush(theme.NEEDLE.qcolor(0.85))
        painter.drawRect(QRectF(10 + _COLUMN / 2 - 5, skin, 10, max(0.0, tip - skin)))
        painter.setPen(theme.NEEDLE_TIP.pen(2.0))
        painter.setBrush(theme.NEEDLE_TIP.qcolor())
        at = QPointF(10 + _COLUMN / 2, tip)
        painter.drawPolygon(QPolygonF([at + QPointF(-8, -8), at + QPointF(8, -8), at]))

    def _paint_hand(self, painter: QPainter, y: float) -> None:
        painter.setPen(QPen(QColor(theme.TEXT), 1.5))
        painter.setBrush(Qt.BrushStyle.NoBrush)
        painter.drawPolygon(QPolygonF([QPointF(0, y - 6), QPointF(9, y), QPointF(0, y + 6)]))

    def _paint_marks(self, painter: QPainter, scene: PadScene) -> None:
        band = scene.depth_tolerance
        first, last = (self.pixel(scene.target_depth + sign * band) for sign in (-1, 1))
        painter.setPen(Qt.PenStyle.NoPen)
        painter.setBrush(theme.TARGET.qcolor(0.35))
        painter.drawRect(QRectF(10, first, _COLUMN, max(2.0, last - first)))
        target, stop = self.pixel(scene.target_depth), self.pixel(scene.stop_depth)
        # The two labels keep a line's height apart even when the marks lie closer.
        label = max(stop, target + 16)
        self._mark(painter, self.pixel(0.0), self.pixel(0.0), theme.SKIN.colour, tr("Skin"))
        self._mark(
            painter,
            target,
            target,
            theme.TARGET.colour,
            tr("Target {mm:.0f}", mm=1e3 * scene.target_depth),
        )
        self._mark(
            painter, stop, label, theme.BAD, tr("Stop {mm:.0f}", mm=1e3 * scene.stop_depth), 4.0
        )

    def _mark(
        self,
        painter: QPainter,
        y: float,
        label_y: float,
        colour: str,
        text: str,
        width: float = 2.0,
    ) -> None:
        painter.setPen(QPen(QColor(colour), width))
        painter.drawLine(QPointF(8, y), QPointF(12 + _COLUMN, y))
        if self._narrow:
            return
        painter.setPen(QPen(QColor(theme.now(colour)), 1.0))
        painter.drawLine(QPointF(12 + _COLUMN, y), QPointF(18 + _COLUMN, label_y))
        painter.drawText(QPointF(21 + _COLUMN, label_y + 5), text)
