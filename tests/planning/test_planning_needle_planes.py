import numpy as np
import pytest
from numpy.testing import assert_allclose

from app.core.errors import NumericalError
from app.planning.needle_planes import (
    Reference,
    follow,
    frame_of,
    in_plane,
    in_plane_90,
    probe,
    through,
)

TIP = np.array([10.0, -20.0, 30.0])
DOWN = np.array([0.0, 1.0, 0.0])  # towards the back, as through the chest of a patient who lies


def letters(frame):
    found = frame.letters()
    return found.left, found.right, found.top, found.bottom


def test_a_needle_in_an_axial_slice_is_seen_as_in_the_axial_view():
    assert letters(in_plane(frame_of(TIP, DOWN))) == ("R", "L", "A", "P")


def test_at_a_right_angle_to_it_the_view_is_sagittal_with_the_needle_pointing_down():
    assert letters(in_plane_90(frame_of(TIP, DOWN))) == ("I", "S", "A", "P")


def test_the_probe_looks_along_the_needle_with_the_head_on_top():
    frame = probe(frame_of(TIP, DOWN))
    assert letters(frame) == ("R", "L", "S", "I")
    assert_allclose(frame.normal, DOWN, atol=1e-12)


def test_the_three_planes_meet_at_the_tip_and_stand_at_right_angles():
    needle = frame_of(TIP, [0.3, 0.8, -0.4])
    frames = in_plane(needle), in_plane_90(needle), probe(needle)
    for frame in frames:
        assert_allclose(frame.point(TIP), (0.0, 0.0, 0.0), atol=1e-12)
    normals = np.stack([frame.normal for frame in frames])
    assert_allclose(normals @ normals.T, np.eye(3), atol=1e-12)
    hub = TIP - 100.0 * needle.axis
    assert_allclose(in_plane(needle).point(hub), (0.0, -100.0, 0.0), atol=1e-9)
    assert_allclose(in_plane_90(needle).point(hub), (0.0, -100.0, 0.0), atol=1e-9)


def test_the_probe_goes_ahead_of_the_tip():
    needle = frame_of(TIP, DOWN)
    assert_allclose(probe(needle, 15.0).origin_mm, TIP + 15.0 * DOWN)


def test_a_needle_along_the_body_takes_anterior_for_superior():
    needle = frame_of(TIP, [0.0, 0.0, -1.0])
    assert needle.reference is Reference.ANTERIOR
    assert_allclose(needle.y, (0.0, -1.0, 0.0), atol=1e-12)


def test_nothing_changes_within_the_dead_bands():
    needle = frame_of(TIP, DOWN)
    assert follow(needle, TIP + [0.2, 0.0, 0.0], DOWN + [0.004, 0.0, 0.0]) is needle


def test_the_tip_alone_moves_without_turning_the_planes():
    needle = frame_of(TIP, DOWN)
    moved = follow(needle, TIP + 5.0 * DOWN, DOWN + [0.004, 0.0, 0.0])
    assert_allclose(moved.tip_mm, TIP + 5.0 * DOWN)
    assert_allclose(moved.axis, needle.axis)


def test_a_plane_through_two_points_holds_both_and_the_view_they_were_clicked_in():
    a, b, normal = TIP, TIP + [30.0, 40.0, 0.0], np.array([0.0, 0.0, 1.0])
    frame = in_plane(through(a, b, normal))
    assert_allclose(frame.point(a)[2], 0.0, atol=1e-12)
    assert_allclose(frame.point(b)[2], 0.0, atol=1e-12)
    assert_allclose(frame.point(b + 10.0 * normal)[2], 0.0, atol=1e-12)


def test_two_points_one_behind_the_other_still_give_a_plane():
    frame = in_plane(through(TIP, TIP + [0.0, 0.0, 9.0], [0.0, 0.0, 1.0]))
    assert frame.point(TIP)[2] == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize("end", [TIP, TIP + [0.4, 0.0, 0.0]])
def test_points_on_one_spot_are_refused(end):
    with pytest.raises(NumericalError, match="apart"):
        through(TIP, end, [0.0, 0.0, 1.0])


@pytest.mark.parametrize("axis", [(0, 0, 0), (np.nan, 0, 1), (np.inf, 0, 0)])
def test_a_needle_without_a_direction_is_refused(axis):
    with pytest.raises(NumericalError):
        frame_of(TIP, axis)
    with pytest.raises(NumericalError):
        follow(frame_of(TIP, DOWN), TIP, axis)


def test_a_tip_that_is_nowhere_is_refused():
    with pytest.raises(NumericalError, match="tip_mm"):
        follow(frame_of(TIP, DOWN), [np.nan, 0.0, 0.0], DOWN)
