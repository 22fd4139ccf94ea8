"""Fastest motion of the joints within their limits."""

import sys

import numpy as np
import pytest

from app.arm.mechanics import load_arm
from app.arm.motion.errors import MotionError, PlannerMissingError
from app.arm.motion.path import JointPath
from app.arm.motion.timing import JointMotion, free_move, timed

pytest.importorskip("ruckig", reason="the extra `arm` is not installed")

ARM = load_arm()


def postures(seed, count=2, share=1.0):
    rng = np.random.default_rng(seed)
    return share * rng.uniform(ARM.lower, ARM.upper, (count, 7))


def held(motion: JointMotion):
    """Limits at fine samples, rest at both ends, and derivatives that are the derivatives."""
    t = np.linspace(0.0, motion.duration, 20001)
    q, v, a, j = motion.at(t)
    for values, most in ((v, ARM.speed), (a, ARM.acceleration), (j, ARM.jerk)):
        assert (np.abs(values) <= most * (1.0 + 1e-9)).all()
    assert np.abs(v[[0, -1]]).max() < 1e-6
    h = t[1]
    for lower, higher, limit in ((q, v, ARM.acceleration), (v, a, ARM.jerk)):
        off = np.abs(np.diff(lower, axis=0) / h - 0.5 * (higher[1:] + higher[:-1]))
        assert (off <= h * limit).all()
    return q


@pytest.mark.parametrize("seed", range(5))
def test_a_straight_line_takes_the_least_time_that_any_motion_takes(seed):
    start, goal = postures(seed)
    straight, free = timed(ARM, JointPath.straight(start, goal)), free_move(ARM, start, goal)
    for motion in (straight, free):
        q = held(motion)
        assert np.abs(q[0] - start).max() < 1e-12
        assert np.abs(q[-1] - goal).max() < 1e-9
    assert straight.use_of_limits(ARM).max() > 1.0 - 1e-9
    # limits of this arm are alike in their ratios: one joint rules, the others can follow it
    assert abs(straight.duration - free.duration) < 1e-9


@pytest.mark.parametrize("seed", range(5))
def test_a_curved_path_is_kept_and_no_limit_passed(seed):
    path = JointPath(np.linspace(0.0, 1.0, 6), postures(seed, 6, 0.5))
    motion = timed(ARM, path)
    q = held(motion)
    s = motion.profile.at(np.linspace(0.0, motion.duration, 20001))[0][:, 0]
    assert (np.diff(s) >= -1e-12).all()
    assert np.abs(q - path.at(s)).max() == 0.0
    assert abs(s[-1] - 1.0) < 1e-9
    assert motion.use_of_limits(ARM)[0].max() > 0.8


def test_a_curved_path_is_slower_than_the_free_move_and_not_absurdly():
    path = JointPath(np.linspace(0.0, 1.0, 4), postures(7, 4, 0.3))
    assert free_move(ARM, path.q[0], path.q[-1]).duration < timed(ARM, path).duration


def test_half_the_speed_takes_longer_and_keeps_to_half_the_speed():
    path = JointPath.straight(*postures(3))
    slow = timed(ARM, path, 0.5)
    assert slow.duration > timed(ARM, path).duration
    assert slow.use_of_limits(ARM)[0].max() < 0.5 * (1.0 + 1e-9)


def test_a_move_of_a_nanoradian_and_none_at_all():
    q = np.zeros(7)
    held(timed(ARM, JointPath.straight(q, q + 1e-9)))
    with pytest.raises(MotionError, match="does not move"):
        timed(ARM, JointPath.straight(q, q))
    with pytest.raises(MotionError, match=r"\(0, 1\]"):
        timed(ARM, JointPath.straight(q, q + 1.0), 0.0)


def test_without_ruckig_the_extra_is_named(monkeypatch):
    monkeypatch.setitem(sys.modules, "ruckig", None)
    with pytest.raises(PlannerMissingError, match=r"make extra NAME=arm"):
        free_move(ARM, *postures(0))
