import numpy as np
import pytest

from app.planning.draft import DraftPlan
from app.planning.errors import PlanError
from app.planning.history import DEPTH, UndoHistory
from app.planning.plan import Plan

ENTRY, TARGET = (10.0, -90.0, 300.0), (4.0, -31.5, 296.0)


def plan() -> Plan:
    return Plan(ENTRY, TARGET, "liver")


def test_length_and_direction_join_entry_and_target() -> None:
    p = plan()
    assert p.length_mm == pytest.approx(np.linalg.norm(np.subtract(TARGET, ENTRY)))
    np.testing.assert_allclose(p.entry_mm + p.length_mm * p.direction, TARGET, atol=1e-12)


def test_points_are_read_only_copies() -> None:
    source = np.array(ENTRY)
    p = Plan(source, TARGET)
    source[0] = 99.0
    assert p.entry_mm[0] == 10.0
    with pytest.raises(ValueError, match="read-only"):
        p.entry_mm[0] = 1.0


def test_target_on_the_entry_is_refused_with_the_distance() -> None:
    with pytest.raises(PlanError, match=r"0\.5 mm apart; a path needs at least 1 mm"):
        Plan(ENTRY, (10.0, -90.0, 300.5))


def test_a_path_of_exactly_one_millimetre_is_accepted() -> None:
    assert Plan((0.1, 0.2, 0.3), (0.1, 0.2, 1.3)).length_mm == pytest.approx(1.0)


@pytest.mark.parametrize("bad", [(np.nan, 0.0, 0.0), (0.0, np.inf, 0.0), (1e8, 0.0, 0.0)])
def test_a_point_that_is_not_finite_or_absurd_is_refused(bad: tuple[float, ...]) -> None:
    with pytest.raises(PlanError, match="target_mm"):
        Plan(ENTRY, bad)


@pytest.mark.parametrize("bad", [(1.0, 2.0), "abc", None, [[1.0, 2.0, 3.0]]])
def test_something_that_is_no_point_is_refused(bad: object) -> None:
    with pytest.raises(PlanError, match="entry_mm"):
        Plan(bad, TARGET)  # type: ignore[arg-type]


def test_plans_compare_by_value() -> None:
    assert plan() == plan()
    assert hash(plan()) == hash(plan())
    assert plan() != plan().with_entry((0.0, 0.0, 0.0))
    assert plan() != "liver"


def test_editing_keeps_the_other_point_and_the_name() -> None:
    edited = plan().with_target((0.0, 0.0, 290.0))
    assert edited.name == "liver"
    np.testing.assert_array_equal(edited.entry_mm, ENTRY)
    np.testing.assert_array_equal(edited.target_mm, (0.0, 0.0, 290.0))


def test_a_target_outside_the_body_is_refused_by_name() -> None:
    plan().require_inside(lambda point: True)
    with pytest.raises(PlanError, match=r"target \(4.0, -31.5, 296.0\) mm lies outside"):
        plan().require_inside(lambda point: False)


def test_a_draft_becomes_a_plan_when_both_points_are_set() -> None:
    draft = DraftPlan()
    with pytest.raises(PlanError, match="no entry yet"):
        draft.plan()
    draft = draft.with_entry(np.array(ENTRY))
    assert not draft.complete
    with pytest.raises(PlanError, match="no target yet"):
        draft.plan()
    draft = draft.with_target(TARGET)
    assert draft.complete
    assert draft.plan() == Plan(ENTRY, TARGET)
    assert DraftPlan.of(plan()).plan() == plan()
    assert draft.with_entry(None) == DraftPlan(None, TARGET)


def test_a_draft_with_both_points_in_one_place_is_kept_but_makes_no_plan() -> None:
    draft = DraftPlan(ENTRY, ENTRY)
    with pytest.raises(PlanError, match="apart"):
        draft.plan()


def test_a_draft_refuses_a_point_that_is_not_finite() -> None:
    with pytest.raises(PlanError, match="must be finite"):
        DraftPlan().with_entry((np.nan, 0.0, 0.0))


def test_undo_and_redo_walk_the_same_values() -> None:
    drafts = [DraftPlan(), DraftPlan(ENTRY), DraftPlan(ENTRY, TARGET)]
    history = UndoHistory(drafts[0]).do(drafts[1]).do(drafts[2])
    assert history.undo().present == drafts[1]
    assert history.undo().undo().present == drafts[0]
    assert history.undo().undo().redo().redo() == history
    assert not history.undo().undo().can_undo
    assert not history.can_redo
    assert history.redo() == history


def test_a_new_step_forgets_what_could_be_redone() -> None:
    history = UndoHistory(1).do(2).undo().do(3)
    assert history.present == 3
    assert not history.can_redo


def test_the_moves_of_a_drag_are_one_step() -> None:
    history = UndoHistory(1).do(2)
    for value in (3, 4, 5):
        history = history.amend(value)
    assert history.present == 5
    assert history.undo().present == 1


def test_an_equal_value_adds_no_step_and_old_steps_are_forgotten() -> None:
    assert not UndoHistory(1).do(1).can_undo
    history = UndoHistory(0)
    for value in range(1, DEPTH + 50):
        history = history.do(value)
    assert len(history.past) == DEPTH
