"""How many great vessels lie within 3 mm of what was ablated, and cool it there.

No table of what a vessel takes away was found: it is a warning, by how many there are.
"""

from typing import Any, Final

from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Vessels within 3 mm",
    "unit": "",
    "higher_is_better": False,
    "reads": ("tip_offset",),
}


def compute(trajectory: Trajectory) -> float:
    """Return how many.

    Raises:
        MetricUnavailableError: if nothing was ablated.
    """
    return float(len(trajectory.steps().ablated().vessels))
