"""The tracker without pictures of its own: another program, or a device, tells the fixes."""

from __future__ import annotations

from app.core.clock import Clock
from app.core.latest import Latest
from app.tracking.fix import NeedleFix
from app.tracking.inspection import Inspection
from app.tracking.statistics import TrackerMeter, TrackerStatistics


class ToldFixes:
    """Holds and counts fixes that somebody else tells; the part of `NeedleTracker` that looks.

    Args:
        clock: for ages.
        told_by: who tells them, by name.
    """

    stereo = None

    def __init__(self, clock: Clock, told_by: str) -> None:
        self.latest: Latest[NeedleFix] = Latest()
        self._clock, self._meter = clock, TrackerMeter(told_by)

    def statistics(self) -> TrackerStatistics:
        """Return the figures of the last seconds."""
        stamped = self.latest.read()
        newest = stamped.value if stamped else None
        return self._meter.statistics(self._clock.now(), newest, (), "")

    def inspect(self, masks: bool = False, lines: bool = True) -> Inspection:
        """Return the newest fix; there are no pictures."""
        stamped = self.latest.read()
        return Inspection((), stamped.value if stamped else None, cameras=1)
