"""The hand at its edges: whatever it is asked, a bounded answer or a named error, and no jump."""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.arm.hand import (
    OVERSHOOT,
    ClosureWay,
    Contacts,
    Coupling,
    FirmGrasp,
    HandFinger,
    Lever,
    SoftContact,
    ToolShaft,
    branches,
    close_hand,
    driven,
    force_closure,
    forward,
    heights,
    inverse,
    jacobian,
    load_hand,
    pair_closed,
    press,
)
from app.arm.hand.errors import GraspError
from app.core.errors import AcusError, NumericalError
from app.mechanisms.errors import MechanismError, UnreachableError

HAND = load_hand().hand
RELAXED = settings(derandomize=True, deadline=None, max_examples=150)
QUICK = settings(derandomize=True, deadline=None, max_examples=40)
anything = st.floats(allow_nan=True, allow_infinity=True)
links = st.floats(0.03, 0.12)
coordinates = st.floats(-0.3, 0.3)
numbers = st.floats(-1.0, 1.0)


def finite(*arrays) -> bool:
    return all(np.isfinite(np.asarray(a, float)).all() for a in arrays)


@RELAXED
@given(st.tuples(anything, anything, anything), anything)
def test_any_point_gets_finite_joints_or_a_named_error(p, phi1_now):
    for finger in HandFinger:
        try:
            pose = inverse(HAND, p, finger, phi1_now if np.isfinite(phi1_now) else 0.0)
        except (UnreachableError, NumericalError):
            continue
        assert finite(pose.joints, pose.spread)
        assert np.linalg.norm(forward(HAND, pose.joints) - p) < 1e-9


@RELAXED
@given(st.tuples(coordinates, coordinates, coordinates))
def test_whatever_is_answered_is_within_the_limits_and_holds_the_point(p):
    for finger in HandFinger:
        for pose in branches(HAND, p, finger):
            if pose.refused:
                assert pose.coupling is Coupling.NEVER
                continue
            assert forward(HAND, pose.joints) == pytest.approx(np.array(p), abs=1e-9)
            assert -1e-6 <= pose.joints[1] <= HAND.most_proximal + 1e-6
            assert -1e-6 <= pose.joints[2] <= HAND.most_distal + 1e-6


@RELAXED
@given(st.floats(0.075, 0.105), st.floats(1e-300, 1e-3), st.floats(-np.pi, np.pi))
def test_near_the_spread_axis_joints_2_and_3_do_not_jump(height, beside, turn):
    """The plane of the finger turns at once there; the angles in it stay."""
    on = inverse(HAND, (0.0, 0.0, height))
    off = inverse(HAND, (beside * np.cos(turn), beside * np.sin(turn), height))
    assert np.abs(on.joints[1:] - off.joints[1:]).max() <= 100.0 * beside + 1e-12
    assert finite(jacobian(HAND, off.joints))


@RELAXED
@given(links, links, st.floats(0.001, 3.0), st.integers(-4, 4))
def test_a_stretched_finger_is_straight_some_bits_beyond_its_length(l2, l3, turn, bits):
    """The argument of the arccos is 1, or some units in the last place off."""
    straight = replace(
        HAND, proximal=l2, distal=l3, pad=0.0, bend=0.0, most_proximal=np.pi, most_distal=np.pi
    )
    reach = (l2 + l3) * (1.0 + bits * 2.0**-52)
    p = (HAND.knuckle + reach * np.cos(turn), 0.0, reach * np.sin(turn))
    pose = inverse(straight, p, HandFinger.THREE)
    room = 2e-7  # √ε of the coordinates' last bits, over the shorter link
    assert abs(pose.joints[2]) <= room
    assert abs(pose.joints[1] - turn) <= room


@RELAXED
@given(anything, st.none() | anything)
def test_any_angle_of_the_motor_gives_joints_or_a_named_error(motor, broken_at):
    try:
        phi2, phi3 = driven(HAND, motor, broken_at)
    except MechanismError:
        return
    assert finite(phi2, phi3)
    assert phi3 >= HAND.coupling * phi2 * (1.0 - 1e-12)


@RELAXED
@given(
    st.tuples(coordinates, coordinates, coordinates),
    st.tuples(numbers, numbers, numbers),
    st.floats(-0.01, 0.2),
    st.floats(-0.5, 3.5),
)
def test_any_tool_is_touched_on_its_surface_or_refused_by_name(position, axis, diameter, spread):
    try:
        tool = ToolShaft(position, axis, diameter)
        grasp = close_hand(HAND, tool, spread)
    except (GraspError, NumericalError):
        return
    for touch in grasp.touches:
        away = touch.point - tool.position
        across = away - tool.axis * (away @ tool.axis)
        assert np.linalg.norm(across) == pytest.approx(diameter / 2, abs=1e-9)
        assert finite(touch.joints, touch.normal)


@QUICK
@given(st.floats(0.0, 0.4))
def test_any_thickness_has_a_height_to_grip_it_at_or_a_reason(radius):
    try:
        least, most = heights(HAND, radius)
    except GraspError:
        assert radius > 0.1
        return
    assert -HAND.joint_height < least <= most < 0.12


def pair(turn_one: float, turn_two: float, mu: float, radius: float = 1.0) -> Contacts:
    points = radius * np.array([(-1.0, 0.0), (1.0, 0.0)])
    turns = np.array([turn_one, np.pi + turn_two])
    return Contacts(points, np.column_stack([np.cos(turns), np.sin(turns)]), mu)


@RELAXED
@given(numbers, numbers, st.floats(1e-8, 2.0), st.floats(1e-6, 1e3))
def test_hull_and_closed_form_agree_on_every_pair_however_slight_or_small(one, two, mu, radius):
    contacts = pair(one, two, mu, radius)
    edge = min(abs(abs(turn) - np.arctan(mu)) for turn in (one, two))
    hull = force_closure(contacts)
    closed = force_closure(contacts, way=ClosureWay.PAIR)
    assert hull.margin == pytest.approx(closed.margin, rel=1e-6, abs=1e-15)
    if edge > 1e-9 * mu:
        assert hull.closed is pair_closed(contacts)


@pytest.mark.long("machine")
@RELAXED
@given(numbers, st.floats(0.01, 2.0), st.floats(-1e-3, 1e-3))
def test_the_margin_does_not_jump_where_a_grasp_opens(turn, mu, step):
    before, after = (force_closure(pair(t, 0.0, mu)).margin for t in (turn, turn + step))
    assert abs(before - after) <= 3.0 * (1.0 + mu) * abs(step) + 1e-12


@pytest.mark.long("machine")
@RELAXED
@given(
    st.lists(st.tuples(numbers, numbers, numbers), min_size=1, max_size=4),
    st.lists(st.tuples(numbers, numbers, numbers), min_size=4, max_size=4),
    st.floats(-0.1, 2.0),
    st.sampled_from([0.0, 1e-9, 0.1]),
)
def test_any_contacts_give_a_margin_between_0_and_1_or_a_named_error(points, normals, mu, soft):
    try:
        contacts = Contacts(np.array(points), np.array(normals)[: len(points)], mu, soft)
        found = force_closure(contacts, edges=4)
    except AcusError:
        return
    assert 0.0 <= found.margin <= 1.0 + 1e-12
    assert found.closed is (found.margin > 0.0)
    assert found.closed is (found.reason == "")
    assert not (found.closed and found.rank < 6)


@QUICK
@given(st.lists(numbers, min_size=3, max_size=4), st.floats(0.0, 2.0), st.floats(0.0, 2 * np.pi))
def test_hard_contacts_on_one_line_never_close(places, mu, turn):
    line = np.array([0.6, 0.0, 0.8])
    u, v = np.array([0.0, 1.0, 0.0]), np.cross(line, (0.0, 1.0, 0.0))
    across = np.cos(turn) * u + np.sin(turn) * v
    signs = np.resize((1.0, -1.0), len(places))
    try:
        contacts = Contacts(np.outer(places, line), np.outer(signs, across), mu)
        found = force_closure(contacts)
    except GraspError:
        return  # all in one point
    assert (found.closed, found.margin) == (False, 0.0)
    assert found.rank < 6


@QUICK
@given(st.lists(st.tuples(numbers, numbers), min_size=2, max_size=5), st.floats(0.0, 5.0))
def test_parallel_normals_never_close(points, mu):
    normals = np.tile((0.6, 0.8), (len(points), 1))
    try:
        found = force_closure(Contacts(np.array(points), normals, mu))
    except GraspError:
        return
    assert (found.closed, found.margin) == (False, 0.0)


LEVER = Lever(free=8e-4, alone=3e-4, arm=0.09, breakaway=0.5)


@pytest.mark.long("machine")
@QUICK
@given(
    st.floats(0.1, 20.0),
    st.floats(1.0, 8.0),
    st.floats(0.0, 0.05),
    st.floats(1e-4, 0.05),
    st.floats(1e-3, 0.05),
    st.floats(0.05, 1.0),
)
def test_no_press_overshoots_whatever_it_meets(goal, decade, relaxation, period, lag, softer):
    stiffness = 10.0**decade
    law = FirmGrasp(goal, LEVER, SoftContact(stiffness, relaxation * stiffness), lag, period, 300.0)
    met = SoftContact(softer * stiffness, softer * relaxation * stiffness, gap=1e-9)
    found = press(law, met, 3000 * period)
    assert finite(found.force, found.travel)
    assert found.force.min() >= 0.0
    assert found.overshoot(goal) <= OVERSHOOT


@RELAXED
@given(st.tuples(*[anything] * 6))
def test_impossible_presses_have_a_named_error(values):
    goal, stiffness, damping, lag, period, gain = values
    try:
        law = FirmGrasp(goal, LEVER, SoftContact(stiffness, damping), lag, period, 300.0, gain)
    except AcusError:
        return
    assert law.used_gain > 0.0


def test_a_press_begins_and_ends_bounded_where_joint_2_lets_go_at_the_goal():
    """The goal is the very force at which the breakaway is reached."""
    goal = LEVER.breakaway / LEVER.arm
    for off in (-1e-12, 0.0, 1e-12):
        law = FirmGrasp(goal * (1.0 + off), LEVER, SoftContact(1e4), 0.01, 0.002, 300.0)
        found = press(law, SoftContact(1e4), 3.0)
        assert found.force[-1] == pytest.approx(goal, rel=1e-6)
