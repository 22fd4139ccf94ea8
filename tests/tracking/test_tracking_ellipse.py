"""The ellipse through the band's edge: right for ellipses, honest about noise, biased for bands."""

import numpy as np
import pytest

from app.tracking.markers.choice import ExtractorName, extractors
from app.tracking.markers.ellipse import fit_conic
from app.tracking.markers.extractor import Centre, Hint, MarkerFix, Miss
from app.tracking.markers.silhouette import centroid_shift

ANGLES = np.linspace(0.0, 2.0 * np.pi, 30, endpoint=False)
CIRCLE = np.column_stack([np.cos(ANGLES), np.sin(ANGLES)])


@pytest.fixture(scope="module")
def ellipses(wide):
    return extractors(wide, ExtractorName.ELLIPSE)


def test_points_on_an_ellipse_give_its_centre_area_and_ratio():
    shape = np.array([[1.2, 0.3], [-0.1, 0.6]])
    points = CIRCLE @ shape.T + [0.11, -0.07]
    found = fit_conic(points, CIRCLE)
    sizes = np.linalg.svd(shape, compute_uv=False)
    assert found.centre == pytest.approx([0.11, -0.07], abs=1e-12)
    assert found.area == pytest.approx(np.pi * np.linalg.det(shape))
    assert found.ratio == pytest.approx(sizes[1] / sizes[0])
    assert found.roughness < 1e-12


def test_the_gain_of_the_centre_is_the_derivative_by_finite_differences():
    rng = np.random.default_rng(1)
    points = CIRCLE * [1.1, 0.7] * (1.0 + 0.1 * rng.standard_normal((30, 1)))
    gain, step = fit_conic(points, CIRCLE).gain, 1e-6
    for k in range(30):
        ends = []
        for sign in (1.0, -1.0):
            moved = points.copy()
            moved[k] += sign * step * CIRCLE[k]
            ends.append(fit_conic(moved, CIRCLE).centre)
        assert gain[:, k] == pytest.approx((ends[0] - ends[1]) / (2.0 * step), abs=1e-7)


def test_points_on_a_line_or_a_hyperbola_or_too_few_are_no_ellipse():
    t = np.linspace(0.5, 2.0, 12)
    assert fit_conic(np.column_stack([t, 0.5 * t]), CIRCLE[:12]) is None
    branch = np.concatenate([np.column_stack([np.cosh(t), np.sinh(t)]), -CIRCLE[:0]])
    both = np.concatenate([branch, -branch])
    assert fit_conic(both, CIRCLE[:24]) is None
    assert fit_conic(CIRCLE[:5], CIRCLE[:5]) is None


@pytest.mark.long("statistics")
def test_the_covariance_of_the_ellipse_is_that_of_repeated_noise(
    wide, wide_renderers, ellipses, scene_at
):
    scene = scene_at(0.05, 15.0, 40.0)
    clean, rng = wide_renderers[0].even(115).render(scene), np.random.default_rng(8)
    hint = Hint(wide.models[0].pixel(scene.p_world))
    found = []
    for _ in range(150):
        noisy = clean + 4.0 * rng.standard_normal(clean.shape, dtype=np.float32)
        one = ellipses[0].find(np.clip(np.rint(noisy), 0, 255).astype(np.uint8), hint)
        assert isinstance(one, MarkerFix)
        assert one.centre is Centre.OUTLINE
        found.append(one)
    sample = np.cov(np.array([fix.uv for fix in found]).T)
    predicted = np.mean([fix.covariance for fix in found], axis=0)
    assert 0.7 < np.sqrt(np.trace(sample) / np.trace(predicted)) < 1.4


def test_the_centre_of_the_ellipse_is_near_the_outlines_centroid_not_the_bands(
    wide, wide_renderers, ellipses, scene_at
):
    leaning, errors, raw = scene_at(0.06, 39.0, 90.0), [], []
    for renderer, ellipse in zip(wide_renderers, ellipses, strict=True):
        model = renderer.model
        true = model.pixel(leaning.p_world)
        found = ellipse.find(renderer.even(115).render(leaning), Hint(true))
        shift = centroid_shift(model, wide.needle.shape, leaning.p_world, leaning.axis_world)
        raw.append(np.linalg.norm(found.uv - true))
        errors.append(np.linalg.norm(found.uv - shift - true))
    assert min(raw) > 0.4
    assert max(errors) < 0.4


def test_what_is_not_round_enough_or_of_another_size_is_refused(wide, wide_renderers, ellipses):
    from dataclasses import replace

    scene_image = np.full((480, 640, 3), 115, dtype=np.uint8)
    scene_image[200:230, 300:303] = (40, 24, 190)  # a stripe
    assert isinstance(ellipses[0].find(scene_image, Hint(np.array([301.0, 215.0]))), Miss)
    scene_image[200:216, 300:314] = (40, 24, 190)
    hint = Hint(np.array([307.0, 208.0]))
    strict = replace(ellipses[0], rough=0.01)
    assert isinstance(strict.find(scene_image, hint), Miss)
    assert isinstance(ellipses[0].find(np.full_like(scene_image, 115), hint), Miss)
