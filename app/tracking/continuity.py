"""Believes one camera only where it goes on with what both have seen.

Two pictures confirm each other; one alone shows the needle's line and every red thing on it. So the
depth by one camera counts while it continues, without a gap and no faster than a hand, a depth that
both cameras have measured.
"""

from dataclasses import replace

import numpy as np

from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.motion.depth_filter import FASTEST

MEMORY = 1.0
"""Time [s] without a depth after which one camera alone is not believed any more."""

SPEED = FASTEST
"""Fastest change of depth [m/s] that is believed."""

SIGMAS = 4.0
"""Noise of both depths [standard deviations] that is allowed for."""


class Continuity:
    """Remembers the last depth that was believed."""

    def __init__(self) -> None:
        self._last: NeedleFix | None = None

    def look(self, fix: NeedleFix) -> NeedleFix:
        """Return the fix, without its point if one camera alone is not to be believed."""
        if not fix.usable:
            return fix
        if fix.status is FixStatus.VALID or self._continues(fix):
            self._last = fix
            return fix
        zero = np.zeros((3, 3))
        return replace(
            fix,
            p_tip_world=np.zeros(3),
            covariance=zero,
            noise_covariance=zero,
            depth=0.0,
            depth_variance=0.0,
            residual_px=0.0,
            has_point=False,
            reason=f"{fix.reason.split(':')[0]}: what the other one sees may be any red thing on "
            "the needle's line until both have seen it",
        )

    def _continues(self, fix: NeedleFix) -> bool:
        last = self._last
        if last is None:
            return False
        gap = fix.time - last.time
        if not 0.0 <= gap <= MEMORY:
            return False
        noise = SIGMAS * float(np.sqrt(fix.depth_variance + last.depth_variance))
        return abs(fix.depth - last.depth) <= SPEED * gap + noise
