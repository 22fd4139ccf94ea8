"""Values drawn straight into a screen's pixels: as Qt scales a picture, grey by grey."""

import numpy as np
import pytest

from app.core.errors import NumericalError
from app.core.progress import Progress
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
    assert np.abs(found - exact(values, SOFT, place, (90, 70))).max() <= 1.0
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
    _load_verdict(Progress())
    before = [list(kernel.signatures) for kernel in (screen._draw, screen._row)]
    volume = np.zeros((4, 5, 6), kind)
    volume.setflags(write=False)
    for values in (volume[1], volume[:, 2], volume[:, :, 3], volume[1].copy()):
        for picture in (values, values[::-1], values.T):
            screen_pixels(picture, SOFT, False, (0.0, 0.0, 9.0, 9.0), (9, 9))
    assert before == [list(kernel.signatures) for kernel in (screen._draw, screen._row)]
    assert all(len(signatures) <= 2 for signatures in before)  # one for each kind of number


SHAPE = (60, 80)
RED = (200.0, 40.0, 10.0)


def drawn(*rows, under=0xFF000000, corner=(0.0, 0.0), scale=1.0, ratio=1.0):
    pixels = np.full(SHAPE, under, np.uint32)
    screen.draw_strokes(pixels, np.array(rows), corner, scale, ratio)
    return pixels


def red(pixels):
    return (pixels >> 16 & 255) / RED[0]


def line(x0, y0, x1, y1, width=2.0, alphas=(1.0, 1.0), smooth=1.0, dashes=(0.0, 0.0)):
    return (x0, y0, x1, y1, width, *RED, *alphas, smooth, *dashes)


def beside_and_along(x0, y0, x1, y1):
    y, x = (np.mgrid[: SHAPE[0], : SHAPE[1]] + 0.5).astype(float)
    length = np.hypot(x1 - x0, y1 - y0)
    ux, uy = (x1 - x0) / length, (y1 - y0) / length
    return np.abs((x - x0) * uy - (y - y0) * ux), (x - x0) * ux + (y - y0) * uy, length


ENDS = [(5.0, 7.0, 70.0, 51.0), (70.3, 5.0, 11.0, 55.5), (10.0, 30.2, 66.6, 30.2),
        (40.4, 3.0, 40.4, 58.0), (-500.0, -300.0, 400.0, 260.0),
        (20.0, 50.0, 26.0, 5.0)]  # fmt: skip


@pytest.mark.parametrize("ends", ENDS)
@pytest.mark.parametrize("width", [1.5, 3.0, 5.0])
def test_a_smooth_stroke_covers_what_lies_within_it_and_half_a_pixel_more_or_less(ends, width):
    beside, along, length = beside_and_along(*ends)
    expected = np.clip(0.5 * width + 0.5 - beside, 0.0, 1.0)
    expected *= np.clip(along + 0.5, 0.0, 1.0) * np.clip(length - along + 0.5, 0.0, 1.0)
    found = red(drawn(line(*ends, width)))
    np.testing.assert_allclose(found, expected, atol=1.0 / RED[0])
    assert expected.max() > 0.9


@pytest.mark.parametrize("ends", ENDS)
def test_a_stroke_without_smooth_edges_covers_the_pixels_whose_middles_it_holds(ends):
    beside, along, length = beside_and_along(*ends)
    dashed = np.mod(along, 12.0) < 8.0
    inside = (beside <= 1.5) & (along >= 0.0) & (along <= length) & dashed
    edge = np.minimum.reduce([np.abs(beside - 1.5), np.abs(along), np.abs(along - length),
                              np.abs(np.mod(along, 12.0) - 8.0),
                              np.mod(along, 12.0), 12.0 - np.mod(along, 12.0)]) < 1e-6  # fmt: skip
    found = red(drawn(line(*ends, 3.0, smooth=0.0, dashes=(8.0, 4.0))))
    assert ((found > 0.5) == inside)[~edge].all()
    assert inside.any()


def test_a_stroke_fades_from_end_to_end_and_lies_over_what_is_there():
    found = drawn(line(0.0, 30.0, 80.0, 30.0, 4.0, (1.0, 0.25)), under=0xFF0000FF)
    assert abs(red(found)[30, 1] - 1.0) < 0.03
    assert abs(red(found)[30, 78] - 0.26) < 0.03
    assert abs((found[30, 78] & 255) / 255.0 - 0.74) < 0.03
    assert (found >> 24 == 255).all()


def test_over_nothing_strokes_are_premultiplied():
    found = drawn(line(0.0, 30.0, 80.0, 30.0, 4.0, (0.5, 0.5)), under=0)
    assert abs(int(found[30, 40] >> 24) - 128) <= 1
    assert abs(int(found[30, 40] >> 16 & 255) - 100) <= 1
    assert found[5, 5] == 0


@pytest.mark.parametrize("axes", [(25.0, 25.0), (30.0, 12.0), (20.0, 0.001), (3.0, 2.0),
                                  (400.0, 300.0)])  # fmt: skip
@pytest.mark.parametrize("angle", [0.0, 0.7, -1.3])
def test_an_ellipse_runs_through_its_own_points_and_nowhere_else(axes, angle):
    at = (41.3, 29.6) if axes[0] < 100.0 else (41.3, 320.0)
    row = (*at, *axes, 2.0, *RED, 1.0, angle, screen.ELLIPSE, 0.0, 0.0)
    found = red(drawn(row))
    turns = np.linspace(0.0, 2.0 * np.pi, 40001)
    u, v = axes[0] * np.cos(turns), axes[1] * np.sin(turns)
    x = at[0] + u * np.cos(angle) - v * np.sin(angle)
    y = at[1] + u * np.sin(angle) + v * np.cos(angle)
    inside = (x > 0) & (x < SHAPE[1]) & (y > 0) & (y < SHAPE[0])
    assert found[y[inside].astype(int), x[inside].astype(int)].min(initial=1.0) > 0.2
    points = np.stack([x, y])[:, ::20]
    for row_, column in zip(*np.nonzero(found > 0.5), strict=True):
        away = np.hypot(points[0] - column - 0.5, points[1] - row_ - 0.5).min()
        assert away <= 1.0 + 0.5


def test_places_are_those_of_the_screen():
    at = drawn(line(110.0, 215.0, 130.0, 215.0), corner=(100.0, 200.0), scale=2.0, ratio=2.0)
    assert red(at)[30, 40] > 0.9
    assert red(at)[30, 15] == 0.0
    assert red(at)[28, 40] > 0.9  # twice as wide
    assert red(at)[26, 40] == 0.0


def test_strokes_without_length_or_number_draw_nothing():
    nothing = np.nan
    found = drawn(line(5.0, 5.0, 5.0, 5.0), line(nothing, 5.0, 9.0, 9.0))
    assert (found == 0xFF000000).all()
