"""By how much the needle came nearer to a risk structure than allowed, at the worst of them."""

from app.scoring.errors import MetricNotAskedError
from app.scoring.trajectory import Trajectory

NAME = "risk_breach"
LABEL = "Too near to risk"
UNIT = "mm"
HIGHER_IS_BETTER = False
READS = ("tip_offset_x", "tip_offset_y", "tip_offset_z")


def compute(trajectory: Trajectory) -> float:
    """Largest breach [mm]: the limit minus the smallest distance; 0 if all limits were kept."""
    if not trajectory.risks:
        raise MetricNotAskedError("no structure of risk was measured")
    return max(risk.breach_mm for risk in trajectory.risks)
