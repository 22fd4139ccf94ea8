"""Sources of the simulated hand: mouse and keyboard on the pad, or a pen with tilt.

Drag and arrows tilt, wheel and Page keys push and pull. A pen is held like the needle: it tilts the
needle, and its pressure pushes it in. The pen is the needle and the tablet the skin: leaning the
pen's end to the right brings the hub to the right and so turns the tip to the left. Nothing moves
while the pen only hovers, and putting it down makes no jump: the hand follows the change of tilt
since then.
"""

from collections.abc import Callable
from math import isfinite, radians
from typing import ClassVar, Final

from PySide6.QtCore import QEvent, QObject, QPointF, Qt, QTimer, Signal
from PySide6.QtGui import QInputDevice, QTabletEvent

from app.session.pad.hand import PadHand
from app.views.exercise.pad_canvas import PadCanvas
from app.views.kit.text import tr


class HandSource(QObject):
    """Moves the simulated hand between `open` and `close`; one source is open at a time.

    Attributes:
        name: as it is recorded with every attempt.
        gain: hand movement per movement of the source, as the user chose it.

    Signals:
        moved(HandChange): the user moved the hand.
        homed(): the hand shall go to where the needle is.
        noted(str): what the user should know about the source now; empty for nothing.
    """

    name: ClassVar[str] = ""

    moved = Signal(object)
    homed = Signal()
    noted = Signal(str)

    def __init__(self, pad: PadCanvas) -> None:
        super().__init__(pad)
        self.pad = pad
        self.gain = 0.5

    def open(self) -> None:
        """Begin to listen.

        Raises:
            AcusError: if this computer lacks what the source needs; says what to install.
        """
        raise NotImplementedError

    def close(self) -> None:
        """Stop listening; idempotent. The hand stays where it is."""
        raise NotImplementedError


class MouseHand(HandSource):
    """Passes on what the pad reports; the gain acts on drags only, keys have their own steps."""

    name: ClassVar[str] = "mouse"

    def __init__(self, pad: PadCanvas) -> None:
        super().__init__(pad)
        self._open = False

    def open(self) -> None:
        """Listen to the pad."""
        if not self._open:
            self._open = True
            self.pad.dragged.connect(self._drag)
            self.pad.tilted.connect(self._tilt)
            self.pad.advanced.connect(self._advance)
            self.pad.homed.connect(self.homed)

    def close(self) -> None:
        """Stop listening."""
        if self._open:
            self._open = False
            self.pad.dragged.disconnect(self._drag)
            self.pad.tilted.disconnect(self._tilt)
            self.pad.advanced.disconnect(self._advance)
            self.pad.homed.disconnect(self.homed)

    def _drag(self, right: float, up: float) -> None:
        step = (self.gain * right, self.gain * up)
        self.moved.emit(lambda hand: hand.drag(step))

    def _tilt(self, right: float, up: float) -> None:
        self.moved.emit(lambda hand: hand.tilt(right, up))

    def _advance(self, step: float) -> None:
        self.moved.emit(lambda hand: hand.advance(step))


RESTING_PRESSURE: Final = 0.3
"""Up to this share of the full pressure the pen only rests on the tablet: the depth stays."""

FASTEST: Final = 0.02
"""Speed along the needle at full pressure [m/s]."""

SIDE_BUTTONS: Final = Qt.MouseButton.RightButton | Qt.MouseButton.MiddleButton
"""Held while pressing, they pull instead of pushing."""

_DOWN, _MOVE, _UP = (
    QEvent.Type.TabletPress, QEvent.Type.TabletMove, QEvent.Type.TabletRelease,
)  # fmt: skip
_GONE = (QEvent.Type.Hide, QEvent.Type.WindowDeactivate, QEvent.Type.TabletLeaveProximity)


def pressed_speed(pressure: float, pulls: bool) -> float:
    """Speed along the needle [m/s] for a pressure in 0…1; rises with its square."""
    if not isfinite(pressure):
        return 0.0
    share = max(0.0, min(1.0, pressure) - RESTING_PRESSURE) / (1.0 - RESTING_PRESSURE)
    return (-FASTEST if pulls else FASTEST) * share * share


class TabletHand(HandSource):
    """Listens to the pen over the pad; a wheel or the Page keys move along the needle as well."""

    name: ClassVar[str] = "tablet"

    def __init__(self, pad: PadCanvas) -> None:
        super().__init__(pad)
        self._tilt: QPointF | None = None
        self._place = QPointF()
        self._speed = 0.0
        self._open = False
        self._timer = QTimer(self, interval=STEP_MS)
        self._timer.timeout.connect(self.step)

    def open(self) -> None:
        """Listen to the pen."""
        if not self._open:
            self._open = True
            self.pad.installEventFilter(self)
            self.pad.advanced.connect(self._advance)
            self.pad.homed.connect(self.homed)
            self.noted.emit(tr("waiting for the pen over the pad"))

    def close(self) -> None:
        """Stop listening."""
        if self._open:
            self._open = False
            self._lift()
            self.pad.removeEventFilter(self)
            self.pad.advanced.disconnect(self._advance)
            self.pad.homed.disconnect(self.homed)
            self.noted.emit("")

    def eventFilter(self, watched: QObject, event: QEvent) -> bool:
        """Take the pen's events, so that Qt makes no mouse events of them."""
        if isinstance(event, QTabletEvent):
            kind = event.type()
            if kind == _DOWN and event.button() is Qt.MouseButton.LeftButton:
                self._put_down(event)
            elif kind in (_DOWN, _MOVE):
                self._follow(event)
            elif kind == _UP and event.button() is Qt.MouseButton.LeftButton:
                self._lift()
            event.accept()
            return True
        if event.type() in _GONE:
            self._lift()
        return False

    def step(self) -> None:
        """Move along the needle for one step of time, as the pen is pressed."""
        if self._speed != 0.0:
            self._advance(self._speed * 1e-3 * STEP_MS)

    def _put_down(self, event: QTabletEvent) -> None:
        self._tilt, self._place = _tilt_of(event), event.position()
        self._press(event)
        self._timer.start()
        tilts = event.pointingDevice().capabilities() & QInputDevice.Capability.XTilt
        self.noted.emit("" if tilts else tr("this pen reports no tilt: move it instead"))

    def _follow(self, event: QTabletEvent) -> None:
        if self._tilt is None:
            return  # it hovers
        tilt, place = _tilt_of(event), event.position()
        leaned, went = tilt - self._tilt, place - self._place
        self._tilt, self._place = tilt, place
        self._press(event)
        if event.pointingDevice().capabilities() & QInputDevice.Capability.XTilt:
            # Qt counts the pen's end to the right and towards the user; the tip goes the other way.
            right, up = -self.gain * radians(leaned.x()), self.gain * radians(leaned.y())
            self.moved.emit(lambda hand: hand.tilt(right, up))
        else:
            share = self.gain / self.pad.area.radius
            step = (share * went.x(), -share * went.y())
            self.moved.emit(lambda hand: hand.drag(step))

    def _press(self, event: QTabletEvent) -> None:
        self._speed = pressed_speed(event.pressure(), bool(event.buttons() & SIDE_BUTTONS))

    def _lift(self) -> None:
        self._tilt, self._speed = None, 0.0
        self._timer.stop()

    def _advance(self, step: float) -> None:
        self.moved.emit(lambda hand: hand.advance(step))


def _tilt_of(event: QTabletEvent) -> QPointF:
    """Tilt of the pen [°]; a driver's nonsense counts as upright."""
    x, y = event.xTilt(), event.yTilt()
    return QPointF(x, y) if isfinite(x) and isfinite(y) else QPointF()


HandChange = Callable[[PadHand], None]
"""One movement: what it does to the hand."""

STEP_MS = 20
"""Sources that move while something is held do it this often."""
