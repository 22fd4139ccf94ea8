from math import asin, asinh, pi, radians, sinh, tan

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core.arrays import angle_between
from app.core.errors import NumericalError
from app.core.rotation import rotation_exp
from app.planning.off_path import Offset
from app.session.pad.geometry import (
    PadScale,
    clamp_to_cone,
    ct_angles,
    direction_letters,
    downward,
    path_frame,
)
from app.views.exercise.bullseye import lateral

SUPINE = np.array([[1.0, 0, 0], [0, 0, 1.0], [0, -1.0, 0]])  # L→+x, S→+y, A→+z; columns L, P, S
finite = st.floats(-1.0, 1.0)
quiet = settings(derandomize=True, deadline=None, max_examples=200)


def cone(limit_deg: float, azimuth: float) -> np.ndarray:
    t = radians(limit_deg)
    return np.array([np.sin(t) * np.cos(azimuth), np.sin(t) * np.sin(azimuth), -np.cos(t)])


@quiet
@given(st.floats(0, 45), st.floats(0, 2 * pi), st.floats(0, 45), st.floats(0, 2 * pi))
def test_tilts_and_direction_are_inverse_over_the_whole_cone(a, b, c, d):
    frame = path_frame(cone(a, b), SUPINE)
    needle = cone(c, d)
    assert np.allclose(frame.direction(frame.tilts(needle)), needle, atol=1e-14)
    assert np.isclose(np.hypot(*frame.tilts(needle)), angle_between(needle, frame.axis), atol=1e-14)


@quiet
@given(st.floats(0, 1e-7), st.floats(0, 2 * pi))
def test_tilts_beside_the_path_are_exact_to_the_last_bits(size, azimuth):
    frame = path_frame((0.3, -0.2, -1.0), SUPINE)
    tilts = size * np.array([np.cos(azimuth), np.sin(azimuth)])
    assert np.allclose(frame.tilts(frame.direction(tilts)), tilts, atol=4e-16)


def test_the_needle_on_the_path_has_no_tilt_and_against_it_a_half_turn():
    frame = path_frame((0.0, 0.0, -1.0), SUPINE)
    assert np.allclose(frame.tilts(frame.axis), 0.0)
    assert np.allclose(frame.tilts(-frame.axis), [pi, 0.0])


@quiet
@given(st.tuples(finite, finite, finite), st.tuples(finite, finite, finite))
def test_the_pad_frame_is_right_handed_seen_along_the_path(axis, turn):
    if np.linalg.norm(axis) < 1e-3:
        return
    frame = path_frame(axis, rotation_exp(3.0 * np.array(turn)) @ SUPINE)
    basis = np.array([frame.right, frame.up, -frame.axis])
    assert np.allclose(basis @ basis.T, np.eye(3), atol=1e-12)
    assert np.isclose(np.linalg.det(basis), 1.0)


def test_up_is_the_head_and_sideways_stays_in_the_axial_plane():
    frame = path_frame((0.3, 0.0, -1.0), SUPINE)
    assert frame.axial
    superior = SUPINE[:, 2]
    assert abs(frame.right @ superior) < 1e-15
    assert frame.up @ superior > 0.9
    assert frame.letters[2:] == ("S", "I")


def test_a_supine_patient_seen_from_above_with_head_up_shows_the_right_side_on_the_left():
    # Lying supine, head up on the pad, read at from above (the front): radiological sides.
    assert path_frame((0.0, 0.0, -1.0), SUPINE).letters == ("R", "L", "S", "I")


def test_a_path_along_the_body_takes_the_anterior_direction_as_up():
    frame = path_frame(SUPINE @ (0.0, 0.0, 1.0), SUPINE)
    assert not frame.axial
    assert frame.letters[2:] == ("A", "P")


def test_letters_name_the_larger_share_first():
    assert direction_letters((1, 0, 0)) == "L"
    assert direction_letters((-0.6, -0.8, 0)) == "AR"
    assert direction_letters((0.1, 0.1, -1)) == "I"


@quiet
@given(st.floats(0.02, 0.25), st.floats(0.001, 0.02), st.floats(0, pi / 2), st.floats(0, pi / 2))
def test_the_scale_is_monotone_and_invertible(length, tolerance, a, b):
    scale = PadScale(length, tolerance)
    assert np.isclose(scale.angle(scale.radius(a)), a, atol=1e-12)
    if a < b:
        assert scale.radius(a) <= scale.radius(b)
    assert np.isclose(scale.radius(pi / 2), 1.0)


@quiet
@given(st.floats(0, 45), st.floats(0, 2 * pi), st.floats(0, 39), st.floats(0, 2 * pi))
def test_place_and_direction_are_inverse_over_the_whole_cone(a, b, c, d):
    frame, scale = path_frame(cone(c, d), SUPINE), PadScale(0.08, 0.002)
    needle = cone(a, b)
    place = scale.place(frame.tilts(needle))
    assert np.allclose(frame.direction(scale.tilts(place)), needle, atol=1e-12)


def test_a_needle_that_pierces_the_target_plane_on_a_ring_is_drawn_on_that_ring():
    frame, scale = path_frame((0.1, 0.2, -1.0), SUPINE), PadScale(0.08, 0.002)
    tilts = np.array([0.03, -0.05])
    needle = frame.direction(tilts)
    pierced = needle * scale.length / (needle @ frame.axis)
    offset = frame.offset(pierced, np.zeros(3))
    assert np.allclose(scale.place_of_offset(offset), scale.place(tilts), atol=1e-14)
    assert np.isclose(np.hypot(*offset), scale.offset_of_angle(np.hypot(*tilts)))


def test_the_scale_follows_its_formula():
    scale = PadScale(0.1, 0.002)
    knee = np.arctan(0.02)
    assert np.isclose(scale.radius(0.3), asinh(0.3 / knee) / asinh(pi / 2 / knee))
    assert np.isclose(scale.angle(0.5), knee * sinh(0.5 * asinh(pi / 2 / knee)))
    assert np.isclose(scale.offset_of_angle(0.3), 0.1 * tan(0.3))


@pytest.mark.long("journey")
@quiet
@given(st.tuples(finite, finite, finite), st.floats(0, 1.2))
def test_the_cone_keeps_directions_inside_and_bounds_the_rest(direction, limit):
    if np.linalg.norm(direction) < 1e-3:
        return
    kept = clamp_to_cone(direction, limit)
    assert np.isclose(np.linalg.norm(kept), 1.0)
    assert angle_between(kept, (0, 0, -1)) <= limit + 1e-12
    if angle_between(direction, (0, 0, -1)) <= limit:
        assert angle_between(kept, direction) < 1e-12


def test_straight_up_is_clamped_to_a_finite_direction_on_the_cone():
    kept = clamp_to_cone((0, 0, 1), radians(39))
    assert np.isclose(angle_between(kept, (0, 0, -1)), radians(39))


def test_horizontal_components_give_the_downward_direction():
    assert np.allclose(downward(0.6, 0.0), (0.6, 0.0, -0.8))
    assert np.allclose(downward(asin(1.0), 0.0)[2], 0.0)


@pytest.mark.parametrize("bad", [(0, 0, 0), (np.nan, 0, 1), (np.inf, 0, 0)])
def test_a_direction_that_is_none_is_refused(bad):
    with pytest.raises(NumericalError):
        path_frame((0, 0, -1), SUPINE).tilts(bad)


def test_a_scale_without_length_or_tolerance_is_refused():
    for length, tolerance in ((0.0, 0.002), (0.08, 0.0), (np.nan, 0.002), (0.08, np.inf)):
        with pytest.raises(NumericalError, match="path length"):
            PadScale(length, tolerance)
    with pytest.raises(NumericalError, match="tilt limit"):
        clamp_to_cone((0, 0, -1), pi / 2)


@pytest.mark.parametrize(
    ("direction", "expected"),
    [
        ((0.0, 1.0, 0.0), (90.0, 0.0)),
        ((1.0, 0.0, 0.0), (0.0, 0.0)),
        ((-1.0, 0.0, 0.0), (0.0, 0.0)),
        ((0.0, -1.0, 0.0), (90.0, 0.0)),
        ((-1.0, 1.0, 0.0), (-45.0, 0.0)),
        ((0.0, 1.0, 1.0), (90.0, 45.0)),
        ((0.0, 0.0, -1.0), (0.0, -90.0)),
    ],
)
def test_ct_angles_are_those_that_one_sets_in_the_axial_slice(direction, expected):
    assert ct_angles(direction) == pytest.approx(expected, abs=1e-9)


def test_ct_angles_follow_the_patient_not_the_table():
    turn = rotation_exp([0.2, -0.4, 0.9])
    world = turn @ np.array([0.3, 0.8, -0.2])
    frame = path_frame(world, turn)
    assert frame.ct_angles(world) == pytest.approx(ct_angles((0.3, 0.8, -0.2)))


def aside(frame, right, up):
    across = right * frame.right + up * frame.up
    return Offset(float(np.hypot(right, up)), 0.0, 0.0, 0.0, across, frame.axis)


def test_how_far_off_the_path_names_no_side_that_could_speak_against_the_dot():
    frame = path_frame((0.0, 0.0, -1.0), SUPINE)
    assert lateral(aside(frame, 0.003, -0.004)) == "off the path: 5.0 mm"
    assert lateral(aside(frame, 0.0, 0.0)) == "off the path: 0.0 mm"
