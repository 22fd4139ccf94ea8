"""Hard cases of the score: a bounded answer or a named error, never NaN."""

from typing import Any

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.exercises.parts import OF_OWN_PLANS
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan
from app.scoring.errors import TrajectoryError
from app.scoring.metrics import available
from app.scoring.paths import raw_length, smooth_length
from app.scoring.result import Score
from app.scoring.risks import RiskMark
from app.scoring.score import score
from app.scoring.trajectory import Trajectory

FULCRUM = np.array([0.0, 0.16056, 0.090])
seeded = settings(derandomize=True, deadline=None, max_examples=50)


def placed(length_mm: float = 80.0, origin_mm: float = 0.0) -> PlacedPlan:
    entry = np.full(3, origin_mm)
    return PlacedPlan.of(Plan(entry, np.add(entry, (0.0, length_mm, 0.0))), Placement(), FULCRUM)


def attempt(n: int, plan: PlacedPlan | None = None, **changes: Any) -> Trajectory:
    """n samples of a straight insertion that never leaves the body."""
    plan = plan or placed()
    depth = np.linspace(0.0, plan.length, n)
    arrays = {
        "time": np.arange(n) * 0.01,
        "tip": plan.p_entry + np.outer(depth, plan.axis),
        "axis": np.tile(plan.axis, (n, 1)),
        "depth": depth,
        "felt": np.zeros((n, 3)),
        "phase": np.full(n, "inserting"),
        "depth_valid": np.ones(n, dtype=bool),
    }
    return Trajectory(placed=plan, **(arrays | changes))


def assert_bounded(result: Score) -> None:
    assert result.void_reason or (result.total is not None and 0.0 <= result.total <= 100.0)
    for row in result.rows:
        assert row.value is None or np.isfinite(row.value)
        assert row.value is not None or row.note
        assert row.sd is None or (np.isfinite(row.sd) and row.sd >= 0.0)
    assert result.total_sd is None or 0.0 <= result.total_sd <= 100.0
    text = result.to_json()
    assert "NaN" not in text
    assert "Infinity" not in text
    assert Score.from_json(text).recomputed() == result


def test_an_empty_trajectory_is_void_and_every_row_says_why() -> None:
    result = score(attempt(0))
    assert result.void_reason.startswith("the attempt was never begun")
    assert all(row.value is None and row.note for row in result.rows)
    assert_bounded(result)


@pytest.mark.parametrize("n", [1, 2, 3])
def test_the_shortest_trajectories_are_bounded(n: int) -> None:
    result = score(attempt(n))
    assert_bounded(result)
    assert result.row("tracking_valid").value == 100.0
    assert result.row("total_time").value == pytest.approx((n - 1) * 0.01)


def test_a_single_sample_at_the_target_is_scored() -> None:
    plan = placed()
    result = score(attempt(1, plan, tip=plan.p_target[None], depth=[plan.length]))
    assert result.row("target_error").value == pytest.approx(0.0, abs=1e-12)
    assert "at least 1 mm" in result.row("path_ratio").note


def test_a_needle_that_never_moves_is_bounded() -> None:
    plan = placed()
    result = score(attempt(500, plan, tip=np.tile(plan.p_entry, (500, 1)), depth=np.zeros(500)))
    assert_bounded(result)
    assert not result.passed
    assert result.row("path_length").value == pytest.approx(0.0, abs=1e-9)
    assert result.row("depth_error").value == pytest.approx(-80.0)


@pytest.mark.parametrize("origin", [0.0, 1e6, 9.9e6])
def test_a_patient_far_from_the_origin_scores_the_same(origin: float) -> None:
    result = score(attempt(300, placed(origin_mm=origin)))
    assert result.total == pytest.approx(100.0)
    assert result.row("target_error").value == pytest.approx(0.0, abs=1e-5)


def test_a_path_of_one_millimetre_is_scored() -> None:
    assert_bounded(score(attempt(300, placed(length_mm=1.0))))


def test_a_needle_that_points_back_is_180_degrees_off() -> None:
    plan = placed()
    result = score(attempt(300, plan, axis=np.tile(-plan.axis, (300, 1))))
    assert result.row("angle_error").value == pytest.approx(180.0)
    assert_bounded(result)


@pytest.mark.parametrize(
    "name", ["time", "tip", "axis", "depth", "felt", "hub", "guide", "target_shift"]
)
@pytest.mark.parametrize("bad", [np.nan, np.inf])
def test_a_value_that_is_not_finite_is_refused_by_name(name: str, bad: float) -> None:
    shape = (300,) if name in ("time", "depth") else (300, 3)
    values = np.zeros(shape)
    values[137] = bad
    with pytest.raises(
        TrajectoryError, match=f"{name} is not finite within .* in 1 of 300 .* sample 137"
    ):
        attempt(300, **{name: values})


@pytest.mark.parametrize("step", [0.0, -1e-9, -1e6])
def test_time_that_does_not_rise_is_refused(step: float) -> None:
    time = np.arange(300) * 0.01
    time[200] = time[199] + step
    with pytest.raises(TrajectoryError, match=r"time (stands still|goes backwards) at sample 200"):
        attempt(300, time=time)


@pytest.mark.parametrize("scale", [1e-12, 1.0, 3e6])
def test_huge_and_tiny_durations_are_bounded(scale: float) -> None:
    assert_bounded(score(attempt(300, time=np.arange(1, 301) * scale)))


def test_a_long_gap_in_time_costs_no_memory() -> None:
    time = np.arange(300) * 0.01
    time[150:] += 9e8
    assert_bounded(score(attempt(300, time=time)))


@pytest.mark.parametrize("size", [1e3, 0.9e9])
def test_a_tip_far_away_is_bounded(size: float) -> None:
    tip = np.zeros((300, 3))
    tip[150:] = size
    assert_bounded(score(attempt(300, tip=tip)))


@pytest.mark.parametrize("size", [1.1e9, 1e150, 1e300])
def test_an_absurd_position_is_refused(size: float) -> None:
    with pytest.raises(TrajectoryError, match="tip is not finite within"):
        attempt(300, tip=np.full((300, 3), size))


@pytest.mark.parametrize("n", [0, 1, 2, 3, 300])
@pytest.mark.parametrize("bad", [np.nan, np.inf, -1.0, 1e300, 0.0])
def test_uncertainties_that_are_no_numbers_are_not_known(n: int, bad: float) -> None:
    result = score(attempt(n, spread=np.full((n, 3), bad), clamped=np.zeros(n, dtype=bool)))
    assert_bounded(result)
    if n == 300:
        assert (result.row("depth_error").sd is None) is (bad != 0.0)


def test_nothing_ever_seen_has_no_uncertainty() -> None:
    n = 300
    result = score(attempt(n, spread=np.zeros((n, 3)), depth_valid=np.zeros(n, dtype=bool)))
    assert_bounded(result)
    assert all(row.sd is None for row in result.rows if row.value is None)


def test_a_path_of_length_zero_has_bounded_uncertainties() -> None:
    plan = placed()
    still = np.tile(plan.p_entry, (500, 1))
    spread = np.tile([1e-4, 5e-5, 0.0], (500, 1))
    result = score(attempt(500, plan, tip=still, depth=np.zeros(500), spread=spread))
    assert_bounded(result)
    assert (result.row("path_length").sd or 0.0) < 0.2  # rounding has a direction
    assert result.row("depth_error").sd == pytest.approx(0.1)


def test_a_huge_uncertainty_gives_all_points_and_says_so() -> None:
    n = 300
    result = score(attempt(n, spread=np.full((n, 3), 1e8)))
    assert_bounded(result)
    assert result.row("depth_error").utility == 1.0


@pytest.mark.parametrize("shape", [(300,), (300, 2), (299, 3)])
def test_a_spread_of_another_shape_is_refused(shape: tuple[int, ...]) -> None:
    with pytest.raises(TrajectoryError, match="spread has shape"):
        attempt(300, spread=np.zeros(shape))


@pytest.mark.parametrize("agreement", [np.nan, -1.0, np.inf])
def test_an_agreement_that_is_no_distance_is_refused(agreement: float) -> None:
    with pytest.raises(TrajectoryError, match="agreement is"):
        attempt(300, agreement=agreement)


def test_a_structure_that_was_never_near_and_one_inside_are_bounded() -> None:
    far = RiskMark("far", 3.0, 1e6, 1e9, 0.0, 0.0)
    old = RiskMark("old", 3.0, 5.0)
    n = 300
    for risks in ((far,), (far, old), (RiskMark("in", 3.0, -4.0, -1e9, 5.0, 2.0),)):
        result = score(attempt(n, risks=risks, spread=np.full((n, 3), 1e-4)))
        assert_bounded(result)
        known = all(risk.inside_s is not None for risk in risks)
        assert (result.row("risk_time").value is not None) is known
    with pytest.raises(TrajectoryError, match="inside"):
        RiskMark("x", 3.0, 1.0, 0.0, 0.0, -1.0)


def test_no_depth_ever_measured_is_void() -> None:
    result = score(attempt(300, depth_valid=np.zeros(300, dtype=bool)))
    assert result.void_reason == "nothing measured how deep the needle was"
    assert_bounded(result)


def test_a_phase_that_flickers_at_every_sample_is_bounded() -> None:
    phase = np.where(np.arange(300) % 2 == 0, "aligning", "inserting")
    result = score(attempt(300, phase=phase))
    assert_bounded(result)
    assert result.row("path_length").value == 0.0


@pytest.mark.long("statistics")
@seeded
@given(
    st.integers(0, 40),
    st.integers(0, 2**31),
    st.sampled_from([1e-6, 1e-3, 1.0, 1e3]),
)
def test_random_attempts_are_bounded(n: int, seed: int, size: float) -> None:
    rng = np.random.default_rng(seed)
    axis = rng.normal(size=(n, 3)) + 1e-9
    names = np.array(["ready", "aligning", "inserting", "holding", "ended", "aborted"])
    result = score(
        attempt(
            n,
            time=np.cumsum(rng.uniform(1e-4, 1.0, n)),
            tip=rng.normal(0.0, size, (n, 3)),
            axis=axis / np.linalg.norm(axis, axis=1, keepdims=True),
            depth=rng.normal(0.0, size, n),
            felt=rng.normal(0.0, size, (n, 3)),
            hub=rng.normal(0.0, size, (n, 3)),
            guide=rng.normal(0.0, size, (n, 3)),
            target_shift=rng.normal(0.0, size, (n, 3)),
            phase=names[rng.integers(0, rng.integers(4, 7), n)],
            depth_valid=rng.random(n) < 0.8,
            spread=np.where(rng.random((n, 3)) < 0.01, np.nan, rng.exponential(size, (n, 3))),
            clamped=rng.random(n) < 0.5,
            agreement=size,
        )
    )
    assert_bounded(result)


def reads_steps(name: str) -> bool:
    """Return whether a metric is of the steps of a procedure, by its file."""
    text = available()[name].path.read_text(encoding="utf-8")
    return "trajectory.steps()" in text or "ablation" in text


@pytest.mark.long("statistics")
def test_a_million_samples_are_scored() -> None:
    n = 1_000_000
    felt = np.zeros((n, 3))
    result = score(attempt(n, time=np.arange(n) * 1e-3, felt=felt, hub=felt, guide=felt))
    assert_bounded(result)
    not_asked = {"risk_breach", "risk_distance", "risk_time", "saturation"}
    not_asked |= {"targets_touched", "time_per_target", "economy_of_motion"}
    not_asked |= {"bone_contacts", "bone_force", "capsule_passes", "gut_touched", "lung_crossed"}
    not_asked |= {"organ_crossed", "pleural_angle", "pleural_crossings", "skin_passes"}
    not_asked |= {"breath_offset"}  # nothing breathes
    not_asked |= {"hand_dose", "complication_answer", "complication_noticed"}
    not_asked |= OF_OWN_PLANS  # the path was given
    not_asked |= {"vessels_touched"}  # no field tells what this needle met
    values = {row.name: row.value for row in result.rows}
    steps = {name for name in available() if reads_steps(name)}
    assert len(steps) > 10
    assert all(values.get(name) is None for name in steps)  # no exercise with steps
    assert {name for name, value in values.items() if value is not None} == set(
        available()
    ) - not_asked - steps


def test_the_smoothed_length_is_never_longer_than_the_raw_one() -> None:
    rng = np.random.default_rng(5)
    for n in (0, 1, 2, 3, 10, 1000):
        time = np.cumsum(rng.uniform(1e-4, 0.2, n))
        points = rng.normal(size=(n, 3))
        assert 0.0 <= smooth_length(time, points) <= raw_length(points) + 1e-9
