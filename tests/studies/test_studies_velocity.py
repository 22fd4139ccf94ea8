"""The study of velocity estimators: its motions, and what it decides."""

import numpy as np
import pytest

from app.mechanisms.pantograph import forward
from app.mechanisms.profile import load_profile
from app.studies.runner import run
from app.studies.velocity import MOTIONS, lag, motion


@pytest.mark.parametrize("name", MOTIONS)
def test_the_speed_of_a_motion_is_the_rate_of_its_place(name):
    _, path = MOTIONS[name]
    times = np.linspace(0.013, 0.79, 500)
    step = 1e-6
    place = (path(times + step)[0] - path(times - step)[0]) / (2.0 * step)
    assert place == pytest.approx(path(times)[1], abs=2e-5)


def test_readings_are_within_half_a_count_of_a_path_along_x():
    profile = load_profile("icube")
    seen = motion("correction", profile, 1000.0)
    count = 2.0 * np.pi / profile.encoder.counts_per_turn
    points = np.array([forward(profile.pantograph, q) for q in seen.readings])
    assert np.ptp(points[:, 1]) < 2.0 * 0.1 * count
    assert np.ptp(points[:, 0]) == pytest.approx(0.010, abs=2.0 * 0.1 * count)
    assert (seen.rates * seen.lever).sum(axis=1) == pytest.approx(seen.speed, abs=1e-12)


def test_the_lag_of_a_delayed_truth_is_its_delay():
    seen = motion("let go", load_profile("icube"), 1000.0)
    late = np.vstack([np.zeros((7, 2)), seen.rates[:-7]])
    assert lag(seen, late) == pytest.approx(7e-3, abs=3e-4)


@pytest.mark.long("statistics")
def test_the_study_finds_the_adaptive_window_quiet_and_quick():
    result = run("velocity", repeats=1)
    assert result.failures == ()
    assert "window 20" not in result.too_coarse()
    assert "difference" in result.too_coarse()
    assert result.findings is not None
    sheets = {sheet.name: sheet for sheet in result.findings.sheets}
    rows = {row[0]: np.array(row[1:]) for row in sheets["errors"].rows}
    means = {name: np.exp(np.mean(np.log(row))) for name, row in rows.items()}
    assert means["window 20"] < min(m for n, m in means.items() if not n.startswith("window"))
