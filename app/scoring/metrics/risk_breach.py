"""By how much the needle came nearer to a risk structure than allowed, at the worst of them."""

from typing import Any, Final

from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.scoring.errors import MetricNotAskedError
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import tip_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Too near to risk",
    "unit": "mm",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Largest breach [mm]: the limit minus the smallest distance; 0 if all limits were kept."""
    if not trajectory.risks:
        raise MetricNotAskedError(sentence("no structure of risk was measured"))
    return max(risk.breach_mm for risk in trajectory.risks)


def deviation(trajectory: Trajectory) -> float:
    """Return an upper bound of the standard deviation [mm]: the tip's largest at that moment."""
    worst = max(trajectory.risks, key=lambda risk: risk.limit_mm - risk.closest_mm)
    return tip_sd(trajectory, trajectory.at(worst.time)) / MILLIMETRE
