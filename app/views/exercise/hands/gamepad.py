"""A gamepad: the left stick tilts the needle, the right one moves it along.

Gamepads are read through pygame-ce, which is the extra `gamepad`, loaded only when one is chosen.
"""

import os
from dataclasses import dataclass
from math import hypot, isfinite, radians
from types import ModuleType
from typing import Any, ClassVar, Final, Protocol

from PySide6.QtCore import QTimer

from app.core.errors import AcusError
from app.views.exercise.hands.source import STEP_MS, HandSource
from app.views.exercise.pad_canvas import PadCanvas
from app.views.kit.text import tr

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
        """Where the sticks stand now; None while no gamepad is plugged in."""
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
    """Looks at the gamepad fifty times a second, and for one while none is plugged in."""

    name: ClassVar[str] = "gamepad"

    def __init__(self, pad: PadCanvas, pads: Pads | None = None) -> None:
        super().__init__(pad)
        self._pads = pads
        self._home = False
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
        self._timer.start()
        self.step()

    def close(self) -> None:
        """Stop looking."""
        self._timer.stop()
        if self._pads is not None:
            self._pads.close()
        self.noted.emit("")

    def step(self) -> None:
        """Move by one step of time as the sticks stand."""
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
        if right or up:
            turn = self.gain * FASTEST_TILT * time
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
            raise GamepadError(
                "a gamepad needs the package pygame-ce, which is not installed here;"
                " run `pip install 'acus[gamepad]'`, or choose mouse or tablet"
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
        """Where the sticks stand; None while no gamepad is plugged in."""
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
