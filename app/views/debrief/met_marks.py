"""Marks where the needle met bone, vessel, lung, gut or heart: over the slices and in 3D.

Each kind has a colour and a shape, so that neither stands alone; a stretch that the tip went
through is a line as well. They lie in the tissue's own coordinates, as the CT shows it. What is
pointed at says all that is known of it.
"""

from __future__ import annotations

from collections.abc import Callable, Collection, Sequence
from dataclasses import dataclass
from functools import partial
from typing import Final

import numpy as np
from PySide6.QtCore import QEvent, QObject, QPointF, QRectF, Qt
from PySide6.QtGui import QColor, QFontMetrics, QHelpEvent, QPainter, QPen
from PySide6.QtWidgets import QToolTip, QWidget

from app.core.arrays import FloatArray
from app.imaging.field.tissue_words import tissue_words
from app.scoring.met import LEAST_MM, Met
from app.session.review import Review
from app.views.exercise.readouts import clock_text
from app.views.kit.text import literal, tr, tr_n, translated
from app.views.kit.theme import Mark, Symbol
from app.views.scene.view import SceneView
from app.views.slices.canvas import SliceCanvas
from app.views.slices.items import MarkItem, draw_symbol, label_font
from app.views.slices.layers import SegmentLayer
from app.views.slices.plane import SlicePlane

MARKS: Final = {
    "bone": Mark("#f0e442", symbol=Symbol.TRIANGLE, width=2.2),
    "vessel": Mark("#ff8a66", symbol=Symbol.CROSS, width=2.6),
    "lung": Mark("#8fc7ff", symbol=Symbol.DOWN, width=2.2),
    "gut": Mark("#35d0a0", symbol=Symbol.PLUS, width=2.6),
    "heart": Mark("#ff8a66", symbol=Symbol.STAR, width=2.2),
    "organ": Mark("#d0b3ff", symbol=Symbol.HEXAGON, width=2.2),
}
"""How each kind is marked: hues that colour-blind people tell apart, lightened for black."""

SAME_MM: Final = 3.0
"""One tissue met again no farther away than this has one mark."""

MOST: Final = 6
"""So many places of a kind are marked, those that fail the attempt first."""

REACH_MM: Final = 4.0
"""A mark is shown in slices that pass no farther from it than this."""

HIT_PX: Final = 12.0
"""Who points so near to a mark means it."""


@dataclass(frozen=True, slots=True, eq=False)
class MetPlace:
    """A place where the needle met something, perhaps again and again.

    Attributes:
        kind: of tissue; a key of `MARKS`.
        name: as it stands beside the mark.
        ends_mm: where the longest stretch in it began and ended, LPS, shape (2, 3).
        help: all that is known, in lines.
        fails: whether it is forbidden.
    """

    kind: str
    name: str
    ends_mm: FloatArray
    help: str
    fails: bool

    @property
    def has_length(self) -> bool:
        """Return whether it is more than a touch."""
        return float(np.linalg.norm(self.ends_mm[1] - self.ends_mm[0])) >= LEAST_MM


def kind_word(kind: str) -> str:
    """Name of a kind of tissue for people."""
    return translated(tissue_words(kind))


def places_of(review: Review) -> tuple[MetPlace, ...]:
    """Return what is marked of an attempt: what may matter, not what every needle goes through."""
    forbidden = review.score.rules.forbidden if review.score is not None else ()
    groups: list[list[Met]] = []
    for met in review.met or ():
        if met.kind not in MARKS or (met.holds_target and met.kind != "lung"):
            continue
        near = (one for one in groups if one[0].words == met.words and _apart(one, met) <= SAME_MM)
        group = next(near, None)
        if group is None:
            groups.append([met])
        else:
            group.append(met)
    places = [_place(group, forbidden, review.clock_at) for group in groups]
    counts = dict.fromkeys(MARKS, 0)
    shown = []
    for place in sorted(places, key=lambda one: not one.fails):
        counts[place.kind] += 1
        if counts[place.kind] <= MOST:
            shown.append(place)
    return tuple(shown)


def _apart(group: Sequence[Met], met: Met) -> float:
    return float(np.linalg.norm(np.subtract(group[0].points[0], met.points[0])))


def _place(
    group: Sequence[Met], forbidden: Collection[str], clock: Callable[[float], float]
) -> MetPlace:
    longest = max(group, key=lambda met: met.length_mm)
    fails = any(met.is_forbidden(forbidden) for met in group)
    forces = [met.force_n for met in group if met.force_n is not None]
    word = kind_word(longest.kind)
    name = translated(longest.words)
    lines = (
        f"{name} ({word})" if name != word else name,
        tr("✖ This fails the attempt.") if fails else "",
        tr("{met}, at {when}", met=group[0].sentence, when=clock_text(clock(group[0].time))),
        tr_n("met {n} time here", "met {n} times here", len(group)) if len(group) > 1 else "",
        tr("longest way in it: {mm:.1f} mm", mm=longest.length_mm),
        tr("largest force along the needle: {force:.1f} N", force=max(forces))
        if forces
        else tr("force along the needle: nobody felt it"),
        tr("{angle:.0f}° from straight in", angle=longest.angle_deg),
    )
    return MetPlace(
        kind=longest.kind,
        name=f"✖ {name}" if fails else name,
        ends_mm=np.array(longest.points, dtype=np.float64),
        help="\n".join(filter(None, lines)),
        fails=fails,
    )


class MetLayer(QObject):
    """The marks over one slice.

    Attributes:
        marks: their symbols, of which those shown have a place.
    """

    def __init__(self, canvas: SliceCanvas) -> None:
        super().__init__(canvas)
        self._canvas = canvas
        self._items: dict[str, list[tuple[SegmentLayer, MarkItem]]] = {}
        self._places: dict[MarkItem, MetPlace] = {}
        self._shown: tuple[MetPlace, ...] = ()
        for kind, mark in MARKS.items():
            self._items[kind] = [
                (SegmentLayer(canvas.drawing, mark, 3.2), MarkItem(mark, 4.5, optional=True))
                for _ in range(MOST)
            ]
        self.marks = tuple(mark for row in self._items.values() for _, mark in row)
        for item in self.marks:
            item.setVisible(False)
            canvas.drawing.add(item)
        canvas.add_layer(self, self.marks)
        canvas.installEventFilter(self)

    def set_places(self, places: tuple[MetPlace, ...]) -> None:
        """Mark other places."""
        self._shown = places
        self._canvas.refresh()

    def place(self, plane: SlicePlane, index: float, scale: float) -> None:
        """Put the marks where they belong in a slice; of those that it does not pass, none."""
        self.hide()
        rows = {kind: iter(items) for kind, items in self._items.items()}
        for place in self._shown:
            begin, end = (plane.point(point, index) for point in place.ends_mm)
            near = min((begin, end), key=lambda at: abs(at.distance))
            reach = plane.half_slab_mm + REACH_MM
            crosses = (begin.distance > 0.0) != (end.distance > 0.0)
            if not crosses and abs(near.distance) > reach:
                continue
            line, mark = next(rows[place.kind])
            if place.has_length:
                line.place(begin, end, plane.half_slab_mm)
            in_slice = crosses or abs(near.distance) <= plane.half_slab_mm
            mark.place(near.x, near.y, partial(str, place.name), in_slice)
            mark.setVisible(True)
            self._places[mark] = place

    def hide(self) -> None:
        """Show nothing."""
        self._places.clear()
        for items in self._items.values():
            for line, mark in items:
                line.hide()
                mark.setVisible(False)

    def at(self, x_px: float, y_px: float) -> MetPlace | None:
        """Return what is marked at a pixel of the pane; None for nothing."""
        pixels = {mark: self._canvas.pixel_at(mark.x(), mark.y()) for mark in self._places}
        return _nearest({self._places[m]: (at.x(), at.y()) for m, at in pixels.items()}, x_px, y_px)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Say what a mark is to whoever points at it."""
        return _explain(event, self._canvas, self.at)


class MetScene(QObject):
    """The marks over the 3D view: the patient never hides them."""

    def __init__(self, scene: SceneView) -> None:
        super().__init__(scene)
        self._scene = scene
        self._shown: tuple[MetPlace, ...] = ()
        scene.overlays.append(self.paint)
        scene.installEventFilter(self)

    def set_places(self, places: tuple[MetPlace, ...]) -> None:
        """Mark other places."""
        self._shown = places
        self._scene.update()

    def paint(self, painter: QPainter, scene: SceneView) -> None:
        """Draw lines, symbols and names; a name is left out where it would lie on another."""
        if not self._shown:
            return
        painter.save()
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        painter.setFont(label_font())
        letters, taken = QFontMetrics(painter.font()), list[QRectF]()
        for place in self._shown:
            mark = MARKS[place.kind]
            colour = QColor(scene.display.colour(mark.colour))
            begin, end = (QPointF(*at) for at in scene.pixels(place.ends_mm).tolist())
            ground = QColor(scene.display.background)
            for width, ink in ((mark.width + 2.5, ground), (mark.width, colour)):
                painter.setPen(QPen(ink, width))
                if place.has_length:
                    painter.drawLine(begin, end)
                painter.save()
                painter.translate(begin)
                draw_symbol(painter, mark, False)
                painter.restore()
            side = begin + QPointF(MarkItem.RADIUS + 4.0, -0.5 * letters.height())
            box = QRectF(
                side.x(), side.y(), letters.horizontalAdvance(place.name), letters.height()
            )
            if any(box.intersects(other) for other in taken):
                continue
            taken.append(box)
            _write(painter, box, place.name, colour, ground)
        painter.restore()

    def at(self, x_px: float, y_px: float) -> MetPlace | None:
        """Return what is marked at a pixel; None for nothing."""
        places = {place: self._scene.pixels(place.ends_mm)[0].tolist() for place in self._shown}
        return _nearest({place: (x, y) for place, (x, y) in places.items()}, x_px, y_px)

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Say what a mark is to whoever points at it."""
        return _explain(event, self._scene, self.at)


def _write(painter: QPainter, box: QRectF, text: str, colour: QColor, ground: QColor) -> None:
    flags = Qt.AlignmentFlag.AlignLeft | Qt.AlignmentFlag.AlignVCenter | Qt.TextFlag.TextDontClip
    painter.setPen(ground)
    for dx, dy in ((-1, 0), (1, 0), (0, -1), (0, 1)):
        painter.drawText(box.translated(dx, dy), flags, text)
    painter.setPen(colour)
    painter.drawText(box, flags, text)


def _nearest(
    pixels: dict[MetPlace, tuple[float, float]], x_px: float, y_px: float
) -> MetPlace | None:
    away = {place: np.hypot(x - x_px, y - y_px) for place, (x, y) in pixels.items()}
    best = min(away, key=lambda place: float(away[place]), default=None)
    return best if best is not None and away[best] <= HIT_PX else None


def _explain(event: QEvent, widget: QWidget, at: Callable[[float, float], MetPlace | None]) -> bool:
    if event.type() != QEvent.Type.ToolTip or not isinstance(event, QHelpEvent):
        return False
    place = at(float(event.pos().x()), float(event.pos().y()))
    if place is None:
        return False
    QToolTip.showText(event.globalPos(), literal(place.help), widget)
    return True
