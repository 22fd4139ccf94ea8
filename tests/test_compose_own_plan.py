"""An exercise in which the student plans: what is scored is the plan as well as the hand.

Entries are drawn at random from the skin of the built-in patient; the hand is perfect each time.
"""

from functools import cache
from types import SimpleNamespace
from typing import Any

import numpy as np
import pytest

from app.compose.exercise_ct import read_ct
from app.compose.exercise_field import tissues_of
from app.exercises.library import load_exercise
from app.exercises.scene import device_of
from app.imaging.body import find_body
from app.imaging.phantom.anatomy import anatomy
from app.imaging.skin import skin_points
from app.planning.limits import ReachLimits
from app.planning.paths import PathObstacle, best, score_paths
from app.planning.placement import PlacedPlan
from app.planning.plan import Plan
from app.planning.reach import reach
from app.scoring.result import Score
from app.scoring.score import score
from app.scoring.trajectory import Trajectory
from app.session.planned import event_of, judged_plan, judged_plan_of, plan_sentences

ENTRIES = 200
OUT_OF_THE_QUESTION = (PathObstacle.REACH, PathObstacle.LONG, PathObstacle.AIR)
"""The program begins no attempt at these."""


@cache
def patient() -> Any:
    """Return the patient of the exercise: its field, the planner's map, and an attempt's frame."""
    exercise = load_exercise("plan-it-yourself")
    facts = anatomy(exercise.ct.phantom.seed)
    plan = Plan(facts.entry_mm, facts.lesion_mm, "own")
    volume, field = read_ct(exercise), tissues_of(exercise, plan)
    body = find_body(volume)
    profile, placement = device_of(exercise), exercise.placement.placement()
    limits = ReachLimits.of(profile)
    skin = skin_points(body)
    scores = score_paths(plan.target_mm, skin, body, (), placement, limits, tissues=field)
    return SimpleNamespace(
        exercise=exercise, field=field, scores=scores, profile=profile, placement=placement,
        target_mm=plan.target_mm, entry_mm=plan.entry_mm,
    )  # fmt: skip


def perfect(entry_mm: Any) -> Score:
    """Score a needle that goes along a plan without any error."""
    seen = patient()
    plan = Plan(entry_mm, seen.target_mm, "own")
    placed = PlacedPlan.of(plan, seen.placement, seen.profile.fulcrum)
    time = np.linspace(0.0, 60.0, 600)
    share = np.clip((time - 20.0) / 30.0, 0.0, 1.0)
    depth = share * placed.length
    path = Trajectory(
        placed=placed,
        time=time,
        tip=placed.p_entry + np.outer(depth, placed.axis),
        axis=np.tile(placed.axis, (600, 1)),
        depth=depth,
        felt=np.zeros((600, 3)),
        phase=np.where(share > 0.0, "inserting", "aligning"),  # type: ignore[arg-type]
        depth_valid=np.ones(600, bool),
        met=(),
        planned=judged_plan_of(placed, seen.field),
    )
    return score(path, seen.exercise.tolerances, seen.exercise.rules)


def drawn(numbers: Any) -> list[int]:
    return np.random.default_rng(28).choice(np.flatnonzero(numbers), ENTRIES, False).tolist()


def legal() -> Any:
    blocked = [tuple(PathObstacle).index(one) for one in OUT_OF_THE_QUESTION]
    return ~np.isin(patient().scores.block, blocked)


def test_an_arbitrary_entry_scores_far_less_than_the_planners_best() -> None:
    """All that an attempt can begin with: with or without a rib, lung or vessel on the way."""
    seen = patient()
    totals = []
    for number in drawn(legal()):
        entry_mm = seen.scores.entries_mm[number]
        assert reach(Plan(entry_mm, seen.target_mm, "own"), seen.placement, seen.profile).reachable
        totals.append(perfect(entry_mm).total)
    best_total = perfect(seen.scores.entries_mm[best(seen.scores, 1)[0]]).total
    print(f"\nany: {np.percentile(totals, [10, 50, 90]).round(1)}, best: {best_total:.1f}")
    assert np.median(totals) <= 60.0
    assert best_total >= 90.0


def test_one_that_meets_nothing_is_no_good_plan_for_that_alone() -> None:
    seen = patient()
    totals = [perfect(seen.scores.entries_mm[n]).total for n in drawn(seen.scores.free)]
    print(f"\nfree: {np.percentile(totals, [10, 50, 90]).round(1)}")
    assert np.median(totals) <= 60.0
    assert max(totals) >= 90.0


def test_a_path_through_what_must_not_be_met_earns_nothing_as_a_plan() -> None:
    seen = patient()
    for kind in (PathObstacle.BONE, PathObstacle.LUNG, PathObstacle.VESSEL):
        rows = np.flatnonzero(seen.scores.block == tuple(PathObstacle).index(kind))
        worst = rows[np.argmax(getattr(seen.scores, f"{kind.value}_mm")[rows])]
        result = perfect(seen.scores.entries_mm[worst])
        assert result.row("plan_score").value == 0.0, kind
        assert result.total == pytest.approx(50.0), "the hand was perfect, and is half of it"
        assert not result.passed


def test_the_score_is_the_one_of_the_map_of_entries() -> None:
    """The map has the skin of the CT, the score that of the field: normals differ by degrees."""
    seen = patient()
    for number in best(seen.scores, 8, 5.0):
        planned = perfect(seen.scores.entries_mm[number]).row("plan_score").value
        assert planned == pytest.approx(float(seen.scores.score[number]), abs=4.0)


def test_what_speaks_against_a_plan_is_said_and_kept_in_the_record() -> None:
    seen = patient()
    rows = np.flatnonzero(seen.scores.block == tuple(PathObstacle).index(PathObstacle.LUNG))
    worst = rows[np.argmax(seen.scores.lung_mm[rows])]
    for number in (worst, best(seen.scores, 1)[0]):
        plan = Plan(seen.scores.entries_mm[number], seen.target_mm, "own")
        placed = PlacedPlan.of(plan, seen.placement, seen.profile.fulcrum)
        planned = judged_plan_of(placed, seen.field)
        assert planned is not None
        assert judged_plan([event_of(planned, 1.0)]) == planned
        said = plan_sentences(planned)
        if number == worst:
            length = seen.scores.lung_mm[number]
            (lung,) = [one for one in said if "lung" in one]
            assert float(lung.split(" mm")[0].rsplit(" ", 1)[1]) == pytest.approx(length, abs=1.5)
        else:
            assert any("mm long and goes in" in one for one in said)
