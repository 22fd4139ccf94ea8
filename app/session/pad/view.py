"""What the bull's-eye pad and the depth bar show at one moment, as values."""

from collections.abc import Mapping
from dataclasses import dataclass
from typing import Final, Self

import numpy as np

from app.core.arrays import FloatArray
from app.core.units import MILLIMETRE
from app.exercises.schema import Exercise
from app.mechanisms.profile import DeviceProfile
from app.planning.off_path import Offset
from app.planning.placement import PlacedPlan
from app.scoring.defaults import DEFAULT_TOLERANCES
from app.scoring.tolerance import Bands
from app.session.pad.aim import passes
from app.session.pad.geometry import PadScale, PathFrame, path_frame
from app.session.pad.hand import Handle, HandLimits, HandPose, PadHand

SAME_PATH: Final = 1e-12
"""Paths whose directions differ by less are one: the target is at rest."""


@dataclass(frozen=True, slots=True)
class PadScene:
    """What stays the same during an attempt.

    Attributes:
        frame: axes of the pad.
        scale: radial scale of the pad.
        rings: radii of the tolerance rings [m], from the inside.
        limits: how far the simulated hand may go.
        p_entry: the entry in world [m], shape (3,).
        target_depth: depth of the target beyond the entry [m].
        depth_tolerance: how far from it along the path is still at the target [m]; across the path
            it is the innermost ring.
        stop_depth: depth that must not be passed [m].
        handle: of the long tool that the hand holds; None for a needle.
    """

    frame: PathFrame
    scale: PadScale
    rings: tuple[float, ...]
    limits: HandLimits
    p_entry: FloatArray
    target_depth: float
    depth_tolerance: float
    stop_depth: float
    handle: Handle | None = None

    @classmethod
    def of(
        cls,
        placed: PlacedPlan,
        profile: DeviceProfile,
        rings: tuple[float, ...],
        depth_tolerance: float,
        touches: bool = False,
    ) -> Self:
        """Return the pad of a plan at a device.

        Args:
            placed: the plan.
            profile: of the device.
            rings: radii of the tolerance rings [m], from the inside.
            depth_tolerance: see `depth_tolerance`.
            touches: whether the hand holds the handle of a long tool.
        """
        shallowest, deepest = profile.depth_range
        return cls(
            frame=path_frame(placed.axis, placed.T_world_patient.rotation),
            scale=PadScale(placed.length, rings[0]),
            rings=rings,
            limits=HandLimits(profile.tilt_limit, shallowest, deepest),
            p_entry=placed.p_entry,
            target_depth=placed.length,
            depth_tolerance=depth_tolerance,
            stop_depth=min(placed.length + rings[-1], deepest),
            handle=Handle(profile.needle_length) if touches else None,
        )

    def hand(self, pose: HandPose) -> PadHand:
        """Return the hand that moves what the exercise has it hold, from where it is now."""
        return PadHand(self.frame, self.scale, self.limits, pose, self.handle)


@dataclass(frozen=True, slots=True)
class NeedleLine:
    """A needle as the pad's dot needs it.

    Attributes:
        direction: needle direction in world, shape (3,).
        offset: from the tip to the target as it is now, by which everybody says "off the path".
        depth: depth of the tip beyond the entry [m].
        measured: whether the depth is a fresh measurement (else held or from the model).
    """

    direction: FloatArray
    offset: Offset
    depth: float
    measured: bool

    def frame(self, scene: PadScene) -> PathFrame:
        """Frame of the path to the target as it is now: the scene's while that is at rest."""
        if float(np.abs(self.offset.path - scene.frame.axis).max()) < SAME_PATH:
            return scene.frame
        return path_frame(self.offset.path, scene.frame.R_world_patient)

    def miss(self, scene: PadScene) -> FloatArray:
        """Return how far from the target, as it is now, the needle's line passes [m], shape (3,).

        Of a tool that touches targets it is where the tip is: there the tip is led, not a line.
        """
        if scene.handle is not None:
            return self.offset.across
        length = scene.scale.length
        return passes(
            self.direction,
            self.offset.path,
            self.offset.across,
            self.depth,
            length,
            measured=self.measured,
        )

    def dot(self, scene: PadScene, hub: bool = False) -> FloatArray:
        """Place of the dot on the pad, shape (2,), the target in the middle: where the needle's
        line passes it, on the pad's scale.

        Args:
            scene: of the path.
            hub: whether the hub is what is moved: the dot is then on the other side, so that it
                goes where the hub goes.
        """
        frame, miss = self.frame(scene), self.miss(scene)
        sign = -1.0 if hub else 1.0
        way = sign * np.array([miss @ frame.right, miss @ frame.up])
        return scene.scale.place(way / scene.scale.length)


def depth_tolerance(tolerances: Mapping[str, Bands] = DEFAULT_TOLERANCES) -> float:
    """Return how far from the target along the path still counts as at it [m]: expert's depth
    error.
    """
    bands = tolerances.get("depth_error", DEFAULT_TOLERANCES["depth_error"])
    return MILLIMETRE * bands.expert


def rings(tolerances: Mapping[str, Bands] = DEFAULT_TOLERANCES) -> tuple[float, float]:
    """Radii of the rings [m]: the lateral error that counts as expert, and the one that passes.

    An exercise that does not score the lateral error gets the default's rings.
    """
    bands = tolerances.get("lateral_error", DEFAULT_TOLERANCES["lateral_error"])
    return MILLIMETRE * bands.expert, MILLIMETRE * bands.pass_


def rings_of(exercise: Exercise) -> tuple[float, float]:
    """Radii of an exercise's rings [m]: of a target to be touched, else by its tolerances."""
    if exercise.touch is not None:
        return touch_rings(exercise.touch.radius_mm * MILLIMETRE)
    return rings(exercise.tolerances)


def touch_rings(radius: float) -> tuple[float, float]:
    """Rings round a target to be touched [m]: within the inner one it is, the outer one is near."""
    return radius, 3.0 * radius


def depth_tolerance_of(exercise: Exercise) -> float:
    """Return how far from an exercise's target along the path still counts as at it [m]."""
    if exercise.touch is not None:
        return exercise.touch.radius_mm * MILLIMETRE
    return depth_tolerance(exercise.tolerances)
