"""How far the true value may be from a measured one."""

import numpy as np

from app.core.arrays import FloatArray


def chi_square_quantile(probability: float, freedom: int) -> float:
    """Value that a chi-square variable stays below with a probability.

    As 2 P⁻¹(freedom / 2, probability); `scipy.stats` has it too, but takes a second to load.
    """
    from scipy.special import gammaincinv  # slow to load, and the window needs the fix alone

    return 2.0 * float(gammaincinv(0.5 * freedom, probability))


def covariance_radius(covariance: FloatArray, probability: float = 0.95) -> float:
    """Radius [m] of a sphere that holds the true point with at least `probability`.

    The quantile of chi-square with three degrees of freedom on the largest principal axis: exact
    where the covariance is isotropic, larger than needed where it is not, never too small.
    """
    largest = float(np.linalg.eigvalsh(covariance)[-1])
    return float(np.sqrt(chi_square_quantile(probability, 3) * max(0.0, largest)))
