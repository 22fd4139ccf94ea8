"""The map of entries: how good a path from each place of the skin to the target would be."""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import NDArray
from PySide6.QtCore import QPointF, Qt
from PySide6.QtGui import QColor, QPainter, QPen

from app.core.arrays import FloatArray
from app.views.kit.text import tr
from app.views.slices.drawing import Drawing, Shape
from app.views.slices.plane import SlicePlane

if TYPE_CHECKING:
    from app.planning.paths import PathScores

CLASSES = (80.0, 65.0, 50.0)
"""Scores from which a path is of the first, second, third class; below is the fourth."""

COLOURS = ((253, 231, 37), (53, 183, 121), (49, 104, 142), (99, 62, 150))
"""Of the classes, best first: from viridis, which also falls in lightness."""

BLOCKED = (150, 150, 150)
SIZES_PX = (6.5, 5.3, 4.2, 3.4)
"""Radii of the dots by class, so that the colour does not stand alone."""

SHOWN_BLOCKED = ("reach", "bone", "structure", "air", "flat", "lung", "vessel", "gut", "heart")
"""Paths that are too long are not drawn: most of the skin is too far away."""


def class_of(score: FloatArray) -> NDArray[np.intp]:
    """Class of scores, 0 (best) to 3."""
    result: NDArray[np.intp] = np.sum(score[:, None] < np.array(CLASSES), axis=1)
    return result


@dataclass(frozen=True, slots=True, eq=False)
class EntryMap:
    """What is drawn of scored paths.

    Attributes:
        points_mm: entries, LPS, shape (n, 3).
        classes: 0 (best) to 3; -1 blocked, shape (n,).
    """

    points_mm: FloatArray
    classes: NDArray[np.intp]

    @classmethod
    def of(cls, scores: PathScores) -> EntryMap:
        """Take over all entries but those too far away."""
        from app.planning.paths import PathObstacle  # scipy: loaded since there are scores

        names = np.array([block.value for block in PathObstacle])[scores.block]
        classes = np.where(scores.free, class_of(np.nan_to_num(scores.score)), -1)
        shown = scores.free | np.isin(names, SHOWN_BLOCKED)
        return cls(scores.entries_mm[shown], classes[shown])


def legend() -> tuple[tuple[tuple[int, int, int], str], ...]:
    """Colours and words of the classes, then of what is blocked."""
    return (
        (COLOURS[0], tr("● {low:.0f} to 100", low=CLASSES[0])),
        (COLOURS[1], tr("● {low:.0f} to {high:.0f}", low=CLASSES[1], high=CLASSES[0])),
        (COLOURS[2], tr("• {low:.0f} to {high:.0f}", low=CLASSES[2], high=CLASSES[1])),
        (COLOURS[3], tr("• below {high:.0f}", high=CLASSES[2])),
        (BLOCKED, tr("× not possible")),
    )


class _Dots(Shape):
    """Dots and crosses of constant size."""

    def __init__(self) -> None:
        super().__init__(1.8, visible=False)
        self._places: list[tuple[float, float, int]] = []
        self._scale = 1.0

    def set_places(self, places: list[tuple[float, float, int]], scale: float) -> None:
        """Take plane points [mm] with their classes, and the zoom [px/mm]."""
        self._places, self._scale = places, scale
        self.setVisible(bool(places))
        self.touch()

    def paint(self, painter: QPainter) -> None:
        """Draw the worst first, so that the best stay visible."""
        rim = QPen(Qt.GlobalColor.black, 1.0)
        rim.setCosmetic(True)
        for x, y, number in sorted(self._places, key=lambda place: -(place[2] % 5)):
            if number < 0:
                cross = QPen(QColor(*BLOCKED), 1.5)
                cross.setCosmetic(True)
                painter.setPen(cross)
                r = 3.0 / self._scale
                painter.drawLine(QPointF(x - r, y - r), QPointF(x + r, y + r))
                painter.drawLine(QPointF(x - r, y + r), QPointF(x + r, y - r))
                continue
            painter.setPen(rim)
            painter.setBrush(QColor(*COLOURS[number]))
            r = SIZES_PX[number] / self._scale
            painter.drawEllipse(QPointF(x, y), r, r)


class EntryMapLayer:
    """The dots in one pane."""

    def __init__(self, drawing: Drawing) -> None:
        self._map: EntryMap | None = None
        self._dots = _Dots()
        drawing.add(self._dots)

    def set_map(self, shown: EntryMap | None) -> None:
        """Show another map from the next `place` on, or none."""
        self._map = shown

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Show the entries near this slice."""
        if self._map is None or not len(self._map.points_mm):
            self._dots.set_places([], scale)
            return
        origin = plane.lps_mm(0.0, 0.0, index)
        x, y = (plane.lps_mm(*at, index) - origin for at in ((1.0, 0.0), (0.0, 1.0)))
        frame = np.linalg.inv(np.column_stack([x, y, np.cross(x, y)]))
        places = (self._map.points_mm - origin) @ frame.T
        near = np.abs(places[:, 2]) <= max(3.5, plane.half_slab_mm)
        self._dots.set_places(
            [
                (x, y, n)
                for (x, y, _), n in zip(
                    places[near].tolist(), self._map.classes[near].tolist(), strict=True
                )
            ],
            scale,
        )

    def hide(self) -> None:
        """Show nothing."""
        self._dots.setVisible(False)
