"""Studies of single formulas: what their references and their other ways are worth."""

import numpy as np
import pytest

from app.simulation.effects.breathing import lujan
from app.studies import breathing_waveform, inverse_kinematics, plant_substeps
from app.studies.runner import find_study, run


@pytest.mark.parametrize("n", [1, 2, 3, 7])
def test_the_cosines_of_a_breath_sum_to_its_power(n):
    weights = breathing_waveform.weights_of(n)
    for phase in np.linspace(0.0, np.pi, 37):
        exact = np.sin(phase) ** (2 * n)
        assert breathing_waveform.cosines(phase, weights) == pytest.approx(exact, abs=1e-14)
        assert lujan(phase, float(n)) == pytest.approx(exact, abs=1e-15)


@pytest.mark.long("statistics")
def test_the_finest_table_of_a_breath_is_off_by_what_its_curvature_says():
    result = run("breathing_waveform", repeats=1)
    worst = {p.way: p for p in result.summary()}
    step = np.pi / 256
    # f'' of sin^6 is at most 6 at the top: h²/8 times that, and 17.1 mm.
    assert worst["table 256"].error == pytest.approx(17.1 * 6.0 * step**2 / 8.0, rel=0.05)
    assert worst["product"].error < 1e-12
    assert {(f.way, f.setting) for f in result.failures} == {("cosines", "n = 2.5")}


@pytest.mark.long("statistics")
def test_the_closed_form_of_the_inverse_is_exact_and_newton_squares_its_error():
    worst = {p.way: p.error for p in run("inverse_kinematics", repeats=1).summary()}
    assert worst["closed form"] < 1e-12
    assert worst["Newton 1"] > 30.0 * worst["Newton 2"] > 30.0 * worst["Newton 3"]
    assert worst["Newton 4"] < 1e-11


@pytest.mark.long("statistics")
@pytest.mark.parametrize("number", range(4))
def test_the_finest_substeps_of_the_robot_are_a_reference_good_to_a_micrometre(number):
    setting = find_study("plant_substeps").settings[number]
    reference = plant_substeps.REFERENCE
    fine = plant_substeps.prepared(setting, reference)().copy()
    finer = plant_substeps.prepared(setting, reference / 2.0)()
    assert np.linalg.norm(fine - finer, axis=1).max() < 0.5e-6
    assert np.ptp(fine, axis=0).max() > 1e-3, "the tool moves"


def test_the_error_of_the_robots_substeps_falls_with_their_length():
    setting = find_study("plant_substeps").settings[1]
    true = plant_substeps.prepared(setting, plant_substeps.REFERENCE)().copy()
    errors = [
        np.linalg.norm(plant_substeps.prepared(setting, h)() - true, axis=1).max()
        for h in (0.5e-3, 0.25e-3, 0.125e-3)
    ]
    assert errors[0] / errors[1] == pytest.approx(2.0, rel=0.1)
    assert errors[1] / errors[2] == pytest.approx(2.0, rel=0.1)


def test_newtons_method_stays_where_the_arms_are_singular():
    links = (0.1, 0.165, 0.085)
    start = float(np.arccos(0.5 * 0.085 / 0.1))  # the elbows meet
    found = inverse_kinematics.newton(0.0, 0.2, start, np.pi - start, links, 5)
    assert found == (start, np.pi - start)
