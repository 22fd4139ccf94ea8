"""The arm where its angles are not defined and where reach or limits end.

Bounded answers or named errors, never NaN; the pose is met wherever an answer is given.
"""

from dataclasses import replace

import numpy as np
import pytest
from hypothesis import assume, given
from hypothesis import strategies as st

from app.arm.mechanics import (
    ARM_BRANCHES,
    ArmSingularity,
    JointLimitError,
    arm_angle,
    arm_branch,
    decoupled,
    feasible,
    forward,
    inverse,
    load_arm,
    nearest_pose,
    reach,
    solve,
)
from app.arm.mechanics.kernels import forward_kernel
from app.arm.mechanics.least_squares import twist_kernel
from app.arm.mechanics.redundancy import SCRATCH, TOLD, solve_kernel
from app.core.transform import RigidTransform
from app.mechanisms.errors import DegenerateError, MechanismError, UnreachableError
from app.mechanisms.status import NOT_FINITE

ARM = load_arm()
SHOULDER = np.array([0.0, 0.0, ARM.pedestal])
OUTER = ARM.upper_arm + ARM.forearm

small = st.integers(0, 17).map(lambda k: 0.0 if k == 17 else 10.0**-k)
signs = st.sampled_from((-1.0, 1.0))
special = st.sampled_from((-2.0, -1.0, -0.5, 0.0, 0.5, 1.0, 2.0)).map(lambda k: 0.5 * np.pi * k)
turns = st.one_of(
    special,
    st.floats(-np.pi, np.pi, exclude_min=True),
    st.builds(lambda at, off, sign: at + sign * off, special, small, signs),
)
postures = st.lists(turns, min_size=7, max_size=7).map(lambda q: np.clip(q, ARM.lower, ARM.upper))
branches = st.sampled_from(ARM_BRANCHES)
directions = st.tuples(*[st.floats(-1.0, 1.0)] * 3).filter(lambda v: np.linalg.norm(v) > 0.1)


def missed(q, there):
    return np.abs(forward(ARM, q).matrix() - there.matrix()).max()


def at(direction, distance):
    away = np.array(direction) / np.linalg.norm(direction)
    return RigidTransform(np.eye(3), SHOULDER + distance * away)


@pytest.mark.long("machine")
@given(postures)
def test_every_posture_within_limits_is_solved_however_aligned_it_is(q):
    there = forward(ARM, q)
    found = solve(ARM, there)
    assert ARM.allows(found.q)
    assert missed(found.q, there) < 1e-10


@given(postures, turns, branches)
def test_every_arm_angle_of_every_branch_meets_the_pose_however_aligned_it_is(q, angle, branch):
    there = forward(ARM, q)
    found = inverse(ARM, there, angle, branch)
    assert missed(found.q, there) < 3e-12
    assert (np.abs(found.q) <= np.pi).all()


@pytest.mark.long("statistics")
@given(postures)
def test_all_eight_decoupled_solutions_meet_the_pose_however_aligned_it_is(q):
    there = forward(ARM, q)
    for one in decoupled(ARM, there, keep=(0.4, -0.3)):
        assert missed(one.q, there) < 3e-12
        assert one.q[2] == 0.0


@pytest.mark.long("machine")
@given(postures)
def test_a_posture_with_its_own_angles_kept_comes_back_to_what_is_defined(q):
    there = forward(ARM, q)
    back = inverse(ARM, there, arm_angle(ARM, q), arm_branch(q), keep=(q[0], q[4]))
    assert missed(back.q, there) < 3e-12
    regular = np.abs(np.sin(q[[1, 3, 5]])).min() > 1e-3
    aside = np.hypot(*there.translation[:2])
    if regular and aside > 1e-3:
        off = np.abs((back.q - q + np.pi) % (2.0 * np.pi) - np.pi).max()
        assert off < 1e-9


@pytest.mark.long("machine")
@given(st.integers(0, 17), st.floats(-np.pi, np.pi), st.floats(0.45, 0.8))
def test_towards_the_first_axis_the_pose_is_met_at_every_distance(k, azimuth, rise):
    aside = 0.0 if k == 17 else 10.0 ** -(k + 1)
    place = SHOULDER + [aside * np.cos(azimuth), aside * np.sin(azimuth), rise]
    there = RigidTransform(forward(ARM, np.full(7, 0.4)).rotation, place)
    for one in decoupled(ARM, there, keep=(0.3, 0.0)):
        assert missed(one.q, there) < 3e-12
        on_axis = np.hypot(*place[:2]) <= 1e-12 * rise
        assert (ArmSingularity.FIRST_AXIS in one.singular) == on_axis


@pytest.mark.long("statistics")
@given(directions, st.integers(3, 16), st.booleans())
def test_across_the_outer_skin_there_is_an_answer_or_a_named_error(direction, k, inside):
    distance = OUTER * (1.0 - 10.0**-k if inside else 1.0 + 10.0**-k)
    there = at(direction, distance)
    if not inside and k <= 11:
        with pytest.raises(UnreachableError):
            solve(ARM, there)
    try:
        found = solve(ARM, there)
    except (UnreachableError, JointLimitError):
        offer = nearest_pose(ARM, there)
        assert ARM.allows(offer.solution.q)
        assert missed(offer.solution.q, offer.T_base_wrist) < 1e-10
    else:
        assert missed(found.q, there) < 1e-10


@given(directions, st.integers(3, 16), st.booleans())
def test_across_the_inner_skin_there_is_an_answer_or_a_named_error(direction, k, inside):
    shell = reach(ARM)
    distance = shell.inner * (1.0 - 10.0**-k if inside else 1.0 + 10.0**-k)
    there = at(direction, distance)
    try:
        found = solve(ARM, there)
    except JointLimitError:
        return
    assert not inside or k >= 10
    assert ARM.allows(found.q)
    assert missed(found.q, there) < 1e-10


@given(postures, st.lists(st.booleans(), min_size=7, max_size=7))
def test_with_joints_at_their_limits_the_pose_is_still_solved(q, at_limit):
    q = np.where(at_limit, np.where(q >= 0.0, ARM.upper, ARM.lower), q)
    there = forward(ARM, q)
    found = solve(ARM, there)
    assert ARM.allows(found.q)
    assert missed(found.q, there) < 1e-10


@pytest.mark.long("machine")
@given(st.floats(0.0, 0.1), st.floats(-0.8, -0.3), st.floats(0.2, 1.0))
def test_a_pose_with_one_arm_angle_only_is_solved_there(first, fourth, sixth):
    """Joint 2 at its limit and the elbow at its highest: every other arm angle is beyond."""
    q = np.array([first, ARM.upper[1], 0.0, fourth, 0.05, sixth, 0.1])
    there = forward(ARM, q)
    found = solve(ARM, there)
    assert np.abs(found.q - q).max() < 1e-6
    assert missed(found.q, there) < 1e-10
    (interval,) = feasible(ARM, there, arm_branch(q))
    assert abs(interval).max() < 1e-6
    with pytest.raises(JointLimitError):
        solve(ARM, forward(ARM, q + [0.0, 1e-6, 0.0, 0.0, 0.0, 0.0, 0.0]))


@pytest.mark.long("machine")
@given(postures, postures)
def test_solving_near_any_posture_is_solving(q, near):
    there = forward(ARM, q)
    found = solve(ARM, there, near=near)
    assert ARM.allows(found.q)
    assert missed(found.q, there) < 1e-10


@pytest.mark.parametrize("aside", [0.0, 1e-15, 1e-12, 1e-9, 1e-6, 1e-3])
def test_a_line_through_the_first_axis_or_beside_it_is_followed_without_a_jump(aside):
    """Where the arm angle's zero turns around, the elbow plane does not."""
    q = np.array([0.4, -0.3, 0.2, 1.2, 0.3, 0.8, 0.1])
    turn = forward(ARM, q).rotation
    steps = []
    for x in np.linspace(-0.1, 0.1, 201):
        there = RigidTransform(turn, SHOULDER + [x, aside, 0.6])
        found = solve(ARM, there, near=q).q if steps else solve(ARM, there).q
        assert missed(found, there) < 1e-10
        steps.append(np.abs(found - q).max())
        q = found
    assert max(steps[1:]) < 0.02


def test_a_turn_through_an_aligned_wrist_is_followed_without_a_jump():
    q = np.array([0.1, 0.5, 0.2, 1.2, 0.3, -0.1, 0.2])
    steps = []
    for sixth in np.linspace(-0.1, 0.1, 201):
        there = forward(ARM, [0.1, 0.5, 0.2, 1.2, 0.3, sixth, 0.2])
        found = solve(ARM, there, near=q).q
        assert missed(found, there) < 1e-10
        steps.append(np.abs(found - q).max())
        q = found
    assert max(steps[1:]) < 0.02


@pytest.mark.long("machine")
@given(directions, st.floats(0.0, 5.0), postures)
def test_whatever_is_asked_the_pose_offered_is_reached_within_limits(direction, distance, q):
    there = RigidTransform(forward(ARM, q).rotation, at(direction, distance).translation)
    offer = nearest_pose(ARM, there)
    assert ARM.allows(offer.solution.q)
    assert missed(offer.solution.q, offer.T_base_wrist) < 1e-10
    shell = reach(ARM)
    assert offer.shift >= max(shell.inner - distance, distance - shell.outer) - 1e-9


@pytest.mark.long("statistics")
@given(postures)
def test_the_size_of_a_twist_is_never_lost_near_half_a_turn(q):
    here = forward(ARM, q)
    for turn in (np.pi, np.pi - 1e-9, np.pi - 1e-5, 1e-9, 0.0):
        c, s = np.cos(turn), np.sin(turn)
        about_x = np.array([[1.0, 0.0, 0.0], [0.0, c, -s], [0.0, s, c]])
        out = np.empty(6)
        size = twist_kernel(
            np.ascontiguousarray(here.rotation),
            here.translation,
            np.ascontiguousarray(here.rotation @ about_x),
            here.translation,
            out,
        )
        assert size == pytest.approx(0.25 * turn, abs=1e-8)


@pytest.mark.long("statistics")
def test_nothing_finite_comes_of_what_is_not_and_the_kernel_says_so():
    rotation, position = np.empty((3, 3)), np.empty(3)
    forward_kernel(np.full(7, 0.3), ARM.lengths, rotation, position)
    work, best, told = np.empty(SCRATCH), np.empty(7), np.zeros(TOLD)
    for bad in (np.nan, np.inf):
        spoiled = rotation.copy()
        spoiled[1, 1] = bad
        for turn, place in ((spoiled, position), (rotation, np.array([bad, 0.0, 0.5]))):
            status = solve_kernel(
                turn,
                place,
                ARM.lengths,
                ARM.lower,
                ARM.upper,
                np.zeros(7),
                False,
                work,
                best,
                told,
            )
            assert status == NOT_FINITE


def test_the_wrist_centre_in_the_shoulder_of_equal_links_is_degenerate():
    equal = replace(ARM, forearm=ARM.upper_arm)
    with pytest.raises(DegenerateError):
        decoupled(equal, RigidTransform(np.eye(3), SHOULDER))


@given(st.floats(allow_nan=True, allow_infinity=True), branches)
def test_any_arm_angle_is_answered_or_refused_by_name(angle, branch):
    assume(not abs(angle) < 1e6)
    there = forward(ARM, np.full(7, 0.3))
    try:
        found = inverse(ARM, there, angle, branch)
    except MechanismError:
        assert not np.isfinite(angle)
    else:
        assert missed(found.q, there) < 3e-12
        assert -np.pi < found.arm_angle <= np.pi
