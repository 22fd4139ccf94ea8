import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from numpy.testing import assert_allclose

from app.core.errors import NumericalError
from app.imaging.reformat import Frame, trace

AXIAL = Frame(np.array([10.0, -20.0, 5.0]), np.eye(3)[0], np.eye(3)[1])
finite = st.floats(-300.0, 300.0)
angles = st.floats(-3.0, 3.0)


def turned(a, b, c):
    frame = AXIAL.turned([1, 0, 0], a, np.zeros(3)).turned([0, 1, 0], b, np.zeros(3))
    return frame.turned([0, 0, 1], c, np.zeros(3))


@given(angles, angles, angles, finite, finite, finite)
@settings(derandomize=True, deadline=None, max_examples=60)
def test_places_and_patient_points_are_inverse_of_each_other(a, b, c, x, y, z):
    frame = turned(a, b, c)
    assert_allclose(frame.point(frame.lps_mm(x, y, z)), (x, y, z), atol=1e-9)


@given(angles, angles, angles, angles, finite, finite, finite)
@settings(derandomize=True, deadline=None, max_examples=60)
def test_turning_keeps_the_place_of_the_point_that_it_turns_about(a, b, c, angle, x, y, z):
    frame = turned(a, b, c)
    before = frame.point([x, y, z])
    again = frame.turned([1.0, 2.0, -0.5], angle, [x, y, z])
    assert_allclose(again.point([x, y, z]), before, atol=1e-9)


@pytest.mark.long("journey")
def test_a_frame_that_is_turned_ten_thousand_times_stays_square():
    frame = AXIAL
    for _ in range(10_000):
        frame = frame.turned([0.3, 0.2, 1.0], 0.01, [3.0, 2.0, 1.0])
    assert abs(frame.right @ frame.down) < 1e-12
    assert np.linalg.norm(frame.normal) == pytest.approx(1.0, abs=1e-12)


def test_the_letters_come_from_the_directions():
    letters = AXIAL.letters()
    assert (letters.left, letters.right, letters.top, letters.bottom) == ("R", "L", "A", "P")
    oblique = AXIAL.turned([1, 0, 0], np.radians(-30.0), np.zeros(3)).letters()
    assert (oblique.top, oblique.bottom) == ("AS", "PI")


def test_a_quarter_turn_brings_the_top_to_the_right():
    letters = AXIAL.quarter(1).letters()
    assert (letters.left, letters.right, letters.top, letters.bottom) == ("P", "A", "R", "L")
    mirrored = AXIAL.quarter(0, mirrored=True).letters()
    assert (mirrored.left, mirrored.right, mirrored.top) == ("L", "R", "A")
    whole = AXIAL.quarter(4)
    assert_allclose(whole.right, AXIAL.right)


def test_directions_that_are_not_square_are_refused():
    with pytest.raises(NumericalError, match="perpendicular"):
        Frame(np.zeros(3), np.eye(3)[0], np.array([0.1, 1.0, 0.0]))
    with pytest.raises(NumericalError, match="parallel"):
        Frame.of(np.zeros(3), [1, 0, 0], [-2, 0, 0])
    with pytest.raises(NumericalError, match="not finite"):
        Frame(np.array([np.nan, 0, 0]), np.eye(3)[0], np.eye(3)[1])


@given(angles, angles, angles, st.floats(-100.0, 100.0))
@settings(derandomize=True, deadline=None, max_examples=60)
def test_a_trace_lies_in_both_planes(a, b, c, along):
    other = turned(a, b, c)
    line = trace(AXIAL, other)
    if line is None:
        assert np.linalg.norm(np.cross(AXIAL.normal, other.normal)) < 1e-5
        return
    x, y, dx, dy = line
    point = AXIAL.lps_mm(x + along * dx, y + along * dy)
    assert abs(other.point(point)[2]) < 1e-6


def test_parallel_planes_have_no_trace():
    assert trace(AXIAL, AXIAL.moved(3.0)) is None


def test_a_picture_of_the_frame_has_its_pixels_where_the_frame_says():
    plane = AXIAL.pixels(2.0, 3.0, 0.5, 4, 5, 7.0)
    assert_allclose(plane.points_mm()[2, 3], AXIAL.lps_mm(3.75, 4.25, 7.0))
