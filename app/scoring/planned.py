"""The path that a student chose, as metrics ask for it."""

from __future__ import annotations

from typing import TYPE_CHECKING

from app.core.messages import sentence
from app.scoring.errors import MetricNotAskedError, MetricUnavailableError

if TYPE_CHECKING:
    from app.planning.judged import JudgedPlan
    from app.planning.lung_path.values import LungPathReport
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


def own_lung_path(trajectory: Trajectory) -> LungPathReport:
    """Return the path report of a lung biopsy for the path that the student chose.

    Raises:
        MetricNotAskedError: if none was asked for, the path was given, or it misses the lung.
    """
    report = own_plan(trajectory).lung
    if report is None:
        raise MetricNotAskedError(sentence("no report of a path through the lung was asked for"))
    return report


def known(figure: float | None) -> float:
    """Return a figure of the report.

    Raises:
        MetricUnavailableError: if nobody labelled what would tell it.
    """
    if figure is None:
        raise MetricUnavailableError(sentence("nobody labelled what would tell it in this patient"))
    return figure
