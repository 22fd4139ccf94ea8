"""Small torque ramps that end as soon as something moves, for the routines that push joints."""

from typing import Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.device.commissioning.results import Side
from app.device.commissioning.routine import Part, Routine
from app.mechanisms.pantograph import mass_matrix

LARGEST: Final = 0.03
"""Where a ramp ends [N·m]."""

HALF: Final = 0.5
"""Value of the input HOMED while signs are being checked: 0.03 N·m and 0.3 N at most."""

HALF_FORCE: Final = 0.3
"""Largest force at the hand meanwhile [N]."""

SIDES: Final = (Side.LEFT, Side.RIGHT)

_CALM: Final = 0.25


LET_GO_AND_CONFIRM: Final = (
    "take the needle out, or stand it upright, let go, keep your hands away and confirm"
)
"""What is asked before the joints are pushed: a leaning needle would topple."""

_CONTROL: Final = 12.0  # [1/s] of the control below: slow against the steps' 100 Hz
_NEAR: Final = 0.03  # [rad]
_PATIENCE: Final = 2.0
_WINDOW: Final = 0.03  # [s] over which a speed is taken


class PulseRoutine(Routine):
    """A routine that pushes single joints."""

    def _holding(self, joint: int, goal: float) -> float:
        """Torque [N·m] that holds a joint at an angle [rad] softly; needs checked signs."""
        inertia = self._inertia(joint)
        error = goal - float(self._loop.latest().q[joint])
        torque = inertia * _CONTROL * (_CONTROL * error - 1.4 * self._speed(joint))
        return float(np.clip(torque, -LARGEST, LARGEST))

    def _go_back(self, pose: FloatArray, message: str) -> Part:
        """Bring the joints near a pose [rad], shape (2,), softly, and leave them at rest there."""
        end = self._now + _PATIENCE
        near = 0
        while near < 10 and self._now < end:
            self._torque(self._holding(0, float(pose[0])), self._holding(1, float(pose[1])))
            state = yield from self._say(message)
            slow = max(abs(self._speed(0)), abs(self._speed(1))) < 0.05
            near = near + 1 if slow and np.abs(state.q - pose).max() < _NEAR else 0
        self._torque()
        yield from self._wait(_CALM, message)

    def _speed(self, joint: int) -> float:
        """Speed of a joint over the last moment [rad/s]."""
        newest = self._loop.latest().tick
        rows = self._loop.rows(max(newest - round(_WINDOW * self._profile.rate_hz), 0))
        span = rows[-1, sv.TIME] - rows[0, sv.TIME] if len(rows) > 1 else 0.0
        if not span > 0.0:
            return 0.0
        return float((rows[-1, sv.Q_LEFT + joint] - rows[0, sv.Q_LEFT + joint]) / span)

    def _inertia(self, joint: int) -> float:
        """Inertia of a joint alone in the present pose, by the profile [kg·m²]."""
        geometry, q = self._profile.pantograph, self._loop.latest().q
        matrix = mass_matrix(geometry, self._profile.lumped_inertia, q)
        return float(matrix[joint, joint])

    def _ramp(
        self,
        side: Side,
        sign: float,
        rate: float,
        enough: float,
        message: str,
        own_only: bool = False,
    ) -> Part:
        """Ramp one motor's torque up at a rate [N·m/s] until a joint has moved by `enough` [rad].

        With `own_only` the joint of that motor must have moved.

        Returns:
            Movement of both joints [rad], shape (2,), zeros if it never was enough, and the ticks
            of the ramp, shape (n, SLOTS).
        """
        which = [index(side)] if own_only else [0, 1]
        yield from self._wait(_CALM, message)
        state = self._loop.latest()
        since, start, begin = state.tick, state.q.copy(), self._now
        moved, last = np.zeros(2), 0.0
        while np.abs(moved[which]).max() < enough and last < LARGEST:
            last = min(rate * (self._now - begin), LARGEST)
            self._push(side, sign * last)
            state = yield from self._say(message)
            moved = state.q - start
        rows = self._loop.rows(since)
        self._torque()
        yield from self._wait(_CALM, message)
        return (moved if np.abs(moved[which]).max() >= enough else np.zeros(2)), rows

    def _push(self, side: Side, torque: float) -> None:
        """Torque [N·m] on one motor, nothing on the other."""
        left = side is Side.LEFT
        self._torque(torque if left else 0.0, 0.0 if left else torque)


def torque_slot(side: Side) -> int:
    """Slot of the torque sent to a joint."""
    return sv.TORQUE_LEFT if side is Side.LEFT else sv.TORQUE_RIGHT


def index(side: Side) -> int:
    """Place of a joint in a pair."""
    return 0 if side is Side.LEFT else 1
