"""How far the path that the student chose stays from the nearer rib's border.

Of the rib below its upper border, of the rib above its lower one; 0 where the path meets a rib,
and no more than 40 mm.
"""

from typing import Any, Final

from app.scoring.planned import known, own_lung_path
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Room to the ribs on the planned path",
    "unit": "mm",
    "higher_is_better": True,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the distance [mm]."""
    report = own_lung_path(trajectory)
    return known(report.rib_mm)


def deviation(trajectory: Trajectory) -> float | None:
    """Return 0: the plan is known exactly."""
    return 0.0
