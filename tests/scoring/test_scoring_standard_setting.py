"""Pass marks by Angoff, borderline regression and contrasting groups, with standard errors."""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from pydantic import ValidationError

from app.scoring.contrasting import contrasted_mark
from app.scoring.errors import ReliabilityError
from app.scoring.pass_mark import MarkMethod, SetMark, is_near_mark
from app.scoring.result import Score
from app.scoring.rows import ScoreRules
from app.scoring.standard_setting import angoff, borderline

DATA = Path(__file__).parents[1] / "data" / "reliability" / "references.json"
R: dict[str, Any] = json.loads(DATA.read_text(encoding="utf-8"))["borderline"]
MARK = SetMark(method=MarkMethod.ANGOFF, points=67.5, standard_error=2.1, people=6, score_error=5.0)


@pytest.mark.parametrize("place", [0, 1])
def test_the_borderline_mark_and_its_error_are_those_of_rs_predicted_line(place: int) -> None:
    result = borderline(R["rating"], R["score"], 16, R["at"][place])
    assert result.points == pytest.approx(R["mark"][place], abs=1e-6)
    assert result.standard_error == pytest.approx(R["se"][place], abs=1e-6)
    assert (result.people, result.attempts) == (16, 16)


def test_an_angoff_mark_is_the_mean_of_the_judges_with_its_standard_error() -> None:
    """Of 60, 66, 72 by hand: mean 66, standard deviation 6, 6/√3."""
    result = angoff([60.0, 66.0, 72.0])
    assert (result.points, result.people) == (66.0, 3)
    assert result.standard_error == pytest.approx(3.4641016)
    assert angoff([70.0] * 4).standard_error == 0.0


def test_two_judges_set_no_mark() -> None:
    with pytest.raises(ReliabilityError, match="2 judges: a mark by Angoff needs 3"):
        angoff([60.0, 70.0])


@pytest.mark.parametrize(
    ("ratings", "points", "message"),
    [
        ([1, 2, 3, 4], [40, 50, 60, 70], "4 rated attempts"),
        ([3, 3, 3, 3, 3], [40, 50, 60, 70, 80], "without spread"),
        ([3, 3, 4, 4, 5], [40, 50, 60, 70, 80], "on both sides"),
        ([1, 2, 3, 4, 5], [80, 70, 60, 50, 40], "do not rise"),
        ([1, 2, 3, 4, 5], [60, 60, 60, 60, 60], "do not rise"),
    ],
)
def test_ratings_that_set_no_mark_are_refused_with_what_to_do(
    ratings: list[float], points: list[float], message: str
) -> None:
    with pytest.raises(ReliabilityError, match=message):
        borderline(ratings, points, 5)


def test_a_line_that_leaves_the_scale_sets_no_mark() -> None:
    """Points 0 0 0 50 100 of ratings 1 to 5: 30 in the middle, 25 a step, -20 at 1."""
    with pytest.raises(ReliabilityError, match="gives -20 points at 1, beyond 0 to 100"):
        borderline([1, 2, 3, 4, 5], [0, 0, 0, 50, 100], 5, at=1.0)


@pytest.mark.long("statistics")
def test_groups_part_half_way_between_two_normal_distributions_of_one_width() -> None:
    rng = np.random.default_rng(29)
    experts = rng.normal(85.0, 4.0, (40, 5)).tolist()
    students = rng.normal(65.0, 4.0, (40, 5)).tolist()
    result = contrasted_mark(experts, students)
    assert result.points == pytest.approx(75.0, abs=2.0)
    assert 0.0 < result.standard_error < 2.0
    assert (result.people, result.attempts) == (80, 400)
    assert contrasted_mark(experts, students) == result  # drawn alike each time


@pytest.mark.long("statistics")
def test_the_error_of_a_mark_is_how_far_marks_of_other_people_lie_apart() -> None:
    """Marks of sixteen schools of 15 and 15 people, whose spread the mean error has to tell."""
    rng = np.random.default_rng(30)
    marks = []
    for _ in range(16):
        groups = [
            (middle + rng.normal(0, 6, (15, 1)) + rng.normal(0, 4, (15, 3))).tolist()
            for middle in (80.0, 65.0)
        ]
        marks.append(contrasted_mark(*groups))
    spread = float(np.std([one.points for one in marks], ddof=1))
    assert 0.6 < float(np.mean([one.standard_error for one in marks])) / spread < 1.7


def test_groups_that_do_alike_or_the_other_way_round_set_no_mark() -> None:
    with pytest.raises(ReliabilityError, match="do not part the two groups"):
        contrasted_mark([[50.0], [55.0], [60.0]], [[80.0], [85.0], [90.0]])
    with pytest.raises(ReliabilityError, match="do not part the two groups"):
        contrasted_mark([[70.0]] * 3, [[70.0]] * 3)


@pytest.mark.long("statistics")
@settings(deadline=None, max_examples=200, derandomize=True)
@given(st.lists(st.tuples(st.integers(1, 5), st.floats(0.0, 100.0)), max_size=12))
def test_a_borderline_mark_lies_between_0_and_100_with_a_finite_error_or_is_refused(
    rated: list[tuple[int, float]],
) -> None:
    try:
        result = borderline([one[0] for one in rated], [one[1] for one in rated], 3)
    except ReliabilityError:
        return
    assert 0.0 <= result.points <= 100.0
    assert np.isfinite(result.standard_error)


def rules() -> ScoreRules:
    return ScoreRules(pass_mark=67.5, mark=MARK)


@pytest.mark.parametrize(
    ("total", "near"), [(62.5, True), (72.5, True), (62.4, False), (72.6, False), (None, False)]
)
def test_scores_within_one_error_of_the_mark_are_near_it(total: float | None, near: bool) -> None:
    score = Score((), total, bool(total and total >= 67.5), "", rules())
    assert score.is_near_mark is near
    stored = score.document()
    assert is_near_mark(stored) is near
    assert Score.from_json(score.to_json()).rules == rules()


def test_nothing_is_near_a_mark_that_nobody_set_or_whose_error_is_not_known() -> None:
    assert not ScoreRules(pass_mark=67.5).is_near_mark(67.5)
    unknown = MARK.model_copy(update={"score_error": None})
    assert not ScoreRules(pass_mark=67.5, mark=unknown).is_near_mark(67.5)
    assert "mark" not in Score((), 67.5, True, "", ScoreRules()).document()["rules"]


def test_a_mark_that_people_set_is_the_pass_mark() -> None:
    with pytest.raises(ValidationError, match="leave mark out"):
        ScoreRules.model_validate({"pass_mark": 70.0, "mark": MARK.model_dump()})
