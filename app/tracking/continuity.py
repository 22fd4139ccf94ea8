"""Believes one camera only where it goes on with what both have seen.

Two pictures confirm each other; one alone shows the needle's line and every red thing on it. So the
depth by one camera counts while it continues, without a gap and no faster than a hand, a depth that
both cameras have measured, and by a find that can be nothing but the marker (`MarkerFix.alone`).
"""

from collections.abc import Sequence
from dataclasses import replace

import numpy as np

from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.markers.extractor import Centre, MarkerFix
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

    def look(self, fix: NeedleFix, found: Sequence[MarkerFix] = ()) -> NeedleFix:
        """Return the fix, without its point if it is not to be believed.

        Args:
            fix: by one camera or two.
            found: what it was made of.
        """
        if not fix.usable:
            return fix
        alone = all(one.alone for one in found)
        if fix.status is FixStatus.VALID:
            if not alone and all(one.centre is Centre.OUTLINE for one in found):
                return _without(fix, FixStatus.INCONSISTENT, "what both see is not of its shape")
            self._last = fix
            return fix
        if alone and self._continues(fix):
            self._last = fix
            return fix
        return _without(
            fix,
            fix.status,
            f"{fix.reason.split(':')[0]}: what the other one sees may be any red thing on "
            "the needle's line until both have seen it",
        )

    def clear(self) -> None:
        """Forget it: both cameras have to see the marker before one is believed."""
        self._last = None

    def _continues(self, fix: NeedleFix) -> bool:
        last = self._last
        if last is None:
            return False
        gap = fix.time - last.time
        if not 0.0 <= gap <= MEMORY:
            return False
        noise = SIGMAS * float(np.sqrt(fix.depth_variance + last.depth_variance))
        return abs(fix.depth - last.depth) <= SPEED * gap + noise


def _without(fix: NeedleFix, status: FixStatus, reason: str) -> NeedleFix:
    zero = np.zeros((3, 3))
    return replace(
        fix,
        status=status,
        p_tip_world=np.zeros(3),
        covariance=zero,
        noise_covariance=zero,
        depth=0.0,
        depth_variance=0.0,
        residual_px=0.0,
        has_point=False,
        reason=reason,
    )
