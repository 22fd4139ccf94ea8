"""The study of stability: its reduction, its criterion, and where the whole device oscillates."""

import numpy as np
import pytest

from app.mechanisms.profile import load_profile
from app.studies.rendered_stiffness import (
    DEPTH,
    OFFSET,
    Device,
    Reduction,
    colgate,
    delayed,
    dies_away,
    reductions,
    spectral_radius,
)
from app.studies.stability import STUDY, highest, largest, linear_limit, without_dry_friction

PROFILE = load_profile("icube")
SMOOTH = without_dry_friction(PROFILE)


@pytest.mark.parametrize("rate", [500.0, 1000.0, 4000.0])
@pytest.mark.parametrize("delay", [0, 1, 2])
def test_the_reduction_meets_the_delay_form_for_a_light_damper(rate, delay):
    model = Reduction(0.15, 0.5)
    found = linear_limit((model,), 0.0, 1.0 / rate, delay)
    assert found == pytest.approx(delayed(0.5, 0.0, 1.0 / rate, delay), rel=0.03)


def test_the_reduction_is_the_simulated_one():
    """Spectral radius against a simulation of the same sampled system in small steps."""
    model, step, delay = Reduction(0.24, 0.18), 1e-3, 1
    for stiffness, stable in ((600.0, True), (900.0, False)):
        x, v, past = 1e-3, 0.0, [1e-3] * (delay + 2)
        widths = []
        for _ in range(3000):
            past = [x, *past[:-1]]
            force = -stiffness * past[delay] - 1.0 * (past[delay] - past[delay + 1]) / step
            for _ in range(100):
                middle = v + 0.5e-5 * (force - model.damping * v) / model.mass
                v += 1e-5 * (force - model.damping * middle) / model.mass
                x += 1e-5 * middle
            widths.append(abs(x))
        assert (max(widths[-300:]) < 1e-3) is stable
        radius = spectral_radius(model, np.array([stiffness]), np.array([1.0]), step, delay)
        assert bool(radius[0] < 1.0) is stable


def test_colgate_s_bound_lies_within_the_stable_region_of_the_undelayed_reduction():
    for model in reductions(PROFILE, DEPTH):
        for step in (2e-3, 1e-3, 5e-4):
            for b in (0.0, 0.05, 0.1):
                bound = colgate(model.damping, np.array([b]), step)[0]
                radius = spectral_radius(model, np.array([0.98 * bound]), np.array([b]), step, 0)
                assert radius[0] < 1.0


def test_mass_and_damping_at_the_tool_are_what_the_published_order_says():
    for model in reductions(PROFILE, DEPTH):
        assert 0.2 < model.mass < 0.35
        assert 0.1 < model.damping < 0.3


def test_swinging_is_told_from_rest():
    times = np.linspace(0.0, 1.5, 1500)
    swing = OFFSET * np.cos(200.0 * times)
    lasting = np.stack([swing, 0.0 * swing], axis=1)
    assert not dies_away(lasting, 1e-5)
    assert dies_away(lasting, 1e-3), "narrower than rest"
    assert dies_away(lasting * np.exp(-times)[:, None], 1e-5)
    assert not dies_away(lasting * np.exp(times)[:, None], 1e-5)


@pytest.mark.parametrize("delay", [0, 1])
def test_the_whole_device_without_dry_friction_ends_where_the_reduction_does(delay):
    limit = linear_limit(reductions(PROFILE, DEPTH), 1.0, 1e-3, delay)
    device = Device(SMOOTH, 1000.0, delay)
    assert device.stable(0.7 * limit, 1.0)
    assert not device.stable(1.3 * limit, 1.0)
    assert largest(device, 1.0) == pytest.approx(limit, rel=0.2)


def test_dry_friction_widens_the_stable_region_and_delay_narrows_it():
    assert Device(PROFILE, 1000.0, 1).stable(1000.0, 1.0)
    assert not Device(SMOOTH, 1000.0, 1).stable(1000.0, 1.0)
    assert not Device(PROFILE, 1000.0, 2).stable(1500.0, 1.0)
    assert Device(PROFILE, 2000.0, 2).stable(1500.0, 1.0)


def test_an_unstable_device_swings_ever_wider_but_stays_finite():
    device = Device(SMOOTH, 1000.0, 2)
    track = device.release(8000.0, 0.0)
    assert np.isfinite(track).all()
    assert np.ptp(track, axis=0).max() > 10.0 * OFFSET


def test_what_guards_the_device_keeps_an_unstable_law_slow():
    rate, swings = 1000.0, {}
    for protected in (False, True):
        track = Device(SMOOTH, rate, 1, protected=protected).release(3000.0, 1.0)
        swings[protected] = np.linalg.norm(np.diff(track, axis=0), axis=1).max() * rate
    assert swings[False] > 0.5
    assert swings[True] < 0.25


def test_the_edge_of_a_map_is_below_the_first_oscillation():
    stable = np.zeros((16, 2))
    stable[:4, 0] = 1.0
    stable[8:, 0] = 1.0
    edge = highest(stable)
    assert edge[0] == pytest.approx(50.0 * 200.0 ** (3.0 / 15.0))
    assert edge[1] == 0.0


@pytest.mark.long("statistics")
def test_the_study_says_when_something_oscillates(monkeypatch):
    monkeypatch.setattr("app.studies.stability.RATES", (1000.0,))
    monkeypatch.setattr("app.studies.stability.DELAYS", (1,))
    monkeypatch.setattr("app.studies.stability.STIFFNESS", np.array([100.0, 5000.0]))
    monkeypatch.setattr("app.studies.stability.DAMPING", np.array([0.0, 0.1, 0.3, 1.0]))
    findings = STUDY.measure(None)
    assert findings.lines[0].startswith("Oscillates: let go 0.25 mm")
    assert len(findings.sheets[1].rows) == 4


@pytest.mark.long("statistics")
def test_a_quick_look_sweeps_two_of_nine_pairs_and_draws_them_in_their_places(monkeypatch):
    monkeypatch.setattr("app.studies.stability.STIFFNESS", np.array([100.0, 5000.0]))
    monkeypatch.setattr("app.studies.stability.DAMPING", np.array([0.0, 0.1, 0.3, 1.0]))
    findings = STUDY.quick(None)
    assert {row[:2] for row in findings.sheets[1].rows} == {(500.0, 0), (1000.0, 1)}
    canvas = pytest.importorskip("matplotlib.figure").Figure(figsize=(11.0, 9.0))
    findings.figures[0].draw(canvas)
    places = [axes.get_subplotspec().num1 for axes in canvas.axes]
    assert places == [0, 4]
