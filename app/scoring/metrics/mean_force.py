"""Mean over time of the force that the hand felt while the needle was in the body."""

import numpy as np

from app.scoring.trajectory import Trajectory

NAME = "mean_force"
LABEL = "Mean force, estimated"
UNIT = "N"
HIGHER_IS_BETTER = False
READS = ("felt_x", "felt_y", "felt_z")


def compute(trajectory: Trajectory) -> float:
    """Return the mean of |felt| weighted with time [N]; of a single sample, its value."""
    total = weight = 0.0
    for part in trajectory.insertions():
        force = np.linalg.norm(trajectory.forces()[part], axis=1)
        steps = np.diff(trajectory.time[part])
        total += float((0.5 * (force[1:] + force[:-1]) * steps).sum())
        weight += float(steps.sum())
    if weight > 0.0:
        return total / weight
    return float(np.linalg.norm(trajectory.forces()[trajectory.inserted], axis=1).mean())
