"""Angle error at the end within the axial plane: positive from the patient's left to the back.

Needle and planned path are seen along the patient's length, as on an axial slice; a path within 5°
of that direction shows no angle there.
"""

from typing import Any, Final

import numpy as np

from app.core.messages import sentence
from app.core.units import DEGREE
from app.scoring.errors import MetricUnavailableError
from app.scoring.trajectory import Trajectory
from app.scoring.uncertainty import axis_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Angle error in plane",
    "unit": "°",
    "higher_is_better": False,
    "reads": (),
}
STEEPEST = np.sin(5.0 * DEGREE)


def compute(trajectory: Trajectory) -> float:
    """Return the signed angle [°], -180 ... 180."""
    i = trajectory.final()
    path = trajectory.offset(i).path
    rotation = trajectory.placed.placement.rotation
    needle, planned = (
        (rotation.T @ (one / np.linalg.norm(one)))[:2] for one in (trajectory.axis[i], path)
    )
    if min(np.linalg.norm(needle), np.linalg.norm(planned)) < STEEPEST:
        raise MetricUnavailableError(
            sentence("the needle or its path runs along the patient's length")
        )
    across = planned[0] * needle[1] - planned[1] * needle[0]
    return float(np.arctan2(across, planned @ needle)) / DEGREE


def deviation(trajectory: Trajectory) -> float:
    """Return the direction's standard deviation as it looks in the plane [°]: larger the more the
    needle leans out of it.
    """
    axis = trajectory.axis[trajectory.final()]
    seen = (trajectory.placed.placement.rotation.T @ axis)[:2]
    return axis_sd(trajectory) / max(float(np.linalg.norm(seen)), float(STEEPEST))
