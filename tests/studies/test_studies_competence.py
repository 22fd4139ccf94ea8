"""The survey of competence: errors over virtual students, what others printed, how late it is."""

import numpy as np
import pytest

from app.core.progress import Progress
from app.scoring.competence import design
from app.studies.competence import (
    PUBLISHED,
    QUICK,
    RULES,
    _verdict,
    errors,
    forecasts,
    learning_curves,
    published,
    relapses,
    signals,
)
from app.studies.runner import find_study


@pytest.fixture(scope="module")
def table():
    """Errors of each rule over ten thousand virtual students, a column each."""
    sheet = errors(QUICK, np.random.default_rng(7), Progress())
    return [dict(zip(sheet.columns, row, strict=True)) for row in sheet.rows]


def test_the_survey_is_there_by_its_name():
    study = find_study("competence")
    assert "Competence" in study.title
    assert study.quick is not None


@pytest.mark.long("statistics")
def test_no_error_is_above_what_was_asked_and_all_lie_within_a_hundredth_below(table):
    assert len(table) == len(RULES)
    for row in table:
        for name in ("alpha", "beta"):
            assert 0.0 <= row[f"{name} asked"] - row[name] <= 0.01, row["rates of"]
        assert row["holds"] == "yes"


@pytest.mark.long("statistics")
def test_virtual_students_are_called_as_often_as_the_chain_says(table):
    """Four standard errors of ten thousand students; the survey's own loop knows no chain."""
    for row in table:
        for name in ("alpha", "beta", "false relapse"):
            spread = 4.0 * np.sqrt(row[name] * (1.0 - row[name]) / QUICK)
            assert abs(row[f"{name} simulated"] - row[name]) < spread + 1e-3


def test_an_error_above_what_was_asked_does_not_hold():
    asked = (0.05, 0.10, 0.05)
    assert _verdict(asked, (0.048, 0.099, 0.048), (0.048, 0.099, 0.048), QUICK) == "yes"
    assert _verdict(asked, (0.051, 0.099, 0.048), (0.051, 0.099, 0.048), QUICK) != "yes"
    assert _verdict(asked, (0.048, 0.099, 0.048), (0.070, 0.099, 0.048), QUICK) != "yes"
    assert _verdict(asked, (0.030, 0.099, 0.048), (0.030, 0.099, 0.048), QUICK) == "yes, coarse"


def test_what_others_printed_lies_within_two_of_their_standard_errors():
    rows = published().rows
    assert len(rows) == len(PUBLISHED) >= 5
    assert [row[-1] for row in rows] == ["yes"] * len(rows)


def test_a_signal_comes_when_the_score_is_added_up_by_hand():
    """Nobody fails: ten passes of log(0.9/0.6) reach 3.89; whoever fails is never called."""
    rng = np.random.default_rng(1)
    assert (signals(0.4, 0.1, 3.89, np.zeros(20), 5, rng) == 10.0).all()
    assert np.isinf(signals(0.4, 0.1, 3.89, np.ones(200), 5, rng)).all()
    assert (signals(0.1, 0.4, 3.76, np.ones(20), 5, rng) == 3.0).all()
    assert (signals(0.1, 0.4, 3.76, np.ones(20), 5, rng, start=1.88) == 2.0).all()


def test_students_who_learn_are_called_after_they_are_better_than_unacceptable():
    sheet = learning_curves(4000, np.random.default_rng(3))
    for row in (dict(zip(sheet.columns, row, strict=True)) for row in sheet.rows):
        assert row["called before it is below p1"] < design().false_alarm
        assert row["below p1 from"] < row["called, median"] < 3 * design().attempts


def test_a_relapse_is_seen_sooner_after_a_gap_at_the_price_of_more_false_ones():
    practising, rested = relapses(4000, np.random.default_rng(4)).rows
    assert rested[4] < practising[4]
    assert practising[1] <= 0.05 < rested[1] < 0.15
    when = signals(0.1, 0.4, 3.76, np.full(6000, 0.1), 2000, np.random.default_rng(6))
    assert np.isfinite(when).all()
    assert practising[2] == pytest.approx(when.mean(), rel=4.0 / np.sqrt(2000))


@pytest.mark.long("statistics")
def test_forecasts_hold_at_least_as_often_as_they_state():
    for row in forecasts(300, np.random.default_rng(5)).rows:
        assert min(row[1:]) > 0.80 - 3.0 * np.sqrt(0.16 / 300)
