"""By how much the needle came nearer to a risk structure than allowed, at the worst of them."""

from typing import Any, Final

from app.scoring.errors import MetricNotAskedError
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Too near to risk",
    "unit": "mm",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Largest breach [mm]: the limit minus the smallest distance; 0 if all limits were kept."""
    if not trajectory.risks:
        raise MetricNotAskedError("no structure of risk was measured")
    return max(risk.breach_mm for risk in trajectory.risks)
