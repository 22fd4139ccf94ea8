"""Factors from the units of files, wires and screens to SI, which is used everywhere inside."""

from math import pi
from typing import Final

MILLIMETRE: Final = 1e-3
"""Metres in a millimetre."""

MILLISECOND: Final = 1e-3
"""Seconds in a millisecond."""

DEGREE: Final = pi / 180.0
"""Radians in a degree."""
