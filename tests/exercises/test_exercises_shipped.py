"""The shipped exercises judge as a teacher would: perfect is 100, worse is never more."""

from itertools import pairwise

import numpy as np
import pytest

from app.exercises.errors import ExerciseError
from app.exercises.guidance import GuidanceMode, Purpose
from app.exercises.library import load_exercise
from app.exercises.parts import TELLING, ViewName
from app.exercises.scene import device_of, draft_of, plan_of
from app.exercises.schema import Exercise
from app.imaging.phantom.anatomy import anatomy
from app.planning.judged import JudgedPlan
from app.planning.placement import PlacedPlan
from app.planning.plan import Plan
from app.planning.reach import reach
from app.scoring.result import Score
from app.scoring.risks import RiskMark
from app.scoring.rows import REACHING
from app.scoring.score import score
from app.scoring.touches import Touches
from app.scoring.trajectory import Trajectory

SHIPPED = [
    "first-insertion",
    "tensegrity-liver",
    "thick-tissue",
    "with-less-help",
    "breathing-liver",
    "kidney",
    "hold-the-breath",
    "past-the-vessel",
    "plan-it-yourself",
    "against-repulsion",
    "beside-the-vein",
    "lung-between-ribs",
    "scans-only",
]
FULCRUM = np.array([0.0, 0.16056, 0.090])


def attempt(exercise: Exercise, badness: float, seed: int) -> Score:
    """Score an insertion: perfect at badness 0; at 1 far off in place, angle, path, time, force."""
    plan = Plan((0.0, -95.0, 300.0), (20.0, -20.0, 310.0))
    placed = PlacedPlan.of(plan, exercise.placement.placement(), FULCRUM)
    rng = np.random.default_rng(seed)
    side = np.cross(placed.axis, rng.normal(size=3))
    side /= np.linalg.norm(side)
    time = np.linspace(0.0, 45.0 + 500.0 * badness, 1500)
    share = np.clip((time / time[-1] - 0.4) / 0.5, 0.0, 1.0)
    bow = badness * (0.06 * np.sin(np.pi * share) + 0.02 * share)
    depth = share * (placed.length + 0.010 * badness)
    tip = placed.p_entry + np.outer(depth, placed.axis) + np.outer(bow, side)
    axis = placed.axis + 0.08 * badness * side
    n = len(time)
    trajectory = Trajectory(
        placed=placed,
        time=time,
        tip=tip,
        axis=np.tile(axis / np.linalg.norm(axis), (n, 1)),
        depth=depth,
        felt=np.tile(6.0 * badness * side, (n, 1)),
        phase=np.where(share > 0.0, "inserting", "aligning"),  # type: ignore[arg-type]
        depth_valid=np.ones(n, dtype=bool),
        risks=tuple(
            RiskMark(name, limit, limit + 1.0 - 6.0 * badness, time[-1], 60.0, 0.0)
            for part in exercise.structures
            for name, limit in part.risks.items()
        ),
        planned=JudgedPlan(90.0 * (1.0 - badness), 75.0, 10.0, 9.0 * (1.0 - badness)),
    )
    return score(trajectory, exercise.tolerances, exercise.rules)


@pytest.mark.long("journey")
@pytest.mark.parametrize("name", SHIPPED)
def test_a_perfect_attempt_scores_100(name: str) -> None:
    result = attempt(load_exercise(name), 0.0, seed=1)
    assert result.total == pytest.approx(100.0)
    assert result.passed


@pytest.mark.long("statistics")
@pytest.mark.parametrize("name", SHIPPED)
@pytest.mark.parametrize("seed", range(5))
def test_the_score_falls_with_everything_that_gets_worse(name: str, seed: int) -> None:
    exercise = load_exercise(name)
    totals = [attempt(exercise, badness, seed).total for badness in np.linspace(0.0, 1.0, 12)]
    numbers = [total for total in totals if total is not None]
    assert len(numbers) == len(totals)
    assert all(a >= b for a, b in pairwise(numbers))
    assert numbers[-1] < 30.0 < numbers[0]


@pytest.mark.parametrize("name", SHIPPED)
def test_a_bad_attempt_fails_by_its_required_metrics(name: str) -> None:
    result = attempt(load_exercise(name), 1.0, seed=2)
    assert not result.passed
    assert result.failures


@pytest.mark.long("journey")
@pytest.mark.parametrize("name", [name for name in SHIPPED if name != "plan-it-yourself"])
def test_the_path_of_each_shipped_exercise_is_within_reach(name: str) -> None:
    exercise = load_exercise(name)
    plan = plan_of(exercise)
    answer = reach(plan, exercise.placement.placement(), device_of(exercise))
    assert answer.reachable, answer.message()
    assert 50.0 < plan.length_mm < 110.0
    assert plan.name == name


@pytest.mark.long("journey")
def test_assessments_guide_by_control_scans_and_show_nothing_live() -> None:
    assessments = [e for e in map(load_exercise, SHIPPED) if e.purpose is Purpose.ASSESSMENT]
    assert [exercise.id for exercise in assessments] == ["scans-only"]
    for exercise in assessments:
        assert exercise.guidance.mode is None  # by default, not because the file says so
        assert exercise.guidance_mode is GuidanceMode.CONTROL_CT
        assert not set(exercise.shown_views) & TELLING
    practice = load_exercise("first-insertion")
    asked = practice.model_copy(update={"purpose": Purpose.ASSESSMENT})
    assert asked.guidance_mode is GuidanceMode.CONTROL_CT
    assert ViewName.LIVE_OVERLAY in practice.shown_views
    assert ViewName.LIVE_OVERLAY not in asked.shown_views


def test_an_entry_can_be_found_for_the_exercise_without_one() -> None:
    exercise = load_exercise("plan-it-yourself")
    draft = draft_of(exercise)
    patient = anatomy(exercise.ct.phantom.seed)
    assert draft.entry_mm is None
    assert draft.target_mm == patient.lesion_mm
    possible = draft.with_entry(patient.entry_mm).plan()
    assert reach(possible, exercise.placement.placement(), device_of(exercise)).reachable
    with pytest.raises(ExerciseError, match="places the entry"):
        plan_of(exercise)


def stopped_short(exercise: Exercise, short: float, seconds: float) -> Score:
    """Score a needle that goes straight down the line, quickly, gently, and stops short [m]."""
    plan = Plan((0.0, -95.0, 300.0), (20.0, -20.0, 310.0))
    placed = PlacedPlan.of(plan, exercise.placement.placement(), FULCRUM)
    time = np.linspace(0.0, seconds, 1500)
    share = np.clip((time / seconds - 0.1) / 0.3, 0.0, 1.0)
    depth = share * (placed.length - short)
    n = len(time)
    trajectory = Trajectory(
        placed=placed,
        time=time,
        tip=placed.p_entry + np.outer(depth, placed.axis),
        axis=np.tile(placed.axis, (n, 1)),
        depth=depth,
        felt=np.zeros((n, 3)),
        phase=np.where(share > 0.0, "inserting", "aligning"),  # type: ignore[arg-type]
        depth_valid=np.ones(n, dtype=bool),
        risks=tuple(
            RiskMark(name, limit, limit + 30.0, time[-1], 60.0, 0.0)
            for part in exercise.structures
            for name, limit in part.risks.items()
        ),
        touches=Touches(6, ()) if exercise.touch else None,
        met=(),
        planned=JudgedPlan(100.0, 60.0, 0.0, 30.0),
    )
    return score(trajectory, exercise.tolerances, exercise.rules)


@pytest.mark.parametrize("name", [*SHIPPED, "laparoscopic-tool"])
@pytest.mark.parametrize("short", [71e-3, 30e-3, 6e-3])
def test_a_needle_that_stops_short_of_its_target_earns_nothing(name: str, short: float) -> None:
    """Straight, quick, gentle, without a scan, far from every risk: and not there."""
    result = stopped_short(load_exercise(name), short, 16.0)
    assert result.total == pytest.approx(0.0)
    assert not result.passed
    bound = [row.name for row in result.rows if row.weight and row.name not in REACHING]
    assert bound, "something else than the place counts"
    for metric in bound:
        row = result.row(metric)
        assert row.gate == 0.0
        assert row.counted == 0.0
    assert any((result.row(metric).utility or 0.0) == 1.0 for metric in bound), "good in itself"
