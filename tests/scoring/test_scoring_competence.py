"""LC-CUSUM and CUSUM of passes and failures: scores, errors, run lengths, and what is said of them.

References are from outside: R (its own script, kept beside), the R packages surveillance and cusum,
counting by hand, and closed forms.
"""

import datetime
import json
from math import ceil, inf, log
from pathlib import Path

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from app.scoring.competence import (
    RULE,
    CompetenceError,
    CompetenceRule,
    CompetenceState,
    competence,
    competence_words,
    design,
)
from app.scoring.competence.cusum import CusumWeights, learning_weights, watching_weights
from app.scoring.competence.forecast import forecast, rates_of
from app.scoring.competence.run_lengths import MOST_ATTEMPTS, mean_run_length, signalled_by

R = json.loads((Path(__file__).parent / "references" / "competence_r.json").read_text())
"""What `references/competence.R` printed."""

DAY = datetime.datetime(2026, 3, 2, 10, tzinfo=datetime.UTC)


def scores(weights, failed):
    """Scores after each attempt, without a limit."""
    found, score = [], 0.0
    for one in failed:
        score = weights.after(score, not one)
        found.append(score)
    return found


def odds(rate, ratio):
    """Failure rate whose odds are `ratio` times those of another."""
    other = ratio * rate / (1.0 - rate)
    return other / (1.0 + other)


# --- against R --------------------------------------------------------------------------------
def test_the_references_say_which_r_computed_them():
    assert R["r"].startswith("R version 4.2.2")
    assert R["surveillance"] == "1.20.3"


@pytest.mark.parametrize("row", R["traces"], ids=lambda row: f"{row['acceptable']}")
def test_scores_of_a_series_are_those_of_r(row):
    rates = row["acceptable"], row["unacceptable"]
    assert scores(learning_weights(*rates), row["failed"]) == pytest.approx(row["learning"])
    assert scores(watching_weights(*rates), row["failed"]) == pytest.approx(row["watching"])


@pytest.mark.parametrize("row", R["enumerated"], ids=lambda row: f"h {row['limit']}")
def test_errors_are_those_that_r_counts_over_all_series(row):
    low, high, limit, n = (row[k] for k in ("acceptable", "unacceptable", "limit", "attempts"))
    learning, watching = learning_weights(low, high), watching_weights(low, high)
    assert signalled_by(learning, limit, high, n)[-1] == pytest.approx(row["alpha"], abs=1e-12)
    assert 1 - signalled_by(learning, limit, low, n)[-1] == pytest.approx(row["missed"], abs=1e-12)
    false_relapse = signalled_by(watching, limit, low, n)[-1]
    assert false_relapse == pytest.approx(row["false_relapse"], abs=1e-12)


@pytest.mark.parametrize("row", R["distributions"], ids=lambda row: f"h {row['limit']}")
def test_run_lengths_are_distributed_as_r_says(row):
    low, high, limit = (row[key] for key in ("acceptable", "unacceptable", "limit"))
    learning, n = learning_weights(low, high), len(row["competent"])
    both = signalled_by(learning, limit, np.array([high, low]), n)[:, 1:]
    assert both[0] == pytest.approx(np.array(row["incompetent"]), abs=1e-9)
    assert both[1] == pytest.approx(np.array(row["competent"]), abs=1e-9)
    halfway = signalled_by(watching_weights(low, high), limit, low, n, start=limit / 2)[1:]
    assert halfway == pytest.approx(np.array(row["halfway"]), abs=1e-9)


@pytest.mark.parametrize("row", R["limits"], ids=lambda row: f"{row['attempts']}")
def test_the_lowest_limits_that_keep_an_error_are_those_of_r(row):
    low, high, n = row["acceptable"], row["unacceptable"], row["attempts"]
    tests = (
        (learning_weights(low, high), high, row["learning"]),
        (watching_weights(low, high), low, row["watching"]),
    )
    for weights, rate, limit in tests:
        assert signalled_by(weights, limit, rate, n)[-1] <= row["alpha"]
        assert signalled_by(weights, limit - 0.01, rate, n)[-1] > row["alpha"]


@pytest.mark.parametrize("row", R["surveillance_arl"], ids=lambda row: f"{row['rate']}")
def test_average_run_lengths_are_those_of_the_r_package_surveillance(row):
    """Its scores are whole tenths: a limit half a tenth below has no rounding to fear."""
    weights = CusumWeights(1.0 - row["k"], row["k"], failing_gains=True)
    assert mean_run_length(weights, row["h"] - 0.05, row["rate"]) == pytest.approx(
        row["arl"], rel=1e-7
    )


def test_false_signals_are_those_that_the_r_package_cusum_simulated():
    """Its tests print 0.038 and 0.026 of 10 000 series; a lowest limit that it counts out."""
    worse = watching_weights(0.05, odds(0.05, 2.0))
    assert signalled_by(worse, 2.96, 0.05, 100)[-1] == pytest.approx(0.038, abs=0.004)
    better = learning_weights(odds(0.1, 0.5), 0.1)
    assert signalled_by(better, 2.96, 0.1, 100)[-1] == pytest.approx(0.026, abs=0.0035)
    counted = watching_weights(0.1, odds(0.1, 2.0))
    assert signalled_by(counted, 1.41227 - 1e-4, 0.1, 10)[-1] > 0.05
    assert signalled_by(counted, 1.41227 + 1e-4, 0.1, 10)[-1] <= 0.05


# --- by hand and in closed form ---------------------------------------------------------------
def test_the_defaults_are_what_r_finds_for_these_rates():
    (row,) = [r for r in R["limits"] if (r["unacceptable"], r["attempts"]) == (0.4, 24)]
    plan = design()
    assert (RULE.acceptable, RULE.unacceptable) == (row["acceptable"], row["unacceptable"])
    assert (plan.limit, plan.watch_limit) == (row["learning"], row["watching"])
    assert plan.attempts == row["attempts"]
    (known,) = [r for r in R["distributions"] if (r["unacceptable"], r["limit"]) == (0.4, 3.89)]
    assert plan.false_alarm == pytest.approx(known["incompetent"][-1], abs=1e-9)
    assert plan.missed == pytest.approx(1.0 - known["competent"][-1], abs=1e-9)


def test_whoever_never_fails_is_called_after_the_limit_over_a_pass_and_no_sooner():
    weights = learning_weights(0.1, 0.4)
    needed = ceil(3.89 / log(0.9 / 0.6))
    by = signalled_by(weights, 3.89, 0.0, 30)
    assert (by[needed - 1], by[needed]) == (0.0, 1.0)
    standing = competence([True] * needed)
    assert standing.changes[0].attempt == needed == 10
    assert competence([True] * (needed - 1)).fewest == 1


def test_whoever_always_fails_never_is():
    assert signalled_by(learning_weights(0.1, 0.4), 3.89, 1.0, 200)[-1] == 0.0
    assert mean_run_length(learning_weights(0.1, 0.4), 3.89, 1.0) == inf
    assert competence([False] * 300).state is CompetenceState.NOT_YET


def test_of_two_rates_that_mirror_each_other_the_run_length_is_a_gambler_s():
    """With p0 = 1 - p1 a pass and a failure weigh the same: a walk on 0, 1, 2, 3 that stays at 0.

    Its mean time to 3 from 0, a step up with probability q: with E3 = 0 and E0 = 1 + q E1 + (1 - q)
    E0 the differences are d0 = 1/q, d1 = (1 + (1 - q) d0)/q, d2 likewise.
    """
    weights, q = learning_weights(0.3, 0.7), 0.6
    steps = [1.0 / q]
    for _ in range(2):
        steps.append((1.0 + (1.0 - q) * steps[-1]) / q)
    limit = 2.5 * weights.gain
    assert mean_run_length(weights, limit, 1.0 - q) == pytest.approx(sum(steps), rel=1e-9)


def test_one_failure_in_ten_attempts_is_worth_a_signal_only_where_it_came_soon():
    """By hand: ten passes in a row are needed; whoever fails once begins again near 0."""
    plan = design()
    loss = log(4.0)
    assert plan.learning.loss == pytest.approx(loss)
    soon = competence([True, False] + [True] * 10)
    late = competence([True] * 9 + [False] + [True] * 2)
    assert soon.state is CompetenceState.COMPETENT
    assert late.state is CompetenceState.NOT_YET
    assert late.fewest == ceil((3.89 - (11 * plan.learning.gain - loss)) / plan.learning.gain)


def test_three_failures_in_a_row_are_a_relapse_and_learning_begins_anew():
    """By hand: a failure adds log 4 = 1.386, the limit is 3.76, which the third one reaches."""
    passed = [True] * 12 + [False] * 3
    standing = competence(passed)
    assert [(one.attempt, one.state.value) for one in standing.changes] == [
        (10, "competent"),
        (15, "relapse"),
    ]
    assert standing.scores[9] >= 1.0
    assert standing.scores[14] >= 1.0
    assert standing.fewest == 10
    again = competence([*passed, *[True] * 10])
    assert again.state is CompetenceState.COMPETENT
    assert again.changes[-1].attempt == 25


# --- gaps -------------------------------------------------------------------------------------
def times(count, gap_after, days):
    """A time a day, with a gap after an attempt."""
    return [
        DAY + datetime.timedelta(days=n + (days if n >= gap_after else 0)) for n in range(count)
    ]


def test_after_weeks_two_failures_are_a_relapse_where_practising_takes_three():
    passed = [True] * 12 + [False] * 2
    assert competence(passed, times(14, 12, 40)).state is CompetenceState.RELAPSE
    assert competence(passed, times(14, 12, 20)).state is CompetenceState.COMPETENT
    assert competence(passed).state is CompetenceState.COMPETENT


def test_a_gap_does_not_take_competence_away():
    assert competence([True] * 10, times(10, 10, 0), DAY + datetime.timedelta(days=400)).state is (
        CompetenceState.COMPETENT
    )


def test_what_was_shown_before_a_gap_does_not_make_a_learner_competent():
    passed = [True] * 10
    assert competence(passed, times(10, 6, 40)).state is CompetenceState.NOT_YET
    assert competence(passed, times(10, 6, 40)).fewest == 6
    later = competence(passed[:6], times(6, 6, 0), DAY + datetime.timedelta(days=60))
    assert later.fewest == 10


@given(st.lists(st.booleans(), max_size=80), st.integers(0, 80))
@settings(max_examples=100, deadline=None)
def test_a_gap_never_makes_anybody_competent_sooner(passed, gap_after):
    def first(standing):
        competent = [c.attempt for c in standing.changes if c.state is CompetenceState.COMPETENT]
        return competent[0] if competent else inf

    with_gap = competence(passed, times(len(passed), gap_after, 100))
    assert first(with_gap) >= first(competence(passed))


# --- what is said -----------------------------------------------------------------------------
def test_a_line_says_since_when_with_which_error_and_how_many_more():
    assert competence_words(competence([True] * 12)) == (
        "competent after 10 attempts (false alarm ≤ 5 %)"
    )
    assert competence_words(competence([True] * 5)).startswith("not yet: at least 5 more (5 to ")
    relapsed = competence_words(competence([True] * 12 + [False] * 3))
    assert relapsed.startswith("relapse after attempt 15: at least 10 more (")
    assert competence_words(competence([])) == "not yet: at least 10 more"
    assert competence_words(competence([False] * 20)).endswith("(hardly, as the last ones went)")


def test_a_signal_after_the_planned_attempts_says_its_larger_error():
    """Whoever fails 4 of 10 and goes on is called competent some day: that share is said."""
    plan = design()
    late = competence([True, False] * 20 + [True] * 10)
    attempt = late.changes[0].attempt
    assert attempt > plan.attempts
    known = signalled_by(plan.learning, plan.limit, 0.4, attempt)[-1]
    assert late.false_alarm == pytest.approx(known)
    assert known > RULE.false_alarm
    assert f"≤ {ceil(100 * known)} %" in competence_words(late)


def test_the_forecast_holds_for_students_whose_rate_stays():
    """Simulated here without the chain: 1500 students each, from eight attempts on."""
    plan, rng = design(), np.random.default_rng(31)
    gain, loss = log(0.9 / 0.6), log(4.0)
    for rate in (0.1, 0.2, 0.3):
        held = []
        for failed in rng.random((1500, 200)) < rate:
            score, number = 0.0, inf
            for place, one in enumerate(failed):
                if place == 8:
                    likely = forecast(plan, score, list(~failed[:8]))
                score = max(0.0, score - loss) if one else score + gain
                if score >= plan.limit:
                    number = place - 7
                    break
            held.append((likely.low or inf) <= number <= (likely.high or inf))
        assert np.mean(held) > 0.80


def test_rates_after_some_attempts_are_those_of_jeffreys():
    """Mean and variance of Beta(k + 1/2, n - k + 1/2) in closed form."""
    for failures, attempts in ((0, 1), (0, 20), (3, 10), (20, 20)):
        rates, shares = rates_of(failures, attempts)
        a, b = failures + 0.5, attempts - failures + 0.5
        assert shares @ rates == pytest.approx(a / (a + b), abs=1e-12)
        spread = shares @ rates**2 - (shares @ rates) ** 2
        assert spread == pytest.approx(a * b / ((a + b) ** 2 * (a + b + 1)), abs=1e-12)


def test_the_fewest_attempts_more_are_the_low_end_or_below_it():
    rng = np.random.default_rng(5)
    for n in range(1, 40):
        standing = competence(list(rng.random(n) < 0.8))
        if standing.forecast is not None and standing.forecast.low is not None:
            assert standing.fewest <= standing.forecast.low


# --- hard cases -------------------------------------------------------------------------------
@pytest.mark.parametrize(
    ("acceptable", "unacceptable"),
    [(0.2, 0.2), (0.4, 0.1), (0.0, 0.4), (0.1, 1.0), (-0.1, 0.4), (float("nan"), 0.4)],
)
def test_rates_that_make_no_test_are_refused(acceptable, unacceptable):
    with pytest.raises(ValidationError):
        CompetenceRule(acceptable=acceptable, unacceptable=unacceptable)
    with pytest.raises(CompetenceError, match="the first must be less than the second"):
        learning_weights(acceptable, unacceptable)


def test_equal_rates_are_refused_in_words():
    with pytest.raises(ValidationError, match=r"0\.2, the acceptable one 0\.2: it must be more"):
        CompetenceRule(acceptable=0.2, unacceptable=0.2)


def test_rates_too_near_to_be_told_apart_are_refused_at_once():
    with pytest.raises(CompetenceError, match="too near to be told apart in 300 attempts"):
        design(CompetenceRule(acceptable=0.1, unacceptable=0.11))


def test_times_of_some_attempts_only_are_refused():
    with pytest.raises(CompetenceError, match="1 times for 2 attempts"):
        competence([True, True], [DAY])


@pytest.mark.parametrize(
    ("limit", "start", "attempts"), [(0.0, 0.0, 5), (2.0, 2.0, 5), (2.0, -1.0, 5), (2.0, 0.0, -1),
                                     (2.0, 0.0, MOST_ATTEMPTS + 1), (float("nan"), 0.0, 5)]
)  # fmt: skip
def test_run_lengths_outside_their_range_are_refused(limit, start, attempts):
    with pytest.raises(CompetenceError, match="the start is at least 0 and below the limit"):
        signalled_by(learning_weights(0.1, 0.4), limit, 0.2, attempts, start)


@pytest.mark.long("statistics")
def test_a_million_attempts_are_told_in_seconds():
    standing = competence([True, True, False] * 333_333 + [True])
    assert standing.attempts == 1_000_000
    assert standing.state is CompetenceState.NOT_YET
    assert competence([True] * 1_000_000).changes[0].attempt == 10


@pytest.mark.long("statistics")
@given(
    st.floats(0.01, 0.6), st.floats(1.5, 8.0), st.sampled_from([0.02, 0.05, 0.1, 0.2]),
    st.sampled_from([0.05, 0.1, 0.2]),
)  # fmt: skip
@settings(max_examples=25, deadline=None)
def test_whatever_the_rule_its_errors_are_kept_or_it_is_refused(low, ratio, alpha, beta):
    high = odds(low, ratio)
    rule = CompetenceRule(acceptable=low, unacceptable=high, false_alarm=alpha, missed=beta)
    try:
        plan = design(rule)
    except CompetenceError:
        assert high - low < 0.2
        return
    assert 0.0 <= plan.false_alarm <= alpha
    assert 0.0 <= plan.missed <= beta
    assert plan.false_relapse <= alpha
    # What can be told without a chain: whoever passes every time is called.
    needed = ceil(plan.limit / plan.learning.gain - 1e-9)
    assert needed <= plan.attempts
    assert plan.false_alarm >= (1.0 - high) ** needed - 1e-12
    assert plan.missed <= 1.0 - (1.0 - low) ** needed + 1e-12


@given(st.lists(st.booleans(), max_size=120))
@settings(max_examples=100, deadline=None)
def test_states_follow_each_other_and_scores_stay_below_the_limit_but_at_signals(passed):
    standing = competence(passed)
    kinds = [one.state for one in standing.changes]
    assert kinds == [CompetenceState.COMPETENT, CompetenceState.RELAPSE] * (len(kinds) // 2) + (
        [CompetenceState.COMPETENT] if len(kinds) % 2 else []
    )
    over = [n for n, score in enumerate(standing.scores, 1) if score >= 1.0]
    assert over == [one.attempt for one in standing.changes]
    assert (standing.fewest == 0) == (standing.state is CompetenceState.COMPETENT)
    json.dumps(standing.document(), allow_nan=False)


def test_within_few_attempts_only_series_without_a_failure_signal():
    """By hand: four passes in a row signal, of which the score needs all from 0 on."""
    weights = learning_weights(0.1, 0.4)
    limit, rate = 4 * weights.gain - 0.01, 0.25
    by = signalled_by(weights, limit, rate, 5)
    assert by[4] == pytest.approx((1 - rate) ** 4)
    # In five attempts: the first four pass, or the first fails and the other four pass.
    assert by[5] == pytest.approx((1 - rate) ** 4 + rate * (1 - rate) ** 4)


def test_what_a_course_does_not_allow_any_more_is_said_and_no_interval_beside_it():
    """Seen: "not yet: at least 10 more" to a student who has no attempt left."""
    standing = competence([True] * 2)
    fewest = standing.fewest
    assert fewest == 8
    assert competence_words(standing, 1) == "not yet: at least 8 more, and the course allows 1"
    assert competence_words(standing, 8) == competence_words(standing) != ""
    assert "allows" not in competence_words(competence([True] * 12), 0)  # shown already
