"""How often the loop ticks and which share of its deadlines it misses, from its counters."""

from app.core.rate_meter import RateMeter
from app.session.snapshot import Snapshot
from app.views.exercise.status_items import MISSED_WINDOW


class LoopRates:
    """Reads a snapshot at every look."""

    def __init__(self) -> None:
        self._rate = RateMeter()
        self._missed, self._due = RateMeter(MISSED_WINDOW), RateMeter(MISSED_WINDOW)

    def read(self, snapshot: Snapshot, now: float) -> tuple[float, float]:
        """Ticks a second [Hz], and the share of deadlines missed in the last seconds."""
        device, timing = snapshot.device, snapshot.timing
        rate = self._rate.read(now, device.tick) if device is not None else 0.0
        if timing is None:
            return rate, 0.0
        missed = self._missed.read(now, timing.missed)
        due = self._due.read(now, timing.ticks + timing.missed)  # a missed deadline has no tick
        return rate, missed / due if due > 0.0 else 0.0
