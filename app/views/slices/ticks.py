"""Where the needle is heading: its line ahead of the tip, with a tick every 10 mm."""

from __future__ import annotations

from math import hypot

import numpy as np
from PySide6.QtCore import QPointF
from PySide6.QtGui import QPainter

from app.core.arrays import FloatArray
from app.views.kit import theme
from app.views.kit.theme import Mark
from app.views.slices.drawing import Drawing, Ink, Shape, Strokes, stroke
from app.views.slices.plane import SlicePlane
from app.views.slices.viewing import Viewing
from app.views.slices.words import rimmed

STEP_MM = 10.0
LABEL_PX = 42.0
"""Labels stand no nearer to each other than this."""

TICK_PX, LONG_TICK_PX = 4.0, 8.0
BEYOND_MM, SHORTEST_MM, LONGEST_MM = 20.0, 50.0, 200.0
"""The line goes so far beyond the target, and is at least and at most so long."""

LINE = Mark(theme.NEEDLE_TIP.colour, dash=(1.5, 3.0), width=1.5)
_LINE_INK, _TICK_INK = Ink.of(LINE), Ink.of(LINE, dash=())


class TicksItem(Strokes):
    """A dotted line with ticks; their distances from its start stand in `labels`."""

    def __init__(self) -> None:
        super().__init__(2.5, visible=False)
        self.labels = _Labels()
        self._start, self._along = (0.0, 0.0), (0.0, 0.0)
        self._length = self._step = 0.0
        self._state: tuple[object, ...] = ()

    def setVisible(self, visible: bool) -> None:
        """Draw line and labels from now on, or not."""
        super().setVisible(visible)
        self.labels.setVisible(visible)

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
        self._start, self._along = start, (run / seen, fall / seen)
        self._length, self._step = seen, STEP_MM * seen / length_mm
        apart = self._step * scale
        label_mm = STEP_MM * next((n for n in (1, 2, 5, 10, 20) if n * apart >= LABEL_PX), 50)
        opacity = 0.5 if faded else 0.95
        alphas = (opacity, opacity)
        rows = [*stroke(start, end, _LINE_INK, alphas)]
        dx, dy = -self._along[1] / scale, self._along[0] / scale
        labels: list[tuple[QPointF, str]] = []
        for number, (x, y) in enumerate(self._places(), start=1):
            reach = LONG_TICK_PX if number % 5 == 0 else TICK_PX
            across, down = reach * dx, reach * dy
            rows += stroke((x - across, y - down), (x + across, y + down), _TICK_INK, alphas)
            depth = number * STEP_MM
            if round(depth % label_mm, 6) == 0:
                beside = 2.2 * LONG_TICK_PX
                labels.append((QPointF(x + beside * dx, y + beside * dy), f"{depth:.0f}"))
        self.set_rows(rows)
        self.labels.show(labels, opacity)

    def _places(self) -> list[tuple[float, float]]:
        count = int(self._length / self._step + 1e-9) if self._step > 0.0 else 0
        (x, y), (dx, dy), step = self._start, self._along, self._step
        return [(x + n * step * dx, y + n * step * dy) for n in range(1, count + 1)]

    @property
    def ticks(self) -> list[QPointF]:
        """Places of the ticks [mm], the first one step from the start."""
        return [QPointF(x, y) for x, y in self._places()]


class _Labels(Shape):
    """Distances beside the ticks; they do not zoom."""

    def __init__(self) -> None:
        super().__init__(3.9, visible=False)
        self._labels: list[tuple[QPointF, str]] = []
        self._opacity = 1.0

    def show(self, labels: list[tuple[QPointF, str]], opacity: float) -> None:
        """Write these in the middle of these places [mm]."""
        self._labels, self._opacity = labels, opacity
        self.touch()

    def paint(self, painter: QPainter) -> None:
        """Copy the words."""
        ratio, to_pixels = painter.device().devicePixelRatioF(), painter.transform()
        painter.resetTransform()
        painter.setOpacity(self._opacity)
        for place, text in self._labels:
            picture = rimmed(text, theme.SMALL_PX, theme.NEEDLE_TIP.colour, ratio)
            size, at = picture.deviceIndependentSize(), to_pixels.map(place)
            painter.drawPixmap(at - QPointF(size.width() / 2, size.height() / 2), picture)
        painter.setOpacity(1.0)


class TickLayer:
    """Ticks ahead of the live tip; without a needle, from the entry along the planned path."""

    def __init__(self, drawing: Drawing, viewing: Viewing) -> None:
        self._viewing = viewing
        self.item = TicksItem()
        drawing.add(self.item)
        drawing.add(self.item.labels)

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
