"""What can be said about a plan: whether the robot can follow it, and whether it lies in the body.

An entry snaps to the same body's skin.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from numpy.typing import ArrayLike

from app.core.arrays import FloatArray
from app.core.errors import AcusError
from app.mechanisms.profile import DeviceProfile
from app.planning.draft import DraftPlan
from app.planning.placement import PlacedPlan, Placement
from app.planning.reach import Reach, reach

if TYPE_CHECKING:
    from app.imaging.body import Body


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
