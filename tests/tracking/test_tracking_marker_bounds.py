"""The Cramér-Rao bounds of the marker: their algebra, the fit's covariance, repeated noise."""

import numpy as np
import pytest

from app.studies.marker import joint_bound, position_bound, schur_bound
from app.tracking.band.fit import BandFitter
from app.tracking.markers.choice import ExtractorName, extractors
from app.tracking.markers.extractor import Hint, MarkerFix
from app.tracking.markers.silhouette import centroid_shift
from app.tracking.simulated.scene import MarkerScene


def _bounds(wide, renderer, scene):
    """Bound of the position alone and beside the fit's unknowns."""
    even, model = renderer.even(115), renderer.model

    def at(p_world):
        return even.render(MarkerScene(p_world, scene.axis_world))

    alone = position_bound(at, even.band(scene), model, scene.p_world, 4.0)
    joint = joint_bound(
        at, model, wide.needle.shape, wide.blur_px, scene.p_world, scene.axis_world, 4.0
    )
    return alone, joint


def test_the_schur_complement_is_the_positions_block_of_the_whole_inverse():
    rng = np.random.default_rng(2)
    position, nuisance = rng.normal(size=(40, 2)), rng.normal(size=(40, 7))
    prior = np.diag(rng.uniform(0.0, 5.0, 7))
    whole = np.column_stack([position, nuisance])
    information = whole.T @ whole
    information[2:, 2:] += prior
    expected = np.linalg.inv(information)[:2, :2]
    assert schur_bound(position, nuisance, prior) == pytest.approx(expected)


def test_unknowns_only_make_the_bound_larger_and_by_little(wide, wide_renderers, scene_at):
    for pose in ((0.05, 15.0, 40.0), (0.0, 40.0, 200.0)):
        for renderer in wide_renderers:
            alone, joint = _bounds(wide, renderer, scene_at(*pose))
            assert 1.0 < np.sqrt(np.trace(joint) / np.trace(alone)) < 1.3


@pytest.mark.long("statistics")
def test_the_joint_bound_is_the_fits_covariance_and_that_of_repeated_noise(
    wide, wide_renderers, scene_at
):
    scene, renderer, rng = scene_at(0.05, 15.0, 40.0), wide_renderers[0], np.random.default_rng(8)
    model, clean = renderer.model, renderer.even(115).render(scene)
    _, joint = _bounds(wide, renderer, scene)
    fitter = BandFitter(model, wide.needle.shape, wide.blur_px, 4.0)
    p_camera = model.T_camera_world @ scene.p_world
    axis = model.T_camera_world.rotate(scene.axis_world)
    fit = fitter.fit(clean, p_camera, axis)
    assert np.sqrt(np.trace(fit.covariance) / np.trace(joint)) == pytest.approx(1.0, abs=0.05)
    found = []
    for _ in range(150):
        noisy = clean + rng.normal(0.0, 4.0, clean.shape)
        image = np.clip(np.rint(noisy), 0, 255).astype(np.uint8)
        found.append(fitter.fit(image, p_camera, axis).uv)
    ratio = np.sqrt(np.trace(np.cov(np.array(found).T)) / np.trace(joint))
    assert 0.85 < ratio < 1.2  # 150 pictures tell it to 6 %


@pytest.mark.long("statistics")
def test_the_outlines_centroid_stays_within_a_few_times_the_bound(wide, wide_renderers, scene_at):
    finders = extractors(wide, ExtractorName.OUTLINE_CENTROID)
    rng, squares, bounds = np.random.default_rng(3), [], []
    for azimuth in (20.0, 110.0, 200.0, 290.0):
        scene = scene_at(0.04, 25.0, azimuth)
        for renderer, finder in zip(wide_renderers, finders, strict=True):
            model, clean = renderer.model, renderer.even(115).render(scene)
            shift = centroid_shift(model, wide.needle.shape, scene.p_world, scene.axis_world)
            bounds.append(np.trace(_bounds(wide, renderer, scene)[0]))
            true, errors = model.pixel(scene.p_world), []
            for _ in range(4):
                noisy = clean + rng.normal(0.0, 4.0, clean.shape)
                image = np.clip(np.rint(noisy), 0, 255).astype(np.uint8)
                found = finder.find(image, Hint(true))
                assert isinstance(found, MarkerFix)
                errors.append(np.sum((found.uv - shift - true) ** 2))
            squares.append(np.mean(errors))
    assert np.sqrt(np.mean(squares) / np.mean(bounds)) < 3.0
