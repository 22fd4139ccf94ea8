"""A tool in the arm's hand about the fulcrum: poses both ways, rates, and the shaft in between."""

import numpy as np
import pytest

from app.arm.mechanics import forward, link_frames, load_arm, solve
from app.arm.motion.errors import FulcrumError, MotionError
from app.arm.motion.path import Bends, JointPath, axis_points, wrists
from app.arm.motion.pivot import LEAST_DEPTH, HeldTool, Pivot
from app.core.rotation import rotation_log
from app.mechanisms.errors import NoGripError, SingularError

ARM = load_arm()
TOOL = HeldTool(length=0.35, grip=0.25, axis_tool=[1.0, 0.0, 0.0])
PIVOT = Pivot(ARM, TOOL, [0.55, 0.0, 0.25], [0.05, -0.1, -1.0])


def tips(count, seed=0):
    rng = np.random.default_rng(seed)
    for _ in range(count):
        aside = 0.25 * rng.normal(size=3)
        depth = rng.uniform(0.03, 0.15)
        yield PIVOT.p_world + depth * (PIVOT.inward_world + aside), rng.uniform(1.9, 2.5), rng


def test_posture_of_a_tip_gives_back_depth_direction_and_roll_with_the_shaft_in_the_fulcrum():
    for tip, roll, _ in tips(20):
        q = solve(ARM, PIVOT.wrist_pose(PIVOT.tip_pose(tip, roll))).q
        state = PIVOT.state(q)
        axis, depth = PIVOT.aim(tip)
        assert state.off < 1e-14
        assert abs(state.depth - depth) < 1e-14
        assert abs(state.roll - roll) < 1e-14
        assert np.abs(state.axis_world - axis).max() < 1e-14
        assert np.abs(TOOL.needle_pose(ARM, q).translation - tip).max() < 1e-14


def test_rates_are_those_of_differences_and_motion_is_inverted_and_scaled_by_depth():
    h = 1e-6
    for tip, roll, rng in tips(20, 1):
        velocity, roll_rate = 0.1 * rng.normal(size=3), rng.normal()
        rates = PIVOT.rates(tip, velocity, roll_rate)
        before, after = (PIVOT.tip_pose(tip + t * velocity, roll + t * roll_rate) for t in (-h, h))
        grips = [(one @ TOOL.T_tool_needle.inverse()).translation for one in (before, after)]
        turned = rotation_log(after.rotation @ before.rotation.T)
        assert np.abs((grips[1] - grips[0]) / (2 * h) - rates.velocity).max() < 1e-8
        assert np.abs(turned / (2 * h) - rates.turning).max() < 1e-8
        axis, depth = PIVOT.aim(tip)
        across = velocity - axis * (axis @ velocity)
        lateral = rates.velocity - axis * (axis @ rates.velocity)
        assert np.abs(lateral + (TOOL.grip - depth) / depth * across).max() < 1e-15
        assert rates.scale == -(TOOL.grip - depth) / depth


def test_rates_of_the_joints_move_the_tip_as_asked_and_leave_the_shaft_where_it_is():
    h = 1e-6
    for tip, roll, rng in tips(20, 2):
        q = solve(ARM, PIVOT.wrist_pose(PIVOT.tip_pose(tip, roll))).q
        velocity = 0.1 * rng.normal(size=3)
        rates = PIVOT.joint_rates(q, velocity, 0.3)
        ends = [TOOL.needle_pose(ARM, q + t * rates).translation for t in (-h, h)]
        assert np.abs((ends[1] - ends[0]) / (2 * h) - velocity).max() < 1e-8
        states = [PIVOT.state(q + t * rates) for t in (-h, h)]
        assert abs((states[1].roll - states[0].roll) / (2 * h) - 0.3) < 1e-7
        assert max(state.off for state in states) < 1e-10


def test_tip_at_the_fulcrum_has_no_scale_and_says_so():
    for away in (0.0, 1e-12, 0.99 * LEAST_DEPTH):
        with pytest.raises(FulcrumError, match="no direction"):
            PIVOT.rates(PIVOT.p_world + away * PIVOT.inward_world, [0.01, 0.0, 0.0])


def test_grazing_shaft_and_a_grip_in_the_trocar_are_refused():
    aside = np.cross(PIVOT.inward_world, [1.0, 0.0, 0.0])
    with pytest.raises(FulcrumError, match="grazes beyond 60°"):
        PIVOT.aim(PIVOT.p_world + 0.1 * aside)
    with pytest.raises(NoGripError, match="grip the tool further back"):
        PIVOT.aim(PIVOT.p_world + 0.24 * PIVOT.inward_world)
    with pytest.raises(NoGripError, match="grip it on its length"):
        HeldTool(0.3, 0.4, [1.0, 0.0, 0.0])
    with pytest.raises(FulcrumError, match="90"):
        Pivot(ARM, TOOL, [0.5, 0.0, 0.2], [0.0, 0.0, -1.0], tilt=2.0)


def test_rates_at_a_stretched_arm_are_refused_by_name():
    q = np.array([0.2, 0.9, 0.0, 1e-9, 0.0, 0.0, 0.0])
    needle = TOOL.needle_pose(ARM, q)
    pivot = Pivot(
        ARM, TOOL, needle.translation - 0.1 * needle.rotation[:, 2], needle.rotation[:, 2]
    )
    with pytest.raises(SingularError, match="elbow, wrist"):
        pivot.joint_rates(q, [0.0, 0.0, 0.01])


def test_no_second_derivative_along_a_path_is_above_its_bound():
    rng = np.random.default_rng(3)
    for _ in range(5):
        path = JointPath(np.linspace(0.0, 1.0, 5), rng.uniform(-1.5, 1.5, (5, 7)))
        bends = Bends.of(ARM, path, 8)
        s = np.linspace(0.0, 1.0, 4001)
        rotation, position = wrists(ARM, path.at(s))
        step = np.clip(np.searchsorted(bends.s, s[1:-1], "right") - 1, 0, len(bends.s) - 2)
        point, aim = rng.normal(size=3), rng.normal(size=3)
        seen = np.einsum("nji,nj->ni", rotation, aim - position)
        for values, bound in (
            (position + rotation @ point, bends.fixed_to_tool(point)),
            (seen, bends.fixed_to_base(aim)),
            (rotation[:, :, 1], bends.direction()),
        ):
            second = (values[2:] - 2.0 * values[1:-1] + values[:-2]) / s[1] ** 2
            assert (np.linalg.norm(second, axis=1) <= bound[step] * (1.0 + 1e-3)).all()


def test_bound_of_the_shaft_holds_between_places_and_is_not_idle():
    start = solve(ARM, PIVOT.wrist_pose(PIVOT.tip_pose(PIVOT.p_world + [0.0, 0.0, -0.1]))).q
    goal = solve(
        ARM, PIVOT.wrist_pose(PIVOT.tip_pose(PIVOT.p_world + [0.02, 0.0, -0.1])), near=start
    ).q
    straight = JointPath.straight(start, goal)
    seen = max(PIVOT.state(q).off for q in straight.at(np.linspace(0.0, 1.0, 999)))
    assert 1e-4 < seen <= PIVOT.off(straight) < 10.0 * seen


def test_a_path_without_ascending_knots_is_refused():
    with pytest.raises(MotionError, match="ascending"):
        JointPath([0.0, 0.0], np.zeros((2, 7)))


def test_wrists_are_those_of_one_posture_at_a_time():
    q = np.random.default_rng(4).uniform(ARM.lower, ARM.upper, (5, 7))
    rotation, position = wrists(ARM, q)
    for k in range(5):
        there = forward(ARM, q[k])
        assert (rotation[k] == there.rotation).all()
        assert (position[k] == there.translation).all()


def test_the_points_on_the_joints_axes_are_on_the_axes_of_the_papers_frames():
    for q in np.random.default_rng(4).uniform(ARM.lower, ARM.upper, (20, 7)):
        (points,) = axis_points(ARM, q[None], forward(ARM, q).translation[None])
        for point, frame in zip(points, link_frames(ARM, q), strict=True):
            assert np.linalg.norm(np.cross(frame[:3, 2], point - frame[:3, 3])) < 1e-14
