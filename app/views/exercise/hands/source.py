"""Sources of the simulated hand: mouse and keyboard on the pad, a pen with tilt, a gamepad.

Drag and arrows tilt, wheel and Page keys push and pull. A pen is held like the needle: it tilts the
needle, and its pressure pushes it in. The pen is the needle and the tablet the skin: leaning the
pen's end to the right brings the hub to the right and so turns the tip to the left, as its own tip
does. Nothing moves while the pen only hovers, and putting it down makes no jump: the hand follows
the change of tilt since then.

Whether tip or hub goes where the hand goes is the user's choice (`HandSource.sense`); a pen that
leans shows both at once, and is followed as it is.

Of a gamepad the left stick tilts the needle and the right one moves it along. Gamepads are read
through pygame-ce, which is the extra `gamepad`, loaded only when one is chosen.
"""

import os
from collections.abc import Callable
from dataclasses import dataclass
from math import hypot, isfinite, radians
from types import ModuleType
from typing import Any, ClassVar, Final, Protocol

from PySide6.QtCore import QEvent, QObject, QPointF, Qt, QTimer, Signal
from PySide6.QtGui import QInputDevice, QTabletEvent
from PySide6.QtWidgets import QApplication

from app.core.errors import AcusError
from app.core.extras import not_installed
from app.session.pad.hand import PadHand
from app.views.exercise.pad_canvas import PadCanvas
from app.views.kit.text import tr


class HandSource(QObject):
    """Moves the simulated hand between `open` and `close`; one source is open at a time.

    Attributes:
        name: as it is recorded with every attempt.
        gain: hand movement per movement of the source, as the user chose it.
        sense: 1 where the needle's tip goes as the source does, seen on the pad; -1 where its hub
            does, and so the tip the other way: as a needle turns about the skin.

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
        self.gain, self.sense = 0.5, 1.0

    def open(self) -> None:
        """Begin to listen.

        Raises:
            AcusError: if this computer lacks what the source needs; says what to install.
        """
        raise NotImplementedError

    def close(self) -> None:
        """Stop listening; idempotent. The hand stays where it is."""
        raise NotImplementedError

    def let_go(self) -> None:
        """Move no further with what is held now: it counts again once it was let go."""


DEAD_ZONE: Final = 0.15
"""A stick that rests is this far off its middle at most."""

FASTEST_TILT: Final = radians(24.0)
"""Tilt per time with the stick at its end and a gain of 1 [rad/s]."""

FASTEST_DEPTH: Final = 0.02
"""Speed along the needle with the stick at its end [m/s]."""

_QUIET: Final = {
    "PYGAME_HIDE_SUPPORT_PROMPT": "1",
    "SDL_VIDEODRIVER": "dummy",  # its event queue is needed, a window of its own is not
    "SDL_JOYSTICK_ALLOW_BACKGROUND_EVENTS": "1",
    "SDL_NO_SIGNAL_HANDLERS": "1",  # Ctrl+C in the terminal stays ours
}
_FULL: Final = 32767.0


@dataclass(frozen=True, slots=True)
class Sticks:
    """Where the sticks stand, each in -1…1, right and up positive; `home` is a button."""

    right: float
    up: float
    along: float
    home: bool = False


class Pads(Protocol):
    """Gamepads of the computer: `PygamePads`, or those of a test."""

    def open(self) -> None:
        """Look for gamepads.

        Raises:
            AcusError: if the gamepad library is not installed.
        """
        ...

    def close(self) -> None:
        """Let go of them; idempotent."""
        ...

    def read(self) -> Sticks | None:
        """Return where the sticks stand now; None while no gamepad is plugged in."""
        ...


def deflection(x: float, y: float = 0.0) -> tuple[float, float]:
    """Take the dead zone out of a stick and make it finer near its middle.

    The length of the result rises from 0 at the edge of the dead zone to 1 at the end, with the
    square of the way; the direction stays. Not finite counts as the middle.
    """
    length = hypot(x, y)
    if not isfinite(length) or length <= DEAD_ZONE:
        return 0.0, 0.0
    share = min(1.0, (length - DEAD_ZONE) / (1.0 - DEAD_ZONE)) ** 2
    return share * x / length, share * y / length


class GamepadHand(HandSource):
    """Polls the gamepad fifty times a second, and for one while none is plugged in."""

    name: ClassVar[str] = "gamepad"

    def __init__(self, pad: PadCanvas, pads: Pads | None = None) -> None:
        super().__init__(pad)
        self._pads = pads
        self._home = self._spent = False
        self._present: bool | None = None
        self._timer = QTimer(self, interval=STEP_MS)
        self._timer.timeout.connect(self.step)

    def open(self) -> None:
        """Look for a gamepad; one may be plugged in later.

        Raises:
            GamepadError: if the gamepad library is not installed.
        """
        if self._pads is None:
            self._pads = PygamePads()
        self._pads.open()
        self._present = None
        if not self._timer.isActive():
            self.pad.advanced.connect(self._advance)
        self._timer.start()
        self.step()

    def close(self) -> None:
        """Stop looking."""
        if self._timer.isActive():
            self.pad.advanced.disconnect(self._advance)
        self._timer.stop()
        if self._pads is not None:
            self._pads.close()
        self.noted.emit("")

    def let_go(self) -> None:
        """Wait until the sticks rest."""
        self._spent = True

    def _advance(self, step: float) -> None:
        self.moved.emit(lambda hand: hand.advance(step))

    def step(self) -> None:
        """Move by one step of time as the sticks stand; not behind a dialog."""
        sticks = None if self._pads is None else self._pads.read()
        if (sticks is not None) is not self._present:
            self._present = sticks is not None
            self.noted.emit("" if self._present else tr("no gamepad: plug one in"))
        if sticks is None:
            self._home = False
            return
        time = 1e-3 * STEP_MS
        right, up = deflection(sticks.right, sticks.up)
        along, _ = deflection(sticks.along)
        self._spent = (self._spent or QApplication.activeModalWidget() is not None) and bool(
            right or up or along
        )
        if self._spent:
            right = up = along = 0.0
        if right or up:
            turn = self.sense * self.gain * FASTEST_TILT * time
            self.moved.emit(lambda hand: hand.tilt(turn * right, turn * up))
        if along:
            self.moved.emit(lambda hand: hand.advance(FASTEST_DEPTH * time * along))
        if sticks.home and not self._home:
            self.homed.emit()
        self._home = sticks.home


class GamepadError(AcusError):
    """No gamepad can be used on this computer."""


class PygamePads:
    """The first gamepad that is plugged in; another one when that is pulled out."""

    def __init__(self) -> None:
        self._pygame: ModuleType | None = None
        self._controllers: Any = None
        self._pad: Any = None

    def open(self) -> None:
        """Load the library and look for gamepads; idempotent.

        Raises:
            GamepadError: if pygame-ce is not installed, or finds no way to gamepads.
        """
        if self._pygame is not None:
            return
        for name, value in _QUIET.items():
            os.environ.setdefault(name, value)
        try:
            import pygame
            from pygame._sdl2 import controller
        except ImportError as error:
            raise not_installed(
                GamepadError,
                "pygame-ce, which reads gamepads,",
                "gamepad",
                "choose mouse or tablet",
            ) from error
        try:
            pygame.display.init()
            controller.init()
        except pygame.error as error:
            raise GamepadError(
                f"gamepads cannot be read: {error}; choose mouse or tablet"
            ) from error
        self._pygame, self._controllers = pygame, controller

    def close(self) -> None:
        """Let go of the gamepad and the library."""
        if self._pygame is not None:
            self._pad = None
            self._controllers.quit()
            self._pygame.display.quit()
            self._pygame = None

    def read(self) -> Sticks | None:
        """Return where the sticks stand; None while no gamepad is plugged in."""
        if self._pygame is None:
            return None
        self._pygame.event.pump()
        self._pygame.event.clear()
        if self._pad is not None and not self._pad.attached():
            self._pad = None
        if self._pad is None:
            self._pad = self._first()
        return None if self._pad is None else self._sticks(self._pad, self._pygame)

    def _first(self) -> Any:
        for index in range(self._controllers.get_count()):
            if self._controllers.is_controller(index):
                return self._controllers.Controller(index)
        return None

    @staticmethod
    def _sticks(pad: Any, names: ModuleType) -> Sticks:
        x, y, along = (
            pad.get_axis(axis) / _FULL
            for axis in (
                names.CONTROLLER_AXIS_LEFTX,
                names.CONTROLLER_AXIS_LEFTY,
                names.CONTROLLER_AXIS_RIGHTY,
            )
        )
        # SDL counts downwards: pushing the right stick away from oneself pushes the needle in.
        return Sticks(x, -y, -along, bool(pad.get_button(names.CONTROLLER_BUTTON_A)))


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
        gain = self.sense * self.gain
        self.moved.emit(lambda hand: hand.drag((gain * right, gain * up)))

    def _tilt(self, right: float, up: float) -> None:
        sense = self.sense
        self.moved.emit(lambda hand: hand.tilt(sense * right, sense * up))

    def _advance(self, step: float) -> None:
        self.moved.emit(lambda hand: hand.advance(step))


RESTING_PRESSURE: Final = 0.3
"""Up to this share of the full pressure the pen only rests on the tablet: the depth stays."""

FASTEST: Final = 0.02
"""Speed along the needle at full pressure [m/s]."""

SIDE_BUTTONS: Final = Qt.MouseButton.RightButton | Qt.MouseButton.MiddleButton
"""Held while pressing, they pull instead of pushing."""

_DOWN, _MOVE, _UP = (
    QEvent.Type.TabletPress,
    QEvent.Type.TabletMove,
    QEvent.Type.TabletRelease,
)
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

    def let_go(self) -> None:
        """Count the pen as lifted."""
        self._lift()

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
            share = self.sense * self.gain / self.pad.area.radius
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
