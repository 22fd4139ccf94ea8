"""When a picture was captured: the driver's word where it can be believed, else the delivery."""

from __future__ import annotations

from math import isfinite

from app.core.units import MILLISECOND

OLDEST = 1.0
"""A driver's time [s] that lies further back is no time of the clock that is used here."""

AHEAD = 0.002
"""A driver's time may lie this far ahead [s]: clocks are read one after the other."""


class CaptureTime:
    """Makes capture times of one stream.

    V4L2 stamps its buffers with CLOCK_MONOTONIC, the clock of the whole program; OpenCV hands the
    stamp out as `CAP_PROP_POS_MSEC`. Other drivers give zero, a count from the start, or nothing.
    The first stamp that is not plausible ends the trust in all later ones: times of two kinds must
    not alternate.

    Args:
        latency: from capture to delivery [s], taken off the delivery where the driver has no time.
    """

    def __init__(self, latency: float = 0.0) -> None:
        self.latency = latency
        self.trusted = True

    def of(self, driver_ms: float, delivered: float) -> float:
        """Capture time [s] of a picture with the driver's stamp [ms], delivered at a time [s].

        A stamp that repeats or goes back is handed on: such a picture is refused by its time.
        """
        stamp = driver_ms * MILLISECOND
        plausible = isfinite(stamp) and delivered - OLDEST <= stamp <= delivered + AHEAD
        self.trusted = self.trusted and plausible and stamp > 0.0
        return stamp if self.trusted else delivered - self.latency
