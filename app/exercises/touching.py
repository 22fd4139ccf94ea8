"""Targets to be touched one after the other with the tip: where they lie, and what a touch is.

They lie in the patient, given or drawn about the path by the exercise's seed, and each is a target
like any other: its path leads from the entry, which is the fulcrum, straight to it, so that the
machine can reach it where it could reach such a plan.
"""

from __future__ import annotations

from dataclasses import dataclass, replace
from typing import TYPE_CHECKING, Annotated, Final

import numpy as np
from pydantic import Field, model_validator

from app.core.arrays import FloatArray, read_only
from app.core.configuration import Strict
from app.core.messages import joined, sentence
from app.core.units import DEGREE, MILLIMETRE
from app.exercises.errors import ExerciseError
from app.exercises.parts import Triple
from app.planning.errors import PlanError
from app.planning.limits import ReachLimits
from app.planning.placement import PlacedPlan
from app.planning.plan import Plan
from app.planning.reach import reach_within

if TYPE_CHECKING:
    from app.mechanisms.profile import DeviceProfile

MOST_TARGETS: Final = 12
LEAST_DEPTH: Final = 10.0
"""Depth of a target below the trocar [mm]: nearer the hand hardly moves the tip sideways."""

_APART: Final = 3.0
"""Drawn targets that follow each other are so many radii apart at least."""
_TRIES: Final = 2000


Given = Annotated[tuple[Triple, ...], Field(min_length=1, max_length=MOST_TARGETS)]


class TouchPattern(Strict):
    """Targets that are drawn about the path, by the exercise's seed.

    Attributes:
        count: how many.
        depth_mm: least and largest distance from the entry [mm].
        within_deg: largest angle between the way to a target and the path [°].
    """

    count: Annotated[int, Field(ge=1, le=MOST_TARGETS)]
    depth_mm: tuple[Annotated[float, Field(ge=LEAST_DEPTH)], Annotated[float, Field(le=500.0)]]
    within_deg: Annotated[float, Field(ge=0.0, le=60.0)]

    @model_validator(mode="after")
    def _depths_rise(self) -> TouchPattern:
        near, far = self.depth_mm
        if not near <= far:
            raise ValueError(
                sentence(
                    "depth_mm: {near:g} to {far:g} mm; give the smaller one first",
                    near=near,
                    far=far,
                )
            )
        return self


class TouchPart(Strict):
    """Targets that the tip has to touch in their order.

    Attributes:
        targets_mm: where they lie, DICOM LPS [mm]; None where they are drawn.
        pattern: how they are drawn; None where they are given.
        radius_mm: the tip touches a target within so many mm of it.
        dwell_s: for so long, without a break.
    """

    targets_mm: Given | None = None
    pattern: TouchPattern | None = None
    radius_mm: Annotated[float, Field(ge=1.0, le=20.0)] = 4.0
    dwell_s: Annotated[float, Field(ge=0.1, le=5.0)] = 0.5

    @model_validator(mode="after")
    def _one_of_two(self) -> TouchPart:
        if (self.targets_mm is None) == (self.pattern is None):
            raise ValueError(
                sentence("give either targets_mm: [[x, y, z], …] or pattern: {{…}}, one of both")
            )
        return self


@dataclass(frozen=True, slots=True, eq=False)
class TouchTask:
    """What is to be touched, as one attempt has it.

    Attributes:
        plans: of each target, in its order: the path from the entry to it, in the world.
        radius: within which the tip touches a target [m].
        dwell: time for which it has to stay there [s].
    """

    plans: tuple[PlacedPlan, ...]
    radius: float
    dwell: float

    def __len__(self) -> int:
        """Return the number of targets."""
        return len(self.plans)

    @property
    def p_targets(self) -> FloatArray:
        """All targets in the world [m], shape (n, 3)."""
        return read_only(np.array([plan.p_target for plan in self.plans]))

    @property
    def points_mm(self) -> FloatArray:
        """All targets in the patient, DICOM LPS [mm], shape (n, 3)."""
        return read_only(np.array([plan.plan.target_mm for plan in self.plans]))


def targets_mm(part: TouchPart, plan: Plan, seed: int) -> FloatArray:
    """Targets, DICOM LPS [mm], shape (n, 3).

    Args:
        part: how an exercise gives them.
        plan: the path that they are drawn about.
        seed: of the exercise.

    Raises:
        ExerciseError: if so many do not find room.
    """
    if part.pattern is not None:
        return _drawn(part.pattern, part.radius_mm, plan, seed)
    return np.array(part.targets_mm, dtype=np.float64)


def _drawn(pattern: TouchPattern, radius_mm: float, plan: Plan, seed: int) -> FloatArray:
    """Draw directions evenly over the cone and depths evenly over their range."""
    random = np.random.default_rng([seed, 3])
    along = plan.direction
    first = np.cross(along, np.eye(3)[int(np.argmin(np.abs(along)))])
    first /= np.linalg.norm(first)
    second = np.cross(along, first)
    found: list[FloatArray] = []
    for _ in range(_TRIES):
        height = random.uniform(np.cos(pattern.within_deg * DEGREE), 1.0)
        turn, depth = random.uniform(0.0, 2.0 * np.pi), random.uniform(*pattern.depth_mm)
        side = np.sqrt(1.0 - height * height)
        way = height * along + side * (np.cos(turn) * first + np.sin(turn) * second)
        at = np.round(plan.entry_mm + depth * way, 1)
        if not found or np.linalg.norm(at - found[-1]) >= _APART * radius_mm:
            found.append(at)
        if len(found) == pattern.count:
            return np.array(found)
    raise ExerciseError(
        sentence(
            "touch.pattern: {targets} targets that follow each other {apart:g} radii of "
            "{radius_mm:g} mm apart find no room within {pattern_within_deg:g}° and depths of "
            "{least_depth_mm:g} to {largest_depth_mm:g} mm; give more room or a "
            "smaller radius",
            targets=pattern.count,
            apart=_APART,
            radius_mm=radius_mm,
            pattern_within_deg=pattern.within_deg,
            least_depth_mm=pattern.depth_mm[0],
            largest_depth_mm=pattern.depth_mm[1],
        )
    )


def touch_task(part: TouchPart | None, placed: PlacedPlan, seed: int) -> TouchTask | None:
    """Return what is to be touched on a placed plan; None where nothing is.

    Args:
        part: of the exercise; None where it has none.
        placed: its plan.
        seed: of the exercise.

    Raises:
        AcusError: if targets find no room, or lie on the entry.
    """
    if part is None:
        return None
    plans = []
    for number, at in enumerate(targets_mm(part, placed.plan, seed), 1):
        try:
            plan = Plan(placed.plan.entry_mm, at, f"target {number}")
        except PlanError as error:
            raise ExerciseError(
                sentence(
                    "touch: target {target_number}: {error}", target_number=number, error=error
                )
            ) from error
        plans.append(PlacedPlan.of(plan, placed.placement, placed.p_entry))
    return TouchTask(tuple(plans), part.radius_mm * MILLIMETRE, part.dwell_s)


def check_touch(task: TouchTask | None, profile: DeviceProfile, quick: bool = False) -> None:
    """Refuse targets that the machine cannot bring the tip to, or that a tip at rest touches.

    Args:
        task: what is to be touched; None where nothing is.
        profile: the machine.
        quick: look at lean and depth alone; the workspace needs compiled code.

    Raises:
        ExerciseError: naming the target, its value and what would be reachable.
    """
    if task is None:
        return
    limits = ReachLimits.of(profile)
    if quick:
        limits = replace(limits, in_workspace=lambda x, y: True)
    for number, one in enumerate(task.plans, 1):
        x, y, z = one.plan.target_mm.tolist()
        reached = reach_within(one.plan, one.placement, limits)
        reasons = [reason.text for reason in reached.reasons]
        depth_mm = one.length / MILLIMETRE
        if depth_mm < LEAST_DEPTH:
            reasons.append(
                sentence(
                    "it lies {depth_mm:.1f} mm from the trocar, not {least_mm:g} mm",
                    depth_mm=depth_mm,
                    least_mm=LEAST_DEPTH,
                )
            )
        elif one.length <= task.radius:
            reasons.append(
                sentence(
                    "it lies {depth_mm:.1f} mm from the trocar, within its own radius of "
                    "{radius_mm:g} mm, where a tool that only comes in touches it",
                    depth_mm=depth_mm,
                    radius_mm=task.radius / MILLIMETRE,
                )
            )
        if reasons:
            raise ExerciseError(
                sentence(
                    "touch: target {target_number} at [{x:g}, {y:g}, {z:g}] mm cannot be touched "
                    "with {profile_name}: {reasons}. Reachable are targets "
                    "{least_depth:g} to {limits_depth_limit_mm:.0f} mm from the entry, by a "
                    "way that leans at most {limits_tilt_limit_deg:.0f}° from straight down",
                    target_number=number,
                    x=x,
                    y=y,
                    z=z,
                    profile_name=profile.name,
                    reasons=joined("; ", reasons),
                    least_depth=LEAST_DEPTH,
                    limits_depth_limit_mm=limits.depth_limit / MILLIMETRE,
                    limits_tilt_limit_deg=limits.tilt_limit / DEGREE,
                )
            )
    _check_apart(task)


def _check_apart(task: TouchTask) -> None:
    """Refuse targets that follow each other so closely that one stay touches both."""
    apart_mm = np.linalg.norm(np.diff(task.points_mm, axis=0), axis=1)
    for number, gap in enumerate(apart_mm.tolist(), 2):
        if gap * MILLIMETRE <= 2.0 * task.radius:
            raise ExerciseError(
                sentence(
                    "touch: targets {first} and {second} lie {gap:.1f} mm apart; with a "
                    "radius of {radius_mm:g} mm a tip that stays touches both: lay them "
                    "more than {least_gap_mm:g} mm apart, or give a smaller radius_mm",
                    first=number - 1,
                    second=number,
                    gap=gap,
                    radius_mm=task.radius / MILLIMETRE,
                    least_gap_mm=2.0 * task.radius / MILLIMETRE,
                )
            )
