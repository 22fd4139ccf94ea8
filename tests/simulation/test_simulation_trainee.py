"""The scripted trainee: phases, skill, determinism."""

from collections.abc import Callable

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st
from scipy.spatial.transform import Rotation

from app.core import state_vector as sv
from app.core.arrays import FloatArray, unit
from app.simulation.errors import SimulationError
from app.simulation.skills import EXPERT, NOVICE
from app.simulation.trainee import (
    STEP,
    ScriptPhase,
    directions,
    tangent_basis,
    tangents,
    traced_script,
    trainee_stage,
    write_script,
)

AXIS = unit(np.array([0.3, 0.1, -0.9]))
DEPTH = 0.08
UPRIGHT = np.array([0.0, 0.0, -0.015])
"""Where a hand waits: x, y of the direction, depth."""


def played(
    skill: str, seed: int = 0, speed: float = 1.0, start: float = 100.0, grip: FloatArray = UPRIGHT
) -> FloatArray:
    """Time, hand direction (3), depth, phase every 2 ms until done, shape (n, 6)."""
    _, step, parameters = trainee_stage(AXIS, DEPTH, skill, seed, speed)
    state, rows = sv.empty_state(), []
    state[sv.ENABLED] = 1.0
    state[sv.GRIP_X], state[sv.GRIP_Y], state[sv.GRIP_DEPTH] = grip
    for k in range(30_000):
        state[sv.TIME] = start + 0.002 * k
        step(state, parameters)
        x, y = state[sv.HAND_X], state[sv.HAND_Y]
        z = -np.sqrt(1.0 - x * x - y * y)
        rows.append([0.002 * k, x, y, z, state[sv.HAND_DEPTH], state[sv.TRAINEE_PHASE]])
        if state[sv.TRAINEE_PHASE] == ScriptPhase.DONE:
            return np.array(rows)
    raise AssertionError("never done")


def angles(rows: FloatArray) -> FloatArray:
    cross = np.linalg.norm(np.cross(rows[:, 1:4], AXIS), axis=1)
    result: FloatArray = np.rad2deg(np.arctan2(cross, rows[:, 1:4] @ AXIS))
    return result


def test_an_expert_takes_about_12_s_and_a_novice_about_25() -> None:
    assert 10.0 < played("expert")[-1, 0] < 14.0
    assert 22.0 < played("novice")[-1, 0] < 28.0


@pytest.mark.parametrize("seed", range(4))
def test_an_expert_aims_within_a_degree_and_ends_within_a_millimetre(seed: int) -> None:
    rows = played("expert", seed)
    inside = rows[:, 4] > 0.0
    assert angles(rows)[inside].max() < 1.2
    assert rows[inside, 4].max() < DEPTH + 1e-3
    tip = rows[-1, 4] * rows[-1, 1:4]
    assert np.linalg.norm(tip - DEPTH * AXIS) < 1e-3


@pytest.mark.parametrize("seed", range(4))
def test_a_novice_aims_wrong_withdraws_redirects_and_overshoots(seed: int) -> None:
    rows = played("novice", seed)
    first = np.flatnonzero(rows[:, 5] == ScriptPhase.INSERT)[0]
    assert 2.4 < angles(rows)[first] < 4.6
    assert {ScriptPhase.WITHDRAW, ScriptPhase.REDIRECT} <= set(rows[:, 5].astype(int))
    assert DEPTH + 2.5e-3 < rows[:, 4].max() < DEPTH + 6.5e-3
    assert abs(rows[-1, 4] - DEPTH) < 2.5e-3


def test_it_starts_above_the_skin_off_the_path_and_holds_at_the_end() -> None:
    rows = played("expert")
    assert rows[0, 4] == pytest.approx(-0.015, abs=2e-4)
    assert angles(rows)[0] > 4.0
    holds = np.isin(rows[:, 5], (ScriptPhase.HOLD, ScriptPhase.WAIT))
    assert np.count_nonzero(holds) * 0.002 == pytest.approx(1.5, abs=0.01)


def test_phases_come_in_order_for_an_expert() -> None:
    phases = played("expert")[:, 5]
    assert (np.diff(phases) >= 0).all()


@pytest.mark.parametrize("skill", ["novice", "expert"])
@pytest.mark.parametrize("grip", [UPRIGHT, (0.3, -0.4, 0.02), (-0.6, 0.0, -0.02), (0.0, 0.6, 0.0)])
def test_it_begins_where_the_hand_is(skill: str, grip: FloatArray) -> None:
    rows = played(skill, grip=grip)
    tremor = {"novice": 4e-3, "expert": 1e-3}[skill]
    np.testing.assert_allclose(rows[0, 1:3], grip[:2], atol=tremor)
    assert rows[0, 4] == pytest.approx(grip[2], abs=3e-4)


def test_where_it_began_is_forgotten_once_it_has_hovered() -> None:
    here, there = played("expert"), played("expert", grip=np.array([0.3, -0.4, 0.02]))
    hovered = here[:, 5] != ScriptPhase.HOVER
    np.testing.assert_allclose(here[hovered], there[hovered], atol=1e-12)


def test_a_hand_that_is_nowhere_does_not_reach_the_script() -> None:
    rows = played("expert", grip=np.array([np.nan, 0.0, np.inf]))
    assert np.isfinite(rows).all()


def test_the_hand_never_jumps() -> None:
    rows = played("novice")
    assert np.abs(np.diff(rows[:, 1:4], axis=0)).max() < 1e-3
    assert np.abs(np.diff(rows[:, 4])).max() < 2e-4


def test_the_same_seed_is_the_same_run_at_any_starting_time() -> None:
    np.testing.assert_allclose(played("novice", 3), played("novice", 3, start=7.0), atol=1e-9)


def test_it_waits_until_armed_and_begins_anew_when_armed_again() -> None:
    _, step, parameters = trainee_stage(AXIS, DEPTH, "expert")
    state = sv.empty_state()
    for enabled, time, phase in (
        (0, 5.0, 0),
        (1, 9.0, 1),
        (1, 11.0, 2),
        (0, 12.0, 2),
        (1, 30.0, 1),
    ):
        state[sv.ENABLED], state[sv.TIME] = enabled, time
        step(state, parameters)
        assert state[sv.TRAINEE_PHASE] == phase


def breathing_run(shift: Callable[[float, bool], float], holds: bool) -> FloatArray:
    """Hand (x, y, depth), phase, hold asked, shift every 2 ms of an expert until he is done."""
    _, step, parameters = trainee_stage(AXIS, DEPTH, "expert", 1, holds=holds)
    state, rows = sv.empty_state(), []
    state[sv.ENABLED], state[sv.DT] = 1.0, 0.002
    for k in range(250_000):
        state[sv.TIME] = 100.0 + 0.002 * k
        state[sv.HOLD_BREATH] = 0.0
        step(state, parameters)
        asked = state[sv.HOLD_BREATH] > 0.5
        state[sv.TARGET_SHIFT_Y] = shift(0.002 * k, asked)
        hand = [state[sv.HAND_X], state[sv.HAND_Y], state[sv.HAND_DEPTH]]
        rows.append([*hand, state[sv.TRAINEE_PHASE], float(asked), state[sv.TARGET_SHIFT_Y]])
        if state[sv.TRAINEE_PHASE] == ScriptPhase.DONE:
            return np.array(rows)
    raise AssertionError("never done")


@pytest.mark.parametrize("period", [3.1, 4.0, 5.3])
def test_its_end_waits_for_the_rest_between_two_breaths(period: float) -> None:
    rows = breathing_run(lambda t, _: -0.012 * np.sin(np.pi * t / period) ** 4, holds=False)
    assert abs(rows[-1, 5]) < 6e-4
    assert not rows[:, 4].any()


@pytest.mark.long("statistics")
def test_it_does_not_wait_for_a_rest_that_never_comes() -> None:
    rows = breathing_run(lambda _t, _a: 0.005, holds=False)
    still = breathing_run(lambda _t, _a: 0.0, holds=False)
    pushing = np.count_nonzero(still[:, 3] >= ScriptPhase.INSERT) * 0.002
    assert len(rows) * 0.002 < len(still) * 0.002 + 50.0 * pushing + 80.0


def test_it_pushes_in_the_rest_between_two_breaths() -> None:
    rows = breathing_run(lambda t, _: -0.012 * np.sin(np.pi * t / 4.0) ** 4, holds=False)
    pushed = np.diff(rows[:, 2], prepend=rows[0, 2])
    inside = (rows[:, 3] == ScriptPhase.INSERT) & (rows[:, 2] > 0.0)
    away = np.abs(rows[:, 5]) > 2e-3
    assert np.abs(pushed[inside & away]).sum() < 0.15 * np.abs(pushed[inside]).sum()


def test_it_has_the_breath_held_waits_and_aims_where_the_target_rests() -> None:
    since = [np.inf]

    def shift(time: float, asked: bool) -> float:
        since[0] = min(since[0], time) if asked else np.inf
        if time - since[0] > 3.0:
            return 0.004
        swing = np.cos(2.0 * np.pi * (time - since[0])) if asked else 1.0
        return 0.004 * float(swing) + 1e-6 * time

    rows = breathing_run(shift, holds=True)
    inside = rows[:, 2] > 0.0
    assert (rows[inside, 4] > 0.5).all()
    assert (rows[inside, 5] == 0.004).all()
    x, y, depth = rows[-1, :3]
    tip = depth * np.array([x, y, -np.sqrt(1.0 - x * x - y * y)])
    assert np.linalg.norm(tip - DEPTH * AXIS - [0.0, 0.004, 0.0]) < 1.2e-3


def test_another_seed_is_another_run() -> None:
    one, two = write_script(AXIS, DEPTH, NOVICE, 1), write_script(AXIS, DEPTH, NOVICE, 2)
    n = min(len(one.rows), len(two.rows))
    assert np.abs(one.rows[:n, :2] - two.rows[:n, :2]).max() > 1e-3


def test_a_speed_factor_shortens_the_run() -> None:
    assert played("novice", speed=2.0)[-1, 0] == pytest.approx(played("novice")[-1, 0] / 2, abs=0.1)


def test_the_tremor_lies_between_8_and_12_hz_and_repeats_without_a_seam() -> None:
    tile = write_script(AXIS, DEPTH, NOVICE, 0).tremor[:, 0]
    power = np.abs(np.fft.rfft(tile)) ** 2
    frequency = np.fft.rfftfreq(len(tile), 0.004)
    band = (frequency >= 8.0) & (frequency <= 12.0)
    assert power[band].sum() > 0.999 * power.sum()
    assert abs(tile[0] - tile[-1]) <= np.abs(np.diff(tile)).max() * 1.01
    assert tile.std() == pytest.approx(NOVICE.tremor, rel=1e-6)


def test_the_start_leans_up_from_a_tilted_path_so_that_it_can_be_reached() -> None:
    tilted = unit(np.array([0.0, np.sin(np.deg2rad(38)), -np.cos(np.deg2rad(38))]))
    for seed in range(20):
        script = write_script(tilted, DEPTH, EXPERT, seed)
        e = script.rows[0, :2] @ script.basis
        assert unit(tilted + e)[2] < tilted[2]


def test_the_duration_is_that_of_the_rows() -> None:
    script = write_script(AXIS, DEPTH, EXPERT, 0)
    assert script.duration == pytest.approx((len(script.rows) - 1) * STEP)
    assert script.rows[-1, 3] == ScriptPhase.DONE


def test_what_cannot_be_played_is_refused_by_name() -> None:
    with pytest.raises(SimulationError, match="are novice, beginner, competent, proficient, exp"):
        trainee_stage(AXIS, DEPTH, "master")
    with pytest.raises(SimulationError, match="must be above 0"):
        trainee_stage(AXIS, -0.01)
    with pytest.raises(SimulationError, match="speed factor is 0"):
        trainee_stage(AXIS, DEPTH, speed=0.0)


@given(
    st.lists(
        st.tuples(st.floats(-0.7, 0.7), st.floats(-0.7, 0.7), st.floats(-0.02, 0.12)),
        min_size=2,
        max_size=6,
    )
)
def test_a_movement_becomes_the_script_that_plays_it(moments):
    axis = unit(np.array([0.2, -0.3, -1.0]))
    basis = tangent_basis(axis)
    e1, e2, depth = np.array(moments).T
    angle = np.hypot(e1, e2)
    axes = np.cos(angle)[:, None] * axis + np.sinc(angle / np.pi)[:, None] * (
        e1[:, None] * basis[0] + e2[:, None] * basis[1]
    )
    np.testing.assert_allclose(np.array(tangents(axes, axis, basis)), [e1, e2], atol=1e-9)
    aside = e1[:, None] * basis[0] + e2[:, None] * basis[1]
    turned = Rotation.from_rotvec(np.cross(axis, aside)).apply(axis)
    np.testing.assert_allclose(directions(e1, e2, axis, basis), turned, atol=1e-9)
    script = traced_script(np.arange(len(depth)) * 0.5, axes, depth, axis)
    assert np.isfinite(script.rows).all()
    np.testing.assert_allclose(script.rows[-1, :3], [e1[-1], e2[-1], depth[-1]], atol=1e-9)
    assert script.rows[-1, 3] == ScriptPhase.DONE


def test_a_movement_of_one_moment_or_without_numbers_is_refused():
    down = np.array([0.0, 0.0, -1.0])
    for time, depth in (([0.0], [0.0]), ([0.0, 1.0], [0.0, np.nan])):
        axes = np.tile(down, (len(time), 1))
        with pytest.raises(SimulationError, match="two finite samples"):
            traced_script(np.array(time), axes, np.array(depth), down)
