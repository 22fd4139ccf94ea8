"""Scoring an attempt: every metric, judged by the exercise's tolerances.

Metrics of somebody else's that an exercise does not count are no part of the score that is recorded
and sealed: they are computed after that, by `with_shown`, for whoever looks at the attempt.
"""

from collections.abc import Mapping
from dataclasses import replace

from app.core.messages import sentence
from app.scoring.defaults import DEFAULT_TOLERANCES
from app.scoring.errors import MetricError, ToleranceError
from app.scoring.metrics import Metric, available, find
from app.scoring.result import Score, judge
from app.scoring.rows import Row, ScoreRules
from app.scoring.tolerance import Tolerance
from app.scoring.trajectory import Trajectory
from app.scoring.version import SCORING_VERSION

__all__ = ["DEFAULT_TOLERANCES", "Row", "Score", "ScoreRules", "check_names", "score", "with_shown"]


def score(
    trajectory: Trajectory,
    tolerances: Mapping[str, Tolerance] = DEFAULT_TOLERANCES,
    rules: ScoreRules | None = None,
    version: int = SCORING_VERSION,
) -> Score:
    """Compute every metric of the program's own, and those that count, and judge the attempt.

    `version` is one of `scoring.version.KNOWN_VERSIONS`: an older score is made by its own rules.

    Raises:
        UnknownMetricError: for a tolerance of a metric that does not exist; lists those that do.
    """
    metrics = available()
    check_names(tolerances, metrics)
    if version != trajectory.scoring_version:
        trajectory = replace(trajectory, scoring_version=version)
    own = [name for name, metric in metrics.items() if metric.is_own]
    names = [*tolerances, *(name for name in own if name not in tolerances)]
    rows = tuple(
        row for name in names if (row := _row(metrics[name], trajectory, tolerances.get(name)))
    )
    rules = rules or ScoreRules()
    return judge(rows, rules, _attempt_void(trajectory, rules), trajectory.met, version)


def with_shown(scored: Score, trajectory: Trajectory) -> Score:
    """Add a row of each metric of somebody else's that the exercise does not count.

    Whatever their files do, the rows that are there stay as they are.
    """
    there = {row.name for row in scored.rows}
    others = [m for name, m in available().items() if not m.is_own and name not in there]
    rows = [row for metric in others if (row := _row(metric, trajectory, None))]
    return replace(scored, rows=(*scored.rows, *rows)) if rows else scored


def check_names(
    tolerances: Mapping[str, Tolerance], metrics: Mapping[str, Metric] | None = None
) -> None:
    """Refuse tolerances of unknown metrics, and bands against a metric's direction.

    Raises:
        UnknownMetricError: naming the metrics that exist.
        ToleranceError: naming the bands and the direction.
        MetricError: for a metric of the user's own whose file is broken; says why.
    """
    for name, limits in tolerances.items():
        # One file is read for a name; a list of all would read seventy.
        metric = metrics[name] if metrics and name in metrics else find(name)
        if metric.fault:
            raise MetricError(
                sentence(
                    "metric {name!r} cannot be used: {metrics_fault}",
                    name=name,
                    metrics_fault=metric.fault,
                )
            )
        if limits.higher_is_better != metric.higher_is_better:
            way = "higher" if metric.higher_is_better else "lower"
            raise ToleranceError(
                sentence(
                    "{name}: bands {limits_knots} (expert, good, pass) run against the metric, "
                    "of which {way} is better",
                    name=name,
                    limits_knots=limits.knots[:3],
                    way=way,
                )
            )


def _row(metric: Metric, trajectory: Trajectory, limits: Tolerance | None) -> Row | None:
    """Row of one metric; None where the exercise has nothing that it could measure."""
    found = metric.measured(trajectory)
    if limits is None and not found.asked:
        return None
    return Row(metric.name, metric.title, metric.unit, found.value, found.note, limits, found.sd)


def _attempt_void(trajectory: Trajectory, rules: ScoreRules) -> str:
    if trajectory.was_aborted:
        return sentence(
            "the attempt was aborted: {trajectory_aborted}",
            trajectory_aborted=trajectory.aborted or "no reason recorded",
        )
    if not trajectory.running.any():
        return sentence(
            "the attempt was never begun: it ended before the needle was out of the skin"
        )
    if not trajectory.depth_valid[trajectory.running].any():
        return sentence("nothing measured how deep the needle was")
    if not trajectory.inserted.any():
        return sentence("the needle never crossed the skin: it was never inserted")
    paused = trajectory.waited
    if paused > rules.maximum_pause and trajectory.computer > 0.5 * paused:
        return sentence(
            "this computer was too slow: the attempt waited {paused:.0f} s for pictures of its own "
            "simulated cameras; {allowed:g} s are allowed",
            paused=paused,
            allowed=rules.maximum_pause,
        )
    if paused > rules.maximum_pause:
        return sentence(
            "the attempt waited {paused:.0f} s for the cameras; {rules_maximum_pause:g} s "
            "are allowed",
            paused=paused,
            rules_maximum_pause=rules.maximum_pause,
        )
    return ""
