"""What a filter of the depth is, and the one in use.

That is a Kalman filter of a needle that keeps its speed but for white noise in its acceleration.
"""

from abc import ABC, abstractmethod
from dataclasses import dataclass
from math import isfinite
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
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
        """Return how far [s] the filtered depth is behind a steady motion at the newest fix."""

    @abstractmethod
    def _begin(self, depth: float, variance: float) -> None:
        """Start at rest."""

    @abstractmethod
    def _step(self, dt: float, depth: float, variance: float) -> None:
        """Take the next depth, `dt` [s] after the last."""

    @abstractmethod
    def _ahead(self, dt: float) -> tuple[float, float, float]:
        """Depth [m], rate [m/s] and variance [m²] `dt` [s] after the newest depth."""


_FIRST_RATE: Final = 0.05
"""Standard deviation of the speed at the first fix [m/s]."""

_LEAST_VARIANCE: Final = (1e-6) ** 2

_MEMORY: Final = 0.85
"""Share of a surprise that is left at the next fix."""


class ConstantVelocity(DepthFilter):
    """State depth and rate; process noise white in the acceleration (Bar-Shalom 2001, 6.2.2).

    A steady motion is followed without lag. After a change of speed it needs a few fixes, the
    fewer the larger `agility`.

    A hand does not accelerate at random: it rests, or begins to push. So the variance handed out is
    larger, as long as a fix lay further from where it was expected than the filter allows for: by
    the largest squared normalised innovation of late (Bar-Shalom 2001, 5.4), fading by 15 % a fix.
    The gains stay those of the model.

    Args:
        agility: spectral density of the acceleration [m²/s³]; `acus study depth_motion` compares
            three of them.
    """

    def __init__(self, agility: float = 2e-4) -> None:
        super().__init__()
        self.agility = agility
        self._state = np.zeros(2)
        self._spread = np.zeros((2, 2))
        self._surprise = 1.0

    @property
    def lag(self) -> float:
        """None behind a steady motion."""
        return 0.0

    def _begin(self, depth: float, variance: float) -> None:
        self._state = np.array([depth, 0.0])
        self._spread = np.diag([variance, _FIRST_RATE**2])
        self._surprise = 1.0

    def _step(self, dt: float, depth: float, variance: float) -> None:
        state, spread = self._predict(dt)
        expected, innovation = spread[0, 0] + max(variance, _LEAST_VARIANCE), depth - state[0]
        self._surprise = max(1.0, _MEMORY * self._surprise, innovation**2 / expected)
        gain = spread[:, 0] / expected
        self._state = state + gain * innovation
        self._state[1] = np.clip(self._state[1], -FASTEST, FASTEST)
        spread = spread - np.outer(gain, spread[0])
        self._spread = 0.5 * (spread + spread.T)

    def _ahead(self, dt: float) -> tuple[float, float, float]:
        state, spread = self._predict(dt)
        return float(state[0]), float(state[1]), float(max(spread[0, 0], 0.0)) * self._surprise

    def _predict(self, dt: float) -> tuple[FloatArray, FloatArray]:
        step = np.array([[1.0, dt], [0.0, 1.0]])
        noise = self.agility * np.array([[dt**3 / 3.0, dt**2 / 2.0], [dt**2 / 2.0, dt]])
        return step @ self._state, step @ self._spread @ step.T + noise
