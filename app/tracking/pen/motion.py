"""How fast the pen moves, to say `hold still` in time."""

from collections import deque

import numpy as np

from app.core.arrays import FloatArray

OVER = 0.3
"""Time [s] over which a speed is taken."""

_OLD = 0.6
"""Age [s] from which the newest place says nothing about now."""


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
        """Return the mean speed [m/s] over the last `OVER` seconds of places; 0 without any now.

        The mean over the span is taken, so that the noise of single pictures counts little.
        """
        places = list(self._places)
        if not places or now - places[-1][0] > _OLD:
            return 0.0
        recent = [place for place in places if places[-1][0] - place[0] <= OVER]
        if len(recent) < 2:
            return 0.0
        (first, start), (last, end) = recent[0], recent[-1]
        return float(np.linalg.norm(end - start)) / (last - first)
