"""Needles by gauge: standard diameters and bending stiffness."""

from math import pi
from types import MappingProxyType
from typing import Final

YOUNGS_MODULUS: Final = 200e9  # [Pa] stainless steel

OUTER_DIAMETER: Final = MappingProxyType(
    {17: 1.473e-3, 18: 1.270e-3, 20: 0.908e-3, 21: 0.819e-3, 22: 0.718e-3, 25: 0.515e-3}
)
"""Gauge -> outer diameter [m]."""

GAUGE_18: Final = OUTER_DIAMETER[18]
"""Outer diameter that the puncture forces of layers belong to [m]."""


def bending_stiffness(outer: float, inner: float = 0.0) -> float:
    """EI of a round tube [N·m²]; with its stylet in place a needle bends like a solid rod."""
    return YOUNGS_MODULUS * pi / 64.0 * (outer**4 - inner**4)
