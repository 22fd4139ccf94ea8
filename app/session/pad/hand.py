"""The simulated hand as mouse and keys move it: two tilts, a depth, and whether it holds."""

from dataclasses import dataclass, replace
from math import hypot, pi
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.core.errors import NumericalError
from app.session.pad.geometry import PadScale, PathFrame, clamp_to_cone

GAINS: Final = {"fine": 0.25, "normal": 0.5, "direct": 1.0}
"""Hand movement per mouse movement on the pad, by name."""


@dataclass(frozen=True, slots=True)
class HandLimits:
    """How far the hand may go: tilt from straight down [rad] and depth beyond the skin [m]."""

    tilt: float
    shallowest: float
    deepest: float

    def __post_init__(self) -> None:
        if not (0.0 <= self.tilt < 0.5 * pi and self.shallowest < self.deepest):
            raise NumericalError(
                f"hand limits need a tilt in [0, π/2) and shallowest < deepest, got {self}"
            )


@dataclass(frozen=True, slots=True)
class HandPose:
    """Where the simulated hand wants the needle.

    Attributes:
        direction: wanted needle direction in world, unit, shape (3,).
        depth: wanted depth of the tip beyond the entry [m].
        holds: whether the hand holds the needle at all.
    """

    direction: FloatArray
    depth: float
    holds: bool


class PadHand:
    """Moves a `HandPose` in the pad's terms and keeps it inside the limits.

    Limits act on the pose itself: pulling back from a limit answers at once, without winding back
    what was dragged beyond it.
    """

    def __init__(
        self, frame: PathFrame, scale: PadScale, limits: HandLimits, pose: HandPose
    ) -> None:
        self._frame = frame
        self._scale = scale
        self._limits = limits
        self._pose = self._limited(pose.direction, pose.depth, pose.holds)

    @property
    def pose(self) -> HandPose:
        """The hand now."""
        return self._pose

    @property
    def tilts(self) -> FloatArray:
        """The hand's two tilts against the path [rad], shape (2,)."""
        return self._frame.tilts(self._pose.direction)

    def drag(self, step: ArrayLike) -> None:
        """Move by a step on the pad, shape (2,), in units of the pad's radius: right and up."""
        place = self._scale.place(self.tilts) + frozen(step, (2,), "pad step")
        place /= max(1.0, hypot(*place))
        self._point(self._frame.direction(self._scale.tilts(place)))

    def tilt(self, right: float, up: float) -> None:
        """Tilt by two angles [rad]."""
        tilts = self.tilts + np.array([right, up])
        tilts *= min(1.0, 0.5 * pi / max(hypot(*tilts), 1e-12))
        self._point(self._frame.direction(tilts))

    def advance(self, step: float) -> None:
        """Push (positive) or pull (negative) by a step [m]."""
        if not np.isfinite(step):
            raise NumericalError(f"depth step {step} is not finite")
        self._pose = self._limited(self._pose.direction, self._pose.depth + step, True)

    def follow(self, direction: ArrayLike, depth: float | None) -> None:
        """Go to where the needle is, so that no spring is stretched; None keeps the depth."""
        wanted = self._pose.depth if depth is None else depth
        self._pose = self._limited(direction, wanted, True)

    def release(self) -> None:
        """Let go of the needle; the pose stays for when it is taken again."""
        self._pose = replace(self._pose, holds=False)

    def _point(self, direction: ArrayLike) -> None:
        self._pose = self._limited(direction, self._pose.depth, True)

    def _limited(self, direction: ArrayLike, depth: float, holds: bool) -> HandPose:
        low, high = self._limits.shallowest, self._limits.deepest
        kept = clamp_to_cone(direction, self._limits.tilt)
        return HandPose(frozen(kept), min(high, max(low, float(depth))), holds)
