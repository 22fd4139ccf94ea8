"""Which of the cameras' depths are believed: none before ten more have agreed with it.

A marker that is mistaken for another thing gives one wrong depth, or a few; force and let-go would
follow it. So a first depth counts for nothing until `AGREEING` more have come, each within what a
hand can have moved the needle since the one before,

    |d - d'| <= v (t - t') + 4 (s + s'),

with the standard deviations s. A depth that is further away is refused, and from then on none is
believed until `AGREEING` new ones agree among themselves: nobody knows which of the two was right.
After `FORGOTTEN` without any the next is a first one again; until then, as on a slow computer,
t - t' counts as `TRACKER_HOLD` at most, so that a depth far from the last is confirmed anew.

What is not believed reaches neither the loop, whose interval is then the profile's whole range
(`device.control.depth_interval`), nor the pose. A depth that is wrong by the same amount in every
picture passes: no gate can see it.
"""

from math import isfinite, sqrt
from typing import Final

from app.core.staleness import TRACKER_HOLD
from app.core.units import MILLIMETRE

AGREEING: Final = 10
"""Depths that have to agree with a first one before it is believed."""

FORGOTTEN: Final = 1.0
"""Time without a depth [s] after which nothing is left to agree with."""

SIGMAS: Final = 4.0
"""Standard deviations within which a depth is taken to lie."""


class DepthGate:
    """Looks at one depth after the other; not thread-safe.

    Args:
        speed: fastest that a hand moves the needle along itself [m/s].

    Attributes:
        doubt: why the depth is not believed now, in the student's words; empty if it is.
    """

    def __init__(self, speed: float) -> None:
        self._speed = speed
        self._last: tuple[float, float, float] | None = None
        self._agreed = 0
        self._jump = 0.0
        self.doubt = ""

    def take(self, time: float, depth: float, variance: float) -> bool:
        """Look at a depth [m] of a `time` [s] with its variance [m²]; says whether it is believed.

        A depth that is no number is refused like one that jumps; times must not go back.
        """
        known = isfinite(depth) and isfinite(variance) and variance >= 0.0
        sigma = sqrt(variance) if known else 0.0
        if self._last is None or not time - self._last[0] <= FORGOTTEN:
            self._agreed = -1  # nothing to agree with
            self._jump = 0.0
        else:
            since, before, spread = self._last
            away = abs(depth - before)
            moved = self._speed * min(time - since, TRACKER_HOLD)
            if not (known and away <= moved + SIGMAS * (sigma + spread)):
                self._agreed, self._jump = -1, away if known else 0.0
        self._last = (time, depth, sigma) if known else None
        self._agreed = min(self._agreed + 1, AGREEING)
        self.doubt = self._why()
        return not self.doubt

    def _why(self) -> str:
        if self._agreed >= AGREEING:
            return ""
        count = f"{self._agreed} of {AGREEING} pictures agree so far"
        if self._jump > 0.0:
            return (
                f"the cameras' depth jumped by {self._jump / MILLIMETRE:.0f} mm, faster than a hand"
                f" moves a needle: {count}"
            )
        return f"the cameras have just found the marker: {count}"
