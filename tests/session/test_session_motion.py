"""The needle replayed: where it was, bent or not, and which moment of another attempt belongs to
which of this one.
"""

import json
from dataclasses import replace

import numpy as np
import pytest

from app.core import paths
from app.core.bend import Bend
from app.core.units import MILLIMETRE
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan
from app.scoring.conditions import Conditions, DeviceKind
from app.session.errors import SessionError
from app.session.index import Indexed
from app.session.motion import (
    NEEDLE_LENGTH,
    Alignment,
    ShownMotion,
    beside,
    motion,
    rivals,
    rows_beside,
    show_expert,
)
from app.session.samples import Samples

FULCRUM = (0.0, 0.16056, 0.090)
PLAN = Plan(np.array([-40.0, -120.0, 60.0]), np.array([-52.0, -40.0, 66.0]), "plan")


def placed_plan():
    return PlacedPlan.of(PLAN, Placement(), FULCRUM)


def samples(depth, state=None, measured=None, step=0.1, bend=None, target=None):
    """An attempt straight along the planned path, to these depths [m]."""
    placed, depth = placed_plan(), np.asarray(depth, dtype=np.float64)
    n = len(depth)
    seen = np.ones(n, dtype=bool) if measured is None else np.asarray(measured)
    axis = np.tile(placed.axis, (n, 1))
    nothing = np.full((n, 3), np.nan)
    return Samples(
        time=100.0 + step * np.arange(n),
        state=np.array(["inserting"] * n if state is None else state),
        valid=np.ones(n, dtype=bool),
        depth_source=np.where(seen, "tracked", "model"),
        depth=depth,
        tip=placed.p_entry + depth[:, None] * axis,
        axis=axis,
        target=np.tile(placed.p_target, (n, 1)) if target is None else target,
        hub=nothing,
        guide=nothing,
        felt=np.zeros((n, 3)),
        measured=np.full(n, np.nan),
        bend=bend,
    )


def moved(depth, **options):
    return motion(samples(depth, **options), placed_plan())


def test_a_needle_on_the_path_is_replayed_on_the_line_from_entry_to_target_in_the_patient():
    replayed = moved([0.0, 0.02, placed_plan().length])
    needle = replayed.needle(2)
    assert needle.valid
    assert needle.tip_mm == pytest.approx(PLAN.target_mm, abs=1e-6)
    assert np.linalg.norm(needle.tip_mm - needle.start_mm) == pytest.approx(1e3 * NEEDLE_LENGTH)
    assert replayed.needle(0).tip_mm == pytest.approx(PLAN.entry_mm, abs=1e-6)
    assert replayed.ending().lateral == pytest.approx(0.0, abs=1e-9)


def test_a_needle_that_tissue_bent_is_replayed_bent_and_as_long_as_it_was():
    placed = placed_plan()
    across = np.cross(placed.axis, [0.0, 1.0, 0.0])
    across /= np.linalg.norm(across)
    bend = Bend(0.003 * across, 0.06 * across, 0.2 * across, 0.08)
    deep = samples([0.08], bend=bend.numbers()[None])
    bent = motion(replace(deep, tip=deep.tip + bend.at(0.08)), placed).needle(0)
    assert len(bent.points_mm) > 2
    straight = bent.start_mm + np.linspace(0.0, 1.0, 50)[:, None] * (bent.tip_mm - bent.start_mm)
    away = min(np.linalg.norm(straight - point, axis=1).min() for point in bent.points_mm[3:-3])
    assert away > 0.2
    length = np.linalg.norm(np.diff(bent.points_mm, axis=0), axis=1).sum()
    assert length == pytest.approx(1e3 * NEEDLE_LENGTH, abs=0.2)


def test_where_nobody_measured_the_depth_the_needle_ends_at_the_entry_and_is_not_believed():
    replayed = moved([0.01, 0.05], measured=[True, False])
    needle = replayed.needle(1)
    assert not needle.valid
    assert needle.tip_mm == pytest.approx(PLAN.entry_mm, abs=1e-6)
    assert replayed.last == 0
    assert replayed.ideal(1) is None


def test_the_sample_of_a_time_is_the_nearest_one_and_the_ends_beyond_them():
    replayed = moved(np.linspace(0.0, 0.05, 11))
    assert [replayed.row(time) for time in (-5.0, 0.0, 0.24, 0.26, 0.96, 99.0)] == [
        0, 0, 2, 3, 10, 10,
    ]  # fmt: skip


def test_the_ideal_needle_is_as_deep_and_on_the_path_to_the_target_as_breathing_has_it():
    placed = placed_plan()
    away = placed.p_target + [0.0, 0.008, 0.0]
    replayed = moved([0.03, 0.05], target=np.tile(away, (2, 1)))
    ideal = replayed.ideal(1)
    path = (away - placed.p_entry) / np.linalg.norm(away - placed.p_entry)
    tip = placed.T_world_patient.inverse() @ (placed.p_entry + 0.05 * path) / MILLIMETRE
    assert ideal.tip_mm == pytest.approx(tip, abs=1e-6)
    assert replayed.target_mm(1) == pytest.approx(
        placed.T_world_patient.inverse() @ away / MILLIMETRE, abs=1e-6
    )
    assert moved([0.03]).target_mm(0) is None


def test_by_time_two_attempts_begin_together_whatever_was_withdrawn_before():
    own = moved(np.linspace(-0.01, 0.04, 6))
    late = moved(
        np.concatenate(([0.02, 0.01], np.linspace(-0.01, 0.04, 4))),
        state=["withdrawing"] * 2 + ["aligning"] * 4,
    )
    rows = rows_beside(own, late, Alignment.TIME)
    assert rows.tolist() == [2, 3, 4, 5, -1, -1]
    assert rows_beside(own, own, Alignment.TIME).tolist() == list(range(6))


def test_by_depth_the_other_needle_is_where_it_first_came_as_deep_and_nowhere_beyond():
    own = moved([-0.01, 0.01, 0.02, 0.05, 0.02])
    other = moved([-0.01, 0.0, 0.02, 0.01, 0.03, 0.04])
    rows = rows_beside(own, other, Alignment.DEPTH)
    assert rows.tolist() == [-1, 2, 2, -1, 2]
    values = beside(np.arange(6.0), rows)
    assert values[1:3].tolist() == [2.0, 2.0]
    assert np.isnan(values[[0, 3]]).all()


def test_an_attempt_without_samples_can_be_asked_and_stands_beside_nothing():
    none = moved([])
    assert none.end == 0.0
    assert none.row(3.0) == 0
    assert none.ending() is None
    assert rows_beside(none, moved([0.01]), Alignment.TIME).tolist() == []
    assert rows_beside(moved([0.01]), none, Alignment.DEPTH).tolist() == [-1]


def under(**changes):
    known = Conditions("first", 1, kind=DeviceKind.SIMULATED, hand="mouse", scoring_version=2)
    return replace(known, **changes)


def attempt(name, student, total, verdict="verified", **changes):
    conditions = under(**changes)
    return Indexed(
        name, "2026-11-20T10:00:00+00:00", student, conditions.exercise, conditions.version,
        "ended", 30.0, total, total is not None and total >= 70.0, verdict, True,
        json.dumps(conditions.document()), "{}",
    )  # fmt: skip


def test_beside_an_attempt_stand_only_comparable_ones_own_best_first_then_the_others_best_first():
    attempts = [
        attempt("a", "ada", 60.0),
        attempt("b", "ada", 80.0),
        attempt("shown", "ada", 70.0),
        attempt("c", "ben", 95.0),
        attempt("d", "ben", 99.0, version=2),
        attempt("e", "ada", 100.0, verdict="altered"),
        attempt("f", "ada", None),
        attempt("g", "ada", 97.0, hand="keyboard"),
        attempt("h", "eve", 98.0),
    ]
    found = rivals(
        attempts, "shown", under(), lambda who: who == "ada", lambda one: one.student != "eve"
    )
    assert [one.id for one in found] == ["b", "a", "c"]


def test_beside_a_void_attempt_may_stand_one_that_was_judged_by_the_newest_rules():
    found = rivals(
        [attempt("a", "ada", 60.0)], "x", under(scoring_version=0), lambda _: True, lambda _: True
    )
    assert [one.id for one in found] == ["a"]


def test_the_movement_of_an_attempt_is_kept_without_a_name_and_read_back():
    depth = np.linspace(-0.015, 0.06, 40)
    shown = ShownMotion.of(moved(depth, measured=[False] * 3 + [True] * 37), "kidney", 2)
    assert len(shown.time) == 37
    shown.save()
    (file,) = (paths.data() / "demonstrations").iterdir()
    assert set(json.loads(file.read_text())) == {
        "format", "exercise", "version", "time", "axis", "depth", "path",
    }  # fmt: skip
    again = ShownMotion.kept("kidney", 2)
    np.testing.assert_allclose(again.depth, shown.depth, atol=1e-7)
    np.testing.assert_allclose(again.axis, shown.axis, atol=1e-7)
    assert ShownMotion.kept("kidney", 3) is None  # another version: the expert
    show_expert("kidney")
    show_expert("kidney")
    assert ShownMotion.kept("kidney", 2) is None


@pytest.mark.parametrize(
    "text", ["", "{}", "[]", '{"format": 1}', '{"format":1,"exercise":"kidney","version":2,'
             '"time":[0,1],"axis":[[0,0,null],[0,0,-1]],"depth":[0,1],"path":[0,0,-1]}',
             '{"format":1,"exercise":"kidney","version":2,'
             '"time":[1,0],"axis":[[0,0,-1],[0,0,-1]],"depth":[0,1],"path":[0,0,-1]}'],
)  # fmt: skip
def test_a_kept_movement_that_cannot_be_used_leaves_the_exercise_to_the_expert(text):
    file = paths.data() / "demonstrations" / "kidney.json"
    file.parent.mkdir(parents=True, exist_ok=True)
    file.write_text(text)
    assert ShownMotion.kept("kidney", 2) is None


def test_a_movement_that_nobody_saw_and_an_exercise_that_is_a_path_are_refused():
    with pytest.raises(SessionError, match="less than a second"):
        ShownMotion.of(moved(np.linspace(0.0, 0.05, 40), measured=[False] * 40), "kidney", 1)
    with pytest.raises(SessionError, match="no identifier"):
        ShownMotion.of(moved(np.linspace(0.0, 0.05, 40)), "../kidney", 1).save()
    assert ShownMotion.kept("../kidney", 1) is None
