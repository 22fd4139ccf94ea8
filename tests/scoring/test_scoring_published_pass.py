"""Share of published hands that would pass: against the distribution itself where that decides."""

from __future__ import annotations

import pytest
from scipy.stats import gamma

from app.scoring.pass_line import published_shares
from app.scoring.rows import ScoreRules
from app.scoring.tolerance import Tolerance

FREEHAND, GUIDED, PATIENTS = (6.3, 3.6), (4.0, 2.7), (5.0, 1.2)
"""Mean and standard deviation [mm], Gruber-Rouh 2015."""


def within(limit: float, mean: float, sd: float) -> float:
    return float(gamma.cdf(limit, (mean / sd) ** 2, scale=sd**2 / mean))


def limits(passing: float, weight: float = 1.0, required: bool = True) -> Tolerance:
    given = {"expert": 0.2 * passing, "good": 0.6 * passing, "pass": passing}
    return Tolerance.model_validate(given | {"weight": weight, "required": required})


@pytest.mark.parametrize("passing", [2.7, 5.0])
def test_where_the_target_alone_counts_a_share_is_that_of_the_distribution(passing: float) -> None:
    """At the pass line the utility is 0.6: a mark of 60 is met by whom the line lets pass."""
    shares = published_shares({"target_error": limits(passing)}, ScoreRules(pass_mark=60.0))
    assert [one.hands for one in shares] == ["freehand", "guided", "guided in patients"]
    for one, hands in zip(shares, (FREEHAND, GUIDED, PATIENTS), strict=True):
        assert one.share == pytest.approx(within(passing, *hands), abs=0.002)


def test_a_mark_of_80_is_met_by_whom_the_good_knot_lets_pass() -> None:
    shares = published_shares({"target_error": limits(5.0)}, ScoreRules(pass_mark=80.0))
    assert shares[0].share == pytest.approx(within(3.0, *FREEHAND), abs=0.002)


def test_parts_of_an_error_let_more_pass_than_the_whole_and_other_metrics_are_perfect() -> None:
    rules = ScoreRules(pass_mark=0.0)
    whole = published_shares({"target_error": limits(2.7), "total_time": limits(100.0)}, rules)
    parts = published_shares({"lateral_error": limits(2.7), "depth_error": limits(2.7)}, rules)
    for a, b in zip(whole, parts, strict=True):
        assert b.share >= a.share > 0.0


def test_nothing_is_said_where_no_place_is_judged() -> None:
    assert published_shares({"total_time": limits(100.0)}, ScoreRules()) == ()
    ignored = limits(2.7, weight=0.0, required=False)
    assert published_shares({"target_error": ignored}, ScoreRules()) == ()
