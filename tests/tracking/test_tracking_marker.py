"""The marker in rendered pictures: unbiased, with an honest covariance, and cheap to follow."""

import numpy as np
import pytest

from app.tracking.markers.colour import RED
from app.tracking.markers.extractor import Hint, MarkerFix
from app.tracking.markers.outline_centroid import OutlineCentroid, mark_half
from app.tracking.markers.silhouette import centroid_shift
from app.tracking.markers.thesis import ThesisMarker
from app.tracking.simulated.picture_effects import NoiseTile, blur, lighting, noise

# Depths [m], tilts and azimuths [deg] all over the range of the wide rig.
POSES = [
    (depth, tilt, azimuth)
    for depth, tilts in ((-0.03, (0, 30)), (0.03, (10, 39)), (0.075, (5, 25)), (0.12, (15, 39)))
    for tilt in tilts
    for azimuth in (20.0, 110.0, 200.0, 290.0)
]


def best(extractor, image):
    """The best find in the whole picture, or None."""
    found = extractor.search(image)
    return found[0] if found and isinstance(found[0], MarkerFix) else None


def _errors(rig, renderers, scene_at, sd_grey=0.0, extractor=None):
    """Corrected pixel minus the true picture of the band's centre, (poses, cameras, 2)."""
    finder = extractor or OutlineCentroid()
    rng = np.random.default_rng(4)
    tile = NoiseTile.make((640, 480), sd_grey, 9)
    errors = np.empty((len(POSES), 2, 2))
    for i, pose in enumerate(POSES):
        scene = scene_at(*pose)
        for k, (renderer, model) in enumerate(zip(renderers, rig.models, strict=True)):
            image = noise(renderer.render(scene), tile, rng)
            found = best(finder, image)
            if found is None and extractor is not None:
                errors[i, k] = np.nan
                continue
            assert found is not None, pose
            shift = centroid_shift(model, rig.needle.shape, scene.p_world, scene.axis_world)
            errors[i, k] = found.uv - shift - model.pixel(scene.p_world)
    return errors


@pytest.mark.long("statistics")
def test_the_marker_is_found_unbiased_over_the_whole_range(wide, wide_renderers, scene_at):
    errors = _errors(wide, wide_renderers, scene_at)
    millimetres = 0.42 / wide.models[0].intrinsics[0] * 1e3  # per pixel, at the rig's distance
    assert np.abs(errors.mean(axis=0)).max() * millimetres < 0.02
    assert np.sqrt((errors**2).mean()) * millimetres < 0.05


def test_without_the_outline_correction_the_centroid_is_biased(wide, wide_renderers, scene_at):
    scene = scene_at(0.06, 39.0, 90.0)  # leaning towards the cameras: the shaft hides the near end
    shifts = [
        centroid_shift(model, wide.needle.shape, scene.p_world, scene.axis_world)
        for model in wide.models
    ]
    assert min(np.linalg.norm(shift) for shift in shifts) > 0.5
    for renderer, model, shift in zip(wide_renderers, wide.models, shifts, strict=True):
        raw = best(OutlineCentroid(), renderer.render(scene)).uv - model.pixel(scene.p_world)
        assert np.linalg.norm(raw - shift) < 0.4 * np.linalg.norm(raw)


def test_the_outline_model_agrees_with_the_rendered_band(wide, wide_renderers, scene_at):
    # the rendered band alone: difference of a red and a black one under the same light
    from app.tracking.simulated import cameras as simulated

    renderer, model = wide_renderers[0], wide.models[0]
    for pose in POSES[::5]:
        scene = scene_at(*pose)
        image = renderer.render(scene).astype(float)
        colours = simulated._COLOURS.copy()
        try:
            simulated._COLOURS[1, 1] = 250.0  # more green where the band is, and nowhere else
            other = renderer.render(scene).astype(float)
        finally:
            simulated._COLOURS[:] = colours
        ambient, diffuse = renderer._light[3:5]
        assert ambient + diffuse <= 1.0
        band = (other - image)[..., 1] > 0.5 * (250.0 - 26.0) * ambient
        v, u = np.nonzero(band)
        centre = np.array([u.mean(), v.mean()])
        shift = centroid_shift(model, wide.needle.shape, scene.p_world, scene.axis_world)
        assert np.linalg.norm(centre - shift - model.pixel(scene.p_world)) < 0.35


@pytest.mark.long("statistics")
def test_the_covariance_of_the_centroid_agrees_with_repeated_noise(wide, wide_renderers, scene_at):
    clean = wide_renderers[0].render(scene_at(0.05, 15.0, 40.0))
    rng = np.random.default_rng(8)
    finder = OutlineCentroid(noise_grey=4.0)
    found = []
    for _ in range(120):
        noisy = clean + 4.0 * rng.standard_normal(clean.shape, dtype=np.float32)
        image = np.clip(np.rint(noisy), 0, 255).astype(np.uint8)
        found.append(finder.find(image, Hint(found[0].uv)) if found else best(finder, image))
    sample = np.cov(np.array([fix.uv for fix in found]).T)
    predicted = np.mean([fix.covariance for fix in found], axis=0)
    ratio = np.sqrt(np.trace(sample) / np.trace(predicted))
    assert 0.7 < ratio < 1.4


def test_following_finds_the_same_as_searching(wide, wide_renderers, scene_at):
    image = wide_renderers[1].render(scene_at(0.04, 20.0, 70.0))
    searched = best(OutlineCentroid(), image)
    followed = OutlineCentroid().find(image, Hint(searched.uv + np.array([11.0, -14.0])))
    assert np.abs(searched.uv - followed.uv).max() < 1e-9


@pytest.mark.parametrize(("effect", "value"), [(lighting, 0.6), (lighting, 1.2), (blur, 1.0)])
def test_dimmer_brighter_or_blurred_pictures_move_the_marker_little(
    wide, wide_renderers, scene_at, effect, value
):
    image = wide_renderers[0].render(scene_at(0.05, 20.0, 30.0))
    plain = best(OutlineCentroid(), image)
    changed = best(OutlineCentroid(), effect(image, value, np.random.default_rng(0)))
    assert np.abs(plain.uv - changed.uv).max() < 0.2


def test_the_thesis_extractor_finds_the_marker_to_about_a_pixel(wide, wide_renderers, scene_at):
    errors = _errors(wide, wide_renderers, scene_at, 4.0, ThesisMarker(area_min=60.0))
    assert np.isfinite(errors).mean() > 0.7
    assert 0.3 < np.sqrt(np.nanmean(errors**2)) < 2.0


def test_the_picture_shows_a_red_band_on_a_grey_needle_where_the_model_says(
    wide, wide_renderers, scene_at
):
    scene = scene_at(0.06, 10.0, 0.0)
    model, image = wide.models[0], wide_renderers[0].render(scene)
    shape = wide.needle.shape

    def colour(along):
        u, v = np.rint(model.pixel(scene.p_world + along * scene.axis_world)).astype(int)
        return image[v, u].astype(int)

    blue, green, red = colour(0.0)
    assert red > 100
    assert red > 3 * max(blue, green)
    blue, green, red = colour(-4.0 * shape.half)  # on the shaft
    assert abs(red - blue) < 20
    assert red > 80
    u, v = np.rint(model.pixel(scene.p_world + (shape.tip + 0.01) * scene.axis_world)).astype(int)
    assert np.array_equal(image[v, u], wide_renderers[0]._background[v, u])  # beyond the tip


@pytest.mark.long("statistics")
def test_the_marked_pixels_are_those_of_every_second_pixel_in_numpy():
    rng = np.random.default_rng(8)
    image = rng.integers(0, 256, (61, 83, 3)).astype(np.uint8)
    image[20:] = rng.integers(90, 120, (41, 83, 3))  # rows with nothing strong in them
    image[40, 20] = (20, 20, 100)
    mask, box = np.empty((31, 42), np.uint8), np.empty(4, np.int64)
    for least in (25.5, 60.5):
        assert mark_half(image, RED.weights, least, mask, box)
        half = image[::2, ::2].astype(np.float64)
        strength = half @ RED.weights
        wanted = (strength >= least) & (strength - 0.3 * half[..., 2] >= 0.5)
        assert (mask == wanted).all()
        v, u = np.nonzero(wanted)
        assert box.tolist() == [u.min(), v.min(), u.max() + 1, v.max() + 1]
    assert not mark_half(np.full_like(image, 90), RED.weights, 25.5, mask, box)
    assert not mask.any()
