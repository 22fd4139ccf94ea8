"""The bull's-eye pad: the target in the middle, its rings, and one dot that the pointer moves.

The dot stands where the needle's line passes the target (`session.pad.aim`), on the side that the
order speaks of, and leaves a trace of its last second: a hand that trembles is seen to.
"""

from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass
from math import atan2, copysign, hypot, radians
from time import monotonic
from typing import Final

import numpy as np
from numpy.typing import ArrayLike
from PySide6.QtCore import QEvent, QPointF, QRectF, QSize, QSizeF, Qt, Signal
from PySide6.QtGui import (
    QColor,
    QFocusEvent,
    QKeyEvent,
    QMouseEvent,
    QPainter,
    QPaintEvent,
    QPen,
    QPolygonF,
    QWheelEvent,
)
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.core.arrays import FloatArray
from app.session.pad.view import NeedleLine, PadScene
from app.views.exercise.hands.feed import DEPTH_STEP, FINE_DEPTH_STEP, GONE, SPEED, Feed
from app.views.kit import theme
from app.views.kit.text import listing, literal, tr

_FAR_MM: Final = (10, 40)
"""Radii of the rings beyond the tolerance [mm]: in the unit of all others."""

DOT_PX: Final = 7.0
"""Radius of the dot [px]."""

TRACE_S: Final = 1.0
"""So long the dot leaves a trace [s]."""

_DIAGONALS: Final = ((0.7071, -0.7071), (0.7071, 0.7071), (-0.7071, 0.7071), (-0.7071, -0.7071))
"""Where a ring's size may stand, to the right and downwards from the middle, in its radius."""

SMALLEST_PX: Final = 10
"""Smallest letters within the rim."""

_BESIDE: Final = 7
"""From the rim to the letters beside it [px]."""


@dataclass(frozen=True, slots=True)
class PadArea:
    """Where the pad lies in its widget: centre and radius [px]."""

    centre: QPointF
    radius: float

    @classmethod
    def inside(cls, width: float, height: float, margin: float) -> "PadArea":
        """Largest pad in a rectangle, leaving `margin` [px] for the letters."""
        return cls(QPointF(width / 2, height / 2), max(10.0, min(width, height) / 2 - margin))

    def point(self, place: ArrayLike) -> QPointF:
        """Pixel of a place on the pad; places beyond the rim are drawn on it."""
        x, y = np.asarray(place, dtype=np.float64)
        shrink = self.radius / max(1.0, hypot(x, y))
        return self.centre + QPointF(shrink * x, -shrink * y)


def paint_hidden(painter: QPainter, area: PadArea, words: str) -> None:
    """Rim and words: a field to move the hand in that says nothing of where it is.

    The words are as large as fits into the rim, and left out where even small ones do not.
    """
    painter.setPen(QPen(QColor(theme.IMAGE_LINE), 1.5))
    painter.setBrush(QColor("#0e1114"))
    painter.drawEllipse(area.centre, area.radius, area.radius)
    painter.setPen(QColor(theme.IMAGE_DIM))
    half = 0.7 * area.radius
    box = QRectF(area.centre.x() - half, area.centre.y() - half, 2 * half, 2 * half)
    flags = Qt.AlignmentFlag.AlignCenter | Qt.TextFlag.TextWordWrap
    for pixels in range(theme.FONT_PX, SMALLEST_PX - 1, -1):
        painter.setFont(theme.font_of(pixels))
        if box.contains(painter.boundingRect(box, flags, words)):
            painter.drawText(box, flags, words)
            return


def paint_background(
    painter: QPainter, area: PadArea, scene: PadScene, taken: list[QRectF] | None = None
) -> list[str]:
    """Rim, rings with their sizes, cross, letters, target: always in the middle, as it is now.

    Args:
        painter: of the widget.
        area: of the pad.
        scene: what the pad shows.
        taken: gets the places of the sizes, for whoever writes more upon it.

    Returns:
        Sizes of rings for which there is no room.
    """
    painter.setPen(QPen(QColor(theme.IMAGE_LINE), 1.5))
    painter.setBrush(QColor("#0e1114"))
    painter.drawEllipse(area.centre, area.radius, area.radius)
    _cross(painter, area)
    taken = [] if taken is None else taken
    unnamed: list[str] = []
    for i, ring in reversed(list(enumerate(scene.rings))):
        radius = scene.scale.radius(atan2(ring, scene.scale.length))
        _ring(painter, area, radius, theme.TARGET.colour, 2.5 if i == 0 else 1.6)
        name = tr("{mm:g} mm", mm=1e3 * ring)
        if not _ring_name(painter, area, radius, theme.TARGET.colour, name, taken):
            unnamed.append(name)
    for far_mm in _FAR_MM:
        radius = scene.scale.radius(atan2(1e-3 * far_mm, scene.scale.length))
        _ring(painter, area, radius, theme.IMAGE_LINE, 1.0)
        name = tr("{mm:g} mm", mm=far_mm)
        if not _ring_name(painter, area, radius, theme.IMAGE_DIM, name, taken):
            unnamed.append(name)
    _letters(painter, area, scene.frame.letters)
    painter.setPen(Qt.PenStyle.NoPen)
    painter.setBrush(theme.TARGET.qcolor())
    painter.drawEllipse(area.centre, 3.5, 3.5)
    return unnamed


def paint_dot(
    painter: QPainter, area: PadArea, places: Sequence[FloatArray], measured: bool
) -> None:
    """Draw the dot where it is, and the trace of where it was; hollow while nobody measures it.

    Args:
        painter: of the widget.
        area: of the pad.
        places: on the pad, the newest last, shape (2,) each; at least one.
        measured: whether the depth is known.
    """
    at = area.point(places[-1])
    painter.setPen(QPen(QColor(theme.IMAGE_DIM), 1.0))
    painter.drawLine(at, area.centre)  # the way that it is to go
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(theme.NEEDLE_TIP.pen(1.5, 0.55))
    painter.drawPolyline(QPolygonF([area.point(place) for place in places]))
    painter.setPen(theme.NEEDLE_TIP.pen(2.5))
    painter.setBrush(theme.NEEDLE_TIP.qcolor() if measured else QColor(theme.IMAGE_GROUND))
    painter.drawEllipse(at, DOT_PX, DOT_PX)


def _cross(painter: QPainter, area: PadArea) -> None:
    painter.setPen(QPen(QColor(theme.IMAGE_LINE), 1.0))
    for x, y in ((1.0, 0.0), (0.0, 1.0)):
        painter.drawLine(area.point((-x, -y)), area.point((x, y)))


def _ring(painter: QPainter, area: PadArea, radius: float, colour: str, width: float) -> None:
    painter.setBrush(Qt.BrushStyle.NoBrush)
    painter.setPen(QPen(QColor(colour), width))
    size = radius * area.radius
    painter.drawEllipse(area.centre, size, size)


def _ring_name(
    painter: QPainter, area: PadArea, radius: float, colour: str, name: str, taken: list[QRectF]
) -> bool:
    """Write a ring's size beside it where no other one's stands, in smaller letters if need be.

    Returns:
        Whether there was room.
    """
    for pixels in range(theme.SMALL_PX, SMALLEST_PX - 1, -1):
        painter.setFont(theme.font_of(pixels))
        metrics = painter.fontMetrics()
        size = QSizeF(metrics.horizontalAdvance(name) + 4.0, float(metrics.height()))
        box = free_corner(area, radius, size, taken)
        if box is not None:
            break
    else:
        return False
    taken.append(box)
    painter.fillRect(box, QColor(theme.IMAGE_GROUND))
    painter.setPen(QColor(colour))
    painter.drawText(box, Qt.AlignmentFlag.AlignCenter, name)
    return True


def free_corner(
    area: PadArea, radius: float, size: QSizeF, taken: Sequence[QRectF]
) -> QRectF | None:
    """Return the first place at a ring for a text that covers none that is taken.

    Outside the ring, else on its line; never across the rim nor over the middle.

    Args:
        area: of the pad.
        radius: of the ring, in radii of the pad.
        size: of the text [px].
        taken: places of other texts.
    """
    reach = radius * area.radius
    on_line = [*(QPointF(reach * x, reach * y) for x, y in _DIAGONALS), QPointF(0.0, -reach)]
    on_line.append(QPointF(0.0, reach))
    outside = [
        QPointF(
            at.x() + copysign(3.0 + size.width() / 2, at.x()),
            at.y() + copysign(size.height() / 2, at.y()),
        )
        for at in on_line[: len(_DIAGONALS)]
    ]
    for middle in (*outside, *on_line):
        box = QRectF(QPointF(), size)
        box.moveCenter(area.centre + middle)
        centred = _distance(box, area.centre) < reach / 2
        covers = any(box.intersects(other) for other in taken)
        if is_inside(box, area) and not covers and not centred:
            return box
    return None


def _distance(box: QRectF, point: QPointF) -> float:
    """Return how far a point is from a rectangle; 0 within it."""
    x = max(box.left() - point.x(), 0.0, point.x() - box.right())
    y = max(box.top() - point.y(), 0.0, point.y() - box.bottom())
    return hypot(x, y)


def is_inside(box: QRectF, area: PadArea) -> bool:
    """Return whether a rectangle lies within the pad's rim."""
    corners = (box.topLeft(), box.topRight(), box.bottomLeft(), box.bottomRight())
    ends = (corner - area.centre for corner in corners)
    return all(hypot(end.x(), end.y()) < area.radius for end in ends)


def _letters(painter: QPainter, area: PadArea, letters: Sequence[str]) -> None:
    painter.setFont(theme.font_of(theme.FONT_PX + 3, bold=True))
    painter.setPen(QColor(theme.TEXT))
    reach = area.radius + 0.5 * theme.FONT_PX + _BESIDE
    for text, (x, y) in zip(letters, ((-1, 0), (1, 0), (0, -1), (0, 1)), strict=True):
        centre = area.centre + QPointF(reach * x, reach * y)
        box = QRectF(centre.x() - 24, centre.y() - 12, 48, 24)
        painter.drawText(box, Qt.AlignmentFlag.AlignCenter, text)


TILT_STEP: Final = radians(0.2)
FINE_TILT_STEP: Final = radians(0.05)
NOTCH: Final = 120
"""One notch of a mouse wheel in the unit of Qt, an eighth of a degree."""
_ARROWS: Final = {
    Qt.Key.Key_Left: (-1.0, 0.0),
    Qt.Key.Key_Right: (1.0, 0.0),
    Qt.Key.Key_Up: (0.0, 1.0),
    Qt.Key.Key_Down: (0.0, -1.0),
}
_FEEDING: Final[dict[Qt.Key | Qt.MouseButton, bool]] = {
    Qt.Key.Key_PageDown: True,
    Qt.Key.Key_PageUp: False,
    Qt.MouseButton.RightButton: True,
    Qt.MouseButton.MiddleButton: False,
}
"""Keys and buttons that feed while they are held, and whether they feed inwards."""

_TURNING: Final = {Qt.Key.Key_E: True, Qt.Key.Key_Q: False}
"""Keys that turn a bevelled needle while they are held, and whether clockwise."""

TURN: Final = radians(90.0) / SPEED
"""Roll of the needle [rad] for what would push by a metre: a press turns by 4.5°."""


class PadCanvas(QWidget):
    """Shows the pad and reports what the user does on it.

    Signals:
        dragged(right, up): mouse step in units of the pad's radius.
        tilted(right, up): key step [rad].
        advanced(step): depth step [m], positive inwards.
        homed(): the hand shall go to where the needle is.
        rolled(step): the needle is turned about itself [rad], clockwise seen from the hub.

    Attributes:
        feed: what is held to push or pull.
        turn: what is held to roll the needle.
        rolls: whether the keys Q and E do; else they are the menus'.
    """

    dragged = Signal(float, float)
    tilted = Signal(float, float)
    advanced = Signal(float)
    homed = Signal()
    rolled = Signal(float)

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._scene: PadScene | None = None
        self._view: NeedleLine | None = None
        self._dots: deque[tuple[float, FloatArray]] = deque()
        self._hub = False
        self._last: QPointF | None = None
        self._wheel = 0
        self._hides_needle = False
        self.feed = Feed(self)
        self.feed.advanced.connect(self.advanced)
        self.turn, self.rolls = Feed(self), False
        self.turn.advanced.connect(lambda step: self.rolled.emit(TURN * step))
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(180, 180)
        self.setAccessibleName(tr("Bull's-eye pad"))

    def sizeHint(self) -> QSize:
        """Preferred size."""
        return QSize(360, 360)

    def set_clock(self, clock: Callable[[], float]) -> None:
        """Take the time [s] by which what is held moves the needle."""
        self.feed.set_clock(clock)
        self.turn.set_clock(clock)

    def set_scene(self, scene: PadScene | None) -> None:
        """Take a new path; None clears the pad."""
        self.setToolTip("")  # of what was shown before
        self.let_go()
        self._scene, self._view = scene, None
        self._dots.clear()
        self.update()

    def retarget(self, scene: PadScene) -> None:
        """Take the path to another target; a drag and what is held go on."""
        self._scene, self._view = scene, None
        self._dots.clear()
        self.update()

    def hide_needle(self, hidden: bool) -> None:
        """Draw neither path nor needle; mouse and keys work as ever."""
        self._hides_needle = hidden
        self.update()

    def show_view(self, view: NeedleLine, hub: bool = False) -> None:
        """Draw a new moment; `hub`: whether the dot goes where the hub goes, not the tip."""
        if self._scene is None:
            return
        if hub is not self._hub:
            self._hub = hub
            self._dots.clear()
        now = monotonic()
        self._view = view
        self._dots.append((now, view.dot(self._scene, hub)))
        while now - self._dots[0][0] > TRACE_S:
            self._dots.popleft()
        self.update()

    @property
    def dot(self) -> FloatArray | None:
        """Place of the dot on the pad, shape (2,), 1 being the rim; None before there is one."""
        return self._dots[-1][1] if self._dots else None

    @property
    def area(self) -> PadArea:
        """Return where the pad lies now."""
        margin = theme.FONT_PX + 3 + _BESIDE
        return PadArea.inside(self.width(), self.height(), margin)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw background and dot."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self._scene is None:
            painter.setPen(theme.ROBOT.qcolor())
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, tr("No planned path"))
            return
        if self._hides_needle:
            words = tr("Move the hand here: it is not shown")
            self.setToolTip(literal(words))
            paint_hidden(painter, self.area, words)
            return
        unnamed = paint_background(painter, self.area, self._scene)
        self.setToolTip(literal(tr("Rings: {sizes}", sizes=listing(unnamed)) if unnamed else ""))
        if self._view is not None:
            places = [place for _, place in self._dots]
            paint_dot(painter, self.area, places, self._view.measured)

    def let_go(self) -> None:
        """End a drag and what is held to push or pull; idempotent."""
        self.feed.let_go()
        self.turn.let_go()
        self._last = None
        self.unsetCursor()

    def event(self, event: QEvent) -> bool:
        """Let go where no release of key or mouse will come; take Q and E from the menus."""
        if event.type() in GONE:
            self.let_go()
        asks = event.type() == QEvent.Type.ShortcutOverride and isinstance(event, QKeyEvent)
        if asks and self._turns(event):
            event.accept()
            return True
        return super().event(event)

    def focusOutEvent(self, event: QFocusEvent) -> None:
        """Let go: the keys are somebody else's now."""
        self.let_go()
        super().focusOutEvent(event)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Start a drag, or begin to push or pull."""
        if event.button() == Qt.MouseButton.LeftButton:
            self._last = event.position()
            self.setCursor(Qt.CursorShape.ClosedHandCursor)
        elif event.button() in _FEEDING:
            self.feed.press(event.button(), _FEEDING[event.button()], _is_fine(event.modifiers()))

    def mouseMoveEvent(self, event: QMouseEvent) -> None:
        """Report the step since the last event."""
        if self._last is not None:
            step = (event.position() - self._last) / self.area.radius
            self._last = event.position()
            self.dragged.emit(step.x(), -step.y())

    def mouseReleaseEvent(self, event: QMouseEvent) -> None:
        """End the drag; the hand stays where it is."""
        if event.button() == Qt.MouseButton.LeftButton:
            self._last = None
            self.unsetCursor()
        self.feed.release(event.button())

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Depth: a notch towards the user pulls, away from the user pushes the needle in.

        So it is also where the system turns the wheel round for pages: a needle is no page.
        """
        delta = event.angleDelta()
        # Some platforms turn Shift+wheel into a horizontal wheel.
        away = delta.y() or delta.x()
        self._wheel += -away if event.inverted() else away
        notches = int(self._wheel / NOTCH)
        self._wheel -= notches * NOTCH
        if notches:
            self.advanced.emit(notches * _depth_step(event.modifiers()))
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Arrows tilt, Page keys move along the needle, Home lets the hand go to the needle."""
        key, fine = Qt.Key(event.key()), _is_fine(event.modifiers())
        if key in _ARROWS:
            step = FINE_TILT_STEP if fine else TILT_STEP
            self.tilted.emit(step * _ARROWS[key][0], step * _ARROWS[key][1])
        elif key == Qt.Key.Key_Shift:
            self.feed.set_fine(True)
            self.turn.set_fine(True)
        elif self._turns(event):
            if not event.isAutoRepeat():
                self.turn.press(key, _TURNING[key], fine)
        elif key in _FEEDING:
            if not event.isAutoRepeat():  # what is held goes on by itself, or was let go by others
                self.feed.press(key, _FEEDING[key], fine)
        elif key == Qt.Key.Key_Home:
            self.homed.emit()
        else:
            super().keyPressEvent(event)

    def keyReleaseEvent(self, event: QKeyEvent) -> None:
        """Stop what the key held."""
        key = Qt.Key(event.key())
        if key == Qt.Key.Key_Shift:
            self.feed.set_fine(False)
            self.turn.set_fine(False)
        elif key in _TURNING:
            if not event.isAutoRepeat():
                self.turn.release(key)
        elif key in _FEEDING:
            if not event.isAutoRepeat():
                self.feed.release(key)
        else:
            super().keyReleaseEvent(event)

    def _turns(self, event: QEvent) -> bool:
        """Return whether a key event turns the needle."""
        if not (self.rolls and isinstance(event, QKeyEvent)):
            return False
        plain = event.modifiers() in (
            Qt.KeyboardModifier.NoModifier,
            Qt.KeyboardModifier.ShiftModifier,
        )
        return plain and event.key() in _TURNING


def _is_fine(modifiers: Qt.KeyboardModifier) -> bool:
    return bool(modifiers & Qt.KeyboardModifier.ShiftModifier)


def _depth_step(modifiers: Qt.KeyboardModifier) -> float:
    return FINE_DEPTH_STEP if _is_fine(modifiers) else DEPTH_STEP
