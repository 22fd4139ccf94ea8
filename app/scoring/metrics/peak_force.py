"""Largest force that the hand felt while the needle was in the body."""

import numpy as np

from app.scoring.trajectory import Trajectory

NAME = "peak_force"
LABEL = "Peak force, estimated"
UNIT = "N"
HIGHER_IS_BETTER = False
READS = ("felt_x", "felt_y", "felt_z")


def compute(trajectory: Trajectory) -> float:
    """Return the force at the hub point, after all limits [N]."""
    trajectory.insertions()
    return float(np.linalg.norm(trajectory.forces()[trajectory.inserted], axis=1).max())
