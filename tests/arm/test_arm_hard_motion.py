"""Pivoting and paths of the arm where they are hardly defined: bounded, or a named error."""

import numpy as np
import pytest
from hypothesis import assume, given, settings
from hypothesis import strategies as st

from app.arm.mechanics import forward, load_arm
from app.arm.motion.errors import FulcrumError
from app.arm.motion.following import MotionRefusedError, PoseLine, follow
from app.arm.motion.path import JointPath
from app.arm.motion.pivot import LEAST_DEPTH, HeldTool, Pivot
from app.arm.motion.timing import timed
from app.core.transform import RigidTransform
from app.mechanisms.errors import MechanismError, NotFiniteError

ARM = load_arm()
TOOL = HeldTool(0.35, 0.25, [1.0, 0.0, 0.0])
INWARD = np.array([0.0, 0.0, -1.0])
PIVOT = Pivot(ARM, TOOL, [0.55, 0.0, 0.25], INWARD)
sizes = st.integers(0, 300).map(lambda k: 10.0**-k)
turns = st.floats(-np.pi, np.pi)
rng_seeds = st.integers(0, 10_000)


@given(sizes, turns, st.floats(0.0, np.pi))
def test_a_tip_near_the_fulcrum_has_bounded_rates_or_none(size, around, lean):
    way = np.array([np.cos(around) * np.sin(lean), np.sin(around) * np.sin(lean), -np.cos(lean)])
    tip = PIVOT.p_world + 0.2 * size * way
    try:
        rates = PIVOT.rates(tip, [0.01, 0.0, 0.0], 0.1)
    except FulcrumError:
        assert 0.2 * size < LEAST_DEPTH * (1 + 1e-9) or lean > PIVOT.tilt - 1e-9
        return
    assert np.isfinite(rates.velocity).all()
    assert np.linalg.norm(rates.velocity) <= 0.01 * TOOL.grip / LEAST_DEPTH
    assert np.isfinite(rates.turning).all()


@given(st.lists(turns, min_size=7, max_size=7))
def test_the_state_of_any_posture_is_finite_and_its_depth_and_distance_make_the_place(q):
    q = np.clip(q, ARM.lower, ARM.upper)
    state = PIVOT.state(q)
    tip = TOOL.needle_pose(ARM, q).translation
    away = np.linalg.norm(tip - PIVOT.p_world)
    assert np.isfinite(state.roll)
    assert np.hypot(state.depth, state.off) == pytest.approx(away, abs=1e-14)


@pytest.mark.long("machine")
@given(rng_seeds, st.integers(0, 12))
@settings(max_examples=30, deadline=None)
def test_the_bound_of_the_shaft_is_never_below_what_is_seen(seed, exponent):
    rng = np.random.default_rng(seed)
    knots = rng.uniform(ARM.lower, ARM.upper)[None, :] + 10.0**-exponent * rng.normal(size=(4, 7))
    path = JointPath(np.linspace(0.0, 1.0, 4), knots)
    seen = max(PIVOT.state(q).off for q in path.at(np.linspace(0.0, 1.0, 97)))
    assert seen <= PIVOT.off(path) * (1.0 + 1e-12) + 1e-15


@pytest.mark.long("machine")
@given(rng_seeds, st.integers(0, 9))
@settings(max_examples=20, deadline=None)
def test_a_line_is_followed_within_its_bound_or_refused_with_a_place_on_it(seed, exponent):
    rng = np.random.default_rng(seed)
    start = forward(ARM, rng.uniform(ARM.lower, ARM.upper))
    way = 10.0**-exponent * rng.normal(size=3)
    a = ARM.tool_pose(start)
    line = PoseLine(a, RigidTransform(a.rotation, a.translation + way))
    refused = None
    try:
        made = follow(ARM, line, RigidTransform.identity(), suggest=False)
    except MotionRefusedError as error:
        refused = error
    if refused is not None:
        assert 0.0 <= refused.at <= 1.0
        assert np.isfinite(refused.p_world).all()
        return
    for s in np.linspace(0.0, 1.0, 23):
        there = ARM.tool_pose(forward(ARM, made.path.at(s))).translation
        assert np.linalg.norm(there - line.at(float(s)).translation) <= made.miss + 1e-12
    assert made.margins.joint >= 0.0


@pytest.mark.long("machine")
@given(rng_seeds, st.integers(0, 10))
@settings(max_examples=20, deadline=None)
def test_no_limit_is_passed_however_small_or_sharp_the_path(seed, exponent):
    pytest.importorskip("ruckig", reason="the extra `arm` is not installed")
    rng = np.random.default_rng(seed)
    size = 10.0**-exponent
    q = size * rng.normal(size=(5, 7))
    s = np.append(0.0, np.cumsum(rng.uniform(0.1, 1.0, 4)))
    assume(np.ptp(q, axis=0).max() > 0.0)
    motion = timed(ARM, JointPath(s, q))
    assert motion.use_of_limits(ARM, motion.duration / 500).max() <= 1.0 + 1e-6
    assert np.abs(motion.at(motion.duration)[0] - q[-1]).max() < 1e-8 * size + 1e-15


def test_numbers_that_are_none_are_refused():
    with pytest.raises(NotFiniteError):
        PIVOT.state(np.full(7, np.nan))
    with pytest.raises(ArithmeticError):
        PIVOT.aim([np.nan, 0.0, 0.0])
    with pytest.raises(MechanismError):
        PIVOT.joint_rates(np.zeros(6), [0.0, 0.0, 0.0])
