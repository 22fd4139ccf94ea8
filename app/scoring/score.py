"""Scoring an attempt: every metric, judged by the exercise's tolerances."""

from collections.abc import Mapping
from math import isfinite

from app.scoring.defaults import DEFAULT_TOLERANCES
from app.scoring.errors import (
    MetricError,
    MetricNotAskedError,
    MetricUnavailableError,
    ToleranceError,
    UnknownMetricError,
)
from app.scoring.metrics import Metric, available
from app.scoring.result import Score, judge
from app.scoring.rows import Row, ScoreRules
from app.scoring.tolerance import Tolerance
from app.scoring.trajectory import Trajectory

__all__ = ["DEFAULT_TOLERANCES", "Row", "Score", "ScoreRules", "check_names", "score"]


def score(
    trajectory: Trajectory,
    tolerances: Mapping[str, Tolerance] = DEFAULT_TOLERANCES,
    rules: ScoreRules | None = None,
) -> Score:
    """Compute every metric of an attempt and judge it.

    Raises:
        UnknownMetricError: for a tolerance of a metric that does not exist; lists those that do.
    """
    metrics = available()
    check_names(tolerances, metrics)
    names = [*tolerances, *(name for name in metrics if name not in tolerances)]
    rows = tuple(
        row for name in names if (row := _row(metrics[name], trajectory, tolerances.get(name)))
    )
    rules = rules or ScoreRules()
    return judge(rows, rules, _attempt_void(trajectory, rules))


def check_names(
    tolerances: Mapping[str, Tolerance], metrics: Mapping[str, Metric] | None = None
) -> None:
    """Refuse tolerances of unknown metrics, and bands against a metric's direction.

    Raises:
        UnknownMetricError: naming the metrics that exist.
        ToleranceError: naming the bands and the direction.
        MetricError: for a metric of the user's own whose file is broken; says why.
    """
    metrics = available() if metrics is None else metrics
    for name, limits in tolerances.items():
        if name not in metrics:
            raise UnknownMetricError(f"no metric {name!r}; there are {', '.join(metrics)}")
        if metrics[name].fault:
            raise MetricError(f"metric {name!r} cannot be used: {metrics[name].fault}")
        if limits.higher_is_better != metrics[name].higher_is_better:
            way = "higher" if metrics[name].higher_is_better else "lower"
            raise ToleranceError(
                f"{name}: bands {limits.knots[:3]} (expert, good, pass) run against the metric, "
                f"of which {way} is better"
            )


def _row(metric: Metric, trajectory: Trajectory, limits: Tolerance | None) -> Row | None:
    """Row of one metric; None where the exercise has nothing that it could measure."""
    note = ""
    try:
        value: float | None = float(metric.compute(trajectory))
    except MetricNotAskedError as error:
        if limits is None:
            return None
        value, note = None, str(error)
    except MetricUnavailableError as error:
        value, note = None, str(error)
    if value is not None and not isfinite(value):
        value, note = None, "the value is too large to be written as a number"
    sd = None if value is None else metric.deviation(trajectory)
    return Row(metric.name, metric.title, metric.unit, value, note, limits, sd)


def _attempt_void(trajectory: Trajectory, rules: ScoreRules) -> str:
    if trajectory.was_aborted:
        return f"the attempt was aborted: {trajectory.aborted or 'no reason recorded'}"
    if not trajectory.running.any():
        return "the attempt was never begun: it ended before the needle was out of the skin"
    if not trajectory.depth_valid[trajectory.running].any():
        return "nothing measured how deep the needle was"
    if not trajectory.inserted.any():
        return "the needle never crossed the skin: it was never inserted"
    paused = trajectory.waited
    if paused > rules.maximum_pause:
        return (
            f"the attempt waited {paused:.0f} s for the cameras; {rules.maximum_pause:g} s are "
            "allowed"
        )
    return ""
