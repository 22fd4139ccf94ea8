"""Work of the virtual fixture on the needle in the body: ∫ F_guide · dx at the hub point.

Positive: the fixture moved the needle, so it did part of the student's task; negative: the hand
worked against it. Off its path a spring gives back what it took, so the sum over a detour is small.
"""

from typing import Any, Final

import numpy as np

from app.core.messages import sentence
from app.scoring.errors import MetricUnavailableError
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Guidance work",
    "unit": "mJ",
    "higher_is_better": False,
    "reads": ("guide",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the work [mJ], by the trapezoidal rule."""
    trajectory.forces()
    guide, hub = trajectory.guide, trajectory.hub
    if guide is None or hub is None:
        raise MetricUnavailableError(sentence("the force of the guidance was not recorded"))
    work = 0.0
    for part in trajectory.insertions():
        force = 0.5 * (guide[part][1:] + guide[part][:-1])
        work += float(np.einsum("ij,ij->", force, np.diff(hub[part], axis=0)))
    return work * 1e3
