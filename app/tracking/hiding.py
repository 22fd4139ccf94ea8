"""Tells a marker that is still inside the tube from one that is lost."""

from collections.abc import Callable
from dataclasses import replace
from typing import Final

from app.core.units import MILLIMETRE
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.optics.rig import NeedleProfile

MARGIN: Final = 10.0 * MILLIMETRE
"""How far [m] outside the tube the band may have been seen last: 0.3 m/s for one picture."""


NEVER: Final = 20.0
"""Time [s] for which a band that was never seen counts as hidden."""

NEVER_SEEN: Final = "not seen yet: push the needle in until both pictures show the red band"


class Hiding:
    """Remembers where the band was seen last.

    A band that no camera shows is hidden if it was last seen at the tube, or never: an attempt
    begins with the needle drawn back. After `NEVER` without a sight of it that is no explanation
    any more, and is said. Nothing hides it where the profile names no range.

    Args:
        needle: of the rig.
        report: takes (kind, message) when the band has not been seen for `NEVER`.
    """

    def __init__(
        self,
        needle: NeedleProfile,
        report: Callable[[str, str], None] = lambda _kind, _message: None,
    ) -> None:
        self._report = report
        self._since: float | None = None
        self._told = False
        self._range = needle.hidden_mm
        self._offset = needle.marker_offset
        self._last: float | None = None

    def look(self, fix: NeedleFix) -> NeedleFix:
        """Return the fix, as `not_yet_visible` if the tube explains why the marker is not seen."""
        if fix.usable:
            self._last = fix.depth - self._offset
            return fix
        if fix.status is not FixStatus.OUT_OF_VIEW or not self._inside():
            return fix
        if self._last is None and self._waited(fix.time):
            return replace(fix, reason=NEVER_SEEN)
        return replace(
            fix,
            status=FixStatus.NOT_YET_VISIBLE,
            reason="the marker is inside the tube: push the needle on until the cameras see it",
        )

    def clear(self) -> None:
        """Forget where the band was, e.g. for a new start."""
        self._last, self._since, self._told = None, None, False

    def _waited(self, time: float) -> bool:
        """Whether the band was never seen for too long to be hidden; told once."""
        self._since = time if self._since is None else min(self._since, time)
        long = time - self._since > NEVER
        if long and not self._told:
            self._told = True
            self._report("tracker", f"the marker is {NEVER_SEEN}")
        return long

    def _inside(self) -> bool:
        if self._range is None:
            return False
        low, high = (end * MILLIMETRE for end in self._range)
        return self._last is None or low - MARGIN <= self._last <= high + MARGIN
