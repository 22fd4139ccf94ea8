"""The needle of a Haply Inverse3: its cursor is the hub, so direction and depth are known at once.

It stands where cameras do, and gives fixes. There are no pictures.
"""

from __future__ import annotations

import threading
from collections.abc import Callable
from typing import Final

import numpy as np

from app.core.clock import Clock
from app.core.messages import sentence
from app.core.staleness import TRACKER_HOLD
from app.core.units import MILLIMETRE
from app.device.links.link import ToldHub
from app.mechanisms.profile import DeviceProfile
from app.tracking.fix import FixStatus, NeedleFix, without_point
from app.tracking.told_fixes import ToldFixes

EVERY: Final = 0.02
"""Time between two fixes [s]."""

SD: Final = 0.2 * MILLIMETRE
"""Standard deviation of the hub, and so of the tip [m]: assumed, nobody measured it."""

CURSOR: Final = {"name": "Haply Inverse3", "simulated": "no", "source": "cursor"}
"""What a record says of its cameras."""


class HubTracker(ToldFixes):
    """Makes fixes of the cursor's places (`tracking.needle_tracker.NeedleTracker`).

    Args:
        hub: what the device tells.
        profile: of the pantograph that it stands in for.
        clock: for ages.
        on_fix: gets every fix, in the tracker's thread.
    """

    def __init__(
        self,
        hub: ToldHub,
        profile: DeviceProfile,
        clock: Clock,
        on_fix: Callable[[NeedleFix], None],
    ) -> None:
        super().__init__(clock, CURSOR["name"])
        self.events, self._seen = hub.events, -np.inf
        self._hub, self._profile, self._on_fix = hub, profile, on_fix
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None

    def open(self) -> None:
        """Start; idempotent."""
        self._stop.clear()
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, name="hub", daemon=True)
            self._thread.start()

    def close(self) -> None:
        """Stop; idempotent."""
        self._stop.set()
        thread, self._thread = self._thread, None
        if thread is not None and thread is not threading.current_thread():
            thread.join(timeout=2.0)

    def look(self) -> None:
        """Make a fix of the newest place."""
        stamped, now = self._hub.latest.read(), self._clock.now()
        if stamped is None or now - stamped.time > TRACKER_HOLD:
            fix = self._none(FixStatus.NO_PICTURE, now, sentence("the Inverse3 tells no place"))
        elif stamped.time <= self._seen:
            return
        elif not stamped.value.inside:
            reason = sentence("the hub is where no needle can be: lift it over the entry")
            fix = self._none(FixStatus.OUT_OF_VIEW, stamped.time, reason)
        else:
            hub, self._seen = stamped.value, stamped.time
            axis = np.array(hub.axis)
            depth = self._profile.needle_length - hub.l_out
            fix = NeedleFix(
                self._profile.fulcrum + depth * axis,
                np.eye(3) * SD**2,
                stamped.time,
                FixStatus.VALID,
                (None, None),
                0.0,
                depth,
                SD**2,
                has_point=True,
            )
        self.latest.publish(fix, fix.time)
        self._meter.count(fix, now)
        self._on_fix(fix)

    def _none(self, status: FixStatus, time: float, reason: str) -> NeedleFix:
        return without_point(status, (None, None), time, ("cursor",), reason)

    def _run(self) -> None:
        while not self._stop.wait(EVERY):
            self.look()
