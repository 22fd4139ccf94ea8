"""From light to a delivered picture: against OpenCV's own sRGB, counted photons and its codec."""

import cv2
import numpy as np
import pytest

from app.core.clock import VirtualClock
from app.tracking.errors import TrackingError
from app.tracking.optics.rig import RigProfile
from app.tracking.simulated.cameras import NeedleRenderer, simulated_cameras
from app.tracking.simulated.delivery import (
    WHITE,
    Jpeg,
    Tone,
    compress,
    develop,
    from_srgb,
    light_of,
    srgb,
)
from app.tracking.simulated.picture_effects import in_order, picture_effects, with_noise

RNG = np.random.default_rng
SRGB, LINEAR = (Tone.of(np.array([model, 4000.0, 8.0])) for model in (0.0, 1.0))


def flat(light: float, size: int = 200) -> np.ndarray:
    return np.full((size, size, 3), round(WHITE * light), np.uint16)


@pytest.mark.long("statistics")
def test_the_tone_curve_has_the_values_of_the_standard() -> None:
    """IEC 61966-2-1: the knee, and the grey that is half as bright as white."""
    assert srgb([0.0, 0.0031308, 1.0]) == pytest.approx([0.0, 0.04045, 1.0], abs=1e-5)
    assert 255.0 * srgb(0.5) == pytest.approx(187.52, abs=0.01)
    assert from_srgb(128 / 255.0) == pytest.approx(0.21586, abs=1e-5)
    grey = np.linspace(0.0, 1.0, 256)
    assert srgb(from_srgb(grey)) == pytest.approx(grey, abs=1e-6)


def test_opencv_linearises_grey_values_to_the_same_light() -> None:
    grey = np.linspace(0.02, 1.0, 200, dtype=np.float32)
    lightness = cv2.cvtColor(np.dstack([grey[None]] * 3), cv2.COLOR_BGR2Lab)[0, :, 0]
    luminance = np.where(lightness > 8.0, ((lightness + 16.0) / 116.0) ** 3, lightness / 903.3)
    assert from_srgb(grey) == pytest.approx(luminance, rel=0.01, abs=1e-3)  # theirs are splines


def test_a_picture_comes_out_in_the_grey_values_of_its_light() -> None:
    quiet = Tone.of(np.array([0.0, 1e5, 0.0]))
    for grey in (5.0, 40.0, 115.0, 250.0):
        seen = develop(flat(light_of(grey) / 255.0), quiet, RNG(1))
        assert seen.dtype == np.uint8
        assert seen.mean() == pytest.approx(grey, abs=0.6)


@pytest.mark.parametrize("light", [0.02, 0.2, 0.8])
def test_its_noise_is_that_of_photons_that_numpy_counts(light: float) -> None:
    seen = develop(flat(light), LINEAR, RNG(3)).astype(float)
    counted = RNG(4).poisson(4000.0 * light, seen.size) + 8.0 * RNG(5).standard_normal(seen.size)
    theirs = np.rint(np.clip(255.0 * counted / 4000.0, 0.0, 255.0))
    assert seen.mean() == pytest.approx(theirs.mean(), abs=0.02)
    assert seen.std() == pytest.approx(theirs.std(), rel=0.02)


def test_the_curve_comes_after_the_noise_dark_grey_is_noisier() -> None:
    for light in (0.005, 0.05, 0.5):
        seen = develop(flat(light), SRGB, RNG(6)).astype(float)
        slope = (srgb(light + 1e-4) - srgb(light - 1e-4)) / 2e-4
        expected = 255.0 * slope * np.sqrt(light * 4000.0 + 64.0) / 4000.0
        assert seen.std() == pytest.approx(np.hypot(expected, 12**-0.5), rel=0.05)


def test_each_picture_has_other_noise_and_a_seed_the_same() -> None:
    tone, rng = Tone.of(np.array([0.0, 4000.0, 8.0])), RNG(7)
    first, second = (develop(flat(0.3), tone, rng) for _ in range(2))
    assert not np.array_equal(first, second)
    assert np.array_equal(first, develop(flat(0.3), Tone.of(np.array([0.0, 4000.0, 8.0])), RNG(7)))


def test_what_is_no_light_is_refused() -> None:
    with pytest.raises(TrackingError, match="light=True"):
        develop(np.zeros((4, 4, 3), np.uint8), SRGB, RNG(1))


def striped(across: bool) -> np.ndarray:
    """Lines of two colours, one pixel wide and as bright as each other."""
    picture = np.zeros((64, 64, 3), np.uint8)
    picture[:], picture[:, 1::2] = (40, 40, 200), (170, 88, 60)
    return picture if across else np.ascontiguousarray(picture.transpose(1, 0, 2))


def lost(model: int, picture: np.ndarray, quality: float = 100.0) -> float:
    seen = compress(picture, Jpeg.of(np.array([model, quality])), RNG(1))
    return float(np.abs(seen.astype(int) - picture).mean())


def test_colour_is_kept_in_the_directions_that_its_sampling_keeps() -> None:
    columns, rows = striped(True), striped(False)
    assert max(lost(2, columns), lost(2, rows)) < 3.0  # 4:4:4
    assert lost(1, rows) < 3.0 < 15.0 < lost(1, columns)  # 4:2:2
    assert min(lost(0, columns), lost(0, rows)) > 15.0  # 4:2:0


def test_the_codec_is_opencvs_with_the_factors_of_the_standard() -> None:
    picture = cv2.GaussianBlur(RNG(2).integers(0, 255, (96, 128, 3), np.uint8), (0, 0), 1.5)
    for model, factor in enumerate((0x221111, 0x211111, 0x111111)):
        for quality in (80, 90):
            options = [cv2.IMWRITE_JPEG_QUALITY, quality, cv2.IMWRITE_JPEG_SAMPLING_FACTOR, factor]
            coded = cv2.imencode(".jpg", picture, options)[1]
            theirs = cv2.imdecode(coded, cv2.IMREAD_COLOR)
            ours = compress(picture, Jpeg.of(np.array([model, quality])), RNG(1))
            assert np.array_equal(ours, theirs)


def blockiness(picture: np.ndarray) -> float:
    """Step between columns at the borders of blocks of eight, over that elsewhere."""
    step = np.abs(np.diff(picture[..., 1].astype(float), axis=1)).mean(axis=0)
    border = np.arange(len(step)) % 8 == 7
    return float(step[border].mean() / step[~border].mean())


def test_it_leaves_blocks_of_eight_pixels_and_the_more_the_lower_the_quality() -> None:
    rough = 120.0 + 60.0 * cv2.GaussianBlur(RNG(8).standard_normal((256, 256, 3)), (0, 0), 2.0)
    picture = np.clip(rough, 0, 255).astype(np.uint8)
    seen = [
        blockiness(compress(picture, Jpeg.of(np.array([0.0, quality])), RNG(1)))
        for quality in (98.0, 60.0, 30.0)
    ]
    assert blockiness(picture) == pytest.approx(1.0, abs=0.05)
    assert seen[0] == pytest.approx(1.0, abs=0.1)
    assert seen[0] < seen[1] < seen[2]
    assert seen[2] > 1.1


def test_tone_curve_and_jpeg_act_last_and_noise_before_jpeg() -> None:
    asked = ("camera_jpeg", "camera_tone", "camera_light", "camera_blur")
    assert in_order(asked) == ["camera_light", "camera_blur", "camera_tone", "camera_jpeg"]
    jpeg = picture_effects({"camera_jpeg": np.array([0.0, 90.0])})
    tone = picture_effects({"camera_tone": np.array([0.0, 4000.0, 8.0])})
    names = [effect.__name__ for effect, _ in with_noise(jpeg, (64, 48), 4.0, 1)]
    assert names == ["noise", "compress"]
    names = [effect.__name__ for effect, _ in with_noise((*tone, *jpeg), (64, 48), 4.0, 1)]
    assert names == ["develop", "compress"]


def test_light_of_lamps_and_blur_act_on_light() -> None:
    """Half the light is three quarters of the grey value, and a blurred edge is brighter."""
    half = {"camera_light": np.array([1.0, 0.5, 0.0, 0.0])}
    soft = {"camera_blur": np.array([0.0, 2.0, 0.0, 0.0])}
    ((dim, level),), ((blur, spread),) = picture_effects(half), picture_effects(soft)
    assert dim(flat(0.4), level, RNG(1)) == pytest.approx(WHITE * 0.2, abs=1.0)
    uneven, gradient = picture_effects({"camera_light": np.array([1.0, 0.5, 0.5, 0.0])})[0]
    assert uneven(flat(0.4), gradient, RNG(1))[:, 0] == pytest.approx(WHITE * 0.1, abs=1.0)
    edge = flat(0.0, 64)
    edge[:, 32:] = WHITE
    between = blur(edge, spread, RNG(1))[20, 31:33, 0].mean()
    assert between == pytest.approx(0.5 * WHITE, rel=0.02)


def test_the_light_of_a_needle_has_its_colours_and_mixes_as_light(
    wide: RigProfile, scene_at
) -> None:
    model, scene = wide.models[0], scene_at(0.06, 10.0, 40.0)
    grey = NeedleRenderer(model, wide.needle, wide.blur_px, 0, light=True).even(115.0)
    light = grey.render(scene)
    assert light.dtype == np.uint16
    assert 255.0 * srgb(light[5, 5] / WHITE) == pytest.approx([115.0] * 3, abs=0.5)
    # the share of the band that pixels at its edge have is the share of its light
    u, v = np.rint(model.pixel(scene.p_world)).astype(int)
    row = light[v, u - 20 : u + 20].astype(float)
    inside, outside = row[np.argmin(row[:, 1])], row[0]
    share = (row - outside) / (inside - outside)
    edge = (share[:, 1] > 0.2) & (share[:, 1] < 0.8)
    assert edge.any()
    assert share[edge, 0] == pytest.approx(share[edge, 1], abs=0.05)


@pytest.mark.long("statistics")
def test_cameras_deliver_eight_bits_whatever_they_draw(wide: RigProfile, scene_at) -> None:
    scene = scene_at(0.06, 10.0, 40.0)
    asked = {"camera_tone": np.array([0.0, 4000.0, 8.0]), "camera_jpeg": np.array([0.0, 90.0])}
    seen = []
    for effects in ({}, asked, asked):
        chain, clock = picture_effects(effects), VirtualClock(1.0)
        camera, _ = simulated_cameras(wide, lambda _: scene, clock, 3, chain)
        camera.open()
        seen.append(camera.read().image)
    assert all(image.dtype == np.uint8 for image in seen)
    assert np.array_equal(seen[1], seen[2])
    assert blockiness(seen[1]) > blockiness(seen[0])
