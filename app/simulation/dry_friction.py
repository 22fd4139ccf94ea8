"""Laws of dry friction, for whatever rubs: a force (or moment) after a displacement, at a level.

All integrate over space, so what rests holds its force and does not creep, and none has a step
size: |result| <= level for any stiffness, speed and displacement.
"""

from typing import Final

import numpy as np

from app.core.compiled import njit

KIKUUWE: Final = 0.0
DAHL: Final = 1.0
LUGRE: Final = 2.0
"""What stands for a law in an array of parameters."""


@njit
def dahl(force: float, travel: float, level: float, stiffness: float) -> float:
    """Friction force after `travel` [m] at constant level: exact, |result| <= level."""
    if level <= 0.0:
        return 0.0
    force = min(max(force, -level), level)  # the level may have fallen since the last step
    if travel == 0.0:
        return force
    end = level if travel > 0.0 else -level
    return end + (force - end) * np.exp(-stiffness * abs(travel) / level)


@njit
def kikuuwe(force: float, travel: float, level: float, stiffness: float) -> float:
    """Friction force after `travel` [m]: a spring that slides at the level; |result| <= level."""
    return min(max(force + stiffness * travel, -level), level)


@njit
def stribeck(speed: float, width: float) -> float:
    """Share of the break-away level that is left at a speed, falling to 0 over `width`."""
    ratio = speed / width
    return np.exp(-ratio * ratio)
