"""What an attempt costs, and what many would, by arithmetic that is done here by hand."""

from statistics import mean, stdev

import pytest

from app.cohort.cost import AttemptCost, Spent
from app.cohort.versions import differences, versions


def test_a_million_attempts_cost_their_time_and_the_preparing_of_every_process():
    cost = AttemptCost.of([Spent(10, 3.0, 18.0), Spent(10, 0.0, 18.0)])
    assert cost.attempt == pytest.approx(1.8)
    assert cost.core_hours(1e6, processes=4) == pytest.approx((1.8e6 + 4 * 3.0) / 3600.0)
    document = cost.document(1e6, 4, 0.05)
    assert document["money"] == pytest.approx(0.05 * document["core_hours"])
    assert cost.document(1e6, 4, None)["money"] is None


def test_the_error_of_an_attempts_cost_is_that_of_a_mean_where_parts_are_alike():
    times = [10.0, 12.0, 11.0, 15.0]
    cost = AttemptCost.of([Spent(5, 0.0, time) for time in times])
    assert cost.attempt == pytest.approx(mean(times) / 5)
    assert cost.attempt_sd == pytest.approx(stdev(times) / 5 / len(times) ** 0.5)


def test_one_part_says_no_error_and_none_costs_nothing():
    assert AttemptCost.of([Spent(3, 1.0, 3.0)]).attempt_sd is None
    assert AttemptCost.of([]) == AttemptCost(0.0, None, 0.0)


def test_what_another_computer_has_otherwise_is_named():
    assert differences(dict(versions())) == ()
    theirs = dict(versions()) | {"acus": "9.9.9"}
    assert differences(theirs) == (f"acus 9.9.9, here {versions()['acus']}",)
    assert len(differences({})) == len(versions())
