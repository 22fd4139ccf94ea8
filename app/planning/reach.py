"""Whether the robot can follow a plan; if not, why, and which rotation of the patient helps."""

from __future__ import annotations

from dataclasses import dataclass
from enum import StrEnum

from app.core.arrays import FloatArray
from app.core.units import DEGREE, MILLIMETRE
from app.mechanisms.profile import DeviceProfile
from app.planning.limits import ReachLimits, tilt_of
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan
from app.planning.remedy import Remedy, find_remedy


class Obstacle(StrEnum):
    """Why a path is out of reach."""

    UPWARD = "upward"
    TILT = "tilt"
    WORKSPACE = "workspace"
    DEPTH = "depth"


@dataclass(frozen=True, slots=True)
class Reason:
    """One reason why a path is out of reach.

    Attributes:
        obstacle: which limit.
        text: the reason for people, with the value and the limit.
    """

    obstacle: Obstacle
    text: str

    def __str__(self) -> str:
        return self.text


@dataclass(frozen=True, slots=True)
class Reach:
    """Answer of `reach`.

    Attributes:
        reachable: whether there is no reason against the path.
        tilt: angle between path and straight down [rad].
        depth: length of the path [m].
        reasons: each limit that is exceeded, with numbers.
        remedy: how to turn the patient so that the path is reachable; None when it already is,
            or when no rotation helps (a path that is too long stays too long).
        placed: the plan in world.
    """

    reachable: bool
    tilt: float
    depth: float
    reasons: tuple[Reason, ...]
    remedy: Remedy | None
    placed: PlacedPlan

    def message(self) -> str:
        """One line for people: reachable, or the reasons and the remedy."""
        if self.reachable:
            return (
                f"reachable: tilt {self.tilt / DEGREE:.1f}°, depth {self.depth / MILLIMETRE:.1f} mm"
            )
        text = "out of reach: " + "; ".join(reason.text for reason in self.reasons)
        return f"{text}. Remedy: {self.remedy.words}" if self.remedy else text


def reach(plan: Plan, placement: Placement, profile: DeviceProfile) -> Reach:
    """Tell whether a device can follow the path from its fulcrum to the target.

    Args:
        plan: entry and target in the patient.
        placement: how the patient lies.
        profile: the device.
    """
    return reach_within(plan, placement, ReachLimits.of(profile))


def reach_within(plan: Plan, placement: Placement, limits: ReachLimits) -> Reach:
    """`reach` for limits that do not come from a profile."""
    placed = PlacedPlan.of(plan, placement, limits.fulcrum)
    reasons = _direction_reasons(placed.axis, limits) + _depth_reasons(placed.length, limits)
    curable = bool(reasons) and all(r.obstacle is not Obstacle.DEPTH for r in reasons)
    return Reach(
        reachable=not reasons,
        tilt=placed.tilt,
        depth=placed.length,
        reasons=reasons,
        remedy=find_remedy(placed, limits) if curable else None,
        placed=placed,
    )


def _direction_reasons(axis: FloatArray, limits: ReachLimits) -> tuple[Reason, ...]:
    tilt, limit = tilt_of(axis) / DEGREE, limits.tilt_limit / DEGREE
    point = limits.tool_point(axis)
    if point is None:
        way = "horizontal" if tilt < 90.001 else f"upward (tilt {tilt:.1f}° of 180°)"
        text = (
            f"the path runs {way}; the needle enters from above, at most {limit:g}° from vertical"
        )
        return (Reason(Obstacle.UPWARD, text),)
    if tilt_of(axis) > limits.tilt_limit + 1e-9:
        return (Reason(Obstacle.TILT, f"tilt {tilt:.1f}° exceeds {limit:g}°"),)
    if not limits.in_workspace(*point):
        x, y = (value / MILLIMETRE for value in point)
        text = f"tool point ({x:.1f}, {y:.1f}) mm lies outside the robot's workspace"
        return (Reason(Obstacle.WORKSPACE, text),)
    return ()


def _depth_reasons(depth: float, limits: ReachLimits) -> tuple[Reason, ...]:
    if depth <= limits.depth_limit + 1e-9:
        return ()
    text = (
        f"depth {depth / MILLIMETRE:.1f} mm exceeds {limits.depth_limit / MILLIMETRE:g} mm; "
        "no rotation shortens a path: choose an entry closer to the target"
    )
    return (Reason(Obstacle.DEPTH, text),)
