"""A pen in place of the robot: its direction, measured a few tens of times a second, as encoders.

Who measures writes joint angles and their time; the tick reads them. Two rows and one number that
says which is whole: the writer fills the other row first, so that no tick reads half of one.
"""

from typing import Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import stage
from app.core.messages import sentence
from app.core.parameters import Stage, numbered, packed
from app.device.errors import LinkError
from app.device.links.link import Link

HOLD = 0.1
"""Age [s] up to which a measured direction counts as the present one: three pictures of a webcam.
After that the angles grow stale as encoders do, so that a lost pen is seen within 0.2 s."""


class _PenPlaces(NamedTuple):
    """The row that is whole (0 or 1) and how long it counts as present; the two rows follow."""

    row: int
    hold: int


class _RowPlaces(NamedTuple):
    """One measurement: angles [rad] and their time [s]."""

    left: int
    right: int
    time: int


_AT: Final = numbered(_PenPlaces)
_ROW: Final = numbered(_RowPlaces)


@stage
def pen_stage(state: FloatArray, p: FloatArray) -> None:
    """Copy the newest angles into Q_* and stamp Q_TIME."""
    row = len(_AT) + len(_ROW) * int(p[_AT.row])
    state[sv.Q_LEFT] = p[row + _ROW.left]
    state[sv.Q_RIGHT] = p[row + _ROW.right]
    state[sv.Q_TIME] = min(state[sv.TIME], p[row + _ROW.time] + p[_AT.hold])


class PenLink:
    """Joint angles of a robot that would hold its needle as the pen is held.

    Args:
        q: angles before the first measurement [rad], (left, right); they count as stale.
    """

    def __init__(self, q: tuple[float, float]) -> None:
        row = [*q, -HOLD]
        self._parameters = packed(_AT, row, row, row=0.0, hold=HOLD)
        self._last = -np.inf

    def write(self, q: FloatArray, time: float) -> None:
        """Give the angles [rad], shape (2,), of a moment [s]; an older one is passed over.

        Raises:
            LinkError: if a value is not finite.
        """
        values = np.array([*q, time], dtype=np.float64)
        if values.shape != (len(_ROW),) or not np.isfinite(values).all():
            raise LinkError(
                sentence("the pen's joint angles {angles} are not finite", angles=values.tolist())
            )
        if time <= self._last:
            return
        self._last = time
        row = 1 - int(self._parameters[_AT.row])
        first = len(_AT) + len(_ROW) * row
        self._parameters[first : first + len(_ROW)] = values
        self._parameters[_AT.row] = float(row)

    def stage(self) -> Stage:
        """Return the stage that reads them."""
        return Stage("pen", pen_stage, self._parameters)

    def stages(self) -> Link:
        """Return the link: angles in, no torque out."""
        return Link.of([self.stage()], [])
