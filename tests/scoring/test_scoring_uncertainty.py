"""Each metric carries its own uncertainty, which is that of repeated measurements."""

from dataclasses import replace

import numpy as np
import pytest
from scoring_attempts import Attempt

from app.core.units import MILLIMETRE
from app.scoring.metrics import available
from app.scoring.result import Score, judge
from app.scoring.rows import Row, ScoreRules
from app.scoring.score import score
from app.scoring.tolerance import Tolerance
from app.scoring.trajectory import Trajectory
from app.tracking.fix import DIRECTION_SIGMA

ALONG, ACROSS, PICTURES = 0.2 * MILLIMETRE, 0.05 * MILLIMETRE, 2
"""Standard deviations of the tip, and samples that share one picture."""

COUNTED = ("control_scans", "notional_dose", "redirects")
BOUNDED = ("frechet_distance", "dtw_distance")
BANDS = Tolerance.model_validate({"expert": 2, "good": 3, "pass": 5})


def insertion() -> Trajectory:
    """A bell of speed that is nowhere at rest, bowed, off its target in all directions."""
    flawed = Attempt(lateral=0.003, depth=0.002, detour=0.02, aligning=2.0, holding=0.0, rate=50.0)
    plain = flawed.trajectory()
    n = len(plain)
    share = np.clip((plain.time - 2.0) / 20.0, 0.0, 1.0)
    depth = np.interp(share - 0.1 * np.sin(2 * np.pi * share) / np.pi, share, plain.depth)
    tip = np.column_stack([np.interp(depth, plain.depth, one) for one in plain.tip.T])
    moved = plain.phase >= 2
    place = np.where(moved[:, None], tip, plain.tip)
    deep = np.where(moved, depth, plain.depth)
    age = np.arange(n) % PICTURES / 50.0
    spread = np.column_stack([np.full(n, ALONG), np.full(n, ACROSS), age])
    return replace(plain, tip=place, depth=deep, spread=spread)


def measured_again(true: Trajectory, rng: np.random.Generator) -> Trajectory:
    """Return the same attempt with another error of each picture."""
    n = len(true)
    errors = rng.normal(0.0, ACROSS, (n // PICTURES + 1, 3)).repeat(PICTURES, axis=0)[:n]
    along = rng.normal(0.0, ALONG, n // PICTURES + 1).repeat(PICTURES)[:n]
    axis = true.axis[0]
    errors += np.outer(along - errors @ axis, axis)
    return replace(true, tip=true.tip + errors, depth=true.depth + along)


@pytest.fixture(scope="module")
def found() -> tuple[Trajectory, dict[str, list[float]]]:
    true = insertion()
    rng = np.random.default_rng(7)
    metrics = available()
    names = (
        *("target_error", "lateral_error", "depth_error", "planned_target_error"),
        *("path_length", "path_ratio", "spectral_arc_length", "log_dimensionless_jerk"),
        "path_length_raw",
        *BOUNDED,
    )
    values: dict[str, list[float]] = {name: [] for name in names}
    for _ in range(200):
        again = measured_again(true, rng)
        for name in names[: -len(BOUNDED)] if len(values["path_length"]) >= 30 else names:
            values[name].append(metrics[name].compute(again))
    return true, values


@pytest.mark.long("statistics")
@pytest.mark.parametrize(
    "name",
    [
        *("lateral_error", "depth_error", "planned_target_error", "path_length", "path_ratio"),
        *("spectral_arc_length", "log_dimensionless_jerk"),
    ],
)
def test_a_deviation_is_that_of_repeated_measurements(
    name: str, found: tuple[Trajectory, dict[str, list[float]]]
) -> None:
    true, values = found
    rng = np.random.default_rng(9)
    told = [available()[name].deviation(measured_again(true, rng)) for _ in range(20)]
    said = float(np.median(np.array(told, dtype=float)))
    seen = float(np.std(values[name]))
    assert said == pytest.approx(seen, rel=0.25)


@pytest.mark.long("statistics")
def test_the_deviation_of_the_raw_path_is_an_upper_bound(
    found: tuple[Trajectory, dict[str, list[float]]],
) -> None:
    """Noise of a step's own size bends the polyline: its length varies less than to first order."""
    true, values = found
    again = measured_again(true, np.random.default_rng(9))
    said, seen = available()["path_length_raw"].deviation(again), np.std(values["path_length_raw"])
    assert said is not None
    assert seen <= said <= 2.0 * seen


@pytest.mark.long("statistics")
@pytest.mark.parametrize(
    "name", ["angle_error", "angle_at_skin", "angle_in_plane", "angle_out_of_plane"]
)
def test_the_deviation_of_an_angle_is_that_of_repeated_directions(name: str) -> None:
    """Encoders err by DIRECTION_SIGMA in each direction across the needle.

    A needle one degree off the path: on the path itself the size of an angle varies less.
    """
    true, metric, rng = insertion(), available()[name], np.random.default_rng(11)
    leaning = true.axis + 0.0175 * np.cross(true.axis, [0.6, 0.8, 0.0])
    true = replace(true, axis=leaning / np.linalg.norm(leaning, axis=1, keepdims=True))
    values = []
    for _ in range(300):
        turned = true.axis + rng.normal(0.0, DIRECTION_SIGMA, true.axis.shape)
        unit = turned / np.linalg.norm(turned, axis=1, keepdims=True)
        values.append(metric.compute(replace(true, axis=unit)))
    assert metric.deviation(true) == pytest.approx(float(np.std(values)), rel=0.2)


@pytest.mark.long("statistics")
@pytest.mark.parametrize("name", BOUNDED)
def test_the_deviation_of_a_distance_between_paths_is_an_upper_bound(
    name: str, found: tuple[Trajectory, dict[str, list[float]]]
) -> None:
    true, values = found
    said = available()[name].deviation(true)
    assert said is not None
    assert 0.0 < float(np.std(values[name])) <= said


def test_every_metric_says_how_unsure_it_is_but_those_of_forces() -> None:
    result = score(replace(insertion(), clamped=np.zeros(len(insertion()), dtype=bool)))
    without = {row.name for row in result.rows if row.value is not None and row.sd is None}
    assert without == {"peak_force", "mean_force"}
    assert all(result.row(name).sd == 0.0 for name in COUNTED)
    assert result.row("total_time").sd == pytest.approx(0.0, abs=1e-12)  # the record's own ends
    assert result.row("insertion_time").sd == pytest.approx(0.02 / 12**0.5)
    again = Score.from_json(result.to_json())
    assert again == result
    assert again.total_sd == result.total_sd


def test_a_check_of_the_registration_counts_for_places_and_not_for_lengths() -> None:
    true = insertion()
    checked = replace(true, agreement=1.0 * MILLIMETRE)
    for name, grows in (("target_error", True), ("frechet_distance", True), ("path_length", False)):
        before, after = (available()[name].deviation(one) for one in (true, checked))
        assert before is not None
        assert after is not None
        assert (after > before) is grows
        if not grows:
            assert after == before


def test_a_radius_of_the_check_is_that_of_95_percent() -> None:
    checked = replace(
        insertion(), agreement=1.0 * MILLIMETRE, spread=np.zeros((len(insertion()), 3))
    )
    sd = available()["target_error"].deviation(checked)
    assert sd is not None
    drawn = np.random.default_rng(2).normal(0.0, sd, (20_000, 3))
    assert np.mean(np.linalg.norm(drawn, axis=1) < 1.0) == pytest.approx(0.95, abs=0.005)


def test_a_needle_that_still_moves_is_less_sure_by_the_way_since_its_picture() -> None:
    true = insertion()
    late = replace(true, spread=np.column_stack([true.spread[:, :2], np.full(len(true), 0.1)]))  # type: ignore[index]
    moving = replace(late, depth=late.depth + 0.01 * (late.time - late.time[-1]))
    depth = available()["depth_error"]
    fresh = depth.deviation(
        replace(moving, spread=np.column_stack([late.spread[:, :2], np.zeros(len(late))]))
    )  # type: ignore[index]
    old = depth.deviation(moving)
    assert fresh is not None
    assert old is not None
    assert old > fresh


def test_a_value_counts_as_the_best_one_within_its_uncertainty() -> None:
    def row(value: float, sd: float | None) -> Row:
        return Row("lateral_error", "Off the path", "mm", value, "", BANDS, sd)

    assert row(5.2, None).failed is False  # not required
    assert row(5.2, None).band == "fail"
    assert row(5.2, 0.3).band == "pass"
    assert row(2.2, 0.3).utility == row(1.9, 0.3).utility == 1.0
    assert row(2.5, 0.2).utility == row(2.3, None).utility
    assert row(-5.2, 0.3).band == "pass"
    higher = Tolerance.model_validate({"expert": 99, "good": 95, "pass": 80})
    assert Row("tracking_valid", "", "%", 79.5, "", higher, 1.0).band == "pass"


def test_the_utility_stays_monotone_and_continuous_under_doubt() -> None:
    values = np.linspace(0.0, 12.0, 2401)
    utilities = [Row("x", "", "mm", v, "", BANDS, 0.37).utility for v in values]
    steps = np.diff(np.array(utilities, dtype=float))
    assert (steps <= 1e-12).all()
    assert np.abs(steps).max() < 0.005


@pytest.mark.long("statistics")
def test_the_totals_deviation_is_that_of_its_rows() -> None:
    rules, rng = ScoreRules(), np.random.default_rng(4)
    sd = (0.1, 0.2)

    def total(a: float, b: float) -> float:
        rows = (
            Row("lateral_error", "", "mm", a, "", BANDS, sd[0]),
            Row("depth_error", "", "mm", b, "", BANDS, sd[1]),
        )
        found = judge(rows, rules)
        assert found.total is not None
        return found.total

    rows = tuple(Row(n, "", "mm", 4.2, "", BANDS, s) for n, s in zip("ab", sd, strict=True))
    seen = np.std([total(*(4.2 + rng.normal(0.0, sd))) for _ in range(4000)])
    assert judge(rows, rules).total_sd == pytest.approx(seen, rel=0.05)


def test_without_a_word_about_the_tip_values_count_as_they_are() -> None:
    silent = replace(insertion(), spread=None)
    assert silent.spread is None
    result = score(silent)
    assert result.row("lateral_error").sd is None
    assert result.row("lateral_error").value == score(insertion()).row("lateral_error").value


def test_saturation_is_the_share_of_the_insertion_at_the_limit() -> None:
    plain = insertion()
    at_limit = (plain.time >= 2.0) & (plain.time < 7.0)  # 5 of 20 s
    row = score(replace(plain, clamped=at_limit)).row("saturation")
    assert row.value == pytest.approx(25.0, abs=0.2)
    assert row.sd == pytest.approx(100.0 * (2 * 0.02**2 / 12) ** 0.5 / 20.0, rel=0.01)
    assert "was not recorded" in score(plain).row("saturation").note
