"""The path that a student chose, as metrics ask for it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.core.messages import sentence
from app.scoring.errors import MetricNotAskedError

if TYPE_CHECKING:
    from app.planning.judged import JudgedPlan
    from app.scoring.trajectory import Trajectory


def own_plan(trajectory: Trajectory) -> JudgedPlan:
    """Return what a planner says of the path that the student chose.

    Raises:
        MetricNotAskedError: if the path was given, or nothing could tell.
    """
    if trajectory.planned is None:
        raise MetricNotAskedError(
            sentence("the path was given, or no tissue field told what lies on it")
        )
    return trajectory.planned
