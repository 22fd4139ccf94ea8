"""Markers in trouble: covered, lit up, beside other red things, at the border, overexposed."""

import numpy as np
import pytest

from app.tracking.errors import TrackingError
from app.tracking.markers.choice import ExtractorName, extractors
from app.tracking.markers.colour import RED, learn
from app.tracking.markers.extractor import Hint, MarkerFix, Miss, MissReason
from app.tracking.optics.rig import load_rig
from app.tracking.simulated.cameras import NeedleRenderer
from app.tracking.simulated.obstacles import (
    ORANGE,
    RED_CLOTH,
    Finger,
    Highlight,
    Patch,
    finger,
    highlight,
    patch,
)
from app.tracking.simulated.picture_effects import lighting
from app.tracking.simulated.scene import MarkerScene

FULCRUM = np.array([0.0, 0.16056, 0.090])
AXIS = np.array([0.2, 0.1, -0.97])


@pytest.fixture(scope="module")
def rig():
    return load_rig("wide")


@pytest.fixture(scope="module")
def renderer(rig):
    return NeedleRenderer(rig.models[0], rig.needle, rig.blur_px, 0)


@pytest.fixture(scope="module")
def fit(rig):
    return extractors(rig, ExtractorName.MODEL_FIT)[0]


@pytest.fixture
def scene(rig):
    return MarkerScene.from_tip(FULCRUM + 0.05 * AXIS, AXIS, rig.needle.marker_offset)


def _hint(renderer, scene):
    return Hint(renderer.model.pixel(scene.p_world), scene.p_world, scene.axis_world)


def _noisy(image, rng):
    return np.clip(np.rint(image + rng.normal(0.0, 4.0, image.shape)), 0, 255).astype(np.uint8)


@pytest.mark.long("statistics")
@pytest.mark.parametrize("angle", [0.0, 1.1, 2.4, 4.0, 5.2])
@pytest.mark.parametrize("share", [-3.0, 0.0, 3.0])
def test_a_finger_over_the_band_is_refused_or_within_four_standard_deviations(
    renderer, fit, scene, angle, share
):
    rng, true = np.random.default_rng(2), renderer.model.pixel(scene.p_world)
    direction = np.array([np.cos(angle), np.sin(angle)])
    cover = Finger(true + share * direction, direction, 14.0)
    image = _noisy(finger(renderer.render(scene), cover, rng), rng)
    found = fit.find(image, _hint(renderer, scene))
    if isinstance(found, MarkerFix):
        error = found.uv - true
        assert error @ np.linalg.solve(found.covariance, error) < 16.0


def test_a_highlight_on_the_band_is_refused_or_costs_little(renderer, fit, scene):
    rng, true = np.random.default_rng(3), renderer.model.pixel(scene.p_world)
    for strength in (60.0, 150.0, 250.0):
        spot = Highlight(true + [2.0, -3.0], 1.5, strength)
        image = _noisy(highlight(renderer.render(scene), spot, rng), rng)
        found = fit.find(image, _hint(renderer, scene))
        if isinstance(found, MarkerFix):
            assert np.linalg.norm(found.uv - true) < 0.25


@pytest.mark.parametrize("colour", [RED_CLOTH, ORANGE])
def test_another_coloured_thing_beside_the_marker_does_not_move_it(renderer, fit, scene, colour):
    rng, true = np.random.default_rng(4), renderer.model.pixel(scene.p_world)
    thing = Patch(true + [60.0, 10.0], np.array([30.0, 22.0]), 20.0, colour)
    image = _noisy(patch(renderer.render(scene), thing, rng), rng)
    found = fit.find(image, _hint(renderer, scene))
    assert isinstance(found, MarkerFix)
    assert np.linalg.norm(found.uv - true) < 0.15
    finds = [one for one in fit.search(image) if isinstance(one, MarkerFix)]
    assert min(np.linalg.norm(one.uv - true) for one in finds) < 1.0


@pytest.mark.long("statistics")
def test_with_the_marker_hidden_red_cloth_and_orange_are_not_taken_for_it(renderer, fit, scene):
    rng = np.random.default_rng(5)
    empty = renderer.render(MarkerScene(scene.p_world, scene.axis_world, visible=False))
    taken = 0
    for _ in range(60):
        image = empty
        for colour in (RED_CLOTH, ORANGE):
            half = np.exp(rng.uniform(np.log(4.0), np.log(80.0), 2))
            place = rng.uniform([60, 60], [580, 420])
            image = patch(image, Patch(place, half, rng.uniform(0, 180), colour), rng)
        image = _noisy(image, rng)
        finds = [one for one in fit.search(image) if isinstance(one, MarkerFix)]
        closer = [fit.find(image, Hint(one.uv, None, scene.axis_world)) for one in finds]
        taken += sum(isinstance(one, MarkerFix) for one in closer)
    assert taken == 0


def test_an_overexposed_marker_is_refused_by_name(renderer, fit, scene):
    image = lighting(renderer.render(scene), 3.0, np.random.default_rng(0))
    found = fit.find(image, _hint(renderer, scene))
    assert isinstance(found, Miss)
    assert found.reason in (MissReason.SATURATED, MissReason.NOTHING_RED)


@pytest.mark.parametrize("light", [0.25, 0.5, 1.2])
def test_another_exposure_needs_no_other_setting(renderer, fit, scene, light):
    rng, true = np.random.default_rng(6), renderer.model.pixel(scene.p_world)
    image = _noisy(lighting(renderer.render(scene), light, rng), rng)
    found = fit.find(image, _hint(renderer, scene))
    assert isinstance(found, MarkerFix)
    assert np.linalg.norm(found.uv - true) < 0.3


@pytest.mark.parametrize("uv", [[np.nan, 3.0], [1e9, -1e9], [-500.0, 200.0], [np.inf, 0.0]])
def test_a_senseless_hint_is_a_miss(renderer, fit, scene, uv):
    assert isinstance(fit.find(renderer.render(scene), Hint(np.array(uv))), Miss)


def test_a_click_teaches_the_colour_and_a_click_on_grey_is_an_error(renderer, rig, scene):
    image, true = renderer.render(scene), renderer.model.pixel(scene.p_world)
    learned = learn(image, true)
    assert learned.angle(np.array(RED.bgr)) < 8.0
    assert learned.model_validate(learned.model_dump()) == learned
    found = extractors(rig, colour=learned)[0].find(image, _hint(renderer, scene))
    assert isinstance(found, MarkerFix)
    with pytest.raises(TrackingError, match="grey"):
        learn(image, true + [60.0, 0.0])
    with pytest.raises(TrackingError, match="outside"):
        learn(image, np.array([-4.0, 9.0]))
