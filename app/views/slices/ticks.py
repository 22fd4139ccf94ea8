"""Where the needle is heading: its line ahead of the tip, with a tick every 10 mm."""

from __future__ import annotations

from math import hypot

import numpy as np
from PySide6.QtCore import QLineF, QPointF, QRectF
from PySide6.QtGui import QPainter, QPen

from app.core.arrays import FloatArray
from app.views.kit import theme
from app.views.kit.theme import Mark
from app.views.slices.drawing import Drawing, Shape
from app.views.slices.plane import SlicePlane
from app.views.slices.rimmed_text import rimmed
from app.views.slices.viewing import Viewing

STEP_MM = 10.0
LABEL_PX = 42.0
"""Labels stand no nearer to each other than this."""

TICK_PX, LONG_TICK_PX = 4.0, 8.0
BEYOND_MM, SHORTEST_MM, LONGEST_MM = 20.0, 50.0, 200.0
"""The line goes so far beyond the target, and is at least and at most so long."""

LINE = Mark(theme.NEEDLE_TIP.colour, dash=(1.5, 3.0), width=1.5)


_LINE_PEN, _TICK_PEN = LINE.pen(), QPen(LINE.qcolor(), 1.5)
_TICK_PEN.setCosmetic(True)


class TicksItem(Shape):
    """A dotted line with ticks and their distances from its start."""

    def __init__(self) -> None:
        super().__init__(2.5, visible=False)
        self._start, self._along = QPointF(), QPointF()
        self._length = self._step = self._scale = 0.0
        self._label_mm = STEP_MM
        self._faded = False
        self._state: tuple[object, ...] = ()

    def place(
        self,
        start: tuple[float, float],
        end: tuple[float, float],
        length_mm: float,
        scale: float,
        faded: bool,
    ) -> None:
        """Run from `start` to `end` in the plane.

        Args:
            start: where it starts [mm].
            end: where it ends [mm].
            length_mm: true length in space; in the plane it may be shorter.
            scale: zoom [px/mm].
            faded: whether it is off the slice.
        """
        run, fall = end[0] - start[0], end[1] - start[1]
        seen = hypot(run, fall)
        if seen < 1e-6:
            self.setVisible(False)
            return
        self.setVisible(True)
        state = (start, end, length_mm, scale, faded)
        if state == self._state:
            return
        self._state = state
        self._start, self._along = QPointF(*start), QPointF(run / seen, fall / seen)
        self._length, self._step = seen, STEP_MM * seen / length_mm
        self._scale, self._faded = scale, faded
        steps = (1, 2, 5, 10, 20)
        apart = self._step * scale
        self._label_mm = STEP_MM * next((n for n in steps if n * apart >= LABEL_PX), 50)
        self.touch()

    @property
    def ticks(self) -> list[QPointF]:
        """Places of the ticks [mm], the first one step from the start."""
        count = int(self._length / self._step + 1e-9) if self._step > 0.0 else 0
        return [self._start + self._along * (n * self._step) for n in range(1, count + 1)]

    def boundingRect(self) -> QRectF:
        """Return the rectangle between the line's ends [mm]."""
        return QRectF(self._start, self._start + self._along * self._length).normalized()

    def paint(self, painter: QPainter) -> None:
        """Draw line, ticks and labels with a dark rim."""
        painter.setOpacity(0.5 if self._faded else 0.95)
        painter.setPen(_LINE_PEN)
        painter.drawLine(self._start, self._start + self._along * self._length)
        across = QPointF(-self._along.y(), self._along.x()) / self._scale
        painter.setPen(_TICK_PEN)
        lines: list[QLineF] = []
        labels: list[tuple[QPointF, str]] = []
        to_pixels = painter.transform()
        for number, tick in enumerate(self.ticks, start=1):
            reach = across * (LONG_TICK_PX if number % 5 == 0 else TICK_PX)
            lines.append(QLineF(tick - reach, tick + reach))
            depth = number * STEP_MM
            if round(depth % self._label_mm, 6) == 0:
                at = to_pixels.map(tick + across * (2.2 * LONG_TICK_PX))
                labels.append((QPointF(at), f"{depth:.0f}"))
        painter.drawLines(lines)
        self._draw_labels(painter, labels)
        painter.setOpacity(1.0)

    @staticmethod
    def _draw_labels(painter: QPainter, labels: list[tuple[QPointF, str]]) -> None:
        """Copy the labels to these pixels of the device."""
        ratio = painter.device().devicePixelRatioF()
        painter.resetTransform()
        for at, text in labels:
            picture = rimmed(text, theme.SMALL_PX, theme.NEEDLE_TIP.colour, ratio)
            size = picture.deviceIndependentSize()
            painter.drawPixmap(at - QPointF(size.width() / 2, size.height() / 2), picture)


class TickLayer:
    """Ticks ahead of the live tip; without a needle, from the entry along the planned path."""

    def __init__(self, drawing: Drawing, viewing: Viewing) -> None:
        self._viewing = viewing
        self.item = TicksItem()
        drawing.add(self.item)

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Show the ticks where needle or path are."""
        line = self._line()
        if line is None:
            self.hide()
            return
        start, end = (plane.point(point, index) for point in line)
        faded = max(abs(start.distance), abs(end.distance)) > plane.half_slab_mm
        length = float(np.linalg.norm(line[1] - line[0]))
        self.item.place((start.x, start.y), (end.x, end.y), length, scale, faded)

    def hide(self) -> None:
        """Show nothing."""
        self.item.setVisible(False)

    def _line(self) -> tuple[FloatArray, FloatArray] | None:
        """Start and end of the line, LPS [mm]."""
        needle, draft = self._viewing.needle, self._viewing.shown_draft
        target = None if draft.target_mm is None else np.asarray(draft.target_mm)
        if needle is not None and needle.valid:
            shaft = needle.tip_direction
            length = float(np.linalg.norm(shaft))
            if length < 1e-6:
                return None
            axis = shaft / length
            left = 0.0 if target is None else float((target - needle.tip_mm) @ axis)
            ahead = min(max(left + BEYOND_MM, SHORTEST_MM), LONGEST_MM)
            return needle.tip_mm, needle.tip_mm + ahead * axis
        if needle is None and draft.entry_mm is not None and target is not None:
            entry = np.asarray(draft.entry_mm)
            return (entry, target) if np.linalg.norm(target - entry) > 1.0 else None
        return None
