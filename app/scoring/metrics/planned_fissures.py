"""How many fissures the path that the student chose crosses.

Each is two more layers of pleura. Not known where nobody labelled the lobes.
"""

from typing import Any, Final

from app.scoring.planned import known, own_lung_path
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Fissures on the planned path",
    "unit": "",
    "higher_is_better": False,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return their number."""
    report = own_lung_path(trajectory)
    return known(None if report.fissures is None else float(len(report.fissures)))


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: the plan is known exactly."""
    return 0.0
