"""A gamepad: the left stick tilts the needle, the right one moves it along."""

from dataclasses import dataclass
from math import hypot, isfinite, radians
from typing import ClassVar, Final, Protocol

from PySide6.QtCore import QTimer

from app.views.exercise.hands.source import STEP_MS, HandSource
from app.views.exercise.pad_canvas import PadCanvas
from app.views.kit.text import tr

DEAD_ZONE: Final = 0.15
"""A stick that rests is this far off its middle at most."""

FASTEST_TILT: Final = radians(24.0)
"""Tilt per time with the stick at its end and a gain of 1 [rad/s]."""

FASTEST_DEPTH: Final = 0.02
"""Speed along the needle with the stick at its end [m/s]."""


@dataclass(frozen=True, slots=True)
class Sticks:
    """Where the sticks stand, each in -1…1, right and up positive; `home` is a button."""

    right: float
    up: float
    along: float
    home: bool = False


class Pads(Protocol):
    """Gamepads of the computer; see `gamepad_driver`."""

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
            from app.views.exercise.hands.gamepad_driver import PygamePads

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
