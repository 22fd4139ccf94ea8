"""How fast the pen moves, to say `hold still` in time."""

from collections import deque

import numpy as np

from app.core.arrays import FloatArray

OVER = 0.3
"""Time [s] over which a speed is taken."""


class Motion:
    """Speed of a point from its places in the last pictures."""

    def __init__(self) -> None:
        self._places: deque[tuple[float, FloatArray]] = deque(maxlen=64)

    def add(self, time: float, p_world: FloatArray) -> None:
        """Take a place [m], shape (3,), at a time [s]; an older time begins anew."""
        if self._places and time <= self._places[-1][0]:
            self._places.clear()
        self._places.append((time, np.array(p_world)))

    def speed(self, now: float) -> float:
        """Return the mean speed [m/s] over the last `OVER` seconds; 0 with fewer than two places.

        The mean over the span is taken, so that the noise of single pictures counts little.
        """
        recent = [place for place in list(self._places) if now - place[0] <= OVER]
        if len(recent) < 2:
            return 0.0
        (first, start), (last, end) = recent[0], recent[-1]
        return float(np.linalg.norm(end - start)) / (last - first)
