"""The arm against the paper's table, Pinocchio, EAIK, differences, scans and Monte Carlo."""

import sys
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest

from app.arm.mechanics import (
    ARM_BRANCHES,
    ArmBranch,
    ArmSingularity,
    JointLimitError,
    arm_angle,
    arm_branch,
    arm_singularity,
    decoupled,
    feasible,
    forward,
    inverse,
    iterate,
    jacobian,
    link_frames,
    load_arm,
    nearest_pose,
    published_arm,
    reach,
    solve,
    starts,
    tool_covariance,
)
from app.arm.studies.references.programs import PinocchioArm, import_pinocchio
from app.core.errors import ConfigurationError
from app.core.rotation import rotation_exp, rotation_log
from app.core.transform import RigidTransform
from app.mechanisms.errors import MechanismError, NotFiniteError, UnreachableError
from app.studies.errors import StudyError

ROOT = Path(__file__).resolve().parents[2]
ARM = load_arm()
SHOULDER = np.array([0.0, 0.0, ARM.pedestal])


def postures(count, seed=1):
    return np.random.default_rng(seed).uniform(ARM.lower, ARM.upper, (count, 7))


def turned(a, b):
    return np.abs((np.asarray(a) - b + np.pi) % (2.0 * np.pi) - np.pi).max()


def apart(a, b):
    return np.abs(a.matrix() - b.matrix()).max()


def pose(position, turn=(0.0, 0.0, 0.0)):
    return RigidTransform(rotation_exp(turn), np.asarray(position, dtype=float))


def far_from_solvable():
    """A pose that the links reach and no posture within limits takes."""
    rng = np.random.default_rng(5)
    while True:
        away, turn = rng.normal(size=3), rng.normal(size=3)
        there = pose(SHOULDER + 0.8 * away / np.linalg.norm(away), turn)
        try:
            solve(ARM, there)
        except JointLimitError:
            return there


def test_forward_is_the_product_of_the_papers_matrices():
    for q in postures(50):
        assert np.abs(link_frames(ARM, q)[6] - forward(ARM, q).matrix()).max() < 1e-15


def test_pose_and_jacobian_are_those_of_pinocchio_on_the_published_description():
    pytest.importorskip("pinocchio")
    other = PinocchioArm(published_arm())
    for q in postures(500):
        assert apart(forward(ARM, q) @ ARM.T_wrist_flange, other.pose(q)) < 1e-12
        ours = jacobian(ARM, q, (0.0, 0.0, ARM.flange))
        assert np.abs(ours - other.jacobian(q)).max() < 1e-12


def test_limits_are_those_of_the_published_description():
    limits = np.radians([joint.limit_deg for joint in published_arm().joints])
    assert (limits == ARM.upper).all()
    assert (-limits == ARM.lower).all()


def test_the_printed_upper_arm_is_wrong_by_up_to_sixty_millimetres():
    printed = replace(ARM, upper_arm=0.36)
    off = [
        np.linalg.norm(forward(printed, q).translation - forward(ARM, q).translation)
        for q in postures(50)
    ]
    assert max(off) == pytest.approx(0.060, abs=1e-12)


def test_the_jacobian_is_the_derivative_of_the_pose():
    at, h = np.array([0.1, -0.2, 0.3]), 1e-5
    for q in postures(30):
        columns = []
        for step in h * np.eye(7):
            up, down = forward(ARM, q + step), forward(ARM, q - step)
            turn = rotation_log(up.rotation @ down.rotation.T)
            columns.append(np.concatenate([up @ at - down @ at, turn]) / (2.0 * h))
        assert np.abs(np.column_stack(columns) - jacobian(ARM, q, at)).max() < 1e-9


def test_all_eight_decoupled_solutions_close_and_are_the_eight_signs():
    for q in postures(200):
        there = forward(ARM, q)
        found = decoupled(ARM, there)
        assert len(found) == 8
        for one in found:
            assert one.q[2] == 0.0
            assert apart(forward(ARM, one.q), there) < 1e-14
        first = np.arctan2(there.translation[1], there.translation[0])
        signs = [
            (round(np.cos(one.q[0] - first)), np.sign(one.q[3]), np.sign(one.q[5])) for one in found
        ]
        assert signs == [(a, b, c) for a in (1, -1) for b in (1, -1) for c in (1, -1)]


def test_a_posture_comes_back_from_its_pose_arm_angle_and_branch():
    for q in postures(500):
        back = inverse(ARM, forward(ARM, q), arm_angle(ARM, q), arm_branch(q))
        assert turned(back.q, q) < 1e-9
        assert back.branch == arm_branch(q)


@pytest.mark.parametrize("branch", ARM_BRANCHES, ids=str)
def test_every_arm_angle_of_every_branch_closes_and_has_that_angle_and_branch(branch):
    rng = np.random.default_rng(3)
    for q in postures(30):
        there, angle = forward(ARM, q), rng.uniform(-np.pi, np.pi)
        found = inverse(ARM, there, angle, branch)
        assert apart(forward(ARM, found.q), there) < 1e-14
        assert found.branch == branch
        assert turned(arm_angle(ARM, found.q), angle) < 1e-12
        assert found.arm_angle == pytest.approx(angle)


def test_the_arm_angle_turns_the_elbow_right_handed_about_shoulder_to_wrist():
    """From the decoupled elbow with the same sign of θ4, measured on the elbow's own place."""
    for q in postures(100):
        there = forward(ARM, q)
        axis = there.translation - SHOULDER
        axis = axis / np.linalg.norm(axis)

        def across(angles, axis=axis):
            elbow = link_frames(ARM, angles)[3][:3, 3] - SHOULDER
            return elbow - axis * (axis @ elbow)

        zero = next(one.q for one in decoupled(ARM, there) if one.q[3] * q[3] > 0.0)
        a, b = across(zero), across(q)
        angle = np.arctan2(axis @ np.cross(a, b), a @ b)
        assert turned(angle, arm_angle(ARM, q)) < 1e-9
        assert abs(arm_angle(ARM, zero)) < 1e-12


def test_zero_of_the_arm_angle_is_the_decoupled_solution_in_front():
    for q in postures(50):
        there = forward(ARM, q)
        for one in decoupled(ARM, there)[:4]:
            again = inverse(ARM, there, 0.0, one.branch).q
            assert turned(again, one.q) < 1e-11


def test_a_solution_within_limits_is_found_for_every_posture_within_limits():
    for q in postures(2000, seed=4):
        there = forward(ARM, q)
        found = solve(ARM, there)
        assert ARM.allows(found.q)
        assert found.margin >= 0.0
        assert apart(forward(ARM, found.q), there) < 1e-11


def test_solving_near_a_posture_gives_it_back_and_twice_the_same():
    for q in postures(100):
        there = forward(ARM, q)
        assert turned(solve(ARM, there, near=q).q, q) < 1e-8
        assert (solve(ARM, there).q == solve(ARM, there).q).all()


@pytest.mark.long("machine")
def test_feasible_arm_angles_are_those_of_a_fine_scan():
    line = np.linspace(-np.pi, np.pi, 721)
    for q in postures(6):
        there = forward(ARM, q)
        for branch in ARM_BRANCHES:
            intervals = feasible(ARM, there, branch)
            for angle in line:
                inside = any(
                    low <= a <= high for low, high in intervals for a in (angle, angle + 2 * np.pi)
                )
                margin = inverse(ARM, there, angle, branch).margin
                assert inside == (margin >= 0.0) or abs(margin) < 1e-9


def test_a_pose_that_only_limits_forbid_names_the_joint_and_a_near_one_is_offered():
    there = far_from_solvable()
    with pytest.raises(JointLimitError, match=r"joint \d would stand .*° beyond its limits"):
        solve(ARM, there)
    offer = nearest_pose(ARM, there)
    assert ARM.allows(offer.solution.q)
    assert apart(forward(ARM, offer.solution.q), offer.T_base_wrist) < 1e-12
    assert 0.0 < offer.shift + 0.25 * offer.turn < 0.3
    # no small change of the posture within limits comes nearer
    error = np.hypot(offer.shift, 0.25 * offer.turn)
    rng = np.random.default_rng(2)
    for _ in range(300):
        q = np.clip(offer.solution.q + 0.02 * rng.normal(size=7), ARM.lower, ARM.upper)
        other = forward(ARM, q)
        shift = np.linalg.norm(other.translation - there.translation)
        turn = np.linalg.norm(rotation_log(other.rotation @ there.rotation.T))
        assert np.hypot(shift, 0.25 * turn) > error - 1e-9


@pytest.mark.parametrize("distance", [0.0, 0.2, 0.9, 3.0])
def test_out_of_the_shell_of_reach_the_nearest_wrist_centre_is_offered(distance):
    there = pose(SHOULDER + distance * np.array([0.6, 0.0, 0.8]))
    offer = nearest_pose(ARM, there)
    shell = reach(ARM)
    least = max(shell.inner - distance, distance - shell.outer)
    assert offer.shift == pytest.approx(least, abs=1e-9)
    assert offer.turn < 1e-7
    assert ARM.allows(offer.solution.q)


def test_a_pose_within_reach_is_its_own_nearest():
    there = forward(ARM, postures(1)[0])
    offer = nearest_pose(ARM, there)
    assert offer.T_base_wrist is there
    assert (offer.shift, offer.turn) == (0.0, 0.0)


def test_the_shell_of_reach_is_that_of_limits_and_links():
    shell = reach(ARM)
    assert shell.inner == pytest.approx(0.4104, abs=5e-5)
    assert shell.outer == pytest.approx(0.82)
    folded = forward(ARM, [0.0, 0.3, 0.0, ARM.upper[3], 0.0, 0.1, 0.0])
    assert np.linalg.norm(folded.translation - SHOULDER) == pytest.approx(shell.inner, abs=1e-15)


def test_out_of_reach_is_refused_with_the_distance():
    with pytest.raises(UnreachableError, match=r"is 0\.9 m from the shoulder.*0\.02 to 0\.82 m"):
        solve(ARM, pose(SHOULDER + [0.9, 0.0, 0.0]))
    with pytest.raises(UnreachableError):
        decoupled(ARM, pose(SHOULDER + [0.01, 0.0, 0.0]))


def test_out_of_reach_the_nearest_place_is_offered_in_the_message_itself():
    with pytest.raises(UnreachableError, match=r"nearest that they reach is \(0\.8200, 0\.0000, "):
        solve(ARM, pose(SHOULDER + [0.9, 0.0, 0.0]))


def test_on_the_first_axis_and_with_an_aligned_wrist_angles_are_kept():
    there = pose(SHOULDER + [0.0, 0.0, 0.6], (0.3, 0.4, 0.5))
    for one in decoupled(ARM, there, keep=(0.7, 0.0)):
        assert turned(one.q[0], 0.7) < 1e-15 or turned(one.q[0], 0.7 + np.pi) < 1e-15
        assert ArmSingularity.FIRST_AXIS in one.singular
        assert apart(forward(ARM, one.q), there) < 1e-14
    straight = forward(ARM, [0.2, 0.5, 0.0, 0.9, 0.3, 0.0, 0.4])
    one = decoupled(ARM, straight, keep=(0.0, -0.4))[0]
    assert one.singular == (ArmSingularity.WRIST,)
    assert one.q[4] == pytest.approx(-0.4)
    assert one.q[4] + one.q[6] == pytest.approx(0.7)


@pytest.mark.parametrize(
    ("q", "kind"),
    [
        ([0.1, 0.5, 0.0, 0.0, 0.3, 0.6, 0.0], ArmSingularity.ELBOW),
        ([0.1, 0.5, 0.2, 0.9, 0.3, 0.0, 0.0], ArmSingularity.WRIST),
        ([0.1, 0.0, 0.2, 0.9, 0.3, 0.6, 0.0], ArmSingularity.SHOULDER),
    ],
)
def test_singular_postures_are_named(q, kind):
    assert arm_singularity(ARM, q).kinds == (kind,)
    assert arm_singularity(ARM, np.add(q, 1e-3)).kinds == ()


def test_a_stretched_elbow_loses_a_direction_and_a_regular_posture_none():
    stretched = arm_singularity(ARM, [0.1, 0.5, 0.3, 0.0, 0.3, 0.6, 0.2])
    assert stretched.dexterity < 1e-15
    assert arm_singularity(ARM, [0.1, 0.5, 0.3, 1.2, 0.3, 0.9, 0.2]).dexterity > 0.05


def test_least_squares_find_the_pose_from_nearby_and_stay_within_limits():
    rng = np.random.default_rng(7)
    for q in postures(100):
        found = iterate(ARM, forward(ARM, q), q + 0.1 * rng.normal(size=7))
        assert ARM.allows(found.q)
        if found.closed:
            assert apart(forward(ARM, found.q), forward(ARM, q)) < 1e-10
    there = forward(ARM, postures(1)[0])
    assert any(iterate(ARM, there, start).closed for start in starts(ARM, 8))


def test_least_squares_out_of_reach_end_beside_it_and_say_so():
    found = iterate(ARM, pose(SHOULDER + [1.0, 0.0, 0.0]), np.full(7, 0.1))
    assert not found.closed
    assert found.error == pytest.approx(0.18, abs=1e-3)


def test_half_a_turn_is_no_obstacle_to_least_squares():
    start = np.array([0.1, 0.5, 0.2, 0.9, 0.3, 0.6, 0.2])
    here = forward(ARM, start)
    there = RigidTransform(here.rotation @ np.diag([1.0, -1.0, -1.0]), here.translation)
    assert np.isfinite(iterate(ARM, there, start).q).all()


def test_eaik_finds_the_same_eight_solutions():
    dh = pytest.importorskip("eaik.IK_DH")
    from app.arm.studies.references.programs import EaikArm

    other = EaikArm(ARM)
    assert dh.DhRobot is not None
    for q in postures(20):
        there = forward(ARM, q)
        theirs = other.solutions(there)
        for one in decoupled(ARM, there):
            assert min(turned(one.q, other_q) for other_q in theirs) < 1e-8


def test_tool_and_wrist_poses_are_inverse_through_base_flange_and_tool():
    arm = replace(
        ARM,
        T_world_base=pose([0.1, 0.2, 0.3], [0.1, 0.0, 0.5]),
        T_flange_tool=pose([0.0, 0.01, 0.2], [0.0, 0.3, 0.0]),
    )
    there = forward(arm, postures(1)[0])
    assert apart(arm.wrist_pose(arm.tool_pose(there)), there) < 1e-15
    straight = ARM.tool_pose(there)
    assert np.allclose(straight.translation, there @ np.array([0.0, 0.0, 0.126]))


@pytest.mark.long("statistics")
def test_the_covariance_of_the_tool_is_that_of_many_drawn_errors():
    arm = replace(
        ARM,
        T_world_base=pose([0.1, 0.2, 0.3], [0.1, 0.0, 0.5]),
        T_flange_tool=pose([0.0, 0.01, 0.2], [0.0, 0.3, 0.0]),
        resolution=2e-4,
    )
    q, rng, count = postures(1)[0], np.random.default_rng(6), 5_000
    right = arm.tool_pose(forward(arm, q))
    errors = []
    for _ in range(count):
        base = np.sqrt(np.diag(arm.base_covariance)) * rng.normal(size=6)
        tool = np.sqrt(np.diag(arm.tool_covariance)) * rng.normal(size=6)
        there = (
            arm.T_world_base
            @ pose(base[:3], base[3:])
            @ forward(arm, q + arm.resolution * rng.normal(size=7))
            @ arm.T_wrist_tool
            @ pose(tool[:3], tool[3:])
        )
        shift = there.translation - right.translation
        errors.append([*shift, *rotation_log(there.rotation @ right.rotation.T)])
    drawn, found = np.cov(np.array(errors).T), tool_covariance(arm, q)
    size = np.sqrt(np.outer(np.diag(found), np.diag(found)))
    assert np.abs((drawn - found) / size).max() < 5.0 / np.sqrt(count)


def test_wrong_input_is_refused_by_name():
    with pytest.raises(MechanismError, match=r"q has shape \(6,\); \(7,\) is needed"):
        forward(ARM, np.zeros(6))
    with pytest.raises(NotFiniteError, match="q is not finite"):
        forward(ARM, [np.nan] * 7)
    there = forward(ARM, postures(1)[0])
    with pytest.raises(NotFiniteError, match="arm angle nan"):
        inverse(ARM, there, float("nan"), ArmBranch(1, 1, 1))
    with pytest.raises(MechanismError, match=r"upper_arm is 0\.0 m"):
        replace(ARM, upper_arm=0.0)
    with pytest.raises(MechanismError, match="must turn both ways"):
        replace(ARM, lower=np.zeros(7))


def test_an_unknown_arm_is_refused_with_the_names(tmp_path):
    with pytest.raises(ConfigurationError, match="no arm 'robot'; there is iiwa14"):
        load_arm("robot")
    with pytest.raises(ConfigurationError, match="there is iiwa14"):
        published_arm("robot")
    text = (tmp_path / "mine.yaml").as_posix()
    (tmp_path / "mine.yaml").write_text("name: mine\n", encoding="utf-8")
    with pytest.raises(ConfigurationError, match="lengths"):
        load_arm(text)


def test_without_pinocchio_the_error_names_the_extra(monkeypatch):
    monkeypatch.setitem(sys.modules, "pinocchio", None)
    with pytest.raises(StudyError, match=r"install the extra `arm`: make extra NAME=arm"):
        import_pinocchio()
