"""How many samples of the biopsy gun hold enough lesion for a diagnosis, by the exercise."""

from typing import Any, Final

from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Diagnostic samples",
    "unit": "",
    "higher_is_better": True,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return how many."""
    return float(sum(sample.is_diagnostic for sample in trajectory.steps().samples))


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: what is counted is exact."""
    return 0.0
