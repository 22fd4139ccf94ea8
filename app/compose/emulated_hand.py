"""The hand at an emulated robot: still, led round by a script, or moved by typed orders."""

from __future__ import annotations

from math import cos, pi, radians, sin
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.device.control import Inbox
from app.device.errors import LinkError
from app.mechanisms.pantograph import system_forward
from app.mechanisms.profile import DeviceProfile

HANDS: Final = ("none", "rest", "script")
ORDERS: Final = ("hold", "turn", "lean")
SPEED: Final = 0.3
"""How fast a typed order moves the needle's direction [1/s]: slower than what counts as let go."""

_SIDES: Final = {"left": 0, "right": 1}
_TILT: Final = 0.15
_LARGEST_TILT: Final = 45.0


class EmulatedHand:
    """Writes HAND_* of the emulator's own loop; `work` must be called now and then.

    Args:
        profile: the robot.
        depth: of the tip, which the hand keeps [m].
        q: joint angles under the upright needle [rad]: left, right.
        name: `none` (the needle is free), `rest` (held), `script` (led round in a cone).

    Raises:
        LinkError: for another name; gives the valid ones.
    """

    def __init__(
        self, profile: DeviceProfile, depth: float, q: tuple[float, float], name: str
    ) -> None:
        self._profile, self._depth = profile, depth
        self._q = np.array(q)
        self._wanted = np.zeros(2)
        self._at = np.zeros(2)
        self._time = 0.0
        self.take(name)

    def take(self, name: str) -> None:
        """Hold the needle otherwise."""
        if name not in HANDS:
            raise LinkError(f"no hand {name!r}; valid names: {', '.join(HANDS)}")
        self.name = name

    def obey(self, words: list[str]) -> None:
        """Obey `hold on|off`, `turn left|right DEGREES` of one link, or `lean X Y` in degrees.

        Turning and leaning take the needle into the hand, and move it at `SPEED`.

        Raises:
            LinkError: if it cannot be understood, or would lean the needle too far.
            MechanismError: if the links cannot take the pose.
        """
        match words:
            case ["hold"] | ["hold", "on" | "1"]:
                self.take("rest")
            case ["hold", "off" | "0"]:
                self.take("none")
            case ["turn", side, angle] if side in _SIDES:
                self._turn(_SIDES[side], radians(_degrees(angle)))
            case ["lean", x, y]:
                self._wanted = np.sin(np.radians([_degrees(x), _degrees(y)]))
                self.name = "rest"
            case _:
                raise LinkError(
                    f"{' '.join(words)!r} is not understood; valid are: hold on|off,"
                    " turn left|right DEGREES, lean X Y (degrees towards x and y)"
                )

    def work(self, now: float, inbox: Inbox) -> None:
        """Move as far as the time since the last call [s] allows."""
        elapsed, self._time = min(max(now - self._time, 0.0), 0.1), now
        if self.name == "script":
            angle = 2.0 * pi * 0.3 * now
            self._at = sin(_TILT) * np.array([cos(angle), sin(angle)])
        else:
            way = self._wanted - self._at
            self._at = self._at + way * min(1.0, SPEED * elapsed / max(np.hypot(*way), 1e-12))
        x, y = self._at.tolist()
        holds = float(self.name != "none")
        inbox.write(hand_x=x, hand_y=y, hand_depth=self._depth, hand_holds=holds)

    def _turn(self, side: int, angle: float) -> None:
        q: FloatArray = self._q.copy()
        q[side] += angle
        geometry = self._profile.pantograph
        needle = system_forward(geometry, q, geometry.needle_length - self._depth)
        if not np.hypot(*needle.axis[:2]) <= sin(radians(_LARGEST_TILT)) or needle.axis[2] > 0.0:
            raise LinkError(
                f"the needle would lean by more than {_LARGEST_TILT:g} degrees; turn by less"
            )
        self._q, self._wanted, self.name = q, np.array(needle.axis[:2]), "rest"


def _degrees(text: str) -> float:
    try:
        value = float(text)
    except ValueError as error:
        raise LinkError(f"{text!r} is no number of degrees") from error
    if not abs(value) <= _LARGEST_TILT:
        raise LinkError(f"{text} degrees is too much; give at most {_LARGEST_TILT:g}")
    return value
