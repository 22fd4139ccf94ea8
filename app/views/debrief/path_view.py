"""The tip's track in the bull's-eye plane, from the entry to where it ended."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np
from PySide6.QtCore import QPointF, QRectF, QSizeF, Qt
from PySide6.QtGui import (
    QColor,
    QPainter,
    QPaintEvent,
    QPen,
    QPixmap,
    QPolygonF,
    QResizeEvent,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.core.arrays import FloatArray
from app.planning.off_path import offset
from app.session.pad.hand import HandLimits
from app.session.pad.view import PadScene
from app.session.review import Review
from app.views.exercise.pad_canvas import PadArea, is_inside, paint_background
from app.views.kit import theme
from app.views.kit.text import tr

_FINENESS: Final = 2000.0
"""Places on the pad are told apart to one part in this of its radius: less than a pixel."""


_MOST: Final = 6000
"""A track of more places that a screen could tell apart is drawn by every second one, or fewer."""


@dataclass(frozen=True, slots=True, eq=False)
class NeedleMoment:
    """The needle at one sample of a replay, as places on the pad, shape (2,).

    Attributes:
        tip: of the needle.
        hub: of the needle.
        aim: where it is heading.
        force: at the hand, in world [N], shape (3,); None where nothing could push.
    """

    tip: FloatArray
    hub: FloatArray
    aim: FloatArray
    force: FloatArray | None


class PathView(QWidget):
    """Pad with the tip's track: a square where it began, a diamond where it ended.

    While the attempt is replayed the needle is drawn where it was then, with the force that was
    felt across it; a ghost's track is dotted.
    """

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._review: Review | None = None
        self._track: FloatArray = np.empty((0, 2))
        self._ghost: FloatArray = np.empty((0, 2))
        self._now: NeedleMoment | None = None
        self._ground: QPixmap | None = None
        self._names: list[QRectF] = []
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(160, 160)
        self.setToolTip(
            tr(
                "Track of the tip, seen along the planned path; a square where it began, a diamond "
                "where it ended; the arrow is the force at the hand"
            )
        )

    def show_review(self, review: Review) -> None:
        """Draw an attempt."""
        self._review, self._track = review, thinned(review.track())
        self._ghost, self._now = np.empty((0, 2)), None
        self._draw_anew()

    def show_ghost(self, track: FloatArray) -> None:
        """Draw the track of another attempt too: places on the pad, shape (n, 2); none if empty."""
        self._ghost = thinned(track)
        self._draw_anew()

    def show_row(self, row: int) -> None:
        """Draw the needle where it was at a sample."""
        self._now = None if self._review is None else moment(self._review, row)
        self.update()

    def resizeEvent(self, event: QResizeEvent) -> None:
        """Draw everything anew."""
        super().resizeEvent(event)
        self._draw_anew()

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw pad and tracks, which stay, then the moment."""
        review = self._review
        if review is None:
            return
        area, ratio = self._area(), self.devicePixelRatioF()
        if self._ground is None or self._ground.devicePixelRatio() != ratio:
            self._ground = self._painted(review, area, ratio)
        painter = QPainter(self)
        painter.drawPixmap(0, 0, self._ground)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self._now is not None:
            _paint_needle(painter, area, self._now)
            arrow = _paint_force(painter, area, pad_scene(review), self._now, review.force_limit)
            if arrow is not None:
                taken = [*self._names, *_places(area, self._now)]
                _write_force(painter, area, *arrow, taken)

    def _area(self) -> PadArea:
        return PadArea.inside(self.width(), self.height(), margin=28)

    def _draw_anew(self) -> None:
        self._ground = None
        self.update()

    def _painted(self, review: Review, area: PadArea, ratio: float) -> QPixmap:
        picture = QPixmap(round(self.width() * ratio), round(self.height() * ratio))
        picture.setDevicePixelRatio(ratio)
        picture.fill(QColor(theme.IMAGE_GROUND))
        with QPainter(picture) as painter:
            painter.setRenderHint(QPainter.RenderHint.Antialiasing)
            self._names = []
            paint_background(painter, area, pad_scene(review), self._names)
            dots = Qt.PenStyle.DotLine
            paint_track(
                painter, area, self._ghost, theme.GHOST.colour, 1.5, line=dots, filled=False
            )
            filled = review.motion is None
            paint_track(painter, area, self._track, theme.NEEDLE_TIP.colour, 1.8, filled=filled)
        return picture


def moment(review: Review, row: int) -> NeedleMoment | None:
    """Return what the pad shows of a sample; None where nothing measured the needle then.

    A place is that of the direction from the entry that leads as far past the target: so tip, hub
    and rings share one scale.
    """
    motion, placed = review.motion, review.placed
    if motion is None or not len(motion) or not motion.measured[row]:
        return None
    tip, axis, target = motion.tip[row], motion.axis[row], motion.target[row]
    if not (np.isfinite(tip).all() and np.isfinite(axis).all()):
        return None
    if not np.isfinite(target).all():
        target = placed.p_target
    away = offset(tip, axis, placed, target)
    hub = tip - motion.length * axis - target
    felt = motion.felt[row]
    frame, scale = review.frame, review.scale

    def place(across: FloatArray) -> FloatArray:
        return scale.place(frame.tilts(placed.p_target + across - placed.p_entry))

    return NeedleMoment(
        tip=place(away.across),
        hub=place(hub - (hub @ away.path) * away.path),
        aim=scale.place(frame.tilts(axis)),
        force=felt if review.renders and np.isfinite(felt).all() else None,
    )


def _paint_needle(painter: QPainter, area: PadArea, now: NeedleMoment) -> None:
    """Needle from hub to tip, and where it is heading: a dashed line to the aim's cross."""
    tip, hub, aim = area.point(now.tip), area.point(now.hub), area.point(now.aim)
    dashed = theme.NEEDLE.pen(1.5, 0.9)
    dashed.setDashPattern([4.0, 3.0])
    painter.setPen(dashed)
    painter.drawLine(tip, aim)
    painter.setPen(theme.NEEDLE.pen(2.0))
    painter.drawLine(aim + QPointF(-7, -7), aim + QPointF(7, 7))
    painter.drawLine(aim + QPointF(-7, 7), aim + QPointF(7, -7))
    painter.setPen(theme.NEEDLE.pen(4.0))
    painter.drawLine(hub, tip)
    painter.setPen(theme.NEEDLE.pen(2.0))
    painter.setBrush(QColor(theme.IMAGE_GROUND))
    painter.drawRect(QRectF(hub.x() - 6, hub.y() - 6, 12, 12))
    painter.setPen(theme.NEEDLE_TIP.pen(2.0))
    painter.setBrush(theme.NEEDLE_TIP.qcolor())
    corners = ((0, -9), (9, 0), (0, 9), (-9, 0))
    painter.drawPolygon(QPolygonF([tip + QPointF(x, y) for x, y in corners]))


_ARROW: Final = 0.45
"""Length of the arrow of the largest force, in radii of the pad."""

_LEAST_N: Final = 0.05
"""Below this force there is no arrow [N]."""


def _places(area: PadArea, now: NeedleMoment) -> list[QRectF]:
    """Return where the marks of hub, tip and aim stand, which no words may cover."""
    side = 2.0 * _MARK_PX
    points = (area.point(place) for place in (now.hub, now.tip, now.aim))
    return [QRectF(at.x() - _MARK_PX, at.y() - _MARK_PX, side, side) for at in points]


_MARK_PX: Final = 9.0
"""Half the width of the largest of them [px]."""


def _paint_force(
    painter: QPainter, area: PadArea, scene: PadScene, now: NeedleMoment, limit: float
) -> tuple[float, QPointF] | None:
    """Draw the arrow of the force across the path from the hub.

    Returns:
        Size of the force [N] and end of the arrow [px]; None where there is none.
    """
    if now.force is None:
        return None
    across = np.array([now.force @ scene.frame.right, -(now.force @ scene.frame.up)])
    size = float(np.hypot(*across))
    if size < _LEAST_N:
        return None
    start = area.point(now.hub)
    step = across / max(limit, size) * _ARROW * area.radius
    end = start + QPointF(float(step[0]), float(step[1]))
    side = QPointF(-float(across[1]), float(across[0])) * (4.0 / size)
    back = QPointF(float(across[0]), float(across[1])) * (8.0 / size)
    painter.setPen(QPen(QColor(FORCE_COLOUR), 2.0))
    painter.setBrush(QColor(FORCE_COLOUR))
    painter.drawLine(start, end)
    painter.drawPolygon(QPolygonF([end, end - back + side, end - back - side]))
    return size, end


def _write_force(
    painter: QPainter, area: PadArea, size: float, end: QPointF, taken: Sequence[QRectF]
) -> None:
    """Write how large a force is near its arrow's end, where nothing else is marked or written."""
    words = tr("{force:.1f} N", force=size)
    painter.setFont(theme.font_of(theme.SMALL_PX))
    metrics = painter.fontMetrics()
    box = force_place(
        area, end, QSizeF(metrics.horizontalAdvance(words) + 4.0, float(metrics.height())), taken
    )
    painter.fillRect(box, QColor(theme.IMAGE_GROUND))
    painter.setPen(QColor(FORCE_COLOUR))
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, words)


def force_place(area: PadArea, end: QPointF, size: QSizeF, taken: Sequence[QRectF]) -> QRectF:
    """Return the nearest free place for words about an arrow, outwards from its end.

    Args:
        area: of the pad.
        end: of the arrow [px].
        size: of the words [px].
        taken: places of marks and other words [px].
    """
    away = end - area.centre
    turn = float(np.arctan2(away.y(), away.x()))
    reach = 6.0 + 0.5 * max(size.width(), size.height())
    for far in np.arange(reach, 2.0 * area.radius, 6.0):
        for angle in turn + np.radians((0.0, 35.0, -35.0, 70.0, -70.0, 110.0, -110.0, 180.0)):
            box = QRectF(QPointF(), size)
            box.moveCenter(end + QPointF(float(far * np.cos(angle)), float(far * np.sin(angle))))
            if is_inside(box, area) and not any(box.intersects(other) for other in taken):
                return box
    box = QRectF(QPointF(), size)
    box.moveCenter(area.centre + QPointF(0.0, area.radius - size.height()))
    return box


FORCE_COLOUR: Final = "#f0e442"
"""Of the force: its curve and its arrow."""


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
    line: Qt.PenStyle = Qt.PenStyle.SolidLine,
    filled: bool = True,
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
        line: how the line is drawn.
        filled: whether the diamond at the end is; a needle that is replayed has one itself.
    """
    known = np.asarray(np.isfinite(places).all(axis=1))
    if not known.any():
        return
    painter.setPen(QPen(QColor(colour), width, line))
    painter.setBrush(Qt.BrushStyle.NoBrush)
    breaks = np.flatnonzero(np.diff(known.astype(np.int8))) + 1
    for part in np.split(np.arange(len(places)), breaks):
        if known[part[0]]:
            painter.drawPolyline(QPolygonF([area.point(places[i]) for i in part]))
    first, last = area.point(places[known][0]), area.point(places[known][-1])
    painter.setPen(QPen(QColor(colour), width))
    painter.setBrush(QColor(ground))
    painter.drawRect(QRectF(first.x() - mark / 2, first.y() - mark / 2, mark, mark))
    painter.setBrush(QColor(colour if filled else ground))
    corners = ((0, -1), (1, 0), (0, 1), (-1, 0))
    painter.drawPolygon(QPolygonF([last + QPointF(mark * x, mark * y) for x, y in corners]))
