"""The angles that one sets at a CT, through ±90° and along the body, read on without a jump."""

from math import cos, radians, sin

import numpy as np
import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st

from app.core.rotation import rotation_exp
from app.session.pad.geometry import ct_angles, path_frame
from app.views.exercise.bullseye import STEEPEST_DEG, ct_words

hard = settings(derandomize=True, deadline=None, max_examples=300)
turns = st.floats(-720.0, 720.0)
steep = st.floats(-84.0, 84.0)
STEP_DEG = 0.05


def needle(in_plane_deg, out_of_plane_deg):
    a, b = radians(in_plane_deg), radians(out_of_plane_deg)
    return np.array([cos(b) * cos(a), cos(b) * sin(a), sin(b)])


@hard
@given(turns, steep)
@example(90.0, 0.0)
@example(-90.0, 0.0)
@example(270.0, 84.0)
def test_a_needle_that_swings_round_its_path_reads_on_by_as_much_as_it_swings(turn, rise):
    path, _ = ct_angles(needle(turn, rise))
    assert -90.0 < path <= 90.0
    for away in np.arange(-89.0, 89.0, 7.3):
        in_plane, out_of_plane = ct_angles(needle(turn + away, rise), path)
        assert in_plane - path == pytest.approx(away, abs=1e-7)
        assert out_of_plane == pytest.approx(rise, abs=1e-9)


@hard
@given(turns, st.floats(-80.0, 80.0), st.floats(-40.0, 40.0), st.floats(-6.0, 6.0))
@example(90.0, 0.0, 0.0, 0.0)
@example(-90.0, 0.0, 1e-9, -1e-9)
def test_small_steps_of_a_needle_beside_its_path_make_small_steps_of_its_angles(
    turn, rise, aside, higher
):
    near, _ = ct_angles(needle(turn, rise))
    here, there = (turn + aside, rise + 0.5 * higher), (turn + aside + STEP_DEG, rise + STEP_DEG)
    first, second = (ct_angles(needle(*at), near) for at in (here, (there[0], here[1] + STEP_DEG)))
    assert second[0] - first[0] == pytest.approx(STEP_DEG, abs=1e-7)
    assert second[1] - first[1] == pytest.approx(STEP_DEG, abs=1e-7)


@hard
@given(turns, st.floats(-90.0, 90.0), st.floats(-300.0, 300.0))
@example(90.0, 90.0, 0.0)
@example(0.0, -90.0, 90.0)
def test_the_same_line_has_the_same_angle_whichever_way_it_is_read(turn, rise, near):
    in_plane, out_of_plane = ct_angles(needle(turn, rise), near)
    assert near - 90.0 - 1e-9 <= in_plane <= near + 90.0 + 1e-9
    assert out_of_plane == pytest.approx(rise, abs=1e-6)
    plain, _ = ct_angles(needle(turn, rise))
    if abs(rise) < 89.9:
        assert (in_plane - plain + 1e-6) % 180.0 == pytest.approx(1e-6, abs=2e-6)


def test_along_the_body_the_angle_in_the_slice_is_the_paths():
    assert ct_angles((0.0, 0.0, 1.0), 37.0) == (37.0, 90.0)
    assert ct_angles((0.0, 0.0, -1.0)) == (0.0, -90.0)


@pytest.mark.parametrize("turn", [np.eye(3), rotation_exp([0.2, -0.4, 0.9])])
def test_what_is_said_of_an_upright_path_does_not_jump_from_one_side_to_the_other(turn):
    """The usual path: straight from the front to the back, ±90° in the axial slice."""
    rest = path_frame(turn @ needle(90.0, 0.0), turn)
    for breath in (-0.3, 0.0, 0.3):  # a target that moves takes its path through 90° as well
        now = path_frame(turn @ needle(90.0 + breath, 0.0), turn)
        for away in (-2.0, -0.1, 0.1, 2.0):
            words = ct_words(now, turn @ needle(90.0 + away, 0.0), rest)
            assert f"in plane {90.0 + away:+.1f}° (path {90.0 + breath:+.1f}°)" in words


def test_along_the_body_no_angle_in_the_slice_is_said():
    frame = path_frame(needle(30.0, STEEPEST_DEG + 1.0), np.eye(3))
    words = ct_words(frame, needle(30.0, STEEPEST_DEG - 1.0))
    assert words.startswith("CT angles: in plane +30.0° (path –)")
