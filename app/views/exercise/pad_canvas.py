"""The pad itself: draws, and turns mouse and keys into steps of the hand."""

from math import radians
from typing import Final

from numpy.typing import ArrayLike
from PySide6.QtCore import QPointF, QSize, Qt, Signal
from PySide6.QtGui import QKeyEvent, QMouseEvent, QPainter, QPaintEvent, QWheelEvent
from PySide6.QtWidgets import QSizePolicy, QWidget

from app.session.pad.view import PadScene, PadView
from app.views.exercise.pad_painter import (
    PadArea,
    paint_background,
    paint_hand,
    paint_hidden,
    paint_needle,
)
from app.views.kit import theme
from app.views.kit.text import tr

TILT_STEP: Final = radians(0.2)
FINE_TILT_STEP: Final = radians(0.05)
DEPTH_STEP: Final = 0.001
FINE_DEPTH_STEP: Final = 0.0002
NOTCH: Final = 120
"""One notch of a mouse wheel in the unit of Qt, an eighth of a degree."""
_ARROWS: Final = {
    Qt.Key.Key_Left: (-1.0, 0.0),
    Qt.Key.Key_Right: (1.0, 0.0),
    Qt.Key.Key_Up: (0.0, 1.0),
    Qt.Key.Key_Down: (0.0, -1.0),
}


class PadCanvas(QWidget):
    """Shows the pad and reports what the user does on it.

    Signals:
        dragged(right, up): mouse step in units of the pad's radius.
        tilted(right, up): key step [rad].
        advanced(step): depth step [m], positive inwards.
        homed(): the hand shall go to where the needle is.
    """

    dragged = Signal(float, float)
    tilted = Signal(float, float)
    advanced = Signal(float)
    homed = Signal()

    def __init__(self, parent: QWidget | None = None) -> None:
        super().__init__(parent)
        self._scene: PadScene | None = None
        self._view: PadView | None = None
        self._hand: ArrayLike | None = None
        self._last: QPointF | None = None
        self._wheel = 0
        self._hides_needle = False
        self.setFocusPolicy(Qt.FocusPolicy.StrongFocus)
        self.setSizePolicy(QSizePolicy.Policy.Expanding, QSizePolicy.Policy.Expanding)
        self.setMinimumSize(180, 180)
        self.setAccessibleName(tr("Bull's-eye pad"))

    def sizeHint(self) -> QSize:
        """Preferred size."""
        return QSize(360, 360)

    def set_scene(self, scene: PadScene | None) -> None:
        """Take a new path; None clears the pad."""
        self._scene, self._view, self._hand = scene, None, None
        self.update()

    def hide_needle(self, hidden: bool) -> None:
        """Draw neither path nor needle; mouse and keys work as ever."""
        self._hides_needle = hidden
        self.update()

    def show_view(self, view: PadView, hand_tilts: ArrayLike | None) -> None:
        """Draw a new moment; `hand_tilts` [rad] is None when no simulated hand holds."""
        self._view, self._hand = view, hand_tilts
        self.update()

    @property
    def area(self) -> PadArea:
        """Where the pad lies now."""
        return PadArea.inside(self.width(), self.height(), margin=30)

    def paintEvent(self, event: QPaintEvent) -> None:
        """Draw background, needle, hand."""
        painter = QPainter(self)
        painter.setRenderHint(QPainter.RenderHint.Antialiasing)
        if self._scene is None:
            painter.setPen(theme.ROBOT.qcolor())
            painter.drawText(self.rect(), Qt.AlignmentFlag.AlignCenter, tr("No planned path"))
            return
        if self._hides_needle:
            paint_hidden(painter, self.area, tr("Move the hand here: it is not shown"))
            return
        paint_background(painter, self.area, self._scene, self._view)
        if self._view is not None:
            paint_needle(painter, self.area, self._scene, self._view)
            if self._hand is not None:
                paint_hand(painter, self.area, self._scene, self._view, self._hand)

    def mousePressEvent(self, event: QMouseEvent) -> None:
        """Start a drag."""
        if event.button() == Qt.MouseButton.LeftButton:
            self._last = event.position()
            self.setCursor(Qt.CursorShape.ClosedHandCursor)

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

    def wheelEvent(self, event: QWheelEvent) -> None:
        """Depth: a notch towards the user pulls, away from the user pushes the needle in."""
        delta = event.angleDelta()
        # Some platforms turn Shift+wheel into a horizontal wheel.
        self._wheel += delta.y() or delta.x()
        notches = int(self._wheel / NOTCH)
        self._wheel -= notches * NOTCH
        if notches:
            self.advanced.emit(notches * _depth_step(event.modifiers()))
        event.accept()

    def keyPressEvent(self, event: QKeyEvent) -> None:
        """Arrows tilt, Page keys move along the needle, Home lets the hand go to the needle."""
        key, shift = Qt.Key(event.key()), event.modifiers()
        if key in _ARROWS:
            fine = shift & Qt.KeyboardModifier.ShiftModifier
            step = FINE_TILT_STEP if fine else TILT_STEP
            self.tilted.emit(step * _ARROWS[key][0], step * _ARROWS[key][1])
        elif key == Qt.Key.Key_PageDown:
            self.advanced.emit(_depth_step(shift))
        elif key == Qt.Key.Key_PageUp:
            self.advanced.emit(-_depth_step(shift))
        elif key == Qt.Key.Key_Home:
            self.homed.emit()
        else:
            super().keyPressEvent(event)


def _depth_step(modifiers: Qt.KeyboardModifier) -> float:
    fine = modifiers & Qt.KeyboardModifier.ShiftModifier
    return FINE_DEPTH_STEP if fine else DEPTH_STEP
