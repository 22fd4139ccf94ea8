"""The latency test on a synthetic camera of known latency, jitter, exposure and rate."""

import numpy as np
import pytest

from app.tracking.cameras.latency import blink_times, estimate_latency, grid_means, liveliest
from app.tracking.errors import CameraError


def _film(latency, jitter=0.0, exposure=0.0, rate=30.0, seconds=20.0, noise=2.0, seed=1):
    """Changes of the display, and time and brightness of the pictures that see them."""
    rng = np.random.default_rng(seed)
    blinks = 5.0 + blink_times(seconds, rate, rng)
    captured = 5.0 + rng.uniform(0, 1 / rate) + np.arange(int(rate * (seconds + 0.5))) / rate
    light = np.linspace(-0.5, 0.5, 21) * exposure
    shown = np.searchsorted(blinks, captured[:, None] + light) % 2
    grey = 60.0 + 90.0 * shown.mean(axis=1) + rng.normal(0.0, noise, captured.size)
    return blinks, captured + latency + rng.normal(0.0, jitter, captured.size), grey


@pytest.mark.parametrize("latency", [0.0, 0.021, 0.0667, 0.0734, 0.31])
def test_the_latency_is_found_finer_than_the_cameras_period(latency):
    found = estimate_latency(*_film(latency))
    assert found.median == pytest.approx(latency, abs=1.5e-3)
    assert found.error < 2e-3
    assert found.n > 60


@pytest.mark.parametrize("seed", range(5))
def test_with_jitter_and_exposure_the_median_stays_and_the_spread_is_told(seed):
    found = estimate_latency(*_film(0.08, jitter=6e-3, exposure=10e-3, seed=seed))
    assert found.median == pytest.approx(0.08, abs=3e-3)
    assert 4e-3 < found.sd < 10e-3  # of both together: 6.7 ms
    assert abs(found.median - 0.08) < 4.0 * found.error


def test_pictures_that_were_lost_do_not_change_it():
    blinks, times, grey = _film(0.05)
    kept = np.random.default_rng(3).random(times.size) > 0.3
    assert estimate_latency(blinks, times[kept], grey[kept]).median == pytest.approx(0.05, abs=2e-3)


def test_pictures_without_a_number_are_left_out():
    blinks, times, grey = _film(0.05)
    grey[::7] = np.nan
    assert estimate_latency(blinks, times, grey).median == pytest.approx(0.05, abs=2e-3)


def test_a_camera_that_looks_elsewhere_is_told_what_to_do():
    blinks, times, grey = _film(0.05)
    with pytest.raises(CameraError, match="point the camera at the patch"):
        estimate_latency(blinks, times, np.full_like(grey, 80.0))
    noise = np.random.default_rng(2).normal(90.0, 30.0, grey.size)
    with pytest.raises(CameraError, match="do not follow the blinking"):
        estimate_latency(blinks, times, noise)


def test_a_test_that_was_broken_off_is_refused():
    blinks, times, grey = _film(0.05)
    with pytest.raises(CameraError, match="too few"):
        estimate_latency(blinks[:4], times, grey)
    with pytest.raises(CameraError, match="increase"):
        estimate_latency(blinks[::-1], times, grey)


def test_the_patch_is_found_where_the_picture_changes():
    rng, tiles = np.random.default_rng(1), []
    for number in range(20):
        image = rng.integers(90, 110, (60, 81, 3)).astype(np.uint8)
        image[20:30, 40:60] = 200 * (number % 2)
        tiles.append(grid_means(image))
    found = liveliest(tiles)
    assert found[1::2].min() > found[::2].max() + 150.0
    with pytest.raises(CameraError, match="no picture came"):
        liveliest([])
    with pytest.raises(CameraError, match="too small"):
        grid_means(np.zeros((2, 9, 3), np.uint8))
