import json
import math
from dataclasses import replace
from itertools import pairwise

import numpy as np
import pytest
from scoring_attempts import Attempt

from app.exercises.procedure import OF_PROCEDURES
from app.scoring.defaults import DEFAULT_TOLERANCES
from app.scoring.errors import ScoreFormatError, ToleranceError, UnknownMetricError
from app.scoring.metrics import available
from app.scoring.result import Score, judge
from app.scoring.rows import Row, ScoreRules, gates
from app.scoring.score import score
from app.scoring.tolerance import Band, Tolerance

PERFECT = Attempt()


def bands(expert: float, good: float, passing: float, **options: object) -> Tolerance:
    return Tolerance.model_validate({"expert": expert, "good": good, "pass": passing} | options)


def test_a_perfect_attempt_scores_100_and_passes() -> None:
    result = score(PERFECT.trajectory())
    assert result.total == pytest.approx(100.0)
    assert result.passed
    assert result.void_reason == ""
    assert {row.band for row in result.rows if row.tolerance} == {Band.EXPERT}


@pytest.mark.parametrize(
    ("name", "amounts"),
    [
        ("lateral", [0.0025, 0.004, 0.006, 0.009]),
        ("depth", [0.0025, 0.004, 0.006, 0.009]),
        ("depth", [-0.0025, -0.004, -0.006, -0.009]),
        ("tilt", [math.radians(a) for a in (1.5, 2.5, 3.5, 5.0)]),
        ("aligning", [110.0, 170.0, 240.0, 320.0]),
        ("detour", [0.03, 0.04, 0.05, 0.06]),
    ],
)
def test_the_worse_an_attempt_the_lower_its_score(name: str, amounts: list[float]) -> None:
    totals = [score(PERFECT.but(**{name: amount}).trajectory()).total for amount in amounts]
    assert all(total is not None for total in totals)
    numbers = [100.0, *[total for total in totals if total is not None]]
    assert all(a > b for a, b in pairwise(numbers))


@pytest.mark.promise("docs/exercises.md: a worse value never scores more")
def test_worse_in_everything_at_once_is_monotone_too() -> None:
    totals = []
    for step in np.linspace(0.0, 1.0, 8):
        attempt = PERFECT.but(lateral=0.009 * step, depth=0.008 * step, tilt=0.08 * step)
        totals.append(score(attempt.trajectory()).total)
    assert totals == sorted(totals, key=lambda total: -(total or 0.0))
    assert totals[0] == pytest.approx(100.0)
    assert (totals[-1] or 0.0) < 60.0


def test_the_total_is_the_weighted_mean_of_the_rows() -> None:
    result = score(PERFECT.but(lateral=0.0045, tilt=0.03).trajectory())
    counted = [row for row in result.rows if row.utility is not None]
    weights = np.array([row.weight for row in counted])
    utilities = np.array([row.utility for row in counted])
    assert result.total == pytest.approx(100.0 * (weights @ utilities) / weights.sum())


def test_doing_nothing_far_from_the_target_earns_nothing() -> None:
    """Straight, quick, upright and 71 mm short was 70 of 100 by the rule of before."""
    short = PERFECT.but(depth=-0.071).trajectory()
    assert score(short, version=6).total > 70.0
    result = score(short)
    assert result.total == pytest.approx(0.0)
    assert next(row.name for _, row in result.losses) == "depth_error"
    assert sum(points for points, _ in result.losses) == pytest.approx(100.0)
    assert Score.from_json(result.to_json()) == result
    assert Score.from_json(result.to_json()).recomputed() == result


@pytest.mark.long("statistics")
@pytest.mark.parametrize("error", ["depth", "lateral"])
def test_what_an_attempt_was_like_counts_less_the_farther_it_ended_without_a_jump(error) -> None:
    ends = np.arange(0.0, 0.012, 0.00006)
    totals = np.array([score(PERFECT.but(**{error: end}).trajectory()).total for end in ends])
    before = [score(PERFECT.but(**{error: e}).trajectory(), version=6).total for e in ends]
    within = ends <= 0.005  # the pass limit
    np.testing.assert_allclose(totals[within], np.array(before)[within])
    assert (np.diff(totals) <= 1e-9).all()
    assert np.abs(np.diff(totals)).max() < 2.4  # of 0.06 mm
    assert totals[-1] < 5.0


@pytest.mark.long("statistics")
@pytest.mark.parametrize("short", [0.0058, 0.0072, 0.0091])
def test_the_totals_deviation_holds_what_a_missed_target_holds_back(short) -> None:
    """Against totals of depths drawn around the measured one."""
    result = score(PERFECT.but(depth=-short).trajectory())
    rows = tuple(replace(row, sd=0.3 if row.name == "depth_error" else None) for row in result.rows)
    drawn = np.random.default_rng(3).normal(0.0, 0.3, 4000)
    totals = []
    for shift in drawn:
        moved = [
            replace(row, value=row.value + shift, sd=None) if row.name == "depth_error" else row
            for row in rows
        ]
        totals.append(judge(tuple(moved), result.rules).total)
    # the points are those of the best depth within one deviation: the slope is that one's
    own = judge(rows, result.rules)
    at = judge(tuple(replace(r, sd=None) for r in rows), result.rules)
    assert own.total > at.total
    assert own.total_sd == pytest.approx(np.std(totals), rel=0.3)


@pytest.mark.parametrize("required", [False, True])
def test_a_needle_drawn_out_at_the_end_earns_nothing_by_it(required) -> None:
    limits = {
        "target_error": bands(0.6, 1.9, 2.7, weight=4.0),
        "path_ratio": bands(1.1, 1.3, 1.6),
        "total_time": bands(120, 200, 300),
    }
    if required:  # and weightless
        limits["target_error"] = bands(0.6, 1.9, 2.7, weight=0.0, required=True)
    missed = score(PERFECT.but(depth=-0.071).trajectory(), limits)
    assert missed.total == pytest.approx(0.0)
    if not required:
        rows = [
            replace(row, value=None, sd=None) if row.name == "target_error" else row
            for row in missed.rows
        ]
        out = judge(tuple(rows), missed.rules)
        assert out.total == pytest.approx(0.0)
        assert sum(points for points, _ in out.losses) == pytest.approx(100.0)


def test_where_nothing_says_whether_the_target_was_reached_nothing_is_held_back() -> None:
    only = {"total_time": bands(120, 200, 300)}
    assert score(PERFECT.but(depth=-0.071).trajectory(), only).total == pytest.approx(100.0)


def test_a_missed_target_fails_whatever_the_total() -> None:
    result = score(PERFECT.but(lateral=0.0055).trajectory())
    assert result.total is not None
    assert result.total > 60.0
    assert not result.passed
    assert [row.name for row in result.failures] == ["lateral_error"]


def test_a_total_below_the_pass_mark_fails() -> None:
    trajectory = PERFECT.but(tilt=0.03).trajectory()
    assert score(trajectory).passed
    assert not score(trajectory, rules=ScoreRules(pass_mark=99.0)).passed


RISKS = {"risk_breach", "risk_distance", "risk_time"}
"""Metrics of structures that only some exercises have."""

MET = {
    *(
        "bone_contacts",
        "bone_force",
        "vessels_touched",
        "gut_touched",
        "skin_passes",
        "capsule_passes",
    ),
    *("pleural_crossings", "pleural_angle", "lung_crossed", "organ_crossed"),
}
"""Metrics of what the needle met, which need a tissue field."""
PLANS = {
    *("plan_score", "plan_clearance", "planned_emphysema", "planned_fissures"),
    *("planned_intercostal", "planned_lung", "planned_pleural_angle", "planned_rib_border"),
}
"""Metrics of a plan of the student's own."""

STEPS = {"pause_before_pleura", "hand_dose"}.union(*OF_PROCEDURES.values())
"""Metrics of steps and scans that only some exercises ask for."""

TOUCHES = {"targets_touched", "time_per_target", "economy_of_motion"}
"""Metrics of targets to be touched, which only some exercises have."""


def test_what_the_exercise_does_not_have_is_a_row_only_where_it_has_a_tolerance() -> None:
    asked = score(PERFECT.trajectory(), {"risk_breach": bands(0, 1, 2)})
    assert "no structure of risk" in asked.row("risk_breach").note
    assert {row.name for row in asked.rows} & RISKS == {"risk_breach"}


def test_metrics_without_a_tolerance_are_shown_and_not_counted() -> None:
    result = score(PERFECT.trajectory(), {"angle_error": bands(1, 2, 3)})
    asked_for = RISKS | TOUCHES | MET | PLANS | STEPS | {"breath_offset"}
    assert {row.name for row in result.rows} == set(available()) - asked_for
    assert result.rows[0].name == "angle_error"
    assert result.row("peak_force").utility is None
    assert result.total == pytest.approx(100.0)


def test_a_metric_that_cannot_be_computed_says_why_and_does_not_count() -> None:
    tolerances = {"angle_error": bands(1, 2, 3), "guidance_work": bands(10, 20, 50)}
    result = score(PERFECT.trajectory(), tolerances)
    row = result.row("guidance_work")
    assert row.value is None
    assert "not recorded" in row.note
    assert row.weight == 0.0
    assert result.total == pytest.approx(100.0)


def test_an_aborted_attempt_is_void() -> None:
    result = score(PERFECT.trajectory(aborted="encoder fault"))
    assert result.total is None
    assert not result.passed
    assert result.void_reason == "the attempt was aborted: encoder fault"


def test_an_attempt_without_insertion_is_void() -> None:
    result = score(PERFECT.trajectory(phase=np.full(2251, "aligning")))
    assert result.void_reason == "the needle never crossed the skin: it was never inserted"
    assert score(PERFECT.trajectory(phase=np.full(2251, "ready"))).void_reason == (
        "the attempt was never begun: it ended before the needle was out of the skin"
    )


def test_poor_tracking_makes_the_score_void_with_both_figures() -> None:
    base = PERFECT.trajectory()
    valid = (base.time < 32.0) | (base.time > 44.5)
    result = score(PERFECT.trajectory(depth_valid=valid))
    assert result.void_reason == "the tip was tracked for 50 % of the insertion; 70 % are needed"
    assert score(
        PERFECT.trajectory(depth_valid=valid), rules=ScoreRules(minimum_tracking=40.0)
    ).passed


def test_a_required_metric_that_cannot_be_computed_makes_the_score_void() -> None:
    phase = np.array(PERFECT.trajectory().phase)
    phase[-3:] = 1
    result = score(PERFECT.trajectory(phase=phase))
    assert result.void_reason == (
        "off the path is required and cannot be computed: the needle was out of the body at the end"
    )


def test_an_unknown_metric_in_the_tolerances_is_refused_with_the_valid_names() -> None:
    with pytest.raises(
        UnknownMetricError, match=r"no metric 'entry_error'; there are .*lateral_error"
    ):
        score(PERFECT.trajectory(), {"entry_error": bands(1, 2, 3)})


def test_bands_against_the_direction_of_their_metric_are_refused() -> None:
    with pytest.raises(ToleranceError, match=r"lateral_error: .* lower is better"):
        score(PERFECT.trajectory(), {"lateral_error": bands(5, 3, 2)})
    with pytest.raises(ToleranceError, match=r"tracking_valid: .* higher is better"):
        score(PERFECT.trajectory(), {"tracking_valid": bands(80, 90, 99)})


def test_weights_of_zero_only_leave_nothing_to_score() -> None:
    result = score(PERFECT.trajectory(), {"angle_error": bands(1, 2, 3, weight=0)})
    assert result.void_reason == "no metric with a weight could be computed"


@pytest.mark.parametrize("attempt", [PERFECT, PERFECT.but(lateral=0.02), PERFECT.but(noise=3e-4)])
def test_a_stored_score_reads_back_and_recomputes_to_itself(attempt: Attempt) -> None:
    result = score(attempt.trajectory())
    again = Score.from_json(result.to_json())
    assert again == result
    assert again.recomputed() == result


def test_a_void_score_is_stored_without_nan() -> None:
    result = score(PERFECT.trajectory(aborted="stopped"))
    text = result.to_json(indent=1)
    assert "NaN" not in text
    assert "Infinity" not in text
    assert json.loads(text)["total"] is None
    assert Score.from_json(text).recomputed() == result


def test_a_stored_score_can_be_judged_by_other_tolerances() -> None:
    result = score(PERFECT.but(lateral=0.004).trajectory())
    harder = result.recomputed({"lateral_error": bands(1, 2, 3, required=True)})
    assert not harder.passed
    assert harder.row("lateral_error").value == result.row("lateral_error").value
    assert result.recomputed(dict(DEFAULT_TOLERANCES)) == result


@pytest.mark.parametrize(
    "text",
    [
        "",
        "[]",
        "{}",
        '{"format": "acus-score/9"}',
        '{"format": "acus-score/1", "total": NaN}',
        "null",
    ],
)
def test_what_is_no_stored_score_is_refused(text: str) -> None:
    with pytest.raises(ScoreFormatError):
        Score.from_json(text)


def test_an_unknown_row_is_refused_with_the_rows_there_are() -> None:
    with pytest.raises(UnknownMetricError, match="no row 'nothing'; it has"):
        score(PERFECT.trajectory()).row("nothing")


def test_a_row_is_held_back_by_the_others_and_not_by_itself() -> None:
    rows = tuple(
        Row(name, name, "mm", 1.0, "", bands(1.0, 2.0, 4.0))
        for name in ("lateral_error", "depth_error", "total_time")
    )
    shares = gates(rows, {"lateral_error": 0.0, "depth_error": 1.0, "total_time": 1.0})
    assert shares == {"lateral_error": 1.0, "depth_error": 0.0, "total_time": 0.0}
