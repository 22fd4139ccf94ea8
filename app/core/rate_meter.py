"""Measures how often something happens from its counter."""

from typing import Final

WINDOW: Final = 1.0
"""Time over which a rate is taken [s], if nothing else is said."""


class RateMeter:
    """Rate of a counter over the last seconds; 0 until it is known."""

    def __init__(self, window: float = WINDOW) -> None:
        """Take the rate over so many seconds."""
        self._window = window
        self._readings: list[tuple[float, int]] = []

    def read(self, time: float, count: int) -> float:
        """Take a reading at `time` [s] and return the rate [1/s]."""
        if self._readings and (time < self._readings[-1][0] or count < self._readings[-1][1]):
            self._readings.clear()  # another clock, or the counter began anew
        if not self._readings or time > self._readings[-1][0]:
            self._readings.append((time, count))
        while len(self._readings) > 2 and self._readings[1][0] <= time - self._window:
            del self._readings[0]
        (first_time, first), (last_time, last) = self._readings[0], self._readings[-1]
        return (last - first) / (last_time - first_time) if last_time > first_time else 0.0
