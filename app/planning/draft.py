"""A plan while it is being made: either point may still be missing.

A judge says whether the robot can follow it, and whether it lies in the body, to whose skin an
entry snaps.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from numpy.typing import ArrayLike

from app.core.arrays import FloatArray
from app.core.errors import AcusError
from app.core.messages import sentence
from app.mechanisms.profile import DeviceProfile
from app.planning.errors import PlanError
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan, checked_point
from app.planning.reach import Reach, reach

if TYPE_CHECKING:
    from app.imaging.body import Body


Point = tuple[float, float, float]


@dataclass(frozen=True, slots=True)
class DraftPlan:
    """What the user has clicked so far; tuples, so that drafts compare by value.

    Attributes:
        entry_mm: entry, LPS [mm], or None before it is set.
        target_mm: target, LPS [mm], or None before it is set.
        name: name of the plan to be.

    Raises:
        PlanError: if a given point is not finite. Points that are too close are accepted here,
            since one of them may be on its way; `plan` refuses them.
    """

    entry_mm: Point | None = None
    target_mm: Point | None = None
    name: str = "plan"

    def __post_init__(self) -> None:
        for name in ("entry_mm", "target_mm"):
            point = getattr(self, name)
            if point is not None:
                x, y, z = checked_point(point, name).tolist()
                object.__setattr__(self, name, (x, y, z))

    @classmethod
    def of(cls, plan: Plan) -> DraftPlan:
        """Open a finished plan for editing."""
        return cls(_point(plan.entry_mm), _point(plan.target_mm), plan.name)

    @property
    def complete(self) -> bool:
        """Return whether both points are set."""
        return self.entry_mm is not None and self.target_mm is not None

    def with_entry(self, entry_mm: object) -> DraftPlan:
        """Return the draft with this entry [mm] (any sequence of three; None removes it)."""
        return DraftPlan(_point(entry_mm), self.target_mm, self.name)

    def with_target(self, target_mm: object) -> DraftPlan:
        """Return the draft with this target [mm] (any sequence of three; None removes it)."""
        return DraftPlan(self.entry_mm, _point(target_mm), self.name)

    def plan(self) -> Plan:
        """Finish the draft.

        Raises:
            PlanError: naming the point that is missing, or why the two do not make a path.
        """
        if self.entry_mm is None or self.target_mm is None:
            missing = "target" if self.entry_mm is not None else "entry"
            raise PlanError(
                sentence(
                    "the plan has no {missing} yet: click it in one of the views", missing=missing
                )
            )
        return Plan(self.entry_mm, self.target_mm, self.name)  # type: ignore[arg-type]


def _point(values: object) -> Point | None:
    if values is None:
        return None
    x, y, z = checked_point(values, "point").tolist()  # type: ignore[arg-type]
    return (x, y, z)


@dataclass(frozen=True, slots=True)
class Edit:
    """What undo goes back to: points and position together."""

    draft: DraftPlan = field(default_factory=DraftPlan)
    placement: Placement = field(default_factory=Placement)


@dataclass(frozen=True, slots=True, eq=False)
class PlanVerdict:
    """What can be said about an edit.

    Attributes:
        reach: the robot's answer; None while the plan is incomplete or not usable.
        problem: why there is no answer, or what else is wrong; empty if nothing is.
    """

    reach: Reach | None
    problem: str = ""

    @property
    def placed(self) -> PlacedPlan | None:
        """The plan in the robot's frame, if the robot can follow it."""
        usable = self.reach is not None and self.reach.reachable and not self.problem
        return self.reach.placed if usable and self.reach is not None else None


class Judge:
    """Judges edits by a body and a device.

    Attributes:
        body: the patient whose skin entries snap to; None before there is one.
        profile: the device whose reach is judged; None before there is one.
    """

    def __init__(self) -> None:
        self.body: Body | None = None
        self.profile: DeviceProfile | None = None

    def verdict(self, edit: Edit) -> PlanVerdict:
        """Say what there is to be said about an edit."""
        if not edit.draft.complete or self.profile is None:
            return PlanVerdict(None)
        try:
            plan = edit.draft.plan()
            reached = reach(plan, edit.placement, self.profile)
            if self.body is not None:
                plan.require_inside(self._inside)
        except AcusError as error:
            return PlanVerdict(None, str(error))
        return PlanVerdict(reached)

    def on_skin(self, point: ArrayLike) -> ArrayLike:
        """Return the place on the skin next to a point; the point itself without a body.

        Raises:
            AcusError: if there is no skin near it.
        """
        if self.body is None:
            return point
        from app.imaging.body import snap_to_skin  # scipy: loaded since there is a body

        return snap_to_skin(self.body, point)

    def _inside(self, point: FloatArray) -> bool:
        if self.body is None:
            return True
        from app.imaging.body import is_inside  # scipy: loaded since there is a body

        return is_inside(self.body, point)
