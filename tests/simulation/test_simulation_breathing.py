"""Breathing: amplitudes in patient axes, rest at exhalation, hysteresis."""

import numpy as np
import pytest
from simulation.effect_rig import memory_of

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.simulation.effects import breathing as effect
from app.simulation.scene import Binding, Scene

SUPINE = np.array([[1.0, 0, 0], [0, 0, 1.0], [0, -1.0, 0]])  # L→+x, S→+y, A→+z: columns L, P, S


def shifts(times: FloatArray, **parameters: float) -> FloatArray:
    memory = memory_of("breathing", parameters, Binding(Scene(R_world_patient=SUPINE)))
    rows = []
    for time in times:
        state = sv.empty_state()
        state[sv.TIME] = time
        effect.step(state, memory)
        rows.append(state[sv.TARGET_SHIFT].copy())
    return np.array(rows)


def test_a_supine_liver_moves_towards_feet_front_and_left_by_its_amplitudes() -> None:
    moved = shifts(1000.0 + np.linspace(0.0, 8.0, 8001))
    assert moved[:, 0].max() == pytest.approx(0.0013, rel=1e-6)
    assert moved[:, 1].min() == pytest.approx(-0.0119, rel=1e-6)
    assert moved[:, 2].max() == pytest.approx(0.0038, rel=1e-6)


def test_it_starts_at_exhalation_and_rests_there_longest() -> None:
    moved = shifts(77.0 + np.linspace(0.0, 4.0, 4001))
    assert abs(moved[0, 1]) == 0.0
    near = np.mean(np.abs(moved[:, 1]) < 0.002)
    assert 0.4 < near < 0.5  # n = 2: 44 % of the time within 2 mm of end-exhale at 12 mm


def test_the_path_is_a_loop_when_the_front_lags() -> None:
    def area(path: FloatArray) -> float:
        return float(abs(np.sum(path[:-1, 1] * path[1:, 2] - path[1:, 1] * path[:-1, 2])) / 2.0)

    times = np.linspace(0.0, 4.0, 4001)
    assert area(shifts(times)) > 1e-6
    assert area(shifts(times, anterior_lag=0.0)) < 1e-12


@pytest.mark.parametrize("shape", [1.0, 2.0, 3.0, 2.5])
def test_the_waveform_is_the_power_of_the_sine_for_whole_and_broken_shapes(shape: float) -> None:
    for phase in np.linspace(-1.0, 4.0, 23):
        expected = abs(np.sin(phase)) ** (2.0 * shape)
        assert effect.lujan(phase, shape) == pytest.approx(expected, rel=1e-12, abs=1e-30)


def commanded(asked: list[tuple[float, bool]], lasts: float, **parameters: float) -> FloatArray:
    """Displacement every 2 ms of a patient who is told at these times to hold, or to breathe."""
    binding = Binding(Scene(R_world_patient=SUPINE), model="on_command")
    memory, state, rows = memory_of("breathing", parameters, binding), sv.empty_state(), []
    state[sv.DT] = 0.002
    for k in range(round(lasts / 0.002)):
        told = [wish for since, wish in asked if since <= 0.002 * k]
        state[sv.TIME], state[sv.HOLD_BREATH] = 50.0 + 0.002 * k, float(told[-1] if told else 0)
        state[sv.TARGET_SHIFT] = 0.0
        effect.step(state, memory)
        rows.append(state[sv.TARGET_SHIFT].copy())
    return np.array(rows)


def test_unasked_it_breathes_as_without_the_command() -> None:
    free = commanded([], 12.0)
    np.testing.assert_allclose(free, shifts(0.002 * np.arange(1, 6001) + 9.0)[:], atol=3e-5)


def test_a_hold_breathes_out_settles_where_it_is_and_lasts_until_he_may_breathe() -> None:
    moved = commanded([(5.0, True), (16.0, False)], 24.0)
    held = moved[round(10.0 / 0.002) : round(16.0 / 0.002)]
    assert np.ptp(held, axis=0).max() == 0.0
    assert 1e-4 < np.linalg.norm(held[0]) < 0.0061  # 2 SD of 3 mm at most
    assert moved[round(16.5 / 0.002) :, 1].min() < -0.0115


def test_a_hold_ends_by_itself_and_has_to_be_asked_for_anew() -> None:
    moved = commanded([(1.0, True), (40.0, False), (41.0, True)], 55.0)
    assert moved[round(26.0 / 0.002) : round(40.0 / 0.002), 1].min() < -0.0115  # asked in vain
    first, second = moved[round(20.0 / 0.002)], moved[round(50.0 / 0.002)]
    assert np.linalg.norm(first - second) > 1e-4  # never twice at one place


@pytest.mark.parametrize("told", [0.0, 1.9, 3.99])
def test_the_target_never_jumps_whenever_it_is_told(told: float) -> None:
    times = told + 0.31 * np.arange(60)
    moved = commanded([(float(t), k % 2 == 0) for k, t in enumerate(times)], 20.0)
    moved = np.vstack([moved, commanded([(told, True), (told + 9.0, False)], 20.0)[1:] * 1.0])
    for part in (moved[:10_000], moved[10_000:]):
        assert np.linalg.norm(np.diff(part, axis=0), axis=1).max() < 0.002 * 0.035


@pytest.mark.long("machine")
def test_where_holds_lie_spreads_as_asked() -> None:
    places = [commanded([(0.0, True)], 7.0, draws=float(k), period=2.0)[-1, 1] for k in range(40)]
    assert 0.0015 < float(np.std(places)) < 0.0035
    assert not commanded([(0.0, True)], 7.0, spread=0.0)[-1].any()


def test_it_is_periodic_even_after_a_day() -> None:
    first = shifts(np.array([0.0, 1.3]))[1]
    later = shifts(np.array([0.0, 1.3 + 21_600 * 4.0]))[1]
    np.testing.assert_allclose(later, first, atol=1e-12)


def varied(times: FloatArray, **parameters: float) -> FloatArray:
    binding = Binding(Scene(R_world_patient=SUPINE), model="varying")
    memory, rows = memory_of("breathing", parameters, binding), []
    for time in times:
        state = sv.empty_state()
        state[sv.TIME] = time
        effect.step(state, memory)
        rows.append(state[sv.TARGET_SHIFT].copy())
    return np.array(rows)


def breaths_of(**parameters: float) -> tuple[FloatArray, FloatArray]:
    """How long each breath of the tile lasts [s], and how far it goes over the mean."""
    memory = memory_of("breathing", parameters, Binding(Scene(), model="varying"))
    ends = memory[effect._ENDS : effect._DEPTHS]
    return np.diff(ends, prepend=0.0), memory[effect._DEPTHS :]


def test_without_variation_varying_breaths_are_the_periodic_ones() -> None:
    times = 50.0 + np.linspace(0.0, 4.0 * effect.BREATHS + 30.0, 20_001)
    same = varied(times, depth_variation=0.0, period_variation=0.0)
    assert np.abs(same - shifts(times)).max() < 1e-12


def test_depth_and_period_vary_by_what_is_asked_and_are_like_the_breath_before() -> None:
    drawn = [breaths_of(draws=float(seed), likeness=0.4) for seed in range(1, 31)]
    for which, mean, asked in ((0, 4.0, 0.15), (1, 1.0, 0.18)):
        every = [one[which] for one in drawn]
        spread = np.std(every) / np.mean(every)
        assert np.mean(every) == pytest.approx(mean, rel=0.01)
        assert 0.92 * asked < spread < asked  # cut off at two standard deviations
        alike = [np.corrcoef(one[1:], one[:-1])[0, 1] for one in every]
        assert np.mean(alike) == pytest.approx(0.4, abs=0.04)
    assert np.min([one[0] for one in drawn]) > 0.0


def test_the_same_seed_breathes_the_same_and_another_does_not() -> None:
    times = np.linspace(3.0, 60.0, 500)
    assert np.array_equal(varied(times, draws=7.0), varied(times, draws=7.0))
    assert not np.array_equal(varied(times, draws=7.0), varied(times, draws=8.0))


def test_time_alone_says_where_a_varying_organ_is() -> None:
    times = np.linspace(0.0, 500.0, 3001)
    backwards = np.concatenate([[0.0], times[::-1]])
    assert np.array_equal(varied(times), varied(backwards)[1:][::-1])


@pytest.mark.long("machine")
def test_no_breath_begins_with_a_jump_not_even_where_the_tile_repeats() -> None:
    worst = {"depth_variation": 0.4, "period_variation": 0.4, "anterior_lag": 1.2}
    lasts, _ = breaths_of(**worst)
    borders = np.concatenate([np.cumsum(lasts)[:40], [lasts.sum()]])
    for border in borders:
        around = varied(np.concatenate([[0.0], border + np.arange(-50, 51) * 1e-4]), **worst)
        # 17.1 mm at most, in π of the shortest breath (a fifth of 4 s): its speed, not a jump.
        assert np.abs(np.diff(around[1:], axis=0)).max() < 0.03 * np.pi / 0.8 * 1e-4
    turns = varied(np.concatenate([[0.0], np.arange(0.0, 200.0, 1e-3)]), **worst)[1:]
    assert np.abs(np.diff(turns, axis=0)).max() < 0.03 * np.pi / 0.8 * 1e-3


def test_a_time_that_is_no_number_moves_no_varying_organ() -> None:
    state = sv.empty_state()
    memory = memory_of("breathing", {}, Binding(Scene(), model="varying"))
    for bad in (np.nan, np.inf, -np.inf):
        state[sv.TIME] = bad
        effect.step(state, memory)
        assert not state[sv.TARGET_SHIFT].any()
