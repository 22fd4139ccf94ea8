"""Smoothness tells more stops from fewer, and how sure it is of that."""

from dataclasses import replace

import numpy as np
import pytest

from app.core.arrays import FloatArray
from app.scoring.metrics import find
from app.scoring.score import score
from app.scoring.smoothness import FINEST, SMOOTHING, even_speed, gaussian_for, spectral_arc_length
from app.scoring.tolerance import Tolerance
from app.scoring.trajectory import Trajectory
from app.scoring.version import KNOWN_VERSIONS, SCORING_VERSION
from tests.scoring.scoring_attempts import placed_plan

STOPS = (1, 2, 4, 8, 16)
LENGTH, PICTURES, LATENCY = 0.09, 30.0, 0.06
"""Insertion of the published comparison [m]; cameras [Hz], [s]."""


def strokes(count: int, seconds: float, time: FloatArray) -> FloatArray:
    """Depth [m] of minimum-jerk movements (Flash and Hogan 1985), one after the other."""
    each = seconds / count
    done = np.clip(np.floor(time / each), 0, count - 1)
    s = np.clip(time / each - done, 0.0, 1.0)
    return np.asarray((done + s**3 * (10.0 - 15.0 * s + 6.0 * s**2)) * LENGTH / count)


def attempt(count: int, seconds: float = 8.0, sigma: float = 0.0, seed: int = 1) -> Trajectory:
    """An insertion as the program samples it: 50 times a second, by pictures at 30 Hz, late."""
    placed = placed_plan()
    time = np.arange(0.0, seconds, 0.02)
    picture = np.floor((time - LATENCY) * PICTURES)
    taken = picture / PICTURES
    rng = np.random.default_rng(seed)
    errors = {k: rng.normal(0.0, sigma) for k in np.unique(picture)}
    depth = strokes(count, seconds, np.maximum(taken, 0.0)) + [errors[k] for k in picture]
    n = len(time)
    spread = np.column_stack([np.full(n, sigma), np.full(n, sigma), time - taken])
    return Trajectory(
        placed=placed,
        time=time,
        tip=placed.p_entry + depth[:, None] * placed.axis,
        axis=np.tile(placed.axis, (n, 1)),
        depth=depth,
        felt=None,
        phase=np.full(n, "inserting"),
        depth_valid=np.ones(n, dtype=bool),
        spread=spread,
    )


def smoothness(trajectory: Trajectory) -> float:
    return find("spectral_arc_length").compute(trajectory)


@pytest.mark.long("statistics")
@pytest.mark.parametrize("seconds", [8.0, 20.0, 60.0])
@pytest.mark.parametrize("sigma", [1e-5, 3e-5, 6e-5])
def test_twice_as_many_stops_in_the_same_time_are_less_smooth(seconds: float, sigma: float) -> None:
    found = [
        [smoothness(attempt(count, seconds, sigma, seed)) for count in STOPS]
        for seed in range(1, 7)
    ]
    steps = np.diff(np.array(found), axis=1)
    assert steps.max() < -0.05, steps.max(axis=0)
    assert (np.abs(steps.mean(axis=0)) > 3.0 * steps.std(axis=0)).all()


def test_the_arc_of_the_published_comparison_is_that_of_the_motion_without_smoothing() -> None:
    """-3.80 and -4.48 are the arcs of 8 and of 16 strokes unsmoothed."""
    time = np.arange(0.0, 8.0, 0.001)
    for count, arc in ((8, -3.80), (16, -4.48)):
        points = strokes(count, 8.0, time)[:, None] * np.array([[0.0, 0.0, -1.0]])
        assert spectral_arc_length(even_speed(time, points), 50.0) == pytest.approx(arc, abs=0.2)


@pytest.mark.parametrize("count", STOPS)
def test_the_deviation_of_smoothness_is_that_of_measuring_again(count: int) -> None:
    again = [smoothness(attempt(count, 8.0, 6e-5, seed)) for seed in range(1, 25)]
    told = find("spectral_arc_length").deviation(attempt(count, 8.0, 6e-5))
    assert told is not None
    # a lobe of the spectrum that only just counts makes it larger, never smaller
    assert 0.4 * np.std(again) < told < max(2.5 * np.std(again), 0.06)


def test_pictures_that_are_held_between_two_samples_are_no_stops() -> None:
    assert smoothness(attempt(1)) == pytest.approx(-1.41, abs=0.05)


def test_noise_asks_for_more_smoothing_and_never_for_more_than_before() -> None:
    widths = [gaussian_for(sigma, 1.0 / 30.0, 1e-3) for sigma in (0.0, 5e-5, 1e-4, 1e-2)]
    assert widths == sorted(widths)
    assert widths[0] == FINEST
    assert widths[-1] == SMOOTHING
    assert gaussian_for(1e-5, 1.0 / 30.0, 0.0) == SMOOTHING


def test_an_older_score_is_made_by_its_own_rule() -> None:
    path = attempt(16, 8.0, 3e-5)
    limits = {"spectral_arc_length": Tolerance.model_validate({"expert": 3, "good": 4, "pass": 5})}
    old, _, new = (score(path, limits, version=one) for one in KNOWN_VERSIONS)
    assert (old.version, new.version) == (KNOWN_VERSIONS[0], SCORING_VERSION)
    # by the rule of version 5: behind a Gaussian of 0.1 s 16 stops pass for smoother than 8
    time, tip = path.time, path.tip
    by_hand = spectral_arc_length(even_speed(time, tip, smoothing=0.1), 50.0)
    assert old.row("spectral_arc_length").value == by_hand
    assert (new.row("spectral_arc_length").value or 0.0) < by_hand - 0.5
    assert score(path, limits) == new
    assert new.version == SCORING_VERSION


def test_an_insertion_of_which_some_pictures_moments_are_unknown_still_has_a_smoothness() -> None:
    whole = attempt(4)
    spread = np.array(whole.spread)
    spread[10] = np.nan
    assert smoothness(replace(whole, spread=spread)) < -2.0
    assert smoothness(replace(whole, spread=None)) < -2.0
    standing = np.array(whole.spread)
    standing[:, 2] = whole.time  # every sample by one and the same picture
    assert smoothness(replace(whole, spread=standing)) < -2.0
