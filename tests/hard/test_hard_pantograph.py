"""The pantograph where it is singular, out of reach, vertical, huge or not a number."""

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.mechanisms.errors import (
    DegenerateError,
    MechanismError,
    NotFiniteError,
    SingularError,
    UnreachableError,
)
from app.mechanisms.pantograph import (
    Geometry,
    felt_force,
    force_map,
    forward,
    inverse,
    jacobian,
    joint_torques,
    lever_map,
    needle_at,
    printed_force,
    system_forward,
    system_inverse,
    tool_force,
)
from app.mechanisms.profile import load_profile

GEOMETRY = load_profile("icube").pantograph
RELAXED = settings(derandomize=True, deadline=None, max_examples=200)
MEETING = np.arccos(GEOMETRY.base / (2.0 * GEOMETRY.proximal))
anything = st.floats(allow_nan=True, allow_infinity=True)


def test_coincident_elbows_are_named_singular():
    with pytest.raises(SingularError, match="singular"):
        forward(GEOMETRY, (MEETING, np.pi - MEETING))


def test_elbows_too_far_apart_are_named_unreachable():
    wide = Geometry(0.2, 0.165, 0.085, GEOMETRY.fulcrum, 0.2)
    with pytest.raises(UnreachableError):
        forward(wide, (np.pi, 0.0))


def test_elbows_exactly_two_links_apart_are_stretched_not_unreachable():
    wide = Geometry(0.1225, 0.165, 0.085, GEOMETRY.fulcrum, 0.2)
    assert forward(wide, (np.pi, 0.0)) == pytest.approx([0.0, 0.0], abs=1e-7)
    with pytest.raises(SingularError):
        jacobian(wide, (np.pi, 0.0))


def test_an_arm_stretched_to_its_very_end_is_reached():
    reach = GEOMETRY.proximal + GEOMETRY.distal
    one_axis = Geometry(0.1, 0.165, 1e-12, GEOMETRY.fulcrum, 0.2)
    for turn in (0.3, 0.9, 1.4):
        p3 = reach * np.array([np.cos(turn), np.sin(turn)]) * (1.0 - 1e-9)
        assert inverse(one_axis, p3) == pytest.approx([turn, turn], abs=1e-3)
    with pytest.raises(UnreachableError):
        inverse(GEOMETRY, (-GEOMETRY.base / 2, reach * (1.0 + 1e-9)))


def test_a_point_on_a_motor_axis_is_named():
    with pytest.raises(DegenerateError):
        inverse(GEOMETRY, (-GEOMETRY.base / 2, 0.0))


def test_each_working_mode_round_trips_in_the_assembly_in_which_it_closes():
    """Elbows outwards close in assembly +1 at the middle, crossed elbows in -1."""
    p3 = GEOMETRY.fulcrum[:2]
    for mode, assembly in (((1, -1), 1), ((-1, 1), -1)):
        q = inverse(GEOMETRY, p3, mode)
        assert forward(GEOMETRY, q, assembly) == pytest.approx(p3, abs=1e-14)
        assert np.linalg.norm(forward(GEOMETRY, q, -assembly) - p3) > 0.01


def test_a_vertical_needle_is_regular_in_every_map():
    needle = needle_at(GEOMETRY, GEOMETRY.fulcrum[:2], 0.11)
    assert needle.axis.tolist() == [0.0, 0.0, -1.0]
    gain = -needle.l_out / needle.l_in
    assert lever_map(needle) == pytest.approx(np.array([[gain, 0], [0, gain], [0, 0]]))
    for law in (force_map, printed_force):
        assert law(needle, (1.0, 2.0, 7.0)) == pytest.approx([gain, 2.0 * gain])


def test_nothing_jumps_as_the_needle_passes_through_the_vertical():
    force = np.array([1.0, -2.0, 0.5])
    previous = None
    for offset in np.linspace(-1e-9, 1e-9, 21):
        needle = needle_at(GEOMETRY, GEOMETRY.fulcrum[:2] + offset * np.array([1.0, 0.3]), 0.11)
        gamma = force_map(needle, force)
        assert previous is None or np.abs(gamma - previous).max() < 1e-8
        previous = gamma


def test_no_lever_jump_where_both_arms_of_the_needle_are_equal():
    for l_out in np.array([1.0 - 1e-9, 1.0, 1.0 + 1e-9]) * GEOMETRY.fulcrum[2]:
        needle = needle_at(GEOMETRY, GEOMETRY.fulcrum[:2], l_out)
        assert force_map(needle, (1.0, 0.0, 0.0)) == pytest.approx([-1.0, 0.0], abs=1e-8)


def test_a_hub_at_level_or_below_the_fulcrum_is_named():
    x, y, z = GEOMETRY.fulcrum
    with pytest.raises(DegenerateError):
        system_inverse(GEOMETRY, (x, y, z))
    for hub in ((x + 0.1, y, z), (x, y, z - 0.05)):
        with pytest.raises(UnreachableError):
            system_inverse(GEOMETRY, hub)


def test_a_needle_in_the_plane_of_the_links_is_named_by_the_force_maps():
    flat = needle_at(GEOMETRY, GEOMETRY.fulcrum[:2], 0.1)
    object.__setattr__(flat, "axis", np.array([1.0, 0.0, 0.0]))
    for law in (force_map, printed_force):
        with pytest.raises(DegenerateError):
            law(flat, (1.0, 0.0, 0.0))
    with pytest.raises(DegenerateError):
        felt_force(flat, (1.0, 0.0))


def test_a_jacobian_without_rank_has_no_tool_force():
    with pytest.raises(SingularError):
        tool_force([[1.0, 2.0], [2.0, 4.0]], (0.1, 0.1))
    with pytest.raises(SingularError):
        tool_force(np.zeros((2, 2)), (0.1, 0.1))


def test_the_printed_law_is_bounded_by_the_lever_over_the_height():
    for tilt in np.radians([10.0, 45.0, 70.0, 89.0]):
        needle = needle_at(
            GEOMETRY,
            GEOMETRY.fulcrum[:2] + GEOMETRY.fulcrum[2] * np.tan(tilt) * np.array([1, 0]),
            0.1,
        )
        for turn in np.linspace(0.0, 3.0, 7):
            force = np.array([np.cos(turn), np.sin(turn), 0.0])
            force -= needle.axis * np.dot(needle.axis, force)
            force /= max(np.linalg.norm(force), 1e-12)
            bound = needle.l_out / GEOMETRY.fulcrum[2] * (1.0 + 1e-12)
            assert np.linalg.norm(printed_force(needle, force)) <= bound


@RELAXED
@given(anything, anything)
def test_forward_and_jacobian_answer_finite_or_raise_by_name(q1, q2):
    try:
        p3 = forward(GEOMETRY, (q1, q2))
        assert np.isfinite(p3).all()
        assert np.isfinite(jacobian(GEOMETRY, (q1, q2))).all()
        assert np.isfinite(system_forward(GEOMETRY, (q1, q2), 0.1).hub).all()
    except MechanismError:
        return


@RELAXED
@given(anything, anything, anything)
def test_inverses_answer_finite_or_raise_by_name(x, y, z):
    for solve, point in ((inverse, (x, y)), (lambda g, p: system_inverse(g, p)[0], (x, y, z))):
        try:
            assert np.isfinite(solve(GEOMETRY, point)).all()
        except MechanismError:
            continue


@pytest.mark.parametrize("bad", [np.nan, np.inf, -np.inf])
def test_what_is_not_a_number_is_named(bad):
    for call in (
        lambda: forward(GEOMETRY, (bad, 0.5)),
        lambda: jacobian(GEOMETRY, (2.6, bad)),
        lambda: inverse(GEOMETRY, (bad, 0.1)),
        lambda: system_inverse(GEOMETRY, (0.0, bad, 0.2)),
    ):
        with pytest.raises(NotFiniteError, match="not finite"):
            call()


def test_wrong_shapes_are_named():
    with pytest.raises(MechanismError, match=r"shape \(3,\); \(2,\) is needed"):
        forward(GEOMETRY, (1.0, 2.0, 3.0))
    with pytest.raises(MechanismError, match=r"\(2, 2\) is needed"):
        joint_torques(np.eye(3), (1.0, 2.0))
    with pytest.raises(MechanismError, match=r"\(3,\) is needed"):
        force_map(needle_at(GEOMETRY, (0.0, 0.16), 0.1), (1.0, 2.0))
