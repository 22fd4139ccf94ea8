"""A plan while it is being made: either point may still be missing."""

from __future__ import annotations

from dataclasses import dataclass

from app.planning.errors import PlanError
from app.planning.plan import Plan, checked_point

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
        for field in ("entry_mm", "target_mm"):
            point = getattr(self, field)
            if point is not None:
                x, y, z = checked_point(point, field).tolist()
                object.__setattr__(self, field, (x, y, z))

    @classmethod
    def of(cls, plan: Plan) -> DraftPlan:
        """Open a finished plan for editing."""
        return cls(_point(plan.entry_mm), _point(plan.target_mm), plan.name)

    @property
    def complete(self) -> bool:
        """Whether both points are set."""
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
            raise PlanError(f"the plan has no {missing} yet: click it in one of the views")
        return Plan(self.entry_mm, self.target_mm, self.name)  # type: ignore[arg-type]


def _point(values: object) -> Point | None:
    if values is None:
        return None
    x, y, z = checked_point(values, "point").tolist()  # type: ignore[arg-type]
    return (x, y, z)
