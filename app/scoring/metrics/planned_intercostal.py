"""How far the path that the student chose stays from the nearest intercostal artery or vein.

Not known where nobody labelled them; no more than 40 mm.
"""

from typing import Any, Final

from app.scoring.planned import known, own_lung_path
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Room to intercostal vessels",
    "unit": "mm",
    "higher_is_better": True,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the distance [mm]."""
    report = own_lung_path(trajectory)
    return known(report.intercostal_mm)


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: the plan is known exactly."""
    return 0.0
