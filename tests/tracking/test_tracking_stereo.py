"""Triangulation, its covariance and the radius it gives."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.tracking.confidence import covariance_radius
from app.tracking.stereo.reprojection import reprojection
from app.tracking.stereo.triangulation import StereoStatus, Way, triangulate

FULCRUM = np.array([0.0, 0.16056, 0.090])


def _poses(rig):
    return tuple(model.T_camera_world for model in rig.models)


def _observe(poses, p_world):
    camera = [pose @ p_world for pose in poses]
    return np.array([p[:2] / p[2] for p in camera])


SIGMA = np.array([np.diag([4e-8, 9e-8]), np.diag([1e-8, 2e-8])])  # differ between the cameras


@settings(derandomize=True, deadline=None, max_examples=60)
@given(*[st.floats(-0.08, 0.08)] * 3, st.sampled_from(list(Way)))
def test_exact_observations_give_back_the_point(wide, dx, dy, dz, way):
    p = FULCRUM + np.array([dx, dy, dz - 0.04])
    found = triangulate(_poses(wide), _observe(_poses(wide), p), SIGMA, way)
    assert found.status is StereoStatus.FOUND
    assert np.abs(found.p_world - p).max() < 1e-12


def test_the_reprojection_jacobian_agrees_with_finite_differences(thesis):
    poses, p, h = _poses(thesis), FULCRUM - [0.01, 0.02, 0.07], 1e-7
    zero = np.zeros((2, 2))
    jacobian = reprojection(poses, zero, p)[1]
    numeric = np.column_stack(
        [
            -(reprojection(poses, zero, p + d)[0] - reprojection(poses, zero, p - d)[0]) / (2 * h)
            for d in h * np.eye(3)
        ]
    )
    assert np.allclose(jacobian, numeric, rtol=1e-6, atol=1e-6)


@pytest.mark.parametrize("name", ["wide", "thesis"])
def test_the_covariance_agrees_with_monte_carlo(name, request):
    poses = _poses(request.getfixturevalue(name))
    p = FULCRUM + np.array([0.01, -0.015, -0.07])
    exact = _observe(poses, p)
    rng = np.random.default_rng(11)
    roots = np.linalg.cholesky(SIGMA)
    points = []
    for _ in range(2500):
        noisy = exact + np.einsum("kij,kj->ki", roots, rng.standard_normal((2, 2)))
        points.append(triangulate(poses, noisy, SIGMA).p_world)
    sample = np.cov(np.array(points).T)
    predicted = triangulate(poses, exact, SIGMA).covariance
    assert np.linalg.norm(sample - predicted) < 0.05 * np.linalg.norm(predicted)
    assert np.sqrt(np.trace(sample)) == pytest.approx(np.sqrt(np.trace(predicted)), rel=0.02)


def test_the_reprojection_error_of_noise_follows_chi_square_with_one_degree_of_freedom(wide):
    poses = _poses(wide)
    exact = _observe(poses, FULCRUM - [0.0, 0.0, 0.06])
    rng = np.random.default_rng(5)
    roots = np.linalg.cholesky(SIGMA)
    values = [
        triangulate(
            poses, exact + np.einsum("kij,kj->ki", roots, rng.standard_normal((2, 2))), SIGMA
        ).chi_square
        for _ in range(1500)
    ]
    assert np.mean(values) == pytest.approx(1.0, abs=0.15)


def test_the_optimal_point_is_never_further_from_the_pictures_than_a_closed_form(thesis):
    poses = _poses(thesis)
    rng = np.random.default_rng(2)
    for _ in range(50):
        p = FULCRUM + rng.uniform(-0.03, 0.03, 3) - [0, 0, 0.06]
        noisy = _observe(poses, p) + rng.normal(0.0, 2e-3, (2, 2))
        costs = {way: triangulate(poses, noisy, SIGMA, way).chi_square for way in Way}
        assert all(costs[Way.REPROJECTION] <= cost * (1 + 1e-9) for cost in costs.values())


def test_the_radius_holds_its_share_and_is_exact_for_a_round_covariance():
    rng = np.random.default_rng(1)
    for variances, exact in (((1.0, 1.0, 1.0), True), ((1.0, 0.3, 0.1), False)):
        covariance = np.diag(variances) * 1e-8
        samples = rng.standard_normal((200_000, 3)) * np.sqrt(np.diag(covariance))
        inside = (np.linalg.norm(samples, axis=1) < covariance_radius(covariance)).mean()
        assert inside >= 0.948
        assert not exact or inside == pytest.approx(0.95, abs=0.003)
    assert covariance_radius(np.zeros((3, 3))) == 0.0
