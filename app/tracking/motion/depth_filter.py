"""What a filter of the depth is."""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from math import isfinite
from typing import Final

from app.core.staleness import TRACKER_HOLD

GAP: Final = TRACKER_HOLD
"""Time [s] without a fix after which a filter forgets: the pose then has no measured depth."""

FASTEST: Final = 0.5
"""Speed [m/s] beyond which no hand pushes a needle; a rate is limited to it."""


HAND_SPEED: Final = 0.02
"""Standard deviation of the speed [m/s] with which a hand goes on where nothing followed it: an
ordinary insertion's."""


@dataclass(frozen=True, slots=True)
class DepthMotion:
    """Depth and its rate at one moment: at `time` [s], [m], [m/s].

    `variance` is that of the depth [m²], with all that the hand may have done since the newest fix.
    """

    time: float
    depth: float
    rate: float
    variance: float


class DepthFilter(ABC):
    """Takes the depths that the cameras measure and tells where the tip is going.

    A depth that is not newer than the last, or not finite, is passed over; after `GAP` without one
    the filter begins anew.
    """

    def __init__(self) -> None:
        self._time: float | None = None

    def take(self, time: float, depth: float, variance: float) -> None:
        """Take a depth [m], captured at `time` [s], with its variance [m²]."""
        if not (isfinite(time) and isfinite(depth) and isfinite(variance)) or variance < 0.0:
            return
        if self._time is not None and time <= self._time:
            return
        if self._time is None or time - self._time > GAP:
            self._begin(depth, variance)
        else:
            self._step(time - self._time, depth, variance)
        self._time = time

    def at(self, time: float) -> DepthMotion | None:
        """Depth expected at `time` [s], at constant rate from the newest depth on; None before one.

        A time before the newest depth gives that one.
        """
        if self._time is None:
            return None
        depth, rate, variance = self._ahead(max(0.0, time - self._time))
        return DepthMotion(time, depth, rate, variance)

    @property
    @abstractmethod
    def lag(self) -> float:
        """How far [s] the filtered depth is behind a steady motion at the newest fix."""

    @abstractmethod
    def _begin(self, depth: float, variance: float) -> None:
        """Start at rest."""

    @abstractmethod
    def _step(self, dt: float, depth: float, variance: float) -> None:
        """Take the next depth, `dt` [s] after the last."""

    @abstractmethod
    def _ahead(self, dt: float) -> tuple[float, float, float]:
        """Depth [m], rate [m/s] and variance [m²] `dt` [s] after the newest depth."""
