"""Angle between the needle and the planned path at the end."""

from app.core.arrays import angle_between
from app.core.units import DEGREE
from app.scoring.trajectory import Trajectory

NAME = "angle_error"
LABEL = "Angle error"
UNIT = "°"
HIGHER_IS_BETTER = False


def compute(trajectory: Trajectory) -> float:
    """Return the angle [°], 0 ... 180."""
    axis = trajectory.axis[trajectory.final()]
    return angle_between(axis, trajectory.placed.axis) / DEGREE
