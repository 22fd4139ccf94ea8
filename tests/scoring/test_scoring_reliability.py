"""Agreement, variance components, G and D study and items, as R and published tables have them.

tests/data/reliability/references.json holds inputs with the answers of R (versions inside), made by
references.R beside it: closed forms are equal to 1e-6, restricted likelihood to 1e-4.
"""

from __future__ import annotations

import json
from pathlib import Path
from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays

from app.core.arrays import FloatArray
from app.scoring.errors import ReliabilityError
from app.scoring.reliability import (
    DecisionStudy,
    ScoreCube,
    VarianceComponents,
    intraclass,
    item_statistics,
    variance_components,
    within_student_sd,
)
from app.scoring.reliability.components import Estimator

DATA = Path(__file__).parents[1] / "data" / "reliability" / "references.json"
R: dict[str, Any] = json.loads(DATA.read_text(encoding="utf-8"))
NAMES = {"s": "student", "e": "exercise", "o": "occasion"}


def cube(table: dict[str, Any]) -> ScoreCube:
    """Put the long table of R into a cube."""
    cells = np.array(table["cells"])
    values = np.full(cells.max(axis=0) + 1, np.nan)
    values[tuple(cells.T)] = table["points"]
    return ScoreCube(values)


def named(variances: dict[str, float]) -> dict[str, float]:
    """Name effects as the program does."""
    return {
        ":".join(NAMES.get(part, part) for part in name.split(":")): value
        for name, value in variances.items()
    }


@pytest.mark.parametrize("table", R["icc"], ids=lambda table: table["source"])
def test_all_six_intraclass_correlations_and_their_intervals_are_those_of_psych(
    table: dict[str, Any],
) -> None:
    result = intraclass(np.array(table["points"], dtype=float))
    for name in ("value", "lower", "upper"):
        assert [getattr(one, name) for one in result] == pytest.approx(table[name], abs=1e-6)


def test_the_table_of_shrout_and_fleiss_has_the_correlations_that_they_published() -> None:
    """Their table 4: .17 .29 .71 .44 .62 .91."""
    result = intraclass(np.array(R["icc"][0]["points"], dtype=float))
    assert [round(one.value, 2) for one in result] == [0.17, 0.29, 0.71, 0.44, 0.62, 0.91]
    assert [one.form for one in result] == ["1,1", "2,1", "3,1", "1,k", "2,k", "3,k"]


@pytest.mark.parametrize("table", R["closed"])
def test_components_of_a_complete_cube_are_those_of_rs_mean_squares(table: dict[str, Any]) -> None:
    result = variance_components(cube(table))
    assert result.estimator is Estimator.ANOVA
    assert dict(result.variances) == pytest.approx(named(table["variances"]), rel=1e-6)


@pytest.mark.parametrize("table", R["reml"], ids=lambda table: table["source"])
def test_components_with_missing_cells_are_those_of_lmer(table: dict[str, Any]) -> None:
    """A complete table of positive estimates has the same by both ways (Penicillin)."""
    result, wanted = variance_components(cube(table)), named(table["variances"])
    assert set(result.variances) == set(wanted)
    for name, variance in wanted.items():
        assert result.variances[name] == pytest.approx(variance, rel=1e-4, abs=1e-4)


def test_the_published_standard_deviations_of_penicillin_are_found_again() -> None:
    """Bates (2010), lme4: mixed-effects modeling with R, section 2.1: 0.847, 1.932, 0.550."""
    result = variance_components(cube(R["reml"][3]))
    sds = [np.sqrt(result.variances[name]) for name in ("student", "exercise", "residual")]
    assert sds == pytest.approx([0.84671, 1.93157, 0.54992], abs=2e-5)


def test_a_component_that_is_small_and_not_0_is_not_left_at_0() -> None:
    """The deviance is flat at 0 itself: from a start beyond the minimum a search may end there."""
    rng = np.random.default_rng(1)
    values = rng.normal(60, 5, (60, 1, 1)) + rng.normal(0, 4, (1, 12, 1))
    values = values + rng.normal(0, 5, (60, 12, 1)) + rng.normal(0, 5, (60, 12, 5))
    values[rng.random(values.shape) < 0.1] = np.nan
    result = variance_components(ScoreCube(values))
    assert result.variances["occasion"] == pytest.approx(0.0083563, rel=1e-2)


def components(**variances: float) -> VarianceComponents:
    named_so = {name.replace("_", ":"): value for name, value in variances.items()}
    return VarianceComponents(20, 4, 3, 240, Estimator.ANOVA, named_so)


def test_coefficients_and_numbers_of_attempts_are_those_worked_out_by_hand() -> None:
    """With 100 of students, 40 with exercises, 20 with occasions and 60 left, two exercises:

    one attempt each has the relative error 40/2 + 20 + 60/2 = 70, so that G is 100/170; with m
    attempts it is 20 + 50/m, and 100/(120 + 50/m) is 0.8 at m = 10. Absolute errors have 8/2 of
    exercises, 6/m and 4/(2m) more: Phi is 100/(124 + 58/m), 0.8 from m = 58 on.
    """
    study = DecisionStudy(
        components(
            student=100.0, exercise=8.0, occasion=6.0, student_exercise=40.0,
            student_occasion=20.0, exercise_occasion=4.0, residual=60.0,
        )
    )  # fmt: skip
    assert study.coefficient(2, 1) == pytest.approx(100.0 / 170.0)
    assert study.coefficient(2, 1, absolute=True) == pytest.approx(100.0 / 182.0)
    assert study.standard_error() == pytest.approx(np.sqrt(138.0))
    assert study.standard_error(absolute=False) == pytest.approx(np.sqrt(120.0))
    assert (study.attempts_for(2), study.attempts_for(2, absolute=True)) == (10, 58)
    assert study.attempts_for(1) is None  # 40 of one exercise is more than 25, however often
    # one attempt: 20 + 100/n is at most 25 from n = 20 on
    assert study.exercises_for(1) == 20


def test_nothing_is_said_of_more_attempts_where_each_had_one() -> None:
    one = VarianceComponents(
        20, 4, 1, 80, Estimator.ANOVA, {"student": 9.0, "exercise": 1.0, "residual": 9.0}
    )
    assert DecisionStudy(one).attempts_for(4) is None
    assert DecisionStudy(one).exercises_for(1) == 4  # 9/(9 + 9/4) is 0.8


def test_difficulty_and_corrected_discrimination_are_those_of_psych() -> None:
    table = R["items"]
    result = item_statistics(np.array(table["points"], dtype=float))
    assert [one.difficulty for one in result] == pytest.approx(table["difficulty"], abs=1e-6)
    assert [one.discrimination for one in result] == pytest.approx(
        table["discrimination"], abs=1e-6
    )


def test_an_exercise_at_which_all_are_equal_has_no_discrimination() -> None:
    points = np.array([[50.0, 60.0, 80.0], [70.0, 65.0, 80.0], [90.0, 80.0, 80.0]])
    assert item_statistics(points)[2].discrimination is None
    assert item_statistics(points)[0].discrimination == pytest.approx(0.9608, abs=1e-4)


def test_the_spread_within_students_is_the_residual_of_rs_linear_model() -> None:
    table = R["within"]
    own = [np.atleast_1d(points).tolist() for points in table["points"].values()]
    assert within_student_sd(own) == pytest.approx((table["sd"], table["freedom"]), rel=1e-6)
    with pytest.raises(ReliabilityError, match="with 2 attempts or more: 1"):
        within_student_sd([[50.0, 60.0], [70.0]])


@pytest.mark.parametrize(
    ("points", "message"),
    [
        ([[50.0, 60.0]], "2 students at least"),
        ([[50.0], [60.0]], "2 exercises or 2 attempts"),
        ([[50.0, np.nan], [60.0, 70.0]], "row 1, column 2 are missing"),
        ([[50.0, 60.0], [60.0, 50.0]], "same mean points"),
        ([[70.0, 70.0], [70.0, 70.0]], "same mean points"),
    ],
)
def test_what_agreement_cannot_be_told_from_is_refused_with_what_would_do(
    points: list[list[float]], message: str
) -> None:
    with pytest.raises(ReliabilityError, match=message):
        intraclass(np.array(points))


@pytest.mark.parametrize(
    ("values", "message"),
    [
        (np.full((1, 3, 2), 60.0), "2 students at least"),
        (np.full((4, 3, 2), 60.0), "nothing varies"),
        (np.arange(4.0).reshape(4, 1, 1), "points once only"),
        (np.full((4, 3, 2), np.nan), "2 students at least"),
        (np.full((4, 3), 1.0), "axes"),
    ],
)
def test_what_components_cannot_be_told_from_is_refused(values: FloatArray, message: str) -> None:
    with pytest.raises(ReliabilityError, match=message):
        ScoreCube(values)


def test_students_who_share_no_exercise_tell_no_two_effects_apart() -> None:
    values = np.full((3, 3, 2), np.nan)
    for student in range(3):
        values[student, student] = [50.0 + 9.0 * student, 61.0 + student * student]
    with pytest.raises(ReliabilityError, match="do not tell student from exercise"):
        variance_components(ScoreCube(values))


def test_points_that_are_sums_leave_nothing_to_chance() -> None:
    rng = np.random.default_rng(5)
    values = (
        rng.normal(60, 9, (8, 1, 1)) + rng.normal(0, 5, (1, 5, 1)) + rng.normal(0, 3, (1, 1, 4))
    )
    complete = variance_components(ScoreCube(values))
    assert complete.variances["residual"] == pytest.approx(0.0, abs=1e-9)
    assert DecisionStudy(complete).coefficient(1, 1) == pytest.approx(1.0)
    values[0, 0, 0] = values[3, 2, 1] = np.nan
    with pytest.raises(ReliabilityError, match="leave nothing to chance"):
        variance_components(ScoreCube(values))


POINTS = st.one_of(st.sampled_from([0.0, 60.0, 100.0]), st.floats(0.0, 100.0))


@settings(deadline=None, max_examples=150, derandomize=True)
@given(
    st.tuples(st.integers(1, 6), st.integers(1, 5)).flatmap(
        lambda s: arrays(float, s, elements=POINTS)
    )
)
def test_agreement_of_any_table_is_finite_and_within_its_interval_or_refused(
    points: FloatArray,
) -> None:
    try:
        result = intraclass(points)
    except ReliabilityError:
        return
    for one in result:
        assert np.isfinite([one.value, one.lower, one.upper]).all()
        assert one.lower - 1e-9 <= one.value <= one.upper + 1e-9
        assert -100.0 <= one.value <= 1.0
    for one in item_statistics(points):
        assert 0.0 <= one.difficulty <= 1.0
        assert one.discrimination is None or -1.0 <= one.discrimination <= 1.0


@pytest.mark.long("statistics")
@settings(deadline=None, max_examples=100, derandomize=True)
@given(
    st.tuples(st.integers(2, 5), st.integers(1, 4), st.integers(1, 3)).flatmap(
        lambda shape: arrays(float, shape, elements=st.one_of(POINTS, st.just(np.nan)))
    )
)
def test_components_of_any_cube_are_finite_and_not_below_0_or_refused(values: FloatArray) -> None:
    try:
        result = variance_components(ScoreCube(values))
    except ReliabilityError:
        return
    assert all(np.isfinite(v) and v >= 0.0 for v in result.variances.values())
    study = DecisionStudy(result)
    for absolute in (False, True):
        assert 0.0 <= study.coefficient(3, 2, absolute) <= 1.0
        assert np.isfinite(study.standard_error(absolute=absolute))


PARTED = [table for table in R["icc"] if table["value"][5] > 0.0]


@pytest.mark.parametrize("table", PARTED, ids=lambda table: table["source"])
def test_an_interval_of_g_over_exercises_alone_is_that_of_icc_3_k_in_psych(
    table: dict[str, Any],
) -> None:
    """With one attempt each G of k exercises is ICC(3,k), whose F interval is exact."""
    points = np.array(table["points"], dtype=float)
    study = DecisionStudy(variance_components(ScoreCube(points[:, :, None])))
    for exercises, form in ((points.shape[1], 5), (1, 2)):
        wanted = (table["lower"][form], table["upper"][form])
        assert study.interval(exercises, 1) == pytest.approx(wanted, abs=0.005)


def crossed(rng: np.random.Generator, **sds: float) -> FloatArray:
    """Draw points of 20 students, 4 exercises and 3 attempts; `sds` by the axes that they have."""
    shape = {"s": 20, "e": 4, "o": 3}
    points = np.full(tuple(shape.values()), 50.0)
    for axes, sd in sds.items():
        own = tuple(count if axis in axes else 1 for axis, count in shape.items())
        points = points + rng.normal(0.0, sd, own)
    return points


@pytest.mark.long("statistics")
def test_intervals_of_g_and_phi_hold_what_is_true_in_95_of_100_studies_or_more() -> None:
    sds = {"s": 8.0, "e": 4.0, "o": 2.0, "se": 5.0, "so": 2.0, "eo": 1.0, "seo": 7.0}
    relative = 25.0 / 4 + 4.0 / 3 + 49.0 / 12
    true = {False: 64.0 / (64.0 + relative)}
    true[True] = 64.0 / (64.0 + relative + 16.0 / 4 + 4.0 / 3 + 1.0 / 12)
    rng, held, times = np.random.default_rng(3), {False: 0, True: 0}, 400
    for _ in range(times):
        study = DecisionStudy(variance_components(ScoreCube(crossed(rng, **sds))))
        for absolute, value in true.items():
            low, high = study.interval(4, 3, absolute) or (1.0, 0.0)
            held[absolute] += low <= value <= high
    assert min(held.values()) >= 0.93 * times  # three standard errors below 0.95 are 0.917
    assert max(held.values()) < times


def test_one_empty_cell_leaves_the_interval_of_g_where_it_was() -> None:
    """The two ways share no formula: mean squares here, curvature of the likelihood there."""
    points = crossed(np.random.default_rng(5), s=9.0, e=4.0, se=5.0, o=2.0, seo=5.0)
    whole = DecisionStudy(variance_components(ScoreCube(points)))
    points[3, 1, 2] = np.nan
    less = DecisionStudy(variance_components(ScoreCube(points)))
    assert (whole.components.estimator, less.components.estimator) == ("anova", "reml")
    assert less.interval(4, 3) == pytest.approx(whole.interval(4, 3), abs=0.05)


def test_an_interval_holds_its_estimate_and_is_within_0_and_1() -> None:
    for table in R["icc"]:
        points = np.array(table["points"], dtype=float)
        study = DecisionStudy(variance_components(ScoreCube(points[:, :, None])))
        for absolute in (False, True):
            low, high = study.interval(2, 1, absolute) or (1.0, 0.0)
            assert 0.0 <= low <= study.coefficient(2, 1, absolute) <= high <= 1.0
