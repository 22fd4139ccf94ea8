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


def test_it_is_periodic_even_after_a_day() -> None:
    first = shifts(np.array([0.0, 1.3]))[1]
    later = shifts(np.array([0.0, 1.3 + 21_600 * 4.0]))[1]
    np.testing.assert_allclose(later, first, atol=1e-12)
