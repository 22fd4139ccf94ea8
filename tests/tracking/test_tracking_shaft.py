"""A marker is a red band on a shaft: what has the band's size and colour alone is refused."""

from copy import copy

import numpy as np
import pytest

from app.tracking.agreement import Continuity
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.markers.choice import ExtractorName, extractors
from app.tracking.markers.extractor import Centre, Hint, MarkerFix, Miss, MissReason
from app.tracking.simulated.obstacles import Patch, patch
from app.tracking.simulated.picture_effects import NoiseTile, noise


@pytest.fixture(scope="module")
def fits(wide):
    return extractors(wide, ExtractorName.MODEL_FIT)


def _without_shaft(renderer):
    other = copy(renderer)
    end = 1.0001 * renderer._shape.half
    other._shape = renderer._shape._replace(tip=end, hub=-end, point=1e-6)
    return other


def _places(scene_at):
    for depth in (0.0, 0.04, 0.08, 0.11):
        for tilt, azimuth in ((2.0, 0.0), (20.0, 70.0), (40.0, 200.0), (44.0, 300.0)):
            yield scene_at(depth, tilt, azimuth)


def test_every_band_on_a_shaft_is_found_and_counts_alone(wide, wide_renderers, fits, scene_at):
    rng, tile = np.random.default_rng(1), NoiseTile.make((640, 480), 4.0, 2)
    alone = []
    for scene in _places(scene_at):
        for renderer, fit in zip(wide_renderers, fits, strict=True):
            hint = Hint(renderer.model.pixel(scene.p_world), scene.p_world, scene.axis_world)
            found = fit.find(noise(renderer.render(scene), tile, rng), hint)
            assert isinstance(found, MarkerFix)
            alone.append(found.alone)
    assert np.mean(alone) > 0.85


@pytest.mark.long("statistics")
def test_a_band_that_hangs_in_the_air_is_no_marker(wide, wide_renderers, fits, scene_at):
    rng, tile = np.random.default_rng(1), NoiseTile.make((640, 480), 4.0, 2)
    refused, shapes = 0, 0
    for scene in _places(scene_at):
        for renderer, fit in zip(wide_renderers, fits, strict=True):
            hint = Hint(renderer.model.pixel(scene.p_world), scene.p_world, scene.axis_world)
            even = _without_shaft(renderer.even(115))
            found = fit.find(noise(even.render(scene), tile, rng), hint)
            assert isinstance(found, Miss)
            shapes += found.reason is MissReason.NO_SHAFT
            housing = _without_shaft(renderer)
            refused += isinstance(fit.find(noise(housing.render(scene), tile, rng), hint), Miss)
    assert shapes > 12  # the others are refused for their ends, which no shaft hides
    assert refused >= 29  # of 32: an edge of the housing may run where the shaft's would


@pytest.mark.parametrize("half", [(30.0, 60.0), (12.0, 50.0), (60.0, 60.0)])
def test_the_middle_of_a_red_cloth_is_no_marker(wide, wide_renderers, fits, scene_at, half):
    scene, rng = scene_at(0.05, 10.0, 40.0), np.random.default_rng(3)
    place = wide_renderers[0].model.pixel(scene.p_world)
    empty = np.full((480, 640, 3), 115, dtype=np.uint8)
    picture = patch(empty, Patch(place, np.array(half), 80.0), rng)
    noisy = np.clip(np.rint(picture + rng.normal(0.0, 4.0, picture.shape)), 0, 255)
    for known in (scene.p_world, None):
        hint = Hint(place, known, scene.axis_world)
        assert isinstance(fits[0].find(noisy.astype(np.uint8), hint), Miss)


def test_a_marker_before_a_red_cloth_that_hides_no_shaft_is_found(
    wide, wide_renderers, fits, scene_at
):
    scene, rng = scene_at(0.05, 10.0, 40.0), np.random.default_rng(3)
    renderer = copy(wide_renderers[0])
    place = renderer.model.pixel(scene.p_world)
    renderer._background = patch(
        renderer.even(115)._background, Patch(place + [26.0, 0.0], np.array([8.0, 24.0])), rng
    )
    hint = Hint(place, scene.p_world, scene.axis_world)
    assert isinstance(fits[0].find(renderer.render(scene), hint), MarkerFix)


def test_one_camera_s_find_that_may_be_another_thing_does_not_carry_a_depth_on():
    def fix(time, status):
        return NeedleFix(
            np.zeros(3), 1e-8 * np.eye(3), time, status, (np.zeros(2), None), 0.0, 0.05, 1e-8,
            has_point=True, reason="",
        )  # fmt: skip

    def find(alone, centre=Centre.BAND):
        return [MarkerFix(np.zeros(2), 1e-4 * np.eye(2), 200.0, 1.0, centre, alone)]

    continuity = Continuity()
    assert continuity.judge(fix(0.0, FixStatus.VALID), find(False)).usable
    assert not continuity.judge(fix(0.03, FixStatus.ONE_CAMERA), find(False)).usable
    assert continuity.judge(fix(0.06, FixStatus.ONE_CAMERA), find(True)).usable
    outlines = find(False, Centre.OUTLINE)
    assert continuity.judge(fix(0.09, FixStatus.VALID), outlines).status is FixStatus.INCONSISTENT
