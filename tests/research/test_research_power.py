"""Power against published tables, closed forms and R; and intervals that hold what they should."""

import numpy as np
import pytest

from app.research import ResearchError
from app.research.power import (
    Assumptions,
    fit,
    power_of_t,
    simulate,
    students_by_simulation,
    students_for,
)

# Cohen, Statistical Power Analysis, 2nd ed. 1988, table 2.4.1, two-sided 0.05: students of one arm.
COHEN = {(0.2, 0.8): 393, (0.5, 0.8): 64, (0.8, 0.8): 26, (0.5, 0.9): 85, (0.5, 0.95): 105}


@pytest.mark.parametrize(("effect", "power"), COHEN)
def test_the_t_test_needs_as_many_students_as_cohens_table_says(effect, power):
    assumed = Assumptions(effect, 1.0)
    found = students_for(lambda n: power_of_t(n, assumed, False), power)
    assert abs(found / 2 - COHEN[effect, power]) <= 1


@pytest.mark.parametrize("correlation", [0.3, 0.5, 0.7])
def test_a_baseline_as_covariate_needs_1_less_r_squared_of_the_students(correlation):
    assumed = Assumptions(0.3, 1.0, correlation)
    without, with_it = (
        students_for(lambda n, w=w: power_of_t(n, assumed, w), 0.9) for w in (False, True)
    )
    assert with_it / without == pytest.approx(1.0 - correlation**2, abs=0.01)  # Borm et al. 2007


def kept_data():
    student, visit = np.meshgrid(np.arange(12), np.arange(3), indexing="ij")
    k, arm = student * 3 + visit, student % 2
    y = ((k * k * 37 + k * 101 + 17) % 211) / 10 + ((student**2 * 53 + 29 * student) % 97) / 3
    return (y + 2 * visit + 3 * arm * (visit > 0))[None], arm[:, 0].astype(float)


def test_a_mixed_model_is_fitted_as_lme4_and_nlme_do():
    """R 4.2: lme4 1.1 `lmer(y ~ 0 + factor(visit) + a1 + a2 + (1 | id))`, REML; nlme the same."""
    found = fit(*kept_data())
    np.testing.assert_allclose(found.effects[0], [0.5934306946, 5.2100973613], rtol=1e-5)
    np.testing.assert_allclose(found.errors[0], [5.047549530, 5.047549530], rtol=1e-6)
    assert found.sd_students[0] == pytest.approx(9.740682208, rel=1e-6)
    assert found.sd_rest[0] == pytest.approx(6.754556623, rel=1e-6)


def test_students_that_do_not_differ_have_no_variance_of_their_own():
    rng = np.random.default_rng(2)
    values = rng.standard_normal((1, 20, 2))
    values -= 0.98 * values.mean(axis=2, keepdims=True)
    assert fit(values, np.arange(20) % 2.0).sd_students[0] == 0.0


@pytest.mark.parametrize("visits", [1, 2, 3])
def test_with_60_students_the_interval_holds_a_known_effect_in_930_to_970_of_1000(visits):
    found = simulate(60, Assumptions(8.0, 15.0, 0.6, visits), simulations=1000, seed=visits)
    assert 0.930 <= found.coverage <= 0.970


@pytest.mark.parametrize(("visits", "with_baseline"), [(1, False), (2, True)])
def test_simulated_power_is_that_of_the_closed_form(visits, with_baseline):
    assumed = Assumptions(8.0, 15.0, 0.6, visits)
    found = simulate(60, assumed, simulations=2000, seed=4)
    assert abs(found.power - power_of_t(60, assumed, with_baseline)) < 3.5 * found.error


def test_without_an_effect_to_speak_of_five_percent_of_the_studies_are_significant():
    found = simulate(40, Assumptions(1e-9, 1.0), simulations=2000, seed=5)
    assert abs(found.power - 0.05) < 4 * (0.05 * 0.95 / 2000) ** 0.5


def test_as_many_students_as_simulation_asks_for_have_the_wanted_power():
    assumed = Assumptions(10.0, 15.0, 0.6, 2)
    found = students_by_simulation(assumed, 0.8, simulations=1000, seed=6)
    assert abs(power_of_t(found.students, assumed, True) - 0.8) < 0.05


WRONG = {
    "effect is 0": {"effect": 0.0},
    "sd is 0": {"sd": 0.0},
    "correlation is 1": {"correlation": 1.0},
    "visits is 0": {"visits": 0},
    "effect is nan": {"effect": float("nan")},
    "alpha is 0.5": {"alpha": 0.5},
}


@pytest.mark.parametrize("reason", WRONG)
def test_what_cannot_be_assumed_is_refused(reason):
    with pytest.raises(ResearchError, match=reason):
        Assumptions(**{"effect": 1.0, "sd": 1.0} | WRONG[reason])


def test_an_effect_that_no_number_of_students_shows_is_refused():
    assumed = Assumptions(0.001, 1.0)
    with pytest.raises(ResearchError, match="too small"):
        students_for(lambda n: power_of_t(n, assumed, False), 0.8)
