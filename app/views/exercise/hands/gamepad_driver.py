"""Gamepads through pygame-ce, which is the extra `gamepad` and loaded only when one is chosen."""

import os
from types import ModuleType
from typing import Any, Final

from app.core.errors import AcusError
from app.views.exercise.hands.gamepad import Sticks

_QUIET: Final = {
    "PYGAME_HIDE_SUPPORT_PROMPT": "1",
    "SDL_VIDEODRIVER": "dummy",  # its event queue is needed, a window of its own is not
    "SDL_JOYSTICK_ALLOW_BACKGROUND_EVENTS": "1",
    "SDL_NO_SIGNAL_HANDLERS": "1",  # Ctrl+C in the terminal stays ours
}
_FULL: Final = 32767.0


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
