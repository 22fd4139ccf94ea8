"""Angle between the needle and the path to the target, where the last insertion began."""

from typing import Any, Final

from app.core.arrays import angle_between
from app.core.units import DEGREE
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import axis_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Angle error at the skin",
    "unit": "°",
    "higher_is_better": False,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the angle [°], 0 ... 180."""
    i = int(trajectory.stays()[-1][0])
    return angle_between(trajectory.axis[i], trajectory.offset(i).path) / DEGREE


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation of the needle's direction in a plane [°]."""
    return axis_sd(trajectory)
