"""The fused pose: orientation from the robot, depth from the cameras."""

import json
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from session_fakes import FULCRUM, FakeFix, row

from app.core import state_vector as sv
from app.core.staleness import ENCODER_ZERO, TRACKER_HOLD
from app.device.state import DeviceState
from app.session.fusion import DIRECTION_SIGMA as ORIENTATION_SIGMA
from app.session.fusion import MODEL_SIGMA, fuse, tip_covariance
from app.session.machine import State
from app.session.needle import DepthSource
from app.session.sample import Sample, messages
from app.tracking.motion.depth_filter import HAND_SPEED


def device(
    time: float = 10.0, axis: Any = (0.0, 0.0, -1.0), depth: float = 0.03, **slots: float
) -> DeviceState:
    return DeviceState.from_row(row(time, 5, axis, depth, **slots))


def beside(x: float, y: float, z: float) -> np.ndarray:
    return FULCRUM + np.array([x, y, z])


def unit(x: float, y: float) -> np.ndarray:
    return np.array([x, y, -np.sqrt(1.0 - x * x - y * y)])


@settings(derandomize=True, deadline=None, max_examples=60)
@given(
    x=st.floats(-0.6, 0.6),
    y=st.floats(-0.6, 0.6),
    depth=st.floats(-0.05, 0.15),
    model=st.floats(-0.05, 0.15),
)
def test_the_tip_is_the_fulcrum_plus_the_tracked_depth_along_the_robots_axis(
    x: float, y: float, depth: float, model: float
) -> None:
    axis = unit(x, y)
    pose = fuse(device(axis=axis, depth=model), FakeFix(FULCRUM + depth * axis, 9.96), 10.0)
    np.testing.assert_allclose(pose.p_tip, FULCRUM + depth * axis, atol=1e-15)
    np.testing.assert_allclose(pose.axis, axis, atol=1e-15)
    assert pose.depth == pytest.approx(depth, abs=1e-15)
    assert pose.valid
    assert pose.measured
    assert pose.depth_source is DepthSource.TRACKED
    assert not pose.p_tip.flags.writeable


def test_a_tip_above_the_skin_has_a_negative_depth() -> None:
    fix = FakeFix(beside(0.0, 0.0, 0.01), 10.0)
    assert fuse(device(), fix, 10.0).depth == pytest.approx(-0.01)


@pytest.mark.parametrize(
    ("age", "source"),
    [
        (0.0, "tracked"),
        (0.1, "tracked"),
        (0.11, "held"),
        (0.2, "held"),
        (0.21, "model"),
        (9.0, "model"),
    ],
)
def test_a_fix_is_held_for_200_ms_then_the_model_takes_over(age: float, source: str) -> None:
    now = 16.0  # a power of two, so that the ages are as exact as they are written
    pose = fuse(device(now, depth=0.09), FakeFix(beside(0.0, 0.0, -0.03), now - age), now)
    assert pose.depth_source == source
    assert pose.depth == pytest.approx(0.09 if source == "model" else 0.03)
    assert pose.depth_age == pytest.approx(0.0 if source == "model" else age)


@pytest.mark.parametrize("status", ["out_of_view", "one_camera", "inconsistent"])
def test_a_fix_that_is_not_valid_is_not_used(status: str) -> None:
    pose = fuse(device(), FakeFix(beside(0.0, 0.0, -0.05), 10.0, status), 10.0)
    assert pose.depth_source is DepthSource.MODEL


def test_one_camera_and_the_line_measure_the_depth_and_the_source_says_so() -> None:
    fix = FakeFix(beside(0.0, 0.0, -0.05), 10.0, "one_camera", has_point=True)
    pose = fuse(device(), fix, 10.0)
    assert pose.depth_source is DepthSource.ONE_CAMERA
    assert pose.measured
    assert pose.depth == pytest.approx(0.05)
    assert fuse(device(10.15), fix, 10.15).depth_source is DepthSource.HELD


def test_without_any_fix_the_model_is_said_to_be_the_source() -> None:
    pose = fuse(device(), None, 10.0)
    assert pose.depth_source is DepthSource.MODEL
    assert not pose.measured
    assert pose.covariance[2, 2] == pytest.approx(MODEL_SIGMA**2)


@pytest.mark.promise(
    "docs/sessions.md: in the record it is never `valid`, tip and depth are null and the direction "
    "stays"
)
def test_a_depth_that_nothing_measured_is_recorded_as_none_with_its_direction() -> None:
    pose = fuse(device(), None, 10.0)
    sample = Sample(10.0, State.INSERTING, pose, None, np.zeros(3))
    written = {topic: json.loads(text) for topic, text in messages(sample, {"sec": 1, "nsec": 0})}
    attempt = written["/attempt"]
    assert (attempt["valid"], attempt["tip"], attempt["depth"]) == (False, None, None)
    assert list(attempt["axis"].values()) == pytest.approx(pose.axis.tolist())
    assert not {"/tf", "/needle/tip"} & set(written)


def test_encoders_older_than_their_limit_make_the_pose_invalid() -> None:
    fresh = fuse(device(10.0), None, 10.0 + 0.99 * ENCODER_ZERO)
    stale = fuse(device(10.0), None, 10.0 + 1.01 * ENCODER_ZERO, fresh)
    assert fresh.valid
    assert not stale.valid
    assert "encoder" in stale.reason
    np.testing.assert_array_equal(stale.p_tip, fresh.p_tip)


def test_the_age_of_a_repeated_depth_keeps_growing() -> None:
    pose = fuse(device(10.0), FakeFix(FULCRUM, 9.95), 10.0)
    broken = fuse(device(10.0, q_time=0.0), None, 10.5, pose)
    assert broken.depth_age == pytest.approx(0.55)


def test_the_covariance_agrees_with_monte_carlo() -> None:
    rng = np.random.default_rng(11)
    axis, depth, sigma, n = unit(0.3, -0.2), 0.1, 2e-5, 400_000
    across = np.linalg.svd(axis[None, :])[2][1:]
    turns = rng.normal(0.0, ORIENTATION_SIGMA, (n, 2)) @ across
    tips = (depth + rng.normal(0.0, sigma, (n, 1))) * (axis + turns)
    expected = tip_covariance(axis, depth, sigma**2)
    np.testing.assert_allclose(np.cov(tips.T), expected, atol=0.01 * np.abs(expected).max())


def test_the_variance_along_the_needle_is_that_of_the_fix_grown_by_its_age() -> None:
    axis = unit(0.5, 0.1)
    covariance = np.diag([1e-8, 4e-8, 9e-8])
    pose = fuse(device(axis=axis), FakeFix(FULCRUM, 9.9, covariance=covariance), 10.0)
    expected = axis @ covariance @ axis + (HAND_SPEED * 0.1) ** 2
    assert axis @ pose.covariance @ axis == pytest.approx(expected)


@pytest.mark.parametrize("slot", ["axis_x", "tip_z", "depth", "q_time"])
@pytest.mark.parametrize("value", [np.nan, np.inf, -np.inf])
def test_whatever_is_not_finite_gives_an_invalid_finite_pose(slot: str, value: float) -> None:
    state = row(10.0, 5)
    state[sv.INDEX[slot]] = value
    for last in (None, fuse(device(), None, 10.0)):
        pose = fuse(DeviceState.from_row(state), None, 10.0, last)
        if slot == "q_time" and value == np.inf:
            assert pose.reason
        assert not pose.valid
        assert np.isfinite([*pose.p_tip, *pose.axis, pose.depth, pose.depth_age]).all()
        assert np.isfinite(pose.orientation_age)
        assert np.isfinite(pose.covariance).all()
        assert pose.reason


@pytest.mark.parametrize("value", [np.nan, np.inf])
def test_a_fix_that_is_not_finite_is_not_used(value: float) -> None:
    for fix in (
        FakeFix(beside(value, 0.0, 0.0), 10.0),
        FakeFix(FULCRUM, value),
        FakeFix(FULCRUM, 10.0, covariance=np.full((3, 3), value)),
    ):
        assert fuse(device(), fix, 10.0).depth_source is DepthSource.MODEL


def test_a_zero_axis_gives_an_invalid_pose() -> None:
    assert "direction" in fuse(DeviceState.from_row(sv.empty_state()), None, 0.0).reason


def test_hold_is_longer_than_fresh() -> None:
    assert TRACKER_HOLD == 0.2


def test_a_needle_that_turns_while_a_fix_is_on_its_way_is_not_taken_for_a_bent_one():
    depth, line = 0.10, (0.2e-3) ** 2
    for rate, age in ((0.1, 0.08), (0.3, 0.04), (0.6, 0.08)):
        then, now = unit(0.2, 0.0), unit(0.2 + rate * age, 0.0)
        robot = device(axis=now, depth=depth)
        fix: Any = FakeFix(FULCRUM + depth * then, robot.time - age, line_variance=line, axis=then)
        pose = fuse(robot, fix, robot.time)
        assert pose.snapped
        assert not pose.bends
        assert pose.deflection < 1e-9
        np.testing.assert_allclose(pose.p_tip, FULCRUM + depth * now, atol=1e-9)


def test_a_bent_needle_turns_with_its_line():
    depth, then, now = 0.10, np.array([0.0, 0.0, -1.0]), unit(0.1, 0.0)
    robot = device(axis=now, depth=depth)
    aside = np.array([0.0, 3e-3, 0.0])
    fix: Any = FakeFix(
        FULCRUM + depth * then + aside, robot.time - 0.05, line_variance=(0.2e-3) ** 2, axis=then
    )
    pose = fuse(robot, fix, robot.time)
    assert pose.bends
    assert not pose.snapped
    assert pose.deflection == pytest.approx(3e-3)
    np.testing.assert_allclose(pose.p_tip, FULCRUM + depth * now + aside, atol=1e-9)


def test_a_straight_needle_is_not_called_bent_now_and_then() -> None:
    rng, line, robot = np.random.default_rng(0), (0.2e-3) ** 2, device(depth=0.06)
    axis = np.asarray(robot.axis)
    across = np.eye(3) - np.outer(axis, axis)
    for _ in range(1000):
        tip = FULCRUM + 0.06 * axis + across @ rng.normal(0.0, 0.2e-3, 3)
        fix: Any = FakeFix(tip, robot.time - 0.02, line_variance=line, axis=axis)
        assert not fuse(robot, fix, robot.time).bends
