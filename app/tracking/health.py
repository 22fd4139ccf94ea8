"""Watches over the fixes for what makes cameras and robot disagree.

Tells a marker that is still inside the tube from one that is lost.
"""

from collections.abc import Callable
from dataclasses import replace
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.tracking.discrepancy import (
    LARGEST_BEND,
    Discrepancy,
    DiscrepancyCause,
    DiscrepancyMonitor,
    Evidence,
)
from app.tracking.fix import DIRECTION_SIGMA, FixStatus, NeedleFix
from app.tracking.optics.rig import NeedleProfile

MARGIN: Final = 10.0 * MILLIMETRE
"""How far [m] outside the tube the band may have been seen last: 0.3 m/s for one picture."""


NEVER: Final = 20.0
"""Time [s] for which a band that was never seen counts as hidden."""

NEVER_SEEN: Final = "not seen yet: push the needle in until both pictures show the red band"


class Hiding:
    """Remembers where the band was seen last.

    A band that no camera shows is hidden if it was last seen at the tube, or never: an attempt
    begins with the needle drawn back. After `NEVER` without being seen that is no explanation
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

    def judge(self, fix: NeedleFix) -> NeedleFix:
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
        """Return whether the band was never seen for too long to be hidden; told once."""
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


_PICTURES_AGREE: Final = 4.5
"""Epipolar residual [standard deviations] up to which both pictures show the same thing."""

_GROSS: Final = 60.0
"""Epipolar residual [standard deviations] beyond which the pictures show two things, unless both
finds are certain."""

_EVERY: Final = 15
"""Fixes between two verdicts; they take longer than a fix."""


class FixHealth:
    """Puts the discrepancy into every fix, and lets a bent needle be measured as such.

    Args:
        marker_offset: from the band to the tip [m].
        force: of the robot on the needle at a time, [N], shape (3,); None where it is not known.
        report: takes (kind, message) when the cause changes.
    """

    def __init__(
        self,
        marker_offset: float,
        force: Callable[[float], FloatArray | None],
        report: Callable[[str, str], None],
    ) -> None:
        self.monitor = DiscrepancyMonitor()
        self._offset = marker_offset
        self._force = force
        self._report = report
        self._verdict = Discrepancy()
        self._count = 0

    def judge(
        self,
        fix: NeedleFix,
        axis: FloatArray | None,
        certain: bool = False,
        exchanged: bool = False,
    ) -> NeedleFix:
        """Return the fix with what is known of the discrepancy.

        A fix that only the line contradicts is a measurement all the same once the needle is known
        to bend: the pictures agree on where the band is.

        Args:
            fix: by the solver.
            axis: needle's direction by the robot.
            certain: whether both pictures show a thing that can be nothing but the marker, so that
                a camera was moved, however far they are apart.
            exchanged: whether the pictures fit with left and right exchanged only.
        """
        if exchanged:
            self._add(Evidence.of_exchanged())
        elif certain and fix.status is FixStatus.INCONSISTENT and not fix.has_point:
            self._add(Evidence.of_rays_that_miss())
        if fix.line_variance is None or axis is None or not (certain or _near(fix)):
            return replace(fix, discrepancy=self._verdict)
        self._gather(fix, axis, fix.line_variance)
        bent = self._verdict.cause is DiscrepancyCause.BENT_NEEDLE and _may_be_bent(fix)
        if bent and (fix.usable or fix.status is FixStatus.INCONSISTENT):
            fix = replace(fix, status=FixStatus.VALID, reason="", covariance=self._of_bent(fix))
        return replace(fix, discrepancy=self._verdict)

    def clear(self) -> None:
        """Forget all evidence, for a new start."""
        self.monitor.clear()
        self._verdict, self._count = Discrepancy(), 0

    def _of_bent(self, fix: NeedleFix) -> FloatArray:
        """Covariance of a bent needle's tip [m²], (3, 3).

        The tip is carried on from the band along the robot's direction; a beam that leaves the
        fulcrum straight leans there by 2 |beside| / depth more, and how it goes on is not known.
        """
        depth = max(fix.depth - self._offset, self._offset)
        lean = 2.0 * self._offset / depth * fix.beside
        return np.asarray(fix.covariance + np.outer(lean, lean))

    def _gather(self, fix: NeedleFix, axis: FloatArray, line_variance: float) -> None:
        force = self._force(fix.time)
        sideways = np.zeros(3) if force is None else force - (force @ axis) * axis
        sigma = np.sqrt(line_variance + float(np.trace(fix.covariance)) / 3.0)
        self._add(
            Evidence(
                fix.depth - self._offset,
                fix.beside,
                float(sigma),
                fix.epipolar,
                sideways,
                *_turn(fix, axis),
                axis=axis,
            )
        )

    def _add(self, evidence: Evidence) -> None:
        self.monitor.add(evidence)
        self._count += 1
        if self._count % _EVERY:
            return
        before, self._verdict = self._verdict.cause, self.monitor.verdict()
        if self._verdict.cause is not before and self._verdict.words:
            self._report("tracker", self._verdict.words)


def _turn(fix: NeedleFix, axis: FloatArray) -> tuple[FloatArray | None, float]:
    """Rotation [rad] from the robot's axis to the cameras' own, and its standard deviation."""
    if fix.axis_world is None or fix.axis_covariance is None:
        return None, 0.0
    variance = 0.5 * float(np.trace(fix.axis_covariance)) + DIRECTION_SIGMA**2
    return np.cross(axis, fix.axis_world), float(np.sqrt(variance))


def _may_be_bent(fix: NeedleFix) -> bool:
    return abs(fix.epipolar) <= _PICTURES_AGREE and _beside(fix) <= LARGEST_BEND


def _beside(fix: NeedleFix) -> float:
    return float(np.linalg.norm(fix.beside))


def _near(fix: NeedleFix) -> bool:
    """Return whether this may be the needle at all, and not two other red things."""
    return _beside(fix) <= LARGEST_BEND and abs(fix.epipolar) <= _GROSS
