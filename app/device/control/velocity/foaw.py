"""First-order adaptive windowing, end-fit: long windows at rest, short ones in quick movement.

The estimate is the slope of the longest line that ends in the newest reading, begins in an older
one, and passes all between them within a band of one encoder count (Janabi-Sharifi, Hayward, Chen:
Discrete-time adaptive windowing for velocity estimation, IEEE TCST 8(6):1003, 2000). All such lines
share their end, so each reading allows an interval of slopes; keeping the intersection of these
makes one pass over the window do what the paper's repeated checks do.
"""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.device.control.velocity.readings import (
    FREE,
    JUMP,
    KEEP,
    RESTART,
    next_reading,
    plausible,
)

LONGEST: Final = 30
"""Steps of the longest window."""

_RING: Final = 32  # a power of two above LONGEST + 1
_BAND: Final = FREE
_WINDOW: Final = FREE + 1
_HEAD: Final = FREE + 2
_USED: Final = FREE + 3  # steps back that count: left and right
_TIMES: Final = FREE + 5
_READINGS: Final = _TIMES + _RING  # left, then right
_SIZE: Final = _READINGS + 2 * _RING
_ROUNDING: Final = 1e-6  # of a count: readings on the band's edge are within it


@njit
def end_fit(p: FloatArray, head: int, first: int, used: int) -> float:
    """Slope [rad/s] of the longest line within the band over at most `used` steps back.

    Args:
        p: the estimator's memory.
        head: ring position of the newest reading.
        first: where the ring of this joint's readings begins.
        used: steps back, at least 1.
    """
    newest, now, band = p[first + head], p[_TIMES + head], p[_BAND]
    slope, least, most = 0.0, -np.inf, np.inf
    for back in range(1, used + 1):
        k = (head - back) & (_RING - 1)
        per_length = 1.0 / (now - p[_TIMES + k])
        candidate = (newest - p[first + k]) * per_length
        if candidate < least or candidate > most:
            break
        slope = candidate
        least = max(least, candidate - band * per_length)
        most = min(most, candidate + band * per_length)
    return slope


@njit
def _add(p: FloatArray, joint: int, head: int, before: int, reading: float) -> float:
    first = _READINGS + joint * _RING
    p[first + head] = reading
    if not abs(reading - p[first + before]) < JUMP:
        p[_USED + joint] = 0.0
        return 0.0
    p[_USED + joint] = min(p[_USED + joint] + 1.0, p[_WINDOW])
    return plausible(end_fit(p, head, first, int(p[_USED + joint])))


@stage
def foaw_stage(state: FloatArray, p: FloatArray) -> None:
    """Write QD_* from Q_*."""
    action, elapsed = next_reading(state, p)
    if action == KEEP:
        return
    before = int(p[_HEAD])
    head = before if action == RESTART else (before + 1) & (_RING - 1)
    p[_HEAD] = head
    if action == RESTART:
        p[_USED], p[_USED + 1], p[_TIMES + head] = 0.0, 0.0, 0.0
        p[_READINGS + head], p[_READINGS + _RING + head] = state[sv.Q_LEFT], state[sv.Q_RIGHT]
        return
    p[_TIMES + head] = p[_TIMES + before] + elapsed
    state[sv.QD_LEFT] = _add(p, 0, head, before, state[sv.Q_LEFT])
    state[sv.QD_RIGHT] = _add(p, 1, head, before, state[sv.Q_RIGHT])


@dataclass(frozen=True, slots=True)
class AdaptiveWindow:
    """First-order adaptive windowing.

    Attributes:
        band: half width of the band about the line [rad]: one encoder count, since both the line's
            ends and each reading between them are off by up to half a count.
        window: longest window [steps], 1 to `LONGEST`; 20 has nearly all that 30 gain, at two
            thirds of the cost and of the lag at rest (`acus study velocity`).
    """

    band: float
    window: int = 20

    def stage(self) -> tuple[str, Any, FloatArray]:
        """Return the stage for a loop's table, with memory of its own."""
        parameters = np.zeros(_SIZE)
        parameters[_BAND] = self.band * (1.0 + _ROUNDING)
        parameters[_WINDOW] = min(max(self.window, 1), LONGEST)
        return "velocity", foaw_stage, parameters
