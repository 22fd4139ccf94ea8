"""Where a needle has cut before: the paths of its tip, bin by bin along the needle.

Memory of the model `track` of the effect `cutting`. Each bin of 1/1024 m of depth keeps the last
`PATHS` ways through it: the needle's direction then, and how deep the tip came within the bin. A
tip is in fresh tissue only where it is farther than a needle's diameter from all of these. Where
the scene has a field, CHANNEL says it instead: the field knows it in the tissue's own coordinates.
In layers the ways lie in the robot's frame, and neither breathing nor a bend moves them.
"""

from typing import Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.parameters import numbered

BIN: Final = 2.0**-10  # [m]; a power of two, so that edges are exact
PATHS: Final = 3
DEEPER: Final = 0.05  # [m] beyond the needle's length that a depth may be measured


class PathPlaces(NamedTuple):
    """A way through a bin: the direction of the needle, and how deep the tip came [m]; 0: none."""

    x: int
    y: int
    z: int
    reach: int


PATH: Final = numbered(PathPlaces)
WIDTH: Final = PATHS * len(PATH) + 1
"""Of a bin: its ways, and which of them is the oldest."""


def bins_of(length: float) -> int:
    """Return how many bins a needle of a length [m] needs."""
    return int(np.ceil((length + DEEPER) / BIN)) + 1


@njit
def _near(p: FloatArray, at: int, x: float, y: float, z: float, place: float, wide: float) -> bool:
    """Return whether the way at `at` is within `wide` [m] of the direction at a depth."""
    if p[at + PATH.reach] == 0.0:
        return False
    dx, dy, dz = x - p[at + PATH.x], y - p[at + PATH.y], z - p[at + PATH.z]
    return place * np.sqrt(dx * dx + dy * dy + dz * dz) <= wide


@njit
def cut_on(
    p: FloatArray, first: int, bins: int, state: FloatArray, old: float, new: float, wide: float
) -> bool:
    """Go on from the place `old` to `new` [m]: lay the way down, and say if its end is fresh.

    Args:
        p: array whose bins begin at `first`.
        first: see p.
        bins: how many there are.
        state: the needle's direction.
        old: place before, 0 or more.
        new: place now, at least `old`.
        wide: the needle's diameter [m].
    """
    x, y, z = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z]
    if not np.isfinite(x + y + z):
        x = y = z = 0.0
    fresh = False
    for j in range(min(int(old / BIN), bins - 1), min(int(new / BIN), bins - 1) + 1):
        end = min(new, (j + 1) * BIN)
        at = first + WIDTH * j
        way = -1
        for k in range(PATHS):
            one = at + len(PATH) * k
            deeper = way < 0 or p[one + PATH.reach] > p[way + PATH.reach]
            if deeper and _near(p, one, x, y, z, end, wide):
                way = one
        if way < 0:
            oldest = int(p[at + WIDTH - 1])
            p[at + WIDTH - 1] = (oldest + 1) % PATHS
            way = at + len(PATH) * oldest
            p[way + PATH.x], p[way + PATH.y], p[way + PATH.z] = x, y, z
            p[way + PATH.reach] = max(old, j * BIN)
        fresh = end > p[way + PATH.reach]
        p[way + PATH.reach] = max(p[way + PATH.reach], end)
    return fresh
