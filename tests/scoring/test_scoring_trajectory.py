from dataclasses import replace

import numpy as np
import pytest
from scoring_attempts import Attempt

from app.scoring.errors import MetricUnavailableError, TrajectoryError
from app.scoring.metrics import find
from app.scoring.trajectory import Phase, Trajectory, runs


def test_arrays_are_read_only_copies() -> None:
    trajectory = Attempt().trajectory()
    with pytest.raises(ValueError, match="read-only"):
        trajectory.tip[0] = 0.0
    with pytest.raises(ValueError, match="read-only"):
        trajectory.phase[0] = 1


def test_phases_are_taken_as_names_or_codes() -> None:
    by_name = Attempt().trajectory()
    by_code = Attempt().trajectory(phase=np.array(by_name.phase))
    np.testing.assert_array_equal(by_name.phase, by_code.phase)
    assert set(by_name.phase) == {Phase.ALIGNING, Phase.INSERTING, Phase.HOLDING}


def test_an_unknown_phase_is_refused_with_the_names_that_exist() -> None:
    phase = np.full(2251, "resting")
    with pytest.raises(TrajectoryError, match="'resting'; phases are ready, aligning"):
        Attempt().trajectory(phase=phase)


@pytest.mark.parametrize(
    ("step", "message"),
    [(0.0, "time stands still at sample 7"), (-0.5, "goes backwards at sample 7")],
)
def test_time_that_does_not_rise_is_refused_with_the_sample(step: float, message: str) -> None:
    time = np.array(Attempt().trajectory().time)
    time[7] = time[6] + step
    with pytest.raises(TrajectoryError, match=message):
        Attempt().trajectory(time=time)


def test_a_sample_that_is_not_finite_is_refused_with_array_and_sample() -> None:
    tip = np.array(Attempt().trajectory().tip)
    tip[12, 1] = np.nan
    with pytest.raises(
        TrajectoryError, match=r"tip is not finite .* in 1 of 2251 samples, first at sample 12"
    ):
        Attempt().trajectory(tip=tip)


def test_an_axis_that_is_no_unit_vector_is_refused() -> None:
    axis = 2.0 * Attempt().trajectory().axis
    with pytest.raises(TrajectoryError, match="at sample 0 is no unit vector"):
        Attempt().trajectory(axis=axis)


@pytest.mark.parametrize("name", ["tip", "axis", "felt", "depth", "phase", "depth_valid", "hub"])
def test_arrays_of_another_length_are_refused_by_name(name: str) -> None:
    values = getattr(Attempt().trajectory(), name)
    with pytest.raises(TrajectoryError, match=f"{name} has shape"):
        Attempt().trajectory(**{name: values[:-1]})


def test_the_durations_of_the_phases_add_up_to_the_whole() -> None:
    trajectory = Attempt(aligning=7.0, inserting=11.0, holding=3.0).trajectory()
    parts = [trajectory.duration(trajectory.phase == phase) for phase in Phase]
    assert sum(parts) == pytest.approx(21.0)
    assert parts[Phase.ALIGNING] == pytest.approx(7.0)
    assert parts[Phase.INSERTING] == pytest.approx(11.0)


def test_the_result_is_read_from_the_last_measured_depth() -> None:
    base = Attempt().trajectory()
    valid = np.ones(len(base), dtype=bool)
    valid[-20:] = False
    assert Attempt().trajectory(depth_valid=valid).final() == len(base) - 21


def test_a_tip_not_seen_for_long_before_the_end_gives_no_result() -> None:
    base = Attempt().trajectory()
    valid = base.time < base.time[-1] - 3.0
    with pytest.raises(MetricUnavailableError, match=r"last seen 3\.0 s before the end"):
        Attempt().trajectory(depth_valid=valid).final()
    with pytest.raises(MetricUnavailableError, match="never measured"):
        Attempt().trajectory(depth_valid=np.zeros(len(base), dtype=bool)).final()


def test_a_needle_that_was_pulled_out_before_the_end_gives_no_result() -> None:
    phase = np.array(Attempt().trajectory().phase)
    phase[-5:] = Phase.ALIGNING
    with pytest.raises(MetricUnavailableError, match="out of the body at the end"):
        Attempt().trajectory(phase=phase).final()


def test_an_attempt_that_ends_while_it_waits_for_the_cameras_is_not_scored_by_where_it_was() -> (
    None
):
    base = Attempt().trajectory()
    phase, valid = np.array(base.phase), np.ones(len(base), dtype=bool)
    phase[-500:], valid[-530:] = Phase.PAUSED, False
    with pytest.raises(MetricUnavailableError, match=r"last seen 10\.6 s before the end"):
        Attempt().trajectory(phase=phase, depth_valid=valid).final()
    valid[-10:] = True  # seen again, not yet long enough to go on
    assert Attempt().trajectory(phase=phase, depth_valid=valid).final() == len(base) - 1


def test_samples_after_the_end_do_not_count() -> None:
    phase = np.array(Attempt().trajectory().phase)
    phase[-100:] = Phase.ENDED
    trajectory = Attempt().trajectory(phase=phase)
    assert trajectory.final() == len(phase) - 101
    assert not trajectory.was_aborted


def test_the_target_moves_with_its_shift() -> None:
    base = Attempt().trajectory()
    shift = np.zeros((len(base), 3))
    shift[-1] = (0.0, 0.01, 0.0)
    moved = Attempt().trajectory(target_shift=shift)
    np.testing.assert_allclose(moved.target(-1) - moved.placed.p_target, (0.0, 0.01, 0.0))
    np.testing.assert_array_equal(base.target(-1), base.placed.p_target)


def test_runs_are_the_stretches_of_true() -> None:
    mask = np.array([True, False, True, True, False, True])
    assert runs(mask) == [slice(0, 1), slice(2, 4), slice(5, 6)]
    assert runs(np.zeros(3, dtype=bool)) == []
    assert runs(np.zeros(0, dtype=bool)) == []


def _paused_on_the_way() -> Trajectory:
    """Half-way in the cameras lose the marker, and the attempt waits for two seconds."""
    whole = Attempt().trajectory()
    phase = whole.phase.copy()
    wait = (whole.time > 29.0) & (whole.time < 31.0)
    phase[wait] = Phase.PAUSED
    return Attempt().trajectory(phase=phase, depth_valid=~wait)


def test_an_insertion_goes_on_after_a_pause() -> None:
    broken = _paused_on_the_way()
    assert len(broken.insertions()) == 2
    (stay,) = broken.stays()
    assert not broken.paused[stay].any()
    assert stay[0] == Attempt().trajectory().insertions()[0].start


def test_a_needle_drawn_out_before_it_goes_on_has_two_stays() -> None:
    whole = Attempt().trajectory()
    phase = whole.phase.copy()
    phase[(whole.time > 29.0) & (whole.time < 31.0)] = Phase.PAUSED
    phase[(whole.time >= 31.0) & (whole.time < 33.0)] = Phase.ALIGNING
    assert len(Attempt().trajectory(phase=phase).stays()) == 2


def test_the_longest_part_of_a_broken_insertion_has_no_pause_in_it() -> None:
    broken = _paused_on_the_way()
    part = broken.longest_part(broken.stays()[-1])
    assert broken.time[part[0]] == 31.0  # the second half, with the time at the target
    assert (np.diff(part) == 1).all()


@pytest.mark.parametrize("name", ["frechet_distance", "dtw_distance", "path_ratio"])
def test_a_pause_on_the_way_in_takes_nothing_from_the_path_before_it(name: str) -> None:
    metric = find(name)
    straight = metric.compute(Attempt().trajectory())
    assert metric.compute(_paused_on_the_way()) == pytest.approx(straight, abs=0.02)


def test_the_angle_at_the_skin_is_that_at_the_skin_after_a_pause_too() -> None:
    broken = _paused_on_the_way()
    turned = Attempt(tilt=0.2).trajectory().axis
    axis = np.where((broken.time > 30.0)[:, None], turned, broken.axis)
    assert find("angle_at_skin").compute(replace(broken, axis=axis)) == pytest.approx(0.0, abs=1e-6)
