"""The tool from its tray into the trocar: phases that meet, within limits, and what cannot be."""

from dataclasses import replace

import numpy as np
import pytest

from app.arm.motion import pick_place
from app.arm.motion.errors import MotionError
from app.arm.motion.pick_place import (
    Hindrance,
    NotPlacedError,
    PhaseName,
    PickPlaceTask,
    can_place,
    pick_and_place,
)
from app.arm.motion.pivot import SHAFT_OFF
from app.arm.motion.searching import Collisions, SearchError
from app.core.arrays import angle_between, unit
from app.core.transform import RigidTransform
from app.mechanisms.errors import NoGripError
from tests.arm.motion_rig import ARM, PIVOT, TOOL, post

pytest.importorskip("ompl", reason="the extra `arm` is not installed")
pytest.importorskip("ruckig", reason="the extra `arm` is not installed")

POST = post(at=(0.5, 0.18), radius=0.04, height=0.55)
START = np.array([0.0, 0.3, 0.0, -1.5, 0.0, 1.2, 0.0])
LYING = RigidTransform(
    np.stack([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]], axis=1), [0.55, 0.4, 0.1]
)
LEANING = unit(PIVOT.inward_world + [0.1, 0.15, 0.0])
TASK = PickPlaceTask(LYING, np.array([0.0, 0.0, 1.0]), 0.1, LEANING)


@pytest.fixture(scope="module")
def done():
    return pick_and_place(PIVOT, TASK, START, POST, lambda tool: POST)


@pytest.mark.long("machine")
def test_the_shaft_turns_about_the_fulcrum_outside_before_it_goes_in(done):
    pivot = next(phase for phase in done.phases if phase.name is PhaseName.PIVOT)
    times = np.linspace(pivot.begin, pivot.end, 200)
    states = [done.pivot.state(done.at(float(t))) for t in times]
    assert max(state.off for state in states) <= SHAFT_OFF
    assert [state.depth for state in states] == pytest.approx([-TASK.before] * 200, abs=1e-4)
    assert angle_between(states[0].axis_world, PIVOT.inward_world) < 1e-6
    assert angle_between(states[-1].axis_world, LEANING) < 1e-6
    whole = angle_between(PIVOT.inward_world, LEANING)
    for state in states:  # the shortest way
        parts = [angle_between(state.axis_world, end) for end in (PIVOT.inward_world, LEANING)]
        assert sum(parts) == pytest.approx(whole, abs=2e-3)


@pytest.mark.long("machine")
def test_along_the_trocars_axis_there_is_nothing_to_turn():
    straight = replace(TASK, axis_world=None)
    planned = pick_and_place(PIVOT, straight, START, POST, lambda tool: POST)
    assert PhaseName.PIVOT not in [phase.name for phase in planned.phases]
    end = planned.pivot.state(planned.at(planned.duration))
    assert angle_between(end.axis_world, PIVOT.inward_world) < 1e-6


@pytest.mark.long("statistics")
@pytest.mark.parametrize("lean", [1e-3, 1.1e-6, 0.9e-6, 1e-12])
def test_a_direction_that_hardly_leans_makes_no_jump(lean):
    aside = unit(np.cross(PIVOT.inward_world, [1.0, 0.0, 0.0]))
    hardly = replace(TASK, axis_world=unit(PIVOT.inward_world + lean * aside))
    planned = pick_and_place(PIVOT, hardly, START, POST, lambda tool: POST)
    names = [phase.name for phase in planned.phases]
    assert (PhaseName.PIVOT in names) is (lean > 1e-6)
    times = np.linspace(planned.phases[2].begin, planned.duration, 2000)
    q = np.array([planned.at(float(t)) for t in times])
    assert (np.abs(np.diff(q, axis=0)) <= 1.001 * ARM.speed * np.diff(times)[0] + 1e-9).all()


@pytest.mark.long("statistics")
def test_with_the_tool_in_the_hand_it_is_as_careful_as_asked(done):
    share = 0.3
    slow = pick_and_place(PIVOT, replace(TASK, careful=share), START, POST, lambda tool: POST)
    for before, after in zip(done.phases, slow.phases, strict=True):
        if not after.held:
            assert after.end - after.begin == pytest.approx(before.end - before.begin)
        for motion in after.motions if after.held else ():
            speed, acceleration, jerk = motion.use_of_limits(ARM).max(axis=1)
            assert speed <= share * (1.0 + 1e-9)
            assert acceleration <= share * (1.0 + 1e-9)
            assert jerk <= share * (1.0 + 1e-9)


@pytest.mark.long("machine")
def test_whether_it_can_be_is_told_without_a_search(monkeypatch):
    def searched(*_, **__):
        raise AssertionError("a way was searched")

    monkeypatch.setattr(pick_place, "search", searched)
    assert can_place(PIVOT, TASK, START, POST, lambda tool: POST)
    far = replace(TASK, T_world_needle=RigidTransform(LYING.rotation, [1.5, 0.4, 0.1]))
    assert not can_place(PIVOT, far, START, POST, lambda tool: POST)


@pytest.mark.long("statistics")
def test_a_refusal_names_the_phase_that_was_come_to_and_what_was_touched():
    blocked = Collisions(
        lambda q: PIVOT.state(q).depth < 0.05, names=lambda q: "the tip comes to a bone"
    )
    with pytest.raises(NotPlacedError) as caught:
        pick_and_place(PIVOT, TASK, START, POST, lambda tool: POST, inside=lambda tool: blocked)
    assert caught.value.phase is PhaseName.INSERT
    assert caught.value.hindrance is Hindrance.TOUCH
    assert caught.value.why.startswith("the tip comes to a bone after")
    far = replace(TASK, T_world_needle=RigidTransform(LYING.rotation, [1.5, 0.4, 0.1]))
    with pytest.raises(NotPlacedError) as caught:
        pick_and_place(PIVOT, far, START, POST, lambda tool: POST)
    assert (caught.value.phase, caught.value.hindrance) == (PhaseName.GRASP, Hindrance.REACH)


def test_a_search_that_ends_without_a_way_is_an_obstacle_of_its_own(monkeypatch):
    def none(*_, **__):
        raise SearchError("no way in 7 tests")

    monkeypatch.setattr(pick_place, "search", none)
    with pytest.raises(NotPlacedError) as caught:
        pick_and_place(PIVOT, TASK, START, POST, lambda tool: POST)
    assert (caught.value.phase, caught.value.hindrance) == (PhaseName.APPROACH, Hindrance.WAY)
    assert caught.value.why == "no way in 7 tests"


@pytest.mark.long("machine")
def test_all_phases_follow_each_other_without_a_jump_within_the_limits(done):
    assert [phase.name for phase in done.phases] == list(PhaseName)
    for before, after in zip(done.phases[:-1], done.phases[1:], strict=True):
        assert after.begin == before.end
    times = np.linspace(-0.1, done.duration + 0.1, 4000)
    q = np.array([done.at(float(t)) for t in times])
    assert (q[0] == START).all()
    assert (np.abs(np.diff(q, axis=0)) <= 1.001 * ARM.speed * np.diff(times)[0]).all()
    for phase in done.phases:
        for motion in phase.motions:
            assert motion.use_of_limits(ARM).max() <= 1.0 + 1e-9


@pytest.mark.long("machine")
def test_nothing_is_touched_on_the_way(done):
    times = np.linspace(0.0, done.duration, 1000)
    assert min(POST.distance(done.at(float(t))) for t in times) > 0.0


@pytest.mark.long("machine")
def test_the_hand_grips_the_tool_where_it_lies_and_carries_it_to_its_depth(done):
    grasp = next(phase for phase in done.phases if phase.name is PhaseName.GRASP)
    q = done.at(grasp.end - 0.5 * grasp.rest)
    needle = done.pivot.tool.needle_pose(ARM, q)
    assert np.linalg.norm(needle.translation - LYING.translation) < 1e-9
    assert angle_between(needle.rotation[:, 2], LYING.rotation[:, 2]) < 1e-9
    hand = ARM.tool_pose(ARM.wrist_pose(needle @ done.pivot.tool.T_tool_needle.inverse()))
    assert hand.rotation[2, 2] == pytest.approx(-1.0)
    end = done.pivot.state(done.at(done.duration))
    assert abs(end.depth - TASK.depth) < 1e-9
    assert end.off < 1e-9


@pytest.mark.long("machine")
def test_the_shaft_stays_in_the_fulcrum_while_it_goes_in_and_the_tool_is_held_from_the_lift(
    done,
):
    insert = done.phases[-1]
    times = np.linspace(insert.begin, insert.end, 500)
    assert max(done.pivot.state(done.at(float(t))).off for t in times) <= SHAFT_OFF
    depths = [done.pivot.state(done.at(float(t))).depth for t in times]
    assert depths[0] == pytest.approx(-TASK.before)
    assert (np.diff(depths) > -1e-9).all()
    assert [phase.held for phase in done.phases] == [False, False, *[True] * 5]


@pytest.mark.long("statistics")
def test_the_same_plan_comes_out_again(done):
    again = pick_and_place(PIVOT, TASK, START, POST, lambda tool: POST)
    assert again.duration == done.duration
    times = np.linspace(0.0, done.duration, 50)
    assert all((again.at(float(t)) == done.at(float(t))).all() for t in times)


@pytest.mark.long("statistics")
def test_a_tray_out_of_reach_and_a_blocked_trocar_are_named_by_phase():
    far = RigidTransform(LYING.rotation, [1.5, 0.4, 0.1])
    with pytest.raises(MotionError, match="grasp: the arm gets 0 %"):
        pick_and_place(
            PIVOT, PickPlaceTask(far, TASK.up_world, 0.1), START, POST, lambda tool: POST
        )
    blocked = Collisions(lambda q: PIVOT.state(q).off > 0.02)
    with pytest.raises(MotionError, match="insert: the arm touches something"):
        pick_and_place(PIVOT, TASK, START, POST, lambda tool: blocked)
    with pytest.raises(NoGripError):
        pick_and_place(
            PIVOT, PickPlaceTask(LYING, TASK.up_world, TOOL.grip), START, POST, lambda tool: POST
        )
