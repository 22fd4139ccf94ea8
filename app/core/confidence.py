"""How far a true value may be from a measured one: quantiles, and radii and axes of covariances."""

from functools import lru_cache

import numpy as np

from app.core.arrays import FloatArray


@lru_cache(64)
def chi_square_quantile(probability: float, freedom: int) -> float:
    """Value that a chi-square variable stays below with a probability.

    As 2 P⁻¹(freedom / 2, probability); `scipy.stats` has it too, but takes a second to load.
    """
    from scipy.special import gammaincinv  # slow to load, and the window needs the module alone

    return 2.0 * float(gammaincinv(0.5 * freedom, probability))


def f_quantile(probability: float, first: int, second: int) -> float:
    """Value that an F variable with `first` and `second` degrees of freedom stays below."""
    from scipy.special import fdtri

    return float(fdtri(first, second, probability))


def covariance_radius(covariance: FloatArray, probability: float = 0.95) -> float:
    """Radius [m] of a sphere that holds the true point with at least `probability`.

    The quantile of chi-square with three degrees of freedom on the largest principal axis: exact
    where the covariance is isotropic, larger than needed where it is not, never too small.
    """
    largest = float(np.linalg.eigvalsh(covariance)[-1])
    return float(np.sqrt(chi_square_quantile(probability, 3) * max(0.0, largest)))


def principal_axes(covariance: FloatArray, probability: float = 0.95) -> FloatArray:
    """Half axes of the ellipsoid (3D) or ellipse (2D) that holds the true point, as columns.

    Args:
        covariance: shape (n, n), n = 2 or 3.
        probability: that the true point lies inside, for a normal error.

    Returns:
        Half axes in the unit of the covariance's root, longest last, shape (n, n). They make a
        right-handed frame in 3D, so that they serve as a rotation once they are scaled to one.
    """
    values, vectors = np.linalg.eigh(covariance)
    if np.linalg.det(vectors) < 0.0:
        vectors = vectors * np.array([-1.0] + [1.0] * (len(values) - 1))
    scale = chi_square_quantile(probability, len(values))
    result: FloatArray = vectors * np.sqrt(scale * np.maximum(values, 0.0))
    return result
