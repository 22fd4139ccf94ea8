"""The sphere that holds a point with a probability, against Imhof's integral and Monte Carlo."""

import numpy as np
import pytest
from scipy.integrate import quad

from app.core.confidence import chi_square_quantile, covariance_radius

SHAPES = [(1.0, 0.999, 0.99), (1.0, 0.3, 0.1), (1.0, 0.9, 0.01), (1.0, 0.5, 0.5)]


def imhof(variances, square):
    """P(Σ λ z² < square), Imhof, Biometrika 48, 419 (1961)."""
    lam = np.array(variances)

    def integrand(u):
        turn = 0.5 * np.arctan(lam * u).sum() - 0.5 * square * u
        return np.sin(turn) / (u * np.prod((1.0 + (lam * u) ** 2) ** 0.25))

    return 0.5 - quad(integrand, 0.0, 400.0, limit=4000, epsabs=1e-9)[0] / np.pi


@pytest.mark.parametrize("variances", SHAPES)
@pytest.mark.parametrize("probability", [0.5, 0.95, 0.999])
def test_the_radius_is_that_of_imhofs_integral(variances, probability):
    radius = covariance_radius(np.diag(variances), probability)
    assert imhof(variances, radius**2) == pytest.approx(probability, abs=1e-5)


@pytest.mark.parametrize("variances", [*SHAPES, (1.0, 1e-4, 0.0), (1.0, 0.0, 0.0)])
def test_the_sphere_holds_95_of_100_points_however_long_the_ellipsoid_is(variances):
    points = np.random.default_rng(3).normal(size=(200_000, 3)) * np.sqrt(variances)
    radius = covariance_radius(np.diag(variances))
    assert (np.linalg.norm(points, axis=1) < radius).mean() == pytest.approx(0.95, abs=0.002)


def test_a_turned_covariance_has_the_same_radius_and_a_larger_one_a_larger():
    turn = np.linalg.qr(np.random.default_rng(1).normal(size=(3, 3)))[0]
    spread = np.diag([4.0, 1.0, 0.2])
    assert covariance_radius(turn @ spread @ turn.T) == pytest.approx(covariance_radius(spread))
    assert covariance_radius(4.0 * spread) == pytest.approx(2.0 * covariance_radius(spread))
    assert covariance_radius(np.eye(3)) == pytest.approx(np.sqrt(chi_square_quantile(0.95, 3)))
    assert covariance_radius(np.zeros((3, 3))) == 0.0
