"""Ways to follow a depth that the program does not use: the newest one, and the one-euro filter."""

import math

from app.tracking.motion.depth_filter import FASTEST, HAND_SPEED, DepthFilter


class Hold(DepthFilter):
    """The newest depth as it came."""

    def __init__(self) -> None:
        super().__init__()
        self._depth = self._variance = 0.0

    @property
    def lag(self) -> float:
        """None at the newest fix; all of a fix's age later."""
        return 0.0

    def _begin(self, depth: float, variance: float) -> None:
        self._depth, self._variance = depth, variance

    def _step(self, dt: float, depth: float, variance: float) -> None:
        self._begin(depth, variance)

    def _ahead(self, dt: float) -> tuple[float, float, float]:
        return self._depth, 0.0, self._variance + (HAND_SPEED * dt) ** 2


class OneEuro(DepthFilter):
    """The one-euro filter: two exponential low passes, of the depth and of its rate.

    Casiez, Roussel, Vogel: 1 € filter, CHI 2012. At rest it is calm, in motion it hardly lags; it
    takes no account of how exact each depth is.

    Args:
        least_cutoff: of the depth at rest [Hz].
        slope: how fast the cutoff opens with the rate [Hz per m/s].
        rate_cutoff: of the rate [Hz].
    """

    def __init__(
        self, least_cutoff: float = 5.0, slope: float = 1000.0, rate_cutoff: float = 5.0
    ) -> None:
        super().__init__()
        self._cutoffs = (least_cutoff, slope, rate_cutoff)
        self._last = self._depth = self._rate = self._variance = 0.0
        self._lag = 0.0

    @property
    def lag(self) -> float:
        """Of the present cutoff: dt (1 - α) / α."""
        return self._lag

    def _begin(self, depth: float, variance: float) -> None:
        self._last = self._depth = depth
        self._rate, self._variance, self._lag = 0.0, variance, 0.0

    def _step(self, dt: float, depth: float, variance: float) -> None:
        least, slope, rate_cutoff = self._cutoffs
        rate = max(-FASTEST, min(FASTEST, (depth - self._last) / dt))
        self._last = depth
        self._rate += _share(rate_cutoff, dt) * (rate - self._rate)
        share = _share(least + slope * abs(self._rate), dt)
        self._depth += share * (depth - self._depth)
        self._lag = dt * (1.0 - share) / share
        self._variance = (1.0 - share) ** 2 * self._variance + share**2 * variance

    def _ahead(self, dt: float) -> tuple[float, float, float]:
        # How wrong the rate may be is not known to this filter: all of it counts.
        unknown = math.hypot(self._rate, HAND_SPEED) * (dt + self._lag)
        return self._depth + self._rate * dt, self._rate, self._variance + unknown**2


def _share(cutoff: float, dt: float) -> float:
    """Weight of a new value in an exponential low pass of a cutoff [Hz]."""
    return 1.0 / (1.0 + 1.0 / (2.0 * math.pi * cutoff * dt))
