"""Says once that the cameras lost the needle, and once that they have found it again."""

from typing import Final

from app.core.staleness import TRACKER_HOLD
from app.session.needle import DepthSource, NeedlePose

STEADY: Final = 1.0
"""Time for which the depth is measured without a break before a loss is told again [s]."""


class DepthNews:
    """Watches where the depth of an attempt comes from.

    A needle that the cameras have not seen yet is no loss; at the edge of their view, where fixes
    come and go, a loss is told once.
    """

    def __init__(self) -> None:
        self._since: float | None = None
        self._lost = False

    def look(self, pose: NeedlePose) -> str:
        """Return what is to be told of this pose; empty for nothing."""
        if pose.measured:
            self._since = pose.time if self._since is None else self._since
            if self._lost and pose.time - self._since >= STEADY:
                self._lost = False
                return "the cameras see the needle again: the depth is measured"
            return ""
        was_measured, self._since = self._since is not None, None
        if pose.depth_source is DepthSource.MODEL and was_measured and not self._lost:
            self._lost = True
            why = pose.doubt or (
                f"the cameras have not seen the needle for {TRACKER_HOLD * 1e3:.0f} ms"
            )
            return (
                f"{why}: from now on the depth is not measured, and the force is held back as if "
                "the needle could be anywhere"
            )
        return ""
