"""Largest error of a distance between two electrodes' tips against the plan."""

from typing import Any, Final

from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Electrode spacing error",
    "unit": "mm",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the error [mm].

    Raises:
        MetricUnavailableError: if nothing was ablated.
    """
    return trajectory.steps().ablated().spacing_error_mm
