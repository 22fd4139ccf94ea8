"""The tool from its tray into the trocar: phases that meet, within limits, and what cannot be."""

import numpy as np
import pytest

from app.core.arrays import angle_between
from app.core.transform import RigidTransform
from app.mechanisms.errors import NoGripError
from app.planning.arm.pick_place import Errand, PhaseName, pick_and_place
from app.planning.arm.pivot import SHAFT_OFF
from app.planning.arm.search import Collisions
from app.planning.errors import MotionError
from tests.planning.arm_rig import ARM, PIVOT, TOOL, post

pytest.importorskip("ompl", reason="the extra `arm` is not installed")
pytest.importorskip("ruckig", reason="the extra `arm` is not installed")

POST = post(at=(0.5, 0.18), radius=0.04, height=0.55)
START = np.array([0.0, 0.3, 0.0, -1.5, 0.0, 1.2, 0.0])
LYING = RigidTransform(
    np.stack([[0.0, 0.0, -1.0], [0.0, 1.0, 0.0], [1.0, 0.0, 0.0]], axis=1), [0.55, 0.4, 0.1]
)
ERRAND = Errand(LYING, np.array([0.0, 0.0, 1.0]), 0.1)


@pytest.fixture(scope="module")
def done():
    return pick_and_place(PIVOT, ERRAND, START, POST, lambda tool: POST)


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


def test_nothing_is_touched_on_the_way(done):
    times = np.linspace(0.0, done.duration, 1000)
    assert min(POST.distance(done.at(float(t))) for t in times) > 0.0


def test_the_hand_grips_the_tool_where_it_lies_and_carries_it_to_its_depth(done):
    grasp = next(phase for phase in done.phases if phase.name is PhaseName.GRASP)
    q = done.at(grasp.end - 0.5 * grasp.rest)
    needle = done.pivot.tool.needle_pose(ARM, q)
    assert np.linalg.norm(needle.translation - LYING.translation) < 1e-9
    assert angle_between(needle.rotation[:, 2], LYING.rotation[:, 2]) < 1e-9
    hand = ARM.tool_pose(ARM.wrist_pose(needle @ done.pivot.tool.T_tool_needle.inverse()))
    assert hand.rotation[2, 2] == pytest.approx(-1.0)
    end = done.pivot.state(done.at(done.duration))
    assert abs(end.depth - ERRAND.depth) < 1e-9
    assert end.off < 1e-9


def test_the_shaft_stays_in_the_fulcrum_while_it_goes_in_and_the_tool_is_held_from_the_lift(
    done,
):
    insert = done.phases[-1]
    times = np.linspace(insert.begin, insert.end, 500)
    assert max(done.pivot.state(done.at(float(t))).off for t in times) <= SHAFT_OFF
    depths = [done.pivot.state(done.at(float(t))).depth for t in times]
    assert depths[0] == pytest.approx(-ERRAND.before)
    assert (np.diff(depths) > -1e-9).all()
    assert [phase.held for phase in done.phases] == [False, False, True, True, True, True]


def test_the_same_plan_comes_out_again(done):
    again = pick_and_place(PIVOT, ERRAND, START, POST, lambda tool: POST)
    assert again.duration == done.duration
    times = np.linspace(0.0, done.duration, 50)
    assert all((again.at(float(t)) == done.at(float(t))).all() for t in times)


def test_a_tray_out_of_reach_and_a_blocked_trocar_are_named_by_phase():
    far = RigidTransform(LYING.rotation, [1.5, 0.4, 0.1])
    with pytest.raises(MotionError, match="grasp: the arm gets 0 %"):
        pick_and_place(PIVOT, Errand(far, ERRAND.up_world, 0.1), START, POST, lambda tool: POST)
    blocked = Collisions(lambda q: PIVOT.state(q).off > 0.02)
    with pytest.raises(MotionError, match="insert: the arm touches something"):
        pick_and_place(PIVOT, ERRAND, START, POST, lambda tool: blocked)
    with pytest.raises(NoGripError):
        pick_and_place(
            PIVOT, Errand(LYING, ERRAND.up_world, TOOL.grip), START, POST, lambda tool: POST
        )
