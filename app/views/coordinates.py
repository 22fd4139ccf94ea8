"""Patient coordinates in words."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from app.views.text import tr

SIDES = (("R", "L"), ("A", "P"), ("I", "S"))
"""Letters of the negative and the positive side of each LPS axis."""


def lps_words(lps_mm: ArrayLike) -> str:
    """Say where an LPS point [mm] lies, each letter naming the side: no signs to think about."""
    x, y, z = (
        f"{SIDES[axis][value >= 0]} {abs(value):.1f}"
        for axis, value in enumerate(np.asarray(lps_mm, dtype=np.float64).round(1).tolist())
    )
    return tr("{x}   {y}   {z} mm", x=x, y=y, z=z)
