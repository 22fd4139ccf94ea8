"""Angle error at the end across the axial plane: positive where the needle leans to the head.

It is the needle's angle to the axial plane less the planned path's.
"""

from typing import Any, Final

import numpy as np

from app.core.units import DEGREE
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import axis_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Angle error out of plane",
    "unit": "°",
    "higher_is_better": False,
    "reads": (),
}


def compute(trajectory: Trajectory) -> float:
    """Return the signed angle [°]."""
    i = trajectory.final()
    path = trajectory.offset(i).path
    head = trajectory.placed.placement.rotation[:, 2]
    needle, planned = (
        float(np.arcsin(np.clip(head @ one / np.linalg.norm(one), -1.0, 1.0)))
        for one in (trajectory.axis[i], path)
    )
    return (needle - planned) / DEGREE


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation of the needle's direction in a plane [°]."""
    return axis_sd(trajectory)
