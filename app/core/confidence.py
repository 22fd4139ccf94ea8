"""How far a true value may be from a measured one: quantiles, and radii and axes of covariances."""

from collections.abc import Callable
from functools import lru_cache
from typing import Final

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
    """Radius [m] of the sphere that holds the true point with a probability, no more and no less.

    A normal error of covariance V is s·√(wᵀ V w) long, w a direction of which all are as likely and
    s² chi-square with three degrees of freedom, so that P(r) is the mean over all directions of
    P(s² < r² / wᵀ V w). The mean is taken by Gauss and Legendre over an eighth of the sphere, in
    V's own axes; the radius is found by regula falsi (the Illinois way).

    Args:
        covariance: of the point [m²], shape (3, 3).
        probability: between 0 and 1.
    """
    values = np.linalg.eigvalsh(covariance)
    largest = float(values[-1])
    if not largest > 0.0:
        return 0.0
    shares = np.maximum(values[:2], 0.0) / largest
    return float(np.sqrt(_sphere(float(shares[0]), float(shares[1]), probability) * largest))


_NODES: Final = 16


@lru_cache(1)
def _directions() -> tuple[FloatArray, FloatArray]:
    """Squares of unit vectors over an eighth of the sphere, (n, 3), and their weights, (n,)."""
    nodes, weights = np.polynomial.legendre.leggauss(_NODES)
    nodes, weights = 0.5 * (nodes + 1.0), 0.5 * weights
    along, turn = (grid.ravel() for grid in np.meshgrid(nodes, 0.5 * np.pi * nodes))
    across = 1.0 - along**2
    squares = np.column_stack([across * np.sin(turn) ** 2, across * np.cos(turn) ** 2, along**2])
    return squares, np.outer(weights, weights).ravel()


@lru_cache(4096)
def _sphere(least: float, middle: float, probability: float) -> float:
    """Squared radius over the largest variance; the others are `least` and `middle` of it."""
    from scipy.special import erf

    squares, weights = _directions()
    spread = squares @ np.array([least, middle, 1.0])

    def beyond(square: float) -> float:
        reach = square / spread
        held = erf(np.sqrt(0.5 * reach)) - np.sqrt(2.0 / np.pi * reach) * np.exp(-0.5 * reach)
        return float(weights @ held) - probability

    # One axis alone holds the point in less, three as large as the largest need more.
    low, high = chi_square_quantile(probability, 1), chi_square_quantile(probability, 3)
    return _root(beyond, 0.999 * low, 1.001 * high)


def _root(function: Callable[[float], float], low: float, high: float) -> float:
    """Return where a rising function that changes its sign between two places is 0, to 1e-9 of
    it.
    """
    at_low, at_high, last = function(low), function(high), 0
    while high - low > 1e-9 * high:
        x = (low * at_high - high * at_low) / (at_high - at_low)
        value = function(x)
        if abs(value) < 1e-12:
            return x
        if value < 0.0:
            low, at_low = x, value
            at_high *= 0.5 if last < 0 else 1.0
        else:
            high, at_high = x, value
            at_low *= 0.5 if last > 0 else 1.0
        last = -1 if value < 0.0 else 1
    return 0.5 * (low + high)


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
