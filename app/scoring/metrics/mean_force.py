"""Mean over time of the force that the hand felt, also where the depth was not known."""

from typing import Any, Final

import numpy as np

from app.scoring.trajectory import Trajectory, runs

DECLARATION: Final[dict[str, Any]] = {
    "title": "Mean force, estimated",
    "unit": "N",
    "higher_is_better": False,
    "reads": ("felt",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the mean of |felt| weighted with time [N]; of a single sample, its value."""
    total = weight = 0.0
    pushed = trajectory.pushed()
    for part in runs(pushed):
        force = np.linalg.norm(trajectory.forces()[part], axis=1)
        steps = np.diff(trajectory.time[part])
        total += float((0.5 * (force[1:] + force[:-1]) * steps).sum())
        weight += float(steps.sum())
    if weight > 0.0:
        return total / weight
    return float(np.linalg.norm(trajectory.forces()[pushed], axis=1).mean())
