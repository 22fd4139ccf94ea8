"""Tells a marker that is still inside the tube from one that is lost."""

from dataclasses import replace
from typing import Final

from app.core.units import MILLIMETRE
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.optics.rig import NeedleProfile

MARGIN: Final = 10.0 * MILLIMETRE
"""How far [m] outside the tube the band may have been seen last: 0.3 m/s for one picture."""


class Hiding:
    """Remembers where the band was seen last.

    A band that no camera shows is hidden if it was last seen at the tube, or never: an attempt
    begins with the needle drawn back. Nothing hides it where the profile names no range.
    """

    def __init__(self, needle: NeedleProfile) -> None:
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
        return replace(
            fix,
            status=FixStatus.NOT_YET_VISIBLE,
            reason="the marker is inside the tube: push the needle on until the cameras see it",
        )

    def _inside(self) -> bool:
        if self._range is None:
            return False
        low, high = (end * MILLIMETRE for end in self._range)
        return self._last is None or low - MARGIN <= self._last <= high + MARGIN
