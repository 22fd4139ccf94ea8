"""What gives way while the needle stands: stresses that relax with several time constants.

Three Maxwell branches of equal weight, with time constants of 1, 10 and 100 times a tissue's own:
soft tissue has no single one (a box-shaped spectrum over decades, Fung 1981). A branch is a spring
in series with a damper and, where tissue slips, with a slider: each stores what its spring holds
and otherwise only takes, so whatever is made of them is passive.

    stretch:  e <- e E + Δx τ/h (1 - E),            E = exp(-h / τ)          (a spring and a damper)
    slipping: f <- clip(f E + σ Δx τ/h (1 - E), ±g)                          (and a slider at g)
    pressed:  f <- what `approach` gives over a way λ, towards its level, and f E as time goes by

All are exact for a motion that is straight within a tick of h, at any h.
"""

from typing import Final

import numpy as np

from app.core.compiled import njit
from app.simulation.along_needle import SNAP

BRANCHES: Final = 3
DECADE: Final = 10.0
"""From the time constant of one branch to the next."""


@njit
def branch_time(first: float, branch: int) -> float:
    """Time constant of a branch, 0 to 2 [s]."""
    time = first
    for _ in range(branch):
        time *= DECADE
    return time


@njit
def stretched(stretch: float, change: float, h: float, tau: float) -> float:
    """Stretch of a branch's spring after its ends moved by `change` within h; 0 near 0."""
    if h > 0.0:
        stretch = stretch * np.exp(-h / tau) - change * tau / h * np.expm1(-h / tau)
    else:
        stretch += change
    return stretch if abs(stretch) > SNAP else 0.0


@njit
def slipping(
    force: float, travel: float, h: float, tau: float, level: float, stiffness: float
) -> float:
    """Force of a branch behind a slider after `travel` within h; |result| <= level."""
    if h > 0.0:
        force = force * np.exp(-h / tau) - stiffness * travel * tau / h * np.expm1(-h / tau)
    else:
        force += stiffness * travel
    force = min(max(force, -level), level)
    return force if abs(force) > SNAP else 0.0


@njit
def pressed(force: float, level: float, travel: float, way: float, h: float, tau: float) -> float:
    """Force of a branch that reaches `level` over a way and is forgotten in its time; 0 near 0.

    At a steady speed v it is level / (1 + way / (v tau)), whatever the tick.
    """
    ahead, back = travel / way, (h / tau if h > 0.0 else 0.0)
    total = ahead + back
    if not total > 0.0:
        return force
    end = level * ahead / total
    force = end + (force - end) * np.exp(-total)
    return force if abs(force) > SNAP else 0.0
