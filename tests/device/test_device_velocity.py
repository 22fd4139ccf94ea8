"""Velocity estimators: what all of them keep, and what sets each apart."""

from math import pi

import numpy as np
import pytest

from app.core import state_vector as sv
from app.device.control import machine_stages
from app.device.control.velocity import (
    _READINGS,
    _RING,
    _TIMES,
    DEFAULT_VELOCITY,
    AdaptiveWindow,
    AlphaBeta,
    BackwardDifference,
    Kalman,
    VelocityFilter,
    VelocityMethod,
    end_fit,
    velocity_stage,
)
from app.device.links.simulated import simulated_link
from app.mechanisms.profile import load_profile

PROFILE = load_profile("icube")
COUNT = 2.0 * pi / PROFILE.encoder.counts_per_turn
DT = 1e-3


class Estimator:
    """A stage on a clock of its own; `at(left)` is one tick with the right joint standing."""

    def __init__(self, stage) -> None:
        self.state = sv.empty_state()
        _, self.function, self.memory = stage
        self.time = 5.0

    def at(self, left, right=0.5, dt=DT, stamp=None):
        self.time += dt
        self.state[sv.TIME], self.state[sv.DT] = self.time, dt
        self.state[sv.Q_TIME] = self.time if stamp is None else stamp
        self.state[sv.Q_LEFT], self.state[sv.Q_RIGHT] = left, right
        self.function(self.state, self.memory)
        return self.state[sv.QD_LEFT]


@pytest.fixture(params=VelocityMethod)
def estimator(request):
    return Estimator(velocity_stage(PROFILE, request.param))


def counted(angle):
    return np.floor(angle / COUNT + 0.5) * COUNT


def errors(stage, angle, rate, dt=DT):
    """Error of the left velocity [rad/s] after the first 50 ms, for functions of time."""
    chosen = Estimator(stage)
    times = np.arange(1, 1500) * dt
    found = np.array([chosen.at(counted(angle(t)), dt=dt) for t in times])
    return (found - rate(times))[times > 0.05]


def test_the_first_velocity_is_zero_not_a_spike(estimator):
    assert estimator.at(2.5) == 0.0
    assert estimator.state[sv.QD_RIGHT] == 0.0


def test_the_velocity_settles_on_the_true_rate(estimator):
    for k in range(2000):
        estimator.at(2.0 + 0.3 * DT * k, 0.5 - 0.1 * DT * k)
    assert estimator.state[sv.QD_LEFT] == pytest.approx(0.3, rel=1e-6)
    assert estimator.state[sv.QD_RIGHT] == pytest.approx(-0.1, rel=1e-6)


def test_a_joint_at_rest_ends_at_exactly_zero(estimator):
    for k in range(100):
        estimator.at(2.0 + 0.3 * DT * k)
    assert [estimator.at(2.03) for _ in range(3000)][-1] == 0.0


def test_a_tick_of_no_length_keeps_the_velocity(estimator):
    for k in range(50):
        before = estimator.at(2.0 + 1e-3 * k)
    assert estimator.at(2.05, dt=0.0) == before
    assert estimator.at(2.05, dt=np.nan, stamp=estimator.time) == before


def test_a_bad_reading_gives_zero_velocity_and_a_fresh_start(estimator):
    for k in range(50):
        estimator.at(2.0 + 1e-3 * k)
    assert estimator.at(np.nan) == 0.0
    assert estimator.at(1.0) == 0.0
    assert abs(estimator.at(1.0)) < 1e-9


def test_a_jump_of_half_a_turn_is_no_movement_and_is_forgotten(estimator):
    for _ in range(100):
        estimator.at(2.0)
    assert estimator.at(2.0 + 2.0 * pi) == 0.0
    found = [estimator.at(2.0 + 2.0 * pi + 0.3 * DT * k) for k in range(1, 400)]
    assert max(found) < 0.5
    assert found[-1] == pytest.approx(0.3, rel=1e-3)


def test_a_reading_that_is_delivered_twice_does_not_show_as_a_standstill(estimator):
    found = []
    for k in range(400):
        stamp = 5.0 + DT * (k + 1)
        estimator.at(2.0 + 0.3 * DT * k, stamp=stamp)
        found.append(estimator.at(2.0 + 0.3 * DT * k, dt=0.5 * DT, stamp=stamp))
        estimator.time -= 0.5 * DT
    assert np.ptp(found[200:]) < 0.02 * 0.3
    assert found[-1] == pytest.approx(0.3, rel=0.01)


def test_readings_that_stay_old_bring_the_velocity_to_zero(estimator):
    for k in range(100):
        moving = estimator.at(2.0 + 0.3 * DT * k)
    stamp = estimator.time
    kept = [estimator.at(2.03, stamp=stamp) for _ in range(30)]
    assert kept[10] == moving
    assert kept[-1] == 0.0


def test_a_late_tick_is_divided_by_the_time_that_passed_not_by_the_clamped_step(estimator):
    for k in range(200):
        estimator.at(2.0 + 0.3 * DT * k)
    estimator.time += 0.095  # the loop clamps DT to 5 ms, the encoder went on
    late = estimator.at(2.0 + 0.3 * (DT * 199 + 0.1), dt=5e-3)
    assert late == pytest.approx(0.3, rel=0.05)


@pytest.mark.parametrize(
    "stage",
    [BackwardDifference().stage(), VelocityFilter(1e12).stage(), AdaptiveWindow(1.0, 1).stage()],
    ids=["backward difference", "filter of no time constant", "window of one step"],
)
def test_three_names_for_a_backward_difference(stage):
    chosen = Estimator(stage)
    chosen.at(2.0)
    assert chosen.at(2.001) == pytest.approx(1.0, rel=1e-8)


def test_the_filter_answers_a_step_with_its_time_constant():
    chosen = Estimator(VelocityFilter(50.0).stage())
    constant = 1.0 / (2.0 * pi * 50.0)
    found = [chosen.at(2.0 + 0.3e-4 * k, dt=1e-4) for k in range(40)]
    expected = 0.3 * (1.0 - (constant / (constant + 1e-4)) ** np.arange(40))
    assert found == pytest.approx(expected, abs=1e-9)


def test_the_backward_difference_shows_one_count_as_a_count_per_tick():
    error = errors(BackwardDifference().stage(), lambda t: 0.0511 * t, lambda t: 0.0511)
    assert np.abs(error).max() <= COUNT / DT
    assert np.sqrt(np.mean(error**2)) == pytest.approx(COUNT / DT / np.sqrt(6.0), rel=0.1)


def test_the_best_line_is_the_longest_one_that_stays_within_the_band():
    random = np.random.default_rng(7)
    for _ in range(300):
        stage = AdaptiveWindow(COUNT, 30).stage()
        memory = stage[2]
        steps = random.uniform(0.5e-3, 2e-3, _RING)
        times = np.cumsum(steps)
        readings = counted(np.cumsum(random.normal(0.0, random.choice([0.2, 1.0]) * COUNT, _RING)))
        memory[_TIMES : _TIMES + _RING] = times
        memory[_READINGS : _READINGS + _RING] = readings
        assert end_fit(memory, _RING - 1, _READINGS, 30) == pytest.approx(
            by_the_paper(times, readings, COUNT), rel=1e-12
        )


def by_the_paper(times, readings, band):
    """The paper's own procedure: try a window, check each reading in it, widen until one fails."""
    last, slope = len(times) - 1, 0.0
    for back in range(1, 31):
        candidate = (readings[last] - readings[last - back]) / (times[last] - times[last - back])
        between = np.arange(last - back + 1, last)
        line = readings[last] - candidate * (times[last] - times[between])
        if (np.abs(line - readings[between]) > band * (1.0 + 1e-6)).any():
            break
        slope = candidate
    return slope


def test_the_window_is_long_at_rest_and_short_when_the_joint_leaves():
    chosen = Estimator(AdaptiveWindow(COUNT).stage())
    for k in range(200):
        found = chosen.at(counted(2.0) + COUNT * (k % 2))
    assert abs(found) <= COUNT / (20 * DT)
    leaving = [chosen.at(counted(2.0 + 3.0 * DT * k)) for k in range(1, 8)]
    assert leaving[-1] == pytest.approx(3.0, rel=0.2)


def test_the_kalman_gains_are_those_of_the_steady_state():
    chosen = Estimator(Kalman(COUNT, 0.1).stage())
    for _ in range(3000):
        chosen.at(2.0)
    noise, q, f = COUNT**2 / 12.0, 0.1, np.array([[1.0, DT], [0.0, 1.0]])
    drive = q * np.array([[DT**3 / 3.0, DT**2 / 2.0], [DT**2 / 2.0, DT]])
    p = np.diag([noise, 1.0])
    for _ in range(20_000):
        p = f @ p @ f.T + drive
        gain = p[:, 0] / (p[0, 0] + noise)
        p = p - np.outer(gain, p[0])
    assert chosen.memory[5:8] == pytest.approx([p[0, 0], p[0, 1], p[1, 1]], rel=1e-6)


def test_the_default_is_quieter_than_the_thesis_own_and_quicker_than_a_filter_as_quiet():
    def slow(t):
        return 2.0 + 0.05 * np.sin(pi * t), 0.05 * pi * np.cos(pi * t)

    def rms(stage):
        error = errors(stage, lambda t: slow(t)[0], lambda t: slow(t)[1])
        return np.sqrt(np.mean(error**2))

    default = rms(velocity_stage(PROFILE, DEFAULT_VELOCITY))
    assert default < 0.1 * rms(BackwardDifference().stage())
    assert default < 0.5 * rms(VelocityFilter().stage())
    assert default < rms(AlphaBeta(20e-3).stage())


def test_a_table_takes_the_estimator_by_name():
    link = simulated_link(PROFILE, [])
    default = machine_stages(PROFILE, [], [], link)
    thesis = machine_stages(PROFILE, [], [], link, velocity=VelocityMethod.BACKWARD_DIFFERENCE)
    assert [stage.name for stage in default] == [stage.name for stage in thesis]
    assert default.compute[2].function is velocity_stage(PROFILE, DEFAULT_VELOCITY)[1]
    assert thesis.compute[2].function is BackwardDifference().stage()[1]
