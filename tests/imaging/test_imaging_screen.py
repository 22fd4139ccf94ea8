"""Values drawn straight into a screen's pixels: as Qt scales a picture, grey by grey."""

import numpy as np
import pytest

from app.core.errors import NumericalError
from app.imaging import screen
from app.imaging.screen import screen_pixels
from app.imaging.window import WindowLevel, to_grey
from app.planning.patient import _load_verdict

SOFT = WindowLevel(400.0, 40.0)


def greys(pixels):
    assert (pixels >> 24 == 255).all()
    assert (pixels & 255 == pixels >> 8 & 255).all()
    return (pixels & 255).astype(int)


def noise(dtype, shape=(40, 50)):
    return np.random.default_rng(1).integers(-400, 500, shape).astype(dtype)


def exact(values, window, place, size):
    """Bilinear between greys in double precision; 0 beside the picture."""
    grey = to_grey(values, window).astype(float)
    along = []
    for start, extent, count, pixels in zip(place[:2], place[2:], values.shape[::-1], size,
                                            strict=True):  # fmt: skip
        middles = np.arange(pixels) + 0.5 - start
        at = np.clip(middles * count / extent - 0.5, 0.0, count - 1.0)
        low = np.minimum(at.astype(int), max(count - 2, 0))
        along.append((low, at - low, (middles >= 0.0) & (middles < extent)))
    (c, u, seen_x), (r, v, seen_y) = along
    c1, r1 = np.minimum(c + 1, grey.shape[1] - 1), np.minimum(r + 1, grey.shape[0] - 1)
    u, v = u[None, :], v[:, None]
    rows = (1 - v) * grey[r] + v * grey[r1]
    found = (1 - u) * rows[:, c] + u * rows[:, c1]
    return found * (seen_y[:, None] & seen_x[None, :])


@pytest.mark.parametrize("dtype", [np.int16, np.float32])
@pytest.mark.parametrize("place", [(0.0, 0.0, 50.0, 40.0), (3.0, -8.0, 50.0, 40.0),
                                   (-20.3, 7.7, 131.0, 99.5), (10.0, 5.0, 21.0, 17.0)])  # fmt: skip
def test_greys_are_those_of_the_window_between_four_values(dtype, place):
    values = noise(dtype)
    found = greys(screen_pixels(values, SOFT, False, place, (90, 70)))
    assert np.abs(found - exact(values, SOFT, place, (90, 70))).max() <= 1.0 + 255.0 / 256.0
    assert np.abs(found - exact(values, SOFT, place, (90, 70))).mean() < 0.4


@pytest.mark.parametrize("dtype", [np.int16, np.float32])
@pytest.mark.parametrize("window", [SOFT, WindowLevel(1.0, 20.0), WindowLevel(2000.0, -600.0)])
def test_a_picture_of_the_screens_own_pixels_is_copied_grey_by_grey(dtype, window):
    values = noise(dtype)
    found = greys(screen_pixels(values, window, False, (2.0, 1.0, 50.0, 40.0), (60, 50)))
    np.testing.assert_array_equal(found[1:41, 2:52], to_grey(values, window))


def test_what_is_inverted_is_255_less_and_the_background_stays():
    values = noise(np.int16)
    place, size = (4.5, 3.0, 80.0, 64.0), (100, 80)
    plain = greys(screen_pixels(values, SOFT, False, place, size, 17))
    dark = greys(screen_pixels(values, SOFT, True, place, size, 17))
    inside = np.zeros_like(plain, bool)
    inside[3:67, 4:84] = True
    np.testing.assert_array_equal(dark[inside], 255 - plain[inside])
    assert (dark[~inside] == 17).all()


def test_a_single_value_fills_its_rectangle():
    found = greys(screen_pixels(np.full((1, 1), 40, np.int16), SOFT, False, (1, 1, 3, 2), (5, 4)))
    assert (found[1:3, 1:4] > 100).all()
    assert found.sum() == found[1:3, 1:4].sum()


@pytest.mark.parametrize("place", [(0.0, 0.0, 0.0, 5.0), (0.0, 0.0, 5.0, -1.0)])
def test_a_picture_without_size_is_refused(place):
    with pytest.raises(NumericalError, match="cannot be drawn"):
        screen_pixels(noise(np.int16), SOFT, False, place, (5, 5))


@pytest.mark.parametrize("kind", [np.int16, np.float32])
def test_once_a_patient_is_prepared_no_slice_of_a_volume_has_anything_compiled(kind):
    _load_verdict()
    before = [list(kernel.signatures) for kernel in (screen._by_table, screen._by_line)]
    volume = np.zeros((4, 5, 6), kind)
    volume.setflags(write=False)
    for values in (volume[1], volume[:, 2], volume[:, :, 3], volume[1].copy()):
        for picture in (values, values[::-1], values.T):
            screen_pixels(picture, SOFT, False, (0.0, 0.0, 9.0, 9.0), (9, 9))
    assert before == [list(kernel.signatures) for kernel in (screen._by_table, screen._by_line)]
