"""Share of the time in the body, pauses included, during which the tip's depth was measured.

An insertion that nobody saw begin counts from where the needle was seen last: who covers the
cameras until the needle is in has not been seen inserting it. Nor has who covered them from the
first moment on, where the record says from which depth on the cameras see the marker.
"""

from typing import Any, Final

import numpy as np
from numpy.typing import NDArray

from app.scoring.trajectory import Phase, Trajectory, runs
from app.scoring.uncertainty import time_sd

DECLARATION: Final[dict[str, Any]] = {
    "title": "Tracking valid",
    "unit": "%",
    "higher_is_better": True,
    "reads": (),
}

SEEN_OUTSIDE: Final = 0.002
"""A needle seen no deeper than this was out of the body [m]: from here on it counts as inserted."""

APPEARS: Final = 0.010
"""A marker that was never seen may be so much deeper than where it comes into view [m]: a fast
hand's way from one picture to the next."""

COUNTED_SINCE: Final = 7
"""Scoring version from which an insertion that nobody saw begin counts."""


def compute(trajectory: Trajectory) -> float:
    """Return the share [%]; of a single sample, 0 or 100."""
    trajectory.insertions()
    inserted = _inserted(trajectory)
    whole = trajectory.duration(inserted)
    if whole > 0.0:
        return 100.0 * trajectory.duration(inserted & trajectory.depth_valid) / whole
    return 100.0 * float(trajectory.depth_valid[inserted].mean())


def deviation(trajectory: Trajectory) -> float:
    """Return the standard deviation [%] that the time between samples leaves."""
    inserted = _inserted(trajectory)
    whole = trajectory.duration(inserted)
    seen = time_sd(trajectory, inserted & trajectory.depth_valid)
    return 100.0 * seen / whole if whole > 0.0 else 0.0


def _inserted(trajectory: Trajectory) -> NDArray[np.bool_]:
    """Find the samples that count as in the body, shape (n,)."""
    inserted: NDArray[np.bool_] = trajectory.inserted | trajectory.paused
    if trajectory.scoring_version >= COUNTED_SINCE:
        inserted = inserted | entered_unseen(trajectory)
    return inserted


def entered_unseen(trajectory: Trajectory) -> NDArray[np.bool_]:
    """Find the samples before insertions that nobody saw begin, shape (n,).

    The needle was seen out of the body, then not at all, and when it was seen again it was in:
    while nobody knew where it was, the phase stayed what it had been. A needle that was never seen
    before counts too where it appears deeper than where the cameras begin to see it. A marker that
    came out of the tube as deep as it had gone in hides nothing.
    """
    appears = max(trajectory.seen_from, 0.0) + APPEARS
    seen, depth = trajectory.depth_valid, trajectory.depth
    hidden = np.zeros(len(trajectory), dtype=np.bool_)
    waits = (trajectory.phase == Phase.ALIGNING) | trajectory.paused
    for stay in runs(trajectory.inserted):
        first = stay.start
        while first > 0 and waits[first - 1] and not seen[first - 1]:
            first -= 1
        last = first  # a look before the attempt begins is one all the same
        while last > 0 and trajectory.phase[last - 1] == Phase.READY and not seen[last - 1]:
            last -= 1
        never = last == 0 and depth[stay.start] > appears
        if never or (last > 0 and seen[last - 1] and depth[last - 1] <= SEEN_OUTSIDE):
            hidden[first : stay.start] = True
    return hidden
