"""How far the breath had moved the target from its place in the CT while the needle was pushed."""

from typing import Any, Final

import numpy as np

from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.scoring.errors import MetricNotAskedError, MetricUnavailableError
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Breath while pushing",
    "unit": "mm",
    "higher_is_better": False,
    "reads": ("target_shift",),
}


def compute(trajectory: Trajectory) -> float:
    """Return the target's mean displacement over the way that was pushed deeper [mm].

    Each step deeper of a measured stay in the body counts by its length, so that a needle which
    waits while the target is away gathers nothing.
    """
    shift = trajectory.target_shift
    if shift is None or not np.any(shift):
        raise MetricNotAskedError(sentence("the breath does not move the target"))
    away, way = 0.0, 0.0
    for stay in trajectory.measured_stays():
        steps = np.maximum(np.diff(trajectory.depth[stay]), 0.0)
        away += float(steps @ np.linalg.norm(shift[stay[1:]], axis=1))
        way += float(steps.sum())
    if not way > 0.0:
        raise MetricUnavailableError(sentence("the needle was never pushed deeper"))
    return away / way / MILLIMETRE
