"""The tip's track in the bull's-eye plane, from the entry to where it ended."""

from typing import Final

import numpy as np
from PySide6.QtCore import QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QPainter, QPaintEvent, QPen, QPolygonF
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.core.arrays import FloatArray
from app.session.pad.hand import HandLimits
from app.session.pad.view import PadScene
from app.session.review import Review
from app.views.exercise.pad_canvas import PadArea, paint_background
from app.views.kit import theme
from app.views.kit.text import tr

_FINENESS: Final = 2000.0
"""Places on the pad are told apart to one part in this of its radius: less than a pixel."""


_MOST: Final = 6000
"""A track of more places that a screen could tell apart is drawn by every second one, or fewer."""


class PathView(QWidget):
    """Pad with the tip's track: a square where it began, a diamond where it ended."""

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._review: Review | None = None
        self._track: FloatArray = np.empty((0, 2))
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(200, 200)
        self.setToolTip(
            tr(
                "Track of the tip, seen along the planned path; a square where it began, a diamond "
                "where it ended"
            )
        )

    def show_review(self, review: Review) -> None:
        """Draw an attempt."""
        self._review, self._track = review, thinned(review.track())
        self.update()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw pad and track."""
        if self._review is None:
            return
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        area = PadArea.inside(self.width(), self.height(), margin=28)
        paint_background(painter, area, pad_scene(self._review))
        paint_track(painter, area, self._track, theme.NEEDLE_TIP.colour, 1.8)


def thinned(places: FloatArray) -> FloatArray:
    """Leave out what no screen can show of a track: places that round to the one before.

    Of what is left no more than `_MOST` places are taken, at equal steps.

    Args:
        places: on the pad, shape (n, 2); NaN where there is none.

    Returns:
        Shape (m, 2), the first and the last place among them, and a gap where one was.
    """
    if len(places) < 3:
        return places
    whole = np.rint(np.nan_to_num(places, nan=-_FINENESS) * _FINENESS)
    moved = np.any(np.diff(whole, axis=0) != 0.0, axis=1)
    keep = np.concatenate(([True], moved))
    keep[:-1] |= moved  # the end of a stretch stays as well as its beginning
    keep[-1] = True
    left = places[keep]
    step = -(-len(left) // _MOST)
    return left if step < 2 else np.vstack((left[::step], left[-1:]))


def pad_scene(review: Review) -> PadScene:
    """Return the pad of an attempt that is over."""
    placed = review.placed
    limits = HandLimits(1.5, -0.03, 2.0 * placed.length)
    return PadScene(
        frame=review.frame,
        scale=review.scale,
        rings=review.rings,
        limits=limits,
        p_entry=placed.p_entry,
        target_depth=placed.length,
        depth_tolerance=review.rings[0],
        stop_depth=placed.length + review.rings[1],
    )


def paint_track(
    painter: QPainter,
    area: PadArea,
    places: FloatArray,
    colour: str,
    width: float,
    mark: float = 8.0,
    ground: str = theme.IMAGE_GROUND,
) -> None:
    """Draw a track of pad places, shape (n, 2); gaps where there is no number.

    Args:
        painter: draws.
        area: where the pad lies.
        places: on the pad.
        colour: of the track.
        width: of the line.
        mark: half the diagonal of the end's diamond.
        ground: colour inside the square at the beginning.
    """
    known = np.asarray(np.isfinite(places).all(axis=1))
    if not known.any():
        return
    painter.setPen(QPen(QColor(colour), width))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    breaks = np.flatnonzero(np.diff(known.astype(np.int8))) + 1
    for part in np.split(np.arange(len(places)), breaks):
        if known[part[0]]:
            painter.drawPolyline(QPolygonF([area.point(places[i]) for i in part]))
    first, last = area.point(places[known][0]), area.point(places[known][-1])
    painter.setBrush(QColor(ground))
    painter.drawRect(QRectF(first.x() - mark / 2, first.y() - mark / 2, mark, mark))
    painter.setBrush(QColor(colour))
    corners = ((0, -1), (1, 0), (0, 1), (-1, 0))
    painter.drawPolygon(QPolygonF([last + QPointF(mark * x, mark * y) for x, y in corners]))
