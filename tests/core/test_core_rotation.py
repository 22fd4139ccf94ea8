"""The rotation closest to a set of moments."""

import numpy as np

from app.core.rotation import closest_rotation, rotation_exp


def test_the_closest_rotation_brings_points_back_and_never_mirrors_them() -> None:
    rng = np.random.default_rng(5)
    for _ in range(20):
        points = rng.normal(size=(6, 3))
        turn = rotation_exp(rng.normal(size=3))
        found, gap = closest_rotation(points.T @ (points @ turn.T))
        np.testing.assert_allclose(found, turn, atol=1e-12)
        assert gap > 1e-3
        mirrored, _ = closest_rotation(points.T @ (points * [1.0, 1.0, -1.0]))
        assert np.linalg.det(mirrored) > 0.0


def test_the_closest_rotation_says_when_another_is_as_good() -> None:
    line = np.outer(np.linspace(-1.0, 1.0, 5), [1.0, 0.0, 0.0])
    assert closest_rotation(line.T @ line)[1] < 1e-12
    assert closest_rotation(np.zeros((3, 3)))[1] == 0.0
