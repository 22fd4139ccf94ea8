"""The simulated hand as mouse and keys move it: two tilts, a depth, and whether it holds.

A hand at the handle of a long tool (`Handle`) moves that in space: its way s across the shaft turns
the tool about the fulcrum by s / outside, outside being what of the tool is between fulcrum and
handle, and so moves the tip by depth / outside · s the other way. These are the rates of
an instrument that pivots in a trocar, read from its handle: ḋ = -s / outside.
"""

from dataclasses import dataclass, replace
from math import cos, hypot, pi, sin
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.core.errors import NumericalError
from app.core.messages import sentence
from app.core.transform import rotation_between
from app.core.units import MILLIMETRE
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
                sentence(
                    "hand limits need a tilt in [0, π/2) and shallowest < deepest, got {this}",
                    this=self,
                )
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


LEAST_OUTSIDE: Final = 20.0 * MILLIMETRE
"""Part of a tool outside the fulcrum by which its handle turns it at least [m]: nearer the skin a
millimetre of the hand would turn it more and more; as the arm's own clearance at a trocar."""

LONGEST_TURN: Final = 0.5
"""Largest turn by one movement of the hand [rad]: what a mouse leaps does not go round."""


@dataclass(frozen=True, slots=True)
class Handle:
    """The handle of a long tool, by which the hand holds it.

    Attributes:
        length: of the tool, handle to tip [m].
        reach: way of the handle for a way of the mouse as long as the pad's radius, at a gain of 1
            [m].
    """

    length: float
    reach: float = 0.12

    def __post_init__(self) -> None:
        if not (LEAST_OUTSIDE < self.length < 10.0 and 0.0 < self.reach < 10.0):
            raise NumericalError(
                sentence(
                    "a handle needs a tool longer than {least_outside} m and shorter than 10 m "
                    "and a reach between 0 and 10 m, got {this}",
                    least_outside=LEAST_OUTSIDE,
                    this=self,
                )
            )

    def outside(self, depth: float) -> float:
        """Part of the tool between fulcrum and handle [m], at least `LEAST_OUTSIDE`."""
        return max(self.length - depth, LEAST_OUTSIDE)

    def scale(self, depth: float) -> float:
        """Way of the tip for a way of the handle across the shaft: negative, for it is inverted.

        Nothing at the fulcrum, and positive before it, where the tip is on the hand's side.
        """
        return -depth / self.outside(depth)

    def turned(
        self, frame: PathFrame, direction: FloatArray, way: ArrayLike, depth: float
    ) -> FloatArray:
        """Direction of the tool after its handle went a way [m], shape (2,): right and up.

        The way is laid across the shaft: the pad's axes are turned to it with the smallest turn,
        so that a way is as long wherever the tool leans.
        """
        right, up = frozen(way, (2,), "way of the handle").tolist()
        length = hypot(right, up)
        if length < 1e-150:
            return direction
        across = (right * frame.right + up * frame.up) / length
        across = rotation_between(frame.axis, direction) @ across
        angle = min(length / self.outside(depth), LONGEST_TURN)
        result: FloatArray = cos(angle) * direction - sin(angle) * across
        return result


class PadHand:
    """Moves a `HandPose` in the pad's terms and keeps it inside the limits.

    Limits act on the pose itself: pulling back from a limit answers at once, without winding back
    what was dragged beyond it. With a `handle`, steps say where the tip is to go as ever, and the
    handle goes as far the other way: its way is the step, the tip's follows from the depth.
    """

    def __init__(
        self,
        frame: PathFrame,
        scale: PadScale,
        limits: HandLimits,
        pose: HandPose,
        handle: Handle | None = None,
    ) -> None:
        self._frame = frame
        self._scale = scale
        self._limits = limits
        self._handle = handle
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
        if self._handle is not None:
            self._lead(self._handle, -self._handle.reach * frozen(step, (2,), "pad step"))
            return
        place = self._scale.place(self.tilts) + frozen(step, (2,), "pad step")
        place /= max(1.0, hypot(*place))
        self._point(self._frame.direction(self._scale.tilts(place)))

    def tilt(self, right: float, up: float) -> None:
        """Tilt by two angles [rad]; with a handle, by so much as it turns with the tip outside."""
        if self._handle is not None:
            self._lead(self._handle, -self._handle.length * np.array([right, up]))
            return
        tilts = self.tilts + np.array([right, up])
        tilts *= min(1.0, 0.5 * pi / max(hypot(*tilts), 1e-12))
        self._point(self._frame.direction(tilts))

    def advance(self, step: float) -> None:
        """Push (positive) or pull (negative) by a step [m]."""
        if not np.isfinite(step):
            raise NumericalError(sentence("depth step {step} is not finite", step=step))
        self._pose = self._limited(self._pose.direction, self._pose.depth + step, True)

    def follow(self, direction: ArrayLike, depth: float | None) -> None:
        """Go to where the needle is, so that no spring is stretched; None keeps the depth."""
        wanted = self._pose.depth if depth is None else depth
        self._pose = self._limited(direction, wanted, True)

    def release(self) -> None:
        """Let go of the needle; the pose stays for when it is taken again."""
        self._pose = replace(self._pose, holds=False)

    def _lead(self, handle: Handle, way: FloatArray) -> None:
        pose = self._pose
        self._point(handle.turned(self._frame, pose.direction, way, pose.depth))

    def _point(self, direction: ArrayLike) -> None:
        self._pose = self._limited(direction, self._pose.depth, True)

    def _limited(self, direction: ArrayLike, depth: float, holds: bool) -> HandPose:
        low, high = self._limits.shallowest, self._limits.deepest
        kept = clamp_to_cone(direction, self._limits.tilt)
        return HandPose(frozen(kept), min(high, max(low, float(depth))), holds)
