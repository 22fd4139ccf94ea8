"""Patient coordinates in words."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike

from app.views.kit.text import number, tr

SIDES = (("R", "L"), ("A", "P"), ("I", "S"))
"""Letters of the negative and the positive side of each LPS axis."""


def axis_words(axis: int, value_mm: float) -> str:
    """Say one LPS coordinate [mm] with the letter of its side: `S 310.2`."""
    value = round(value_mm, 1)
    return f"{SIDES[axis][value >= 0]} {number(abs(value), '.1f')}"


def lps_words(lps_mm: ArrayLike) -> str:
    """Say where an LPS point [mm] lies, each letter naming the side: no signs to think about."""
    values = np.asarray(lps_mm, dtype=np.float64).tolist()
    x, y, z = (axis_words(axis, value) for axis, value in enumerate(values))
    return tr("{x}   {y}   {z} mm", x=x, y=y, z=z)
