"""Longest rest of the tip shortly before it first crossed pleura or capsule.

One stops there, lets the patient hold the breath, looks once more, and crosses in one go: a needle
that lingers across a moving pleura tears it. A rest is less than 1 mm along the needle, within the
last 15 mm before the membrane.
"""

from typing import Any, Final

import numpy as np

from app.core.messages import sentence
from app.imaging.field.tissue_field import TissueKind
from app.scoring.errors import MetricUnavailableError
from app.scoring.met import BY_TIP
from app.scoring.trajectory import Trajectory

DECLARATION: Final[dict[str, Any]] = {
    "title": "Pause before the membrane",
    "unit": "s",
    "higher_is_better": True,
    "reads": ("tip_offset",),
}

WITHIN: Final = 0.015
"""The pause is looked for so near before the membrane [m]."""

STILL: Final = 0.001
"""A tip rests while its depth stays within this [m]."""


def compute(trajectory: Trajectory) -> float:
    """Return the time [s], 0 without a rest.

    Raises:
        MetricNotAskedError: if the exercise has no steps of a procedure.
        MetricUnavailableError: if no pleura or capsule was crossed.
    """
    trajectory.steps()
    crossed = [
        one
        for one in trajectory.tissues_met()
        if one.by == BY_TIP and (one.kind == TissueKind.LUNG or one.holds_target)
    ]
    if not crossed:
        raise MetricUnavailableError(sentence("neither pleura nor capsule was crossed"))
    first = min(crossed, key=lambda one: one.time)
    depth, time = trajectory.depth, trajectory.time
    at = first.entered_mm * 1e-3
    before = trajectory.inserted & trajectory.depth_valid & (time < first.time)
    before &= (depth <= at + STILL) & (depth >= at - WITHIN)
    rows = np.flatnonzero(before)
    longest, begin = 0.0, 0
    for end in range(len(rows)):
        while np.ptp(depth[rows[begin : end + 1]]) > STILL:
            begin += 1
        if rows[end] - rows[begin] == end - begin:  # one stretch
            longest = max(longest, float(time[rows[end]] - time[rows[begin]]))
    return longest
