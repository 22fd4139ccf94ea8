"""Time that the needle was inside structures of risk, each structure's own added up.

Inside is the needle if any of its part in the body is, tip or shaft. The record tells it of each
structure by itself.
"""

from typing import Any, Final

from app.core.messages import sentence
from app.scoring.errors import MetricNotAskedError, MetricUnavailableError
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import EDGE

DECLARATION: Final[dict[str, Any]] = {
    "title": "Time inside risk",
    "unit": "s",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the sum over the structures [s]; 0 where all were spared."""
    if not trajectory.risks:
        raise MetricNotAskedError(sentence("no structure of risk was measured"))
    times = [risk.inside_s for risk in trajectory.risks]
    if None in times:
        raise MetricUnavailableError(sentence("how long the needle was inside was not recorded"))
    return float(sum(time for time in times if time is not None))


def deviation(trajectory: Trajectory) -> float:
    """Return what the time between samples leaves [s]: entry and exit of each structure."""
    inside = sum(bool(risk.inside_s) for risk in trajectory.risks)
    steps = trajectory.time[-1] - trajectory.time[0]
    period = float(steps) / max(1, len(trajectory) - 1)
    return EDGE * period * float(2 * inside) ** 0.5
