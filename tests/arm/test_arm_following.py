"""Lines, arcs and sweeps as paths of the joints, and what is refused."""

from dataclasses import replace

import numpy as np
import pytest

from app.arm.mechanics import load_arm
from app.arm.motion.errors import FulcrumError, MotionError
from app.arm.motion.following import (
    TURN_WITHIN,
    WITHIN,
    MotionRefusedError,
    PoseArc,
    PoseLine,
    Sweep,
    follow,
)
from app.arm.motion.path import wrists
from app.arm.motion.pivot import SHAFT_OFF, HeldTool, Pivot
from app.core.arrays import angle_between
from app.core.rotation import rotation_exp, rotation_log
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE

ARM = load_arm()
TOOL = HeldTool(length=0.35, grip=0.25, axis_tool=[1.0, 0.0, 0.0])
PIVOT = Pivot(ARM, TOOL, [0.55, 0.0, 0.25], [0.05, -0.1, -1.0])
DOWN = np.diag([1.0, -1.0, -1.0])
HERE = RigidTransform(DOWN, [0.5, 0.2, 0.3])
HAND = RigidTransform.identity()
S = np.linspace(0.0, 1.0, 777)


def missed(followed, motion, T_tool_moved):
    """Largest error of position and orientation at places that the planner did not look at."""
    off = turned = 0.0
    for s, turn, place in zip(S, *wrists(ARM, followed.path.at(S)), strict=True):
        tool = ARM.tool_pose(RigidTransform(turn, place))
        found, wanted = tool @ T_tool_moved, motion.at(float(s))
        off = max(off, float(np.linalg.norm(found.translation - wanted.translation)))
        turn = rotation_log(found.rotation.T @ wanted.rotation)
        turned = max(turned, float(np.linalg.norm(turn)))
    return off, turned


MOTIONS = {
    "line": PoseLine(HERE, RigidTransform(DOWN @ rotation_exp([0.2, 0.3, 0.4]), [0.4, -0.2, 0.4])),
    "turn in place": PoseLine(
        HERE, RigidTransform(DOWN @ rotation_exp([0, 0, 1]), [0.5, 0.2, 0.3])
    ),
    "arc": PoseArc(HERE, RigidTransform(DOWN, [0.3, 0.4, 0.3]), [0.3, 0.2, 0.3], [0.0, 0.0, 1.0]),
}


@pytest.mark.parametrize("name", MOTIONS)
def test_a_motion_is_kept_to_within_its_bound_also_between_the_places_looked_at(name):
    motion = MOTIONS[name]
    followed = follow(ARM, motion, HAND)
    off, turned = missed(followed, motion, HAND)
    assert off <= followed.miss <= WITHIN
    assert turned <= followed.turn_miss <= TURN_WITHIN
    assert followed.margins.joint > 0.0
    assert followed.margins.reach > 0.0
    q = followed.path.at(S)
    assert np.abs(np.diff(q, axis=0)).max() < 0.02
    assert all(ARM.allows(one) for one in q)


@pytest.mark.long("machine")
def test_insertion_through_the_fulcrum_and_a_sweep_within_keep_the_shaft_in_it():
    d = PIVOT.inward_world
    line = PoseLine(PIVOT.pose(d, -0.05), PIVOT.pose(d, 0.1))
    inside = follow(ARM, line, TOOL.T_tool_needle, pivot=PIVOT)
    last = inside.path.q[-1]
    tip = TOOL.needle_pose(ARM, last).translation
    sweep = Sweep(PIVOT, [tip, tip + [0.03, 0.02, -0.02]], PIVOT.state(last).roll)
    swept = follow(ARM, sweep, TOOL.T_tool_needle, start=last, pivot=PIVOT)
    for one in (inside, swept):
        seen = max(PIVOT.state(q).off for q in one.path.at(S))
        assert seen <= one.off <= SHAFT_OFF
    tips = [TOOL.needle_pose(ARM, q).translation for q in swept.path.at(S)]
    wanted = [sweep.at(float(s)).translation for s in S]
    assert np.linalg.norm(np.subtract(tips, wanted), axis=1).max() <= swept.miss <= WITHIN


@pytest.mark.long("machine")
def test_finer_errors_are_met_with_more_knots():
    motion = MOTIONS["line"]
    fine = follow(ARM, motion, HAND, within=0.002 * MILLIMETRE)
    assert fine.miss <= 0.002 * MILLIMETRE
    assert len(fine.path.s) > len(follow(ARM, motion, HAND).path.s)


def test_arc_ends_where_it_should_and_turns_right_handed():
    arc = MOTIONS["arc"]
    assert abs(arc.angle - 0.5 * np.pi) < 1e-15
    assert np.abs(arc.at(1.0).matrix() - arc.end.matrix()).max() < 1e-15
    whole = PoseArc(HERE, HERE, [0.3, 0.2, 0.3], [0.0, 0.0, 1.0])
    assert whole.angle == 2.0 * np.pi
    with pytest.raises(MotionError, match="no arc"):
        PoseArc(HERE, RigidTransform(DOWN, [0.3, 0.5, 0.3]), [0.3, 0.2, 0.3], [0.0, 0.0, 1.0])


@pytest.mark.long("statistics")
def test_a_line_out_of_reach_is_refused_with_place_reason_and_a_base_that_could():
    line = PoseLine(HERE, RigidTransform(DOWN, [0.9, 0.4, 0.3]))
    with pytest.raises(MotionRefusedError, match=r"unreachable.*with its base at") as caught:
        follow(ARM, line, HAND)
    error = caught.value
    assert 0.5 < error.at < 0.7
    assert np.abs(error.p_world - line.at(error.at).translation).max() < 1e-15
    moved = replace(ARM, T_world_base=error.placement)
    assert follow(moved, line, HAND).miss <= WITHIN


def test_a_line_that_no_base_can_reach_says_so():
    far = RigidTransform(DOWN, [3.0, 0.0, 0.3])
    with pytest.raises(MotionRefusedError, match=r"no base within 0\.5 m"):
        follow(ARM, PoseLine(HERE, far), HAND)


def test_a_start_that_is_not_the_motions_own_is_refused():
    with pytest.raises(MotionRefusedError, match="begins with"):
        follow(ARM, MOTIONS["line"], HAND, start=np.full(7, 0.5), suggest=False)


@pytest.mark.long("statistics")
def test_dexterity_asked_for_is_kept_or_refused():
    with pytest.raises(MotionRefusedError, match="dexterity falls to"):
        follow(ARM, MOTIONS["line"], HAND, least_dexterity=0.9, suggest=False)


def test_a_sweep_through_the_fulcrum_is_refused_as_undefined():
    d = PIVOT.inward_world
    sweep = Sweep(PIVOT, [PIVOT.p_world + 0.05 * d, PIVOT.p_world - 0.05 * d])
    with pytest.raises(FulcrumError):
        follow(ARM, sweep, TOOL.T_tool_needle, pivot=PIVOT)


@pytest.mark.long("machine")
def test_a_sweep_through_several_places_is_one_smooth_way_and_is_kept():
    axis, depth, roll = PIVOT.inward_world, 0.1, 2.1
    tip = PIVOT.p_world + depth * axis
    tips = [tip, tip + [0.02, 0.0, 0.0], tip + [0.02, 0.02, -0.01], tip + [0.0, 0.02, -0.02]]
    sweep = Sweep(PIVOT, tips, roll)
    swept = follow(ARM, sweep, TOOL.T_tool_needle, pivot=PIVOT)
    found = np.array([TOOL.needle_pose(ARM, q).translation for q in swept.path.at(S)])
    wanted = [sweep.at(float(s)).translation for s in S]
    assert np.linalg.norm(found - wanted, axis=1).max() <= swept.miss <= WITHIN
    assert min(np.linalg.norm(found - tips[1], axis=1)) < 1e-4
    assert max(PIVOT.state(q).off for q in swept.path.at(S)) <= swept.off <= SHAFT_OFF
    for wrong in ([tip], [tip, tip], [1.0, 2.0]):
        with pytest.raises(MotionError):
            Sweep(PIVOT, wrong)


def test_the_orientation_goes_the_shortest_way():
    line = MOTIONS["line"]
    whole = np.linalg.norm(rotation_log(line.start.rotation.T @ line.end.rotation))
    half = rotation_log(line.start.rotation.T @ line.at(0.5).rotation)
    assert abs(np.linalg.norm(half) - 0.5 * whole) < 1e-15
    assert angle_between(line.at(1.0).rotation[:, 0], line.end.rotation[:, 0]) < 1e-7 * DEGREE


@pytest.mark.parametrize("name", MOTIONS)
def test_what_a_motion_bends_is_its_second_derivative_by_differences(name):
    motion, h = MOTIONS[name], 1e-4
    bend, turn_bend = 0.0, 0.0
    for s in np.linspace(0.05, 0.95, 19):
        before, here, after = (motion.at(float(s + k * h)) for k in (-1, 0, 1))
        second = (before.translation - 2.0 * here.translation + after.translation) / h**2
        bend = max(bend, float(np.linalg.norm(second)))
        fixed = (before.rotation - 2.0 * here.rotation + after.rotation) / h**2
        turn_bend = max(turn_bend, float(np.linalg.svd(fixed, compute_uv=False)[0]))
    assert motion.bend == pytest.approx(bend, abs=1e-6)
    assert motion.turn_bend == pytest.approx(turn_bend, abs=1e-6)
