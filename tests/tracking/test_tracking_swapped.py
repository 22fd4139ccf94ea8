"""Exchanged cameras are found by the marker's pixels."""

import numpy as np
import pytest

from app.tracking.stereo.epipolar import Order, check_order


def _pixels(models, points):
    return [tuple(model.pixel(p) for model in models) for p in points]


@pytest.fixture(params=["wide", "thesis"])
def models(request):
    return request.getfixturevalue(request.param).models


POINTS = np.array([0.0, 0.16056, 0.020]) + 1e-3 * np.array([[12, 5, 3], [-8, 9, 8], [10, -9, -5]])


def test_the_right_order_and_the_exchanged_one_are_told_apart(models):
    pixels = _pixels(models, POINTS)
    assert check_order(models, pixels).order is Order.AS_SET
    swapped = check_order(models, [(b, a) for a, b in pixels])
    assert swapped.order is Order.SWAPPED
    assert "exchange left and right" in swapped.text


def test_on_the_plane_of_symmetry_nothing_is_decided(wide):
    pixels = _pixels(wide.models, np.array([[0.0, 0.16056, 0.03]]))
    found = check_order(wide.models, pixels)
    assert found.order is Order.UNDECIDED
    assert "move the needle" in found.text


def test_pictures_that_fit_in_no_order_and_no_pictures_are_said(models):
    pixels = [(a + 40.0, b - [0.0, 40.0]) for a, b in _pixels(models, POINTS)]
    assert "calibrate again" in check_order(models, pixels).text
    assert "must see the marker" in check_order(models, []).text
