"""Metrics of how the needle moved: against independent formulas and published values."""

import numpy as np
import pytest

from app.core.arrays import FloatArray
from app.scoring import metrics
from app.scoring.errors import MetricUnavailableError
from app.scoring.paths import frechet, resampled, time_warping
from app.scoring.smoothness import log_dimensionless_jerk, spectral_arc_length
from app.scoring.trajectory import Trajectory
from app.studies.runner import examine
from tests.scoring.scoring_attempts import Attempt

BELL = np.exp(-5.0 * np.arange(-1.0, 1.0, 0.01) ** 2)
MM = 1e-3
DEGREE = np.pi / 180.0


def value(name: str, trajectory: Trajectory) -> float:
    return metrics.find(name).compute(trajectory)


def test_smoothness_is_what_its_authors_publish() -> None:
    assert spectral_arc_length(BELL, 100.0) == pytest.approx(-1.41403, abs=5e-6)
    assert log_dimensionless_jerk(BELL, 100.0) == pytest.approx(-5.81636, abs=5e-6)


def test_smoothness_does_not_depend_on_how_fast_or_how_far() -> None:
    for rate in (50.0, 200.0):
        assert log_dimensionless_jerk(7.0 * BELL, rate) == pytest.approx(-5.81636, abs=5e-6)
    assert spectral_arc_length(7.0 * BELL, 100.0) == pytest.approx(-1.41403, abs=5e-6)


def test_the_study_prints_the_published_values() -> None:
    (sheet,) = examine("metrics").findings.sheets
    found = {str(row[0]): row[2] for row in sheet.rows[:2]}
    assert found == {"SPARC": "-1.41403", "LDLJ": "-5.81636"}


def _recursive(a: FloatArray, b: FloatArray, i: int, j: int, longest: bool) -> float:
    distance = float(np.linalg.norm(a[i] - b[j]))
    if i == 0 and j == 0:
        return distance if longest else 2.0 * distance
    before = [
        (_recursive(a, b, i - p, j - q, longest), p + q)
        for p, q in ((1, 0), (0, 1), (1, 1))
        if i >= p and j >= q
    ]
    if longest:
        return max(distance, min(one for one, _ in before))
    return min(one + weight * distance for one, weight in before)


@pytest.mark.parametrize("seed", range(5))
def test_distances_of_paths_are_those_of_the_recursive_definition(seed: int) -> None:
    rng = np.random.default_rng(seed)
    a, b = rng.normal(size=(5, 3)), rng.normal(size=(6, 3))
    assert frechet(a, b) == pytest.approx(_recursive(a, b, 4, 5, True), rel=1e-12)
    assert time_warping(a, b) == pytest.approx(_recursive(a, b, 4, 5, False) / 11, rel=1e-12)


def test_a_path_is_resampled_evenly_with_both_ends() -> None:
    points = resampled(np.array([[0.0, 0.0, 0.0], [0.0, 0.0, 0.1]]))
    assert len(points) == 201
    np.testing.assert_allclose(points[[0, -1], 2], [0.0, 0.1])
    assert len(resampled(np.zeros((3, 3)))) == 2


def test_a_straight_insertion_lies_on_the_plan_and_a_detour_as_far_off_as_it_goes() -> None:
    straight = Attempt().trajectory()
    assert value("frechet_distance", straight) < 0.3
    bent = Attempt(detour=6.0 * MM).trajectory()
    assert value("frechet_distance", bent) == pytest.approx(6.0, abs=0.3)
    assert 0.5 < value("dtw_distance", bent) < 6.0


def test_an_insertion_that_stops_and_goes_is_less_smooth_by_both_measures() -> None:
    attempt = Attempt()
    smooth = attempt.trajectory()
    time = smooth.time
    share = np.clip((time - attempt.aligning) / attempt.inserting, 0.0, 1.0)
    ease = 10.0 * share**3 - 15.0 * share**4 + 6.0 * share**5
    jerky = share + np.sin(2.0 * np.pi * 8.0 * share) / (2.0 * np.pi * 8.0)

    def inserted(way: FloatArray) -> Trajectory:
        depth = way * smooth.placed.length
        tip = smooth.placed.p_entry + np.outer(depth, smooth.placed.axis)
        return attempt.trajectory(depth=depth, tip=tip)

    for name in ("spectral_arc_length", "log_dimensionless_jerk"):
        assert value(name, inserted(jerky)) < value(name, inserted(ease)) < 0.0
    assert value("spectral_arc_length", inserted(ease)) == pytest.approx(-1.5, abs=0.2)


def test_a_tip_that_stands_still_has_no_smoothness() -> None:
    still = Attempt().trajectory()
    tip = np.tile(still.tip[-1], (len(still), 1))
    with pytest.raises(MetricUnavailableError, match="speed never changed"):
        value("log_dimensionless_jerk", Attempt().trajectory(tip=tip))


@pytest.mark.parametrize(
    ("back", "turn", "count"), [(0.015, 5.0, 1), (0.015, 1.0, 0), (0.005, 5.0, 0)]
)
def test_a_redirect_is_drawn_back_far_enough_and_turned_far_enough(
    back: float, turn: float, count: int
) -> None:
    attempt = Attempt()
    plain = attempt.trajectory()
    times = [0.0, 20.0, 28.0, 32.0, 40.0, 45.0]
    depth = np.interp(plain.time, times, [0.0, 0.0, 0.05, 0.05 - back, 0.08, 0.08])
    side = np.cross(plain.axis[0], [0.0, 1.0, 0.0])
    side /= np.linalg.norm(side)
    angle = np.where(plain.time > 30.0, turn, 0.0)[:, None] * DEGREE
    axis = np.cos(angle) * plain.axis + np.sin(angle) * side
    assert value("redirects", attempt.trajectory(depth=depth, axis=axis)) == count


def test_angles_in_and_out_of_the_axial_plane_make_up_the_angle_error() -> None:
    attempt = Attempt()
    plain = attempt.trajectory()
    rotation = plain.placed.placement.rotation
    path = rotation.T @ plain.placed.axis
    flat, up = np.arctan2(path[1], path[0]), np.arcsin(path[2])
    for turn, lean in ((3.0, 0.0), (0.0, 2.0), (-2.0, 1.5)):
        a, b = flat + turn * DEGREE, up + lean * DEGREE
        leaning = rotation @ [np.cos(b) * np.cos(a), np.cos(b) * np.sin(a), np.sin(b)]
        tip = plain.placed.p_entry + np.outer(plain.depth, plain.placed.axis)
        moved = attempt.trajectory(axis=np.tile(leaning, (len(plain), 1)), tip=tip)
        assert value("angle_in_plane", moved) == pytest.approx(turn, abs=1e-6)
        assert value("angle_out_of_plane", moved) == pytest.approx(lean, abs=1e-6)
        whole = value("angle_error", moved)
        assert whole == pytest.approx(np.hypot(turn * np.cos(up), lean), rel=0.02)


def test_the_angle_at_the_skin_is_that_of_the_beginning() -> None:
    attempt = Attempt()
    tilted = attempt.but(tilt=4.0 * DEGREE).trajectory()
    straight = attempt.trajectory()
    axis = np.where(straight.time[:, None] < 30.0, tilted.axis, straight.axis)
    moved = attempt.trajectory(axis=axis)
    assert value("angle_at_skin", moved) == pytest.approx(4.0, abs=1e-6)
    assert value("angle_error", moved) == pytest.approx(0.0, abs=1e-5)
