"""Studies of the cameras: triangulation with figure 42, and the filters of the depth."""

import numpy as np
import pytest

from app.core.units import MILLIMETRE
from app.studies import depth_motion, marker, stereo
from app.studies.runner import run
from app.tracking.optics.rig import load_rig
from app.tracking.stereo.triangulation import Way


@pytest.fixture
def few(monkeypatch):
    monkeypatch.setattr(stereo, "_POINTS", 20)
    monkeypatch.setattr(stereo, "_TRIALS", 60)
    monkeypatch.setattr(stereo, "_STEP", 12e-3)


@pytest.mark.parametrize("name", stereo.RIGS)
def test_the_printed_error_is_about_a_third_of_the_real_one(name, monkeypatch):
    monkeypatch.setattr(stereo, "_TRIALS", 300)
    rig = load_rig(name)
    points = stereo.workspace(rig, 20e-3)
    assert len(points) > 2
    for point in points[:3]:
        printed, rms, radius = stereo.figures(rig, point)
        assert 0.3 < printed / rms < 0.42
        assert 1.5 * rms < radius < 2.5 * rms
        errors = stereo.simulated(rig, point, Way.REPROJECTION, 4)
        assert np.sqrt(np.mean(np.sum(errors**2, axis=1))) == pytest.approx(rms, rel=0.12)


def test_the_thesis_rig_gives_the_size_that_its_figure_shows():
    rig = load_rig("thesis")
    printed = [stereo.figures(rig, p)[0] / MILLIMETRE for p in stereo.workspace(rig, 8e-3)]
    assert 0.012 < np.mean(printed) < 0.018


@pytest.mark.long("statistics")
def test_the_study_of_triangulation_runs(few):
    result = run("stereo", repeats=1)
    assert result.failures == ()
    assert result.too_coarse() == ()
    sheet = result.findings.sheets[0]
    assert {row[0] for row in sheet.rows} == {"thesis", "wide"}


@pytest.mark.long("statistics")
def test_the_default_filter_is_calm_at_rest_and_close_in_motion():
    errors = {
        name: [depth_motion.shown_error(make(), path) for path in depth_motion.PATHS.values()]
        for name, (_, make) in depth_motion._FILTERS.items()
    }
    strokes, _, rest, steady = errors["Kalman, 2e-4 m²/s³"]
    assert rest < 0.2
    assert strokes < 0.4 * errors["newest fix"][0]
    assert steady < 0.05 * errors["newest fix"][3]
    assert strokes < errors["one euro, 5 Hz"][0]


@pytest.mark.long("statistics")
def test_the_study_of_the_marker_orders_the_ways_and_none_is_below_the_bound(monkeypatch):
    monkeypatch.setattr(marker, "_SCENES", 5)
    result = run("marker", repeats=1)
    assert result.failures == ()
    error = {p.way: p.error for p in result.points if p.setting == "even grey"}
    assert error["model_fit"] < error["outline_centroid"] < error["ellipse"] < error["thesis"]
    rows = result.findings.sheets[0].rows
    assert {row[1] for row in rows} == {"bound: position alone", "bound: joint", *error}
    assert all(row[4] > 0.7 for row in rows)


@pytest.mark.parametrize(
    ("name", "least", "claim"),
    [("strokes", 0.90, 1.0), ("pushes", 0.87, 3.0), ("rest", 0.99, 0.6), ("steady", 0.99, 0.6)],
)
def test_the_shown_depth_claims_little_at_rest_and_enough_when_a_hand_pushes(name, least, claim):
    make = depth_motion._FILTERS["Kalman, 2e-4 m²/s³"][1]
    errors, claims = depth_motion.shown_errors(make(), depth_motion.PATHS[name]).T
    assert np.mean(np.abs(errors) <= 1.96 * claims) >= least
    assert np.median(claims) < claim  # [mm]
