"""Fixes of simulated pictures in virtual time: each when it is due, whatever the computer took."""

from typing import Final

from app.core.paced_clock import PacedClock
from app.core.units import MILLISECOND
from app.tracking.fix import NeedleFix
from app.tracking.optics.rig import RigProfile
from app.tracking.simulated.sampled import PROCESSING

MAY_MISS: Final = 0.12
"""Without a picture for so long the depth is still held (`core.staleness.TRACKER_HOLD`) [s]."""


class PacedFixes:
    """Hands a fix on when a computer that is quick enough would have it, and holds time for it.

    A fix is due when both pictures are delivered and `sampled.PROCESSING` later, as in trials that
    have no pictures. From one on time waits for the next; for a person's hand it does so only where
    more than `MAY_MISS` has passed without one. Slower time is felt, a picture that is left out is
    not, and cameras that are there miss some too.

    Args:
        clock: of the run.
        rig: its cameras.
        every: whether no picture may be left out: a script's run is to be the same on any computer.
    """

    def __init__(self, clock: PacedClock, rig: RigProfile, every: bool = True) -> None:
        self._clock = clock
        self._delay = (rig.latency_ms + abs(rig.skew_ms)) * MILLISECOND + PROCESSING
        self._every = every
        self._period = 1.0 / rig.rate_hz if every else max(MAY_MISS, 1.0 / rig.rate_hz)
        self._hold = clock.hold("cameras")

    def begin(self) -> None:
        """Hold time until the first fix is due, where none may be left out: the cameras are opened.

        A person does not wait for it: the first pictures of a start may take a minute of compiling.
        """
        if self._every:
            self._hold.until(self._clock.now() + self._period + self._delay)

    def wait(self, fix: NeedleFix) -> None:
        """Wait until a fix is due."""
        self._clock.sleep_until(fix.time + self._delay)

    def go_on(self, fix: NeedleFix) -> None:
        """Let time go on until the fix after this one is due."""
        self._hold.until(max(fix.time + self._period + self._delay, self._clock.now()))

    def release(self) -> None:
        """Hold time no more: the cameras are closed."""
        self._hold.release()
