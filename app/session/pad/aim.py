"""Where a needle will pass its target: the one quantity that the order and the dot share.

A needle turns about the skin. Before the skin its tip is on the other side of the path than its
line will be at the target, and a bent needle's tip is beside its own line: so neither the tip nor
the tilt alone says which way to turn. The pass does, at every depth, and what the student is asked
to do is always to bring it to nothing.
"""

from __future__ import annotations

from math import atan2, sqrt
from typing import Final

import numpy as np

from app.core.arrays import FloatArray

CERTAIN: Final = 3.0
"""An order is given for no less than so many standard deviations of what it is measured by."""


def passes(
    direction: FloatArray,
    path: FloatArray,
    across: FloatArray,
    depth: float,
    length: float,
    measured: bool = True,
) -> FloatArray:
    """Return where the needle's line passes the target, across the path [m], shape (3,).

    To first order in the angle: angle times length, so that it is regular on the path and goes on
    beyond a right angle. A bent needle's line is moved by what its tip is beside the straight one.

    Args:
        direction: of the needle, hub to tip, unit, shape (3,).
        path: from the entry to the target as it is now, unit, shape (3,).
        across: from the path to the tip, across the path [m], shape (3,).
        depth: of the tip beyond the entry, along the needle [m].
        length: of the path [m].
        measured: whether the depth is known, and with it the tip.
    """
    along = float(direction @ path)
    sideways = direction - along * path
    sine = float(np.linalg.norm(sideways))
    angle = atan2(sine, along)
    straight = sideways * (length * angle / sine) if sine > 1e-12 else np.zeros(3)
    bent = across - depth * sideways if measured and depth > 0.0 else np.zeros(3)
    result: FloatArray = straight + bent
    return result


def spread(covariance: FloatArray | None, path: FloatArray) -> tuple[float, float]:
    """Return the standard deviation of a tip across the path, in one direction, and along it [m].

    Args:
        covariance: of the tip [m²], shape (3, 3); None where nobody knows it: then nothing.
        path: unit, shape (3,).
    """
    if covariance is None or not np.isfinite(covariance).all():
        return 0.0, 0.0
    along = max(0.0, float(path @ covariance @ path))
    across = max(0.0, float(np.trace(covariance)) - along)
    return sqrt(0.5 * across), sqrt(along)
