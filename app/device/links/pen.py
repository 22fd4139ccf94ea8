"""A pen in place of the robot: its direction, measured a few tens of times a second, as encoders.

Who measures writes joint angles and their time; the tick reads them. Two rows and one number that
says which is whole: the writer fills the other row first, so that no tick reads half of one.
"""

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import stage
from app.device.errors import LinkError
from app.device.links.link import Link, Triple

HOLD = 0.1
"""Age [s] up to which a measured direction counts as the present one: three pictures of a webcam.
After that the angles grow stale as encoders do, so that a lost pen is seen within 0.2 s."""

_ROW, _HOLD, _FIRST = range(3)
_WIDTH = 3  # left, right, time


@stage
def pen_stage(state: FloatArray, p: FloatArray) -> None:
    """Copy the newest angles into Q_* and stamp Q_TIME."""
    base = 2 + 3 * int(p[0])
    state[sv.Q_LEFT] = p[base]
    state[sv.Q_RIGHT] = p[base + 1]
    state[sv.Q_TIME] = min(state[sv.TIME], p[base + 2] + p[1])


class PenLink:
    """Joint angles of a robot that would hold its needle as the pen is held.

    Args:
        q: angles before the first measurement [rad], (left, right); they count as stale.
    """

    def __init__(self, q: tuple[float, float]) -> None:
        row = [*q, -HOLD]
        self._parameters = np.array([0.0, HOLD, *row, *row])
        self._last = -np.inf

    def write(self, q: FloatArray, time: float) -> None:
        """Give the angles [rad], shape (2,), of a moment [s]; an older one is passed over.

        Raises:
            LinkError: if a value is not finite.
        """
        values = np.array([*q, time], dtype=np.float64)
        if values.shape != (_WIDTH,) or not np.isfinite(values).all():
            raise LinkError(f"the pen's joint angles {values.tolist()} are not finite")
        if time <= self._last:
            return
        self._last = time
        row = 1 - int(self._parameters[_ROW])
        first = _FIRST + _WIDTH * row
        self._parameters[first : first + _WIDTH] = values
        self._parameters[_ROW] = float(row)

    def stage(self) -> Triple:
        """Return the stage that reads them."""
        return "pen", pen_stage, self._parameters

    def stages(self) -> Link:
        """Return the link: angles in, no torque out."""
        return Link.of([self.stage()], [])
