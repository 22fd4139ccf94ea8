"""The fit of the band's picture gives what it gave: figures of drawn pictures, kept."""

import numpy as np
import pytest

from app.tracking.band.fit import BandFitter

CENTRE = np.array([0.002, 0.165, 0.055])
"""Of the band [m]; the pictures are drawn here, so that no renderer's change moves the figures."""


def _soft(x):
    return 0.5 * (1.0 + np.tanh(1.2 * x))


def _drawn(model, shape, axis, seed, *, edge=False, finger=False, bright=False):
    """A shaded band on its shaft, with noise."""
    width, height = model.image_size
    ends = CENTRE + np.outer([-shape.half, shape.half], axis)
    (first, second), centre = model.project(ends)[0], model.pixel(CENTRE)
    along = (second - first) / np.linalg.norm(second - first)
    v, u = np.mgrid[0:height, 0:width] - centre[::-1, None, None]
    e, n = u * along[0] + v * along[1], v * along[0] - u * along[1]
    half = 0.5 * np.linalg.norm(second - first)
    radius = half * shape.radius / shape.half
    ground = 110.0 + 0.05 * u + (60.0 * _soft(0.8 * u + 0.6 * v - 9.0) if edge else 0.0)
    picture = np.repeat(ground[..., None], 3, axis=2)
    shaft = _soft(radius * shape.shaft / shape.radius - np.abs(n))[..., None]
    picture += shaft * (170.0 - picture)
    light = 0.75 + 0.25 * n / radius
    paint = light[..., None] * np.array([45.0, 30.0, 330.0 if bright else 200.0])
    picture += (_soft(radius - np.abs(n)) * _soft(half - np.abs(e)))[..., None] * (paint - picture)
    if finger:
        over = _soft(6.0 - np.hypot(e - 8.0, n - radius))[..., None]
        picture += over * (np.array([130.0, 160.0, 200.0]) - picture)
    noisy = picture + np.random.default_rng(seed).normal(0.0, 4.0, picture.shape)
    return np.clip(np.rint(noisy), 0, 255).astype(np.uint8)


def _axis(tilt_deg, azimuth_deg):
    tilt, azimuth = np.radians([tilt_deg, azimuth_deg])
    return np.array([np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), -np.cos(tilt)])


CASES = {
    "even": (0, (10.0, 40.0), {}, (0.0, 0.0, 0.0)),
    "begun_afar": (1, (25.0, 200.0), {}, (4e-4, -3e-4, 1e-3)),
    "before_an_edge": (0, (15.0, 300.0), {"edge": True}, (1e-4, 0.0, 0.0)),
    "under_a_finger": (1, (5.0, 120.0), {"finger": True}, (0.0, 1e-4, 0.0)),
    "overexposed": (0, (20.0, 80.0), {"bright": True}, (0.0, 0.0, 0.0)),
}

BEFORE = {
    "even": (
        -0.0481277371,
        0.7442707837,
        0.0080222018,
        0.0077317515,
        0.9597556412,
        0.9964195445,
        1.4470494299,
        0.0205834848,
        201.5835862531,
    ),
    "begun_afar": (
        0.2146810849,
        0.6009753137,
        0.0082967864,
        0.007800265,
        0.9638099691,
        0.9983995409,
        1.5523098232,
        0.0,
        199.8925753265,
    ),
    "before_an_edge": (
        0.012269902,
        -0.3134682403,
        0.0083001367,
        0.0077104842,
        0.9682834435,
        0.9975142896,
        1.4637321779,
        0.0,
        206.1876120064,
    ),
    "under_a_finger": (
        0.0018977114,
        0.312069854,
        0.0147672201,
        0.0104350827,
        0.9765409147,
        0.9942932973,
        2.1369302093,
        0.655516738,
        202.3136677467,
    ),
    "overexposed": (
        0.1865274295,
        1.2323708778,
        0.0080458558,
        0.0081020513,
        0.9324942823,
        0.9917736552,
        1.5698073943,
        0.4449024301,
        188.0784170291,
    ),
}
"""Shift from the centre's picture u and v, deviations of u and v, width, length, misfit, outliers
and area of each: an edit that moves them must be meant to."""


def figures(wide, name):
    """What the fit says of a case, shape (9,)."""
    camera, angles, options, off = CASES[name]
    model, shape, axis = wide.models[camera], wide.needle.shape, _axis(*angles)
    fitter = BandFitter(model, shape, wide.blur_px, 4.0)
    image = _drawn(model, shape, axis, sorted(CASES).index(name), **options)
    p_camera = model.T_camera_world @ CENTRE + np.array(off)
    fit = fitter.fit(image, p_camera, model.T_camera_world.rotate(axis))
    assert fit is not None
    shift, deviations = fit.uv - model.pixel(CENTRE), np.sqrt(np.diag(fit.covariance))
    return np.array([*shift, *deviations, *fit.stretch, fit.misfit, fit.outliers, fit.area])


@pytest.mark.parametrize("name", CASES)
def test_the_fit_finds_what_it_found_before(wide, name):
    assert figures(wide, name) == pytest.approx(BEFORE[name], rel=1e-7, abs=1e-8)


def test_a_band_beside_the_picture_or_behind_the_camera_is_no_fit(wide):
    model, shape = wide.models[0], wide.needle.shape
    fitter = BandFitter(model, shape, wide.blur_px, 4.0)
    image = np.full((480, 640, 3), 120, dtype=np.uint8)
    across = np.array([1.0, 0.0, 0.0])
    for p_camera in ([0.0, 0.0, -0.3], [0.4, 0.0, 0.3], [np.nan, 0.0, 0.3]):
        assert fitter.fit(image, np.array(p_camera), across) is None
