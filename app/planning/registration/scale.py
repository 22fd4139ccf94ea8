"""Whether lengths between touched fiducials are right, which residuals of a rigid fit hide.

A calibration board whose squares were entered wrongly leaves every residual of the calibration, and
every pair held back, as good as they were: the same wrong ruler measured both. Everything that the
cameras measure later is too long or too short by one factor. Fiducials at known distances tell:

    s = Σ wᵢ·(R·xᵢ)·yᵢ / Σ wᵢ·|xᵢ|²,   sd(s) = σ / √(Σ wᵢ·|xᵢ|²)

with x, y the reference and measured points about their centroids, R of the rigid fit (the best one
does not depend on s) and σ a careful touch's standard deviation per axis.
"""

from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core.confidence import chi_square_quantile
from app.planning.registration.rigid import RigidFit

LARGEST: Final = 0.01
"""A relative error of lengths up to this is no mistake: a plate is not better known."""

_SURE: Final = 3.0
_RARE: Final = 0.999


@dataclass(frozen=True, slots=True)
class Scale:
    """Lengths between measured points over those between reference points.

    Attributes:
        value: 1 is right.
        sd: standard deviation of it by careful touches.
        explains: whether the points fit as careful touches do once lengths are divided by it: one
            misplaced point is no scale.
    """

    value: float
    sd: float
    explains: bool

    @property
    def wrong(self) -> bool:
        """Whether lengths are wrong by more than `LARGEST`, beyond doubt."""
        return self.explains and abs(self.value - 1.0) > LARGEST + _SURE * self.sd


def scale_of(fit: RigidFit, variance: float) -> Scale:
    """Return the scale of a fit.

    Args:
        fit: of reference to measured points.
        variance: of a careful touch per axis [m²].
    """
    w = fit.weights
    x = (fit.reference - w @ fit.reference / len(w)) @ fit.T_measured_reference.rotation.T
    y = fit.measured - w @ fit.measured / len(w)
    extent = float(w @ np.sum(x * x, axis=1))
    value = float(w @ np.sum(x * y, axis=1)) / extent
    remaining = float(w @ np.sum((y - value * x) ** 2, axis=1))
    limit = chi_square_quantile(_RARE, 3 * len(w) - 7) * variance
    return Scale(value, float(np.sqrt(variance / extent)), remaining <= limit)
