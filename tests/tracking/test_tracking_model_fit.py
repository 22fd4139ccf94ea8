"""The fit of the band's picture: as good as the noise lets it be, and honest about it."""

import numpy as np
import pytest

from app.studies.marker import position_bound
from app.tracking.markers.choice import ExtractorName, extractors
from app.tracking.markers.extractor import Centre, Hint, MarkerFix, Miss
from app.tracking.simulated.picture_effects import NoiseTile, noise
from app.tracking.simulated.scene import MarkerScene


@pytest.fixture(scope="module")
def fits(wide):
    return extractors(wide, ExtractorName.MODEL_FIT)


def _noisy(image, rng, sd=4.0):
    return np.clip(np.rint(image + rng.normal(0.0, sd, image.shape)), 0, 255).astype(np.uint8)


def _poses(wide, rng, count):
    for _ in range(count):
        depth = rng.uniform(wide.range.depth_min_mm, wide.range.depth_max_mm) * 1e-3
        tilt = np.deg2rad(rng.uniform(0.0, wide.range.tilt_max_deg))
        azimuth = rng.uniform(0.0, 2.0 * np.pi)
        axis = np.array(
            [np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth), -np.cos(tilt)]
        )
        tip = np.array([0.0, 0.16056, 0.090]) + depth * axis
        yield MarkerScene.from_tip(tip, axis, wide.needle.marker_offset)


@pytest.mark.long("statistics")
def test_the_error_stays_near_the_cramer_rao_bound(wide, wide_renderers, fits):
    rng = np.random.default_rng(3)
    errors, bounds = [], []
    for scene in _poses(wide, rng, 8):
        for renderer, fit in zip(wide_renderers, fits, strict=True):
            even = renderer.even(115)
            image, model = even.render(scene), renderer.model

            def at(p_world, even=even, scene=scene):
                return even.render(MarkerScene(p_world, scene.axis_world))

            bound = position_bound(at, even.band(scene), model, scene.p_world, 4.0)
            true = model.pixel(scene.p_world)
            for _ in range(4):
                hint = Hint(true + rng.normal(0, 3, 2), scene.p_world, scene.axis_world)
                found = fit.find(_noisy(image, rng), hint)
                assert isinstance(found, MarkerFix)
                assert found.centre is Centre.BAND
                errors.append(found.uv - true)
                bounds.append(np.trace(bound))
    ratio = np.sqrt((np.array(errors) ** 2).sum(axis=1).mean() / np.mean(bounds))
    assert 0.8 < ratio < 1.5


def test_a_needle_that_leans_to_a_camera_or_away_is_found_without_bias(
    wide, wide_renderers, fits, scene_at
):
    # the point begins at the band's end: its strips are not the band's (0.034 px if taken for them)
    errors = []
    for azimuth in range(0, 360, 30):
        scene = scene_at(0.03, 44.0, float(azimuth))
        for renderer, fit in zip(wide_renderers, fits, strict=True):
            true = renderer.model.pixel(scene.p_world)
            clean = renderer.even(115).render(scene)
            found = fit.find(clean, Hint(true, scene.p_world, scene.axis_world))
            assert isinstance(found, MarkerFix)
            errors.append(np.linalg.norm(found.uv - true))
    assert max(errors) < 0.025
    assert np.sqrt(np.mean(np.square(errors))) < 0.012


def test_before_the_housing_the_error_is_a_fraction_of_a_tenth_of_a_pixel(
    wide, wide_renderers, fits
):
    rng = np.random.default_rng(4)
    tile = NoiseTile.make((640, 480), 4.0, 2)
    errors = []
    for scene in _poses(wide, rng, 16):
        for renderer, fit in zip(wide_renderers, fits, strict=True):
            true = renderer.model.pixel(scene.p_world)
            hint = Hint(true, scene.p_world, scene.axis_world)
            found = fit.find(noise(renderer.render(scene), tile, rng), hint)
            assert isinstance(found, MarkerFix)
            errors.append(np.linalg.norm(found.uv - true))
    assert np.median(errors) < 0.025
    assert np.sqrt(np.mean(np.square(errors))) < 0.06


@pytest.mark.long("statistics")
def test_the_covariance_of_the_fit_is_that_of_its_errors(wide, wide_renderers, fits, scene_at):
    scene, rng = scene_at(0.05, 15.0, 40.0), np.random.default_rng(8)
    # edges of the housing behind the band are misfit, for which the covariance grows: left out
    even = wide_renderers[0].even(115)
    clean, true = even.render(scene), wide.models[0].pixel(scene.p_world)
    hint = Hint(true, scene.p_world, scene.axis_world)
    found = [fits[0].find(_noisy(clean, rng), hint) for _ in range(40)]
    sample = np.cov(np.array([fix.uv for fix in found]).T)
    predicted = np.median([fix.covariance for fix in found], axis=0)
    predicted -= fits[0].floor_px ** 2 * np.eye(2)  # for what no noise shows
    assert 0.6 < np.sqrt(np.trace(sample) / np.trace(predicted)) < 1.5


def test_without_an_axis_the_centroid_is_handed_out(wide_renderers, fits, scene_at):
    image = wide_renderers[0].render(scene_at(0.05, 15.0, 40.0))
    found = fits[0].search(image)[0]
    again = fits[0].find(image, Hint(found.uv))
    assert again.centre is Centre.OUTLINE
    assert again.uv == pytest.approx(found.uv)


@pytest.mark.parametrize("axis", [np.zeros(3), np.full(3, np.nan)])
def test_a_senseless_axis_gives_the_centroid(wide_renderers, fits, scene_at, axis):
    scene = scene_at(0.05, 15.0, 40.0)
    image = wide_renderers[0].render(scene)
    found = fits[0].find(image, Hint(wide_renderers[0].model.pixel(scene.p_world), None, axis))
    assert found.centre is Centre.OUTLINE


def test_a_wrong_axis_is_a_wrong_shape_or_costs_covariance(wide_renderers, fits, scene_at):
    scene = scene_at(0.05, 10.0, 40.0)
    image, model = wide_renderers[0].render(scene), wide_renderers[0].model
    wrong = scene_at(0.05, 39.0, 220.0).axis_world
    found = fits[0].find(image, Hint(model.pixel(scene.p_world), scene.p_world, wrong))
    assert isinstance(found, Miss)
