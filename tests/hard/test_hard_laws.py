"""Force laws at their worst: NaN, huge stiffness, ε from 1e-12 to π, fulcrum, grip lost, edges."""

import numpy as np
import pytest
from device.law_rig import FULCRUM, PROFILE, OneLaw, leaning, pose, unit, with_joints
from hypothesis import given, settings
from hypothesis import strategies as st

from app.core import state_vector as sv
from app.device.control import laws
from app.device.control.law_kernels import damper_share, hill_kernel, spring_kernel
from app.device.control.laws.impedance import _AT as IMPEDANCE

PLACE = {
    f"{e}_{i}": v for e in ("from", "to") for i, v in zip("xyz", (0.0, 0.17, 0.04), strict=True)
}
REQUESTS = {
    "fixture": {},
    "cone_wall": {},
    "forbidden_region": PLACE,
    "impedance": {},
    "compensation": {},
}
FORCES = list(sv.SUMS)
anything = st.floats(allow_nan=True, allow_infinity=True)
DOWN = np.array([0.0, 0.0, -1.0])


def at_path(d, path, dial, **slots):
    x, y, z = path
    return pose(d, path_x=x, path_y=y, path_z=z, assistance=dial, **slots)


@pytest.mark.parametrize("name", REQUESTS)
@settings(derandomize=True, deadline=None, max_examples=40)
@given(st.lists(st.tuples(st.sampled_from(range(sv.SLOTS)), anything), max_size=8))
def test_after_whatever_a_law_was_fed_it_is_itself_again(name, rubbish):
    """Rubbish for a tick, then good values: finite again, within bounds, as a fresh law is."""
    law, fresh = OneLaw(name, **REQUESTS[name]), OneLaw(name, **REQUESTS[name])
    good = with_joints(at_path(leaning(0.3, 0.2), leaning(0.2, 0.1), -0.8))
    bad = good.copy()
    for slot, value in rubbish:
        bad[slot] = value
    law.run(good)
    law.run(bad)
    for _ in range(3000 if name == "impedance" else 2):
        done = law.run(good)
    for _ in range(3000 if name == "impedance" else 2):
        wanted = fresh.run(good)
    assert np.isfinite(done).all()
    np.testing.assert_allclose(done[FORCES], wanted[FORCES], atol=2e-6)


@pytest.mark.parametrize("name", REQUESTS)
def test_a_path_of_nan_gives_no_force_and_no_nan(name):
    law = OneLaw(name, **REQUESTS[name])
    done = law.run(with_joints(at_path(leaning(0.1, 0.0), (np.nan, 0.0, -1.0), 1.0)))
    assert np.isfinite(done[FORCES]).all()
    if name in ("fixture", "impedance"):
        assert not done[FORCES].any()


@pytest.mark.parametrize("dial", [1.0, -1.0])
def test_from_tiny_errors_to_opposite_the_fixture_is_bounded_and_never_jumps(dial):
    angles = np.concatenate([10.0 ** np.linspace(-12, -3, 200), np.linspace(1e-3, np.pi, 20_000)])
    law = OneLaw("fixture")
    forces = np.array([law.force(at_path(DOWN, leaning(a, 0.7), dial)) for a in angles])
    assert np.isfinite(forces).all()
    assert np.linalg.norm(forces, axis=1).max() <= 5.0 + 1e-9
    steps = np.linalg.norm(np.diff(forces, axis=0), axis=1)
    assert np.all(steps <= 40.0 * np.diff(angles) + 1e-12)
    assert np.linalg.norm(forces[0]) <= 40.0 * 1e-12
    assert np.linalg.norm(forces[-1]) < 1e-12


def test_on_the_path_the_repulsion_is_exactly_zero_and_no_nan():
    for tilt in (0.0, 0.2, 0.5):
        d = leaning(tilt, 0.3)
        done = OneLaw("fixture").run(at_path(d, d, -1.0))
        assert not done[sv.FORCE].any()
        assert done[sv.POTENTIAL] > 0.0


def test_spring_and_hill_without_strength_or_reach_do_nothing():
    assert spring_kernel(2.0, 0.0, 5.0) == (0.0, 0.0)
    assert spring_kernel(1.0, 0.0, 0.0) == (0.0, 0.0)
    assert spring_kernel(1.0, 10.0, 0.0) == (0.0, 0.0)
    assert hill_kernel(0.0, 0.0, 10.0) == (0.0, 0.0)


@pytest.mark.long("statistics")
@settings(derandomize=True, deadline=None, max_examples=300)
@given(st.tuples(*(st.floats(-1e6, 1e6),) * 6), st.floats(0.0, 5.0))
def test_the_damper_gives_way_just_enough(numbers, limit):
    f, b = np.array(numbers[:3]), np.array(numbers[3:])
    if np.linalg.norm(f) > 0.0:
        f *= min(1.0, limit / np.linalg.norm(f))
    share = damper_share(*f, *b, limit)
    assert 0.0 <= share <= 1.0
    assert np.linalg.norm(f + share * b) <= limit * (1.0 + 1e-9) + 1e-9
    if np.linalg.norm(f + b) <= limit * (1.0 - 1e-9):
        assert share == pytest.approx(1.0) or not b.any()


def test_a_force_along_the_needle_is_left_to_nobody():
    """A region dead ahead pushes along the needle only: nothing is asked of the motors."""
    centre = np.array([PLACE[f"from_{i}"] for i in "xyz"])
    aim = unit(centre - FULCRUM)
    law = OneLaw("forbidden_region", **PLACE)
    for depth in np.linspace(-0.03, 0.1, 400):
        assert np.linalg.norm(law.force(pose(aim, depth))) < 1e-9


def test_past_the_regions_axis_the_force_turns_round_without_a_jump():
    centre = np.array([PLACE[f"from_{i}"] for i in "xyz"])
    aim, law = unit(centre - FULCRUM), OneLaw("forbidden_region", **PLACE)
    offsets = np.concatenate(
        [-(10.0 ** np.linspace(-2, -15, 300)), 10.0 ** np.linspace(-15, -2, 300)]
    )
    forces = np.array([law.force(pose(unit(aim + [s, 0.0, 0.0]), 0.06)) for s in offsets])
    steps = np.linalg.norm(np.diff(forces, axis=0), axis=1)
    assert np.isfinite(forces).all()
    assert np.all(steps <= 400.0 * np.diff(offsets) + 1e-9)
    assert forces[0, 0] * forces[-1, 0] < 0.0


@pytest.mark.parametrize("name", REQUESTS)
def test_with_almost_no_grip_left_the_forces_stay_finite(name):
    law = OneLaw(name, **REQUESTS[name])
    for l_out in (0.005, 1e-3, 1e-6):
        state = with_joints(at_path(leaning(0.3, 0.2), leaning(0.1, 0.1), 1.0))
        state[sv.L_OUT], state[sv.DEPTH] = l_out, 0.2 - l_out
        for _ in range(50):
            done = law.run(state)
        assert np.isfinite(done[FORCES]).all()
        if name not in ("impedance", "compensation"):
            assert np.linalg.norm(done[sv.FORCE]) <= 5.0 + 1e-9


@pytest.mark.parametrize("name", ["impedance", "compensation"])
def test_where_the_arms_lose_their_inverse_the_torques_stay_bounded(name):
    law = OneLaw(name, **REQUESTS[name])
    rng = np.random.default_rng(2)
    state = with_joints(at_path(leaning(0.3, 0.2), leaning(0.1, 0.1), 1.0), (3.0, -2.0))
    for _ in range(300):
        state[[sv.J_XL, sv.J_XR]] = 0.09 * rng.normal(size=2)
        state[[sv.J_YL, sv.J_YR]] = state[[sv.J_XL, sv.J_XR]] * rng.choice([0.0, 1.0, 1.0 + 1e-9])
        done = law.run(state)
        assert np.isfinite(done[FORCES]).all()
        assert np.abs(done[[sv.JOINT_LEFT, sv.JOINT_RIGHT]]).max() <= 0.1
    state[[sv.J_XL, sv.J_XR, sv.J_YL, sv.J_YR]] = 0.0
    assert np.isfinite(law.run(state)[FORCES]).all()


def test_a_needle_that_rests_leaves_no_subnormal_numbers_in_the_impedance():
    law = OneLaw("impedance")
    away = with_joints(at_path(leaning(0.2, 0.1), DOWN, 0.0))
    rest = with_joints(at_path(leaning(1e-9, 0.0), DOWN, 0.0))
    for _ in range(50):
        law.run(away)
    for _ in range(20_000):
        law.run(rest)
    moving = law.memory[[IMPEDANCE.wx, IMPEDANCE.wy]]
    assert np.all((moving == 0.0) | (np.abs(moving) > 1e-150))


def test_all_laws_together_have_the_sum_of_their_bounds():
    total = laws.energy_bound(REQUESTS, PROFILE)
    assert total == pytest.approx(sum(laws.energy_bounds(REQUESTS, PROFILE).values()))
    stages = laws.stages_of(REQUESTS, PROFILE)
    state = with_joints(at_path(leaning(0.6, 0.2), leaning(0.1, 0.1), -1.0), (1.0, 2.0))
    for _, function, memory in stages:
        function(state, memory)
    assert 0.0 < state[sv.POTENTIAL] <= total
