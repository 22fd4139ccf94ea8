"""Projection, distortion and its inverse."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.tracking.optics.distortion import (
    distort_point,
    distortion_jacobian,
    fold_radius,
    undistort_point,
)
from app.tracking.optics.rig import RigProfile

THESIS = np.array([-0.091006, 2.735876, -0.001135, -0.004749, -20.789586])
WIDE = np.array([-0.11, 0.14, 0.0004, -0.0003, 0.0])


@settings(derandomize=True, deadline=None, max_examples=200)
@given(st.floats(0.0, 0.45), st.floats(0.0, 6.3), st.sampled_from([0, 1]))
def test_undistorting_inverts_distorting_up_to_near_the_fold(radius, angle, which):
    c = (THESIS, WIDE)[which]
    x, y = radius * np.cos(angle), radius * np.sin(angle)
    x_d, y_d = distort_point(x, y, c)
    nx, ny, found = undistort_point(x_d, y_d, c, fold_radius(c))
    assert found
    assert np.hypot(nx - x, ny - y) < 1e-10


@settings(derandomize=True, deadline=None, max_examples=100)
@given(st.floats(-0.4, 0.4), st.floats(-0.4, 0.4))
def test_the_distortion_jacobian_agrees_with_finite_differences(x, y):
    h = 1e-6
    xx, xy, yx, yy = distortion_jacobian(x, y, THESIS)
    right, left = distort_point(x + h, y, THESIS), distort_point(x - h, y, THESIS)
    down, up = distort_point(x, y + h, THESIS), distort_point(x, y - h, THESIS)
    numeric = [(right[0] - left[0]), (right[1] - left[1]), (down[0] - up[0]), (down[1] - up[1])]
    assert np.allclose([xx, yx, xy, yy], np.array(numeric) / (2 * h), atol=1e-7)


def test_the_thesis_distortion_folds_where_the_errata_say():
    assert fold_radius(THESIS) == pytest.approx(0.4726, abs=1e-3)
    assert fold_radius(np.zeros(5)) == np.inf


def test_a_pixel_goes_out_along_a_ray_and_comes_back(wide: RigProfile, thesis: RigProfile):
    rng = np.random.default_rng(3)
    for model in (*wide.models, *thesis.models):
        pixels = rng.uniform([0, 0], [639, 479], (200, 2))
        rays, found = model.undistort(pixels)
        points = np.column_stack([rays, np.ones(200)]) * rng.uniform(0.1, 1.0, (200, 1))
        back, ok = model.project(model.T_world_camera @ points)
        assert found.all()
        assert ok.all()
        assert np.abs(back - pixels).max() < 1e-8


def test_the_ray_jacobian_agrees_with_finite_differences(thesis: RigProfile):
    model = thesis.models[0]
    for pixel in ([50.0, 60.0], [320.0, 240.0], [600.0, 430.0]):
        ray = model.undistort(pixel)[0][0]
        h = 1e-4
        numeric = np.column_stack(
            [
                (model.undistort(pixel + d)[0][0] - model.undistort(pixel - d)[0][0]) / (2 * h)
                for d in (np.array([h, 0.0]), np.array([0.0, h]))
            ]
        )
        assert np.allclose(model.ray_jacobian(ray), numeric, rtol=1e-6, atol=1e-11)


def test_a_point_behind_the_camera_or_beyond_the_fold_has_no_picture(thesis: RigProfile):
    model = thesis.models[0]
    points = np.array([[0.0, 0.0, -0.1], [0.0, 0.0, 0.0], [0.06, 0.0, 0.1], [np.nan, 0.0, 1.0]])
    uv, ok = model.project(model.T_world_camera @ points)
    assert not ok.any()
    assert np.isfinite(uv).all()
    assert model.pixel(model.T_world_camera @ points[0]) is None
