"""The arm's scene in MuJoCo: the same kinematics, at rest where it should be, and a firm grasp."""

from dataclasses import replace

import numpy as np
import pytest

from app.arm.hand import HandFinger
from app.arm.hand import forward as finger_forward
from app.arm.mechanics import forward, link_frames
from app.arm.motion import pick_place
from app.arm.motion.path import JointPath
from app.arm.motion.searching import SearchError
from app.arm.motion.timing import timed
from app.arm.scene import (
    ArmScene,
    CarryError,
    CarryFailure,
    Insertion,
    RunningScene,
    SceneClearance,
    SeenTool,
    ToolBody,
    TrocarRing,
    carry,
    could_carry,
    plan,
)
from app.arm.scene.mjcf import finger_joint, write_scene
from app.core.progress import Cancelled
from app.core.transform import RigidTransform
from app.simulation.errors import SimulationError

mujoco = pytest.importorskip("mujoco", reason="needs the extra arm: make extra NAME=arm")

SCENE = ArmScene.seeded(3)
DOWN = np.array([0.0, 0.0, -1.0])
DEPTH = 0.05


def leaning(tilt, azimuth=0.0):
    """Direction that leans from straight down, both in degrees."""
    tilt, azimuth = np.radians((tilt, azimuth))
    across = np.sin(tilt) * np.array([np.cos(azimuth), np.sin(azimuth), 0.0])
    return across + np.cos(tilt) * DOWN


def phases(running, wanted=None, to="insert", force=5.0):
    """Plan with perfect eyes and carry out up to a phase; what was done."""
    known = Insertion.known(running.scene, DOWN, DEPTH, running.state.T_world_tool)
    wanted = wanted or known
    done = {}
    for phase in carry(running, wanted, plan(running.scene, wanted), force):
        done[phase.name] = phase.errors
        if phase.name == to:
            break
    return done


def placed(q, fingers=None):
    """MuJoCo's own data of the scene at joint angles."""
    model = mujoco.MjModel.from_xml_string(write_scene(SCENE))
    data = mujoco.MjData(model)
    for k in range(7):
        data.joint(f"joint_{k + 1}").qpos = q[k]
    for finger, two in zip(HandFinger, fingers or (), strict=fingers is not None):
        for k, joint in enumerate((2, 3)):
            data.joint(finger_joint(finger, joint)).qpos = two[k]
    mujoco.mj_kinematics(model, data)
    return data


def test_forward_kinematics_is_that_of_the_arm():
    rng = np.random.default_rng(1)
    for _ in range(20):
        q = rng.uniform(SCENE.arm.lower, SCENE.arm.upper)
        data, hand = placed(q), SCENE.arm.tool_pose(forward(SCENE.arm, q))
        flange = SCENE.arm.T_world_base @ forward(SCENE.arm, q) @ SCENE.arm.T_wrist_flange
        assert data.site("hand").xpos == pytest.approx(hand.translation, abs=1e-9)
        assert data.site("hand").xmat.reshape(3, 3) == pytest.approx(hand.rotation, abs=1e-9)
        assert data.site("flange").xpos == pytest.approx(flange.translation, abs=1e-9)
        elbow = SCENE.arm.T_world_base @ link_frames(SCENE.arm, q)[3][:3, 3]
        assert data.body("joint_4").xpos == pytest.approx(elbow, abs=1e-9)


def test_a_finger_ends_where_its_geometry_says():
    rng, hand = np.random.default_rng(2), SCENE.hand.hand
    joints = [rng.uniform(0.0, (hand.most_proximal, hand.most_distal)) for _ in HandFinger]
    data = placed(np.zeros(7), joints)
    T_world_hand = SCENE.arm.tool_pose(forward(SCENE.arm, np.zeros(7)))
    for finger, two in zip(HandFinger, joints, strict=True):
        place = T_world_hand @ finger.placed(hand)
        inner = replace(hand, distal=hand.distal - hand.pad)  # to the middle of the round tip
        tip = place @ finger_forward(inner, (0.0, *two))
        shape = data.geom(finger_joint(finger, 3))
        half = 0.5 * (hand.distal - hand.pad)
        end = shape.xpos - half * shape.xmat.reshape(3, 3)[:, 2]
        assert end == pytest.approx(tip, abs=1e-9)


def test_masses_are_the_published_ones():
    model = mujoco.MjModel.from_xml_string(write_scene(SCENE))
    for joint in SCENE.published.joints:
        assert model.body(joint.name).mass[0] == joint.mass
        assert model.body(joint.name).ipos == pytest.approx(joint.centre, abs=1e-15)
    parts = [f"{f.name.lower()}_{link}" for f in HandFinger for link in ("proximal", "distal")]
    hand = sum(float(model.body(name).mass[0]) for name in ("hand", *parts))
    assert hand == pytest.approx(SCENE.hand_mass)
    assert model.body("tool").mass[0] == pytest.approx(SCENE.tool.mass)


@pytest.mark.long("machine")
def test_a_seed_gives_the_same_scene_and_the_tool_lies_still_on_both_rails():
    assert ArmScene.seeded(5).T_world_tool.matrix() == pytest.approx(
        ArmScene.seeded(5).T_world_tool.matrix(), abs=0.0
    )
    for seed in range(4):
        with RunningScene(ArmScene.seeded(seed)) as running:
            first = running.state
            running.stay(0.3)
            last = running.state
        rails = {pair[1] for pair in first.touching} | {pair[0] for pair in first.touching}
        assert {"left rail", "right rail"} <= rails
        moved = last.T_world_tool.translation - first.T_world_tool.translation
        assert np.linalg.norm(moved) < 1e-4


def test_the_arm_stands_against_gravity_and_follows_a_line():
    with RunningScene(SCENE) as running:
        assert running.state.q == pytest.approx(SCENE.home, abs=1e-6)
        goal = SCENE.home + np.radians([10.0, 5.0, -5.0, -8.0, 20.0, 10.0, 30.0])
        motion = timed(SCENE.arm, JointPath.straight(SCENE.home, goal), 0.4)
        path = motion.at(
            np.append(np.arange(SCENE.step, motion.duration, SCENE.step), motion.duration)
        )[0]
        running.follow(path)
        assert running.state.q == pytest.approx(goal, abs=2e-4)
        running.stay(0.3)
        assert running.state.q == pytest.approx(goal, abs=1e-6)
        assert np.abs(running.state.speed).max() < 1e-4
        assert running.busy > 0.0
        speeds = np.abs(np.diff(path, axis=0)).max(axis=0) / SCENE.step
        assert (speeds <= 0.4 * SCENE.arm.speed * (1.0 + 1e-9)).all()
        beyond = SCENE.home.copy()
        beyond[3] = -2.2
        with pytest.raises(SimulationError, match="joint 4 6"):
            running.follow(beyond)


@pytest.mark.long("machine")
def test_the_tool_is_lifted_without_slipping():
    for seed in (0, 1, 4):
        with RunningScene(ArmScene.seeded(seed)) as running:
            done = phases(running, to="lift")
            state = running.state
        assert list(done) == ["approach", "grasp", "lift"]
        assert (state.forces > 1.5).all()
        touching = {name for pair in state.touching for name in pair}
        assert touching == {"shaft", "one_3", "two_3", "three_3"}
        assert abs(done["lift"]["height_mm"] - 100.0) < 0.5
        assert done["lift"]["slip_mm"] < 0.2
        assert done["lift"]["slip_deg"] < 0.5
        assert done["grasp"]["in_hand_mm"] < 1.5
        assert abs(done["grasp"]["force_N"]) < 1.0


@pytest.mark.long("machine")
@pytest.mark.parametrize("azimuth", [20.0, 200.0])
def test_the_tool_goes_through_the_trocar_along_a_leaning_path_without_touching_it(azimuth):
    axis, depth = leaning(25.0, azimuth), 0.09
    scene = ArmScene.seeded(1, ToolBody().reaching(depth), axis)
    with RunningScene(scene) as running:
        wanted = Insertion.known(scene, axis, depth, running.state.T_world_tool)
        done = phases(running, wanted)
        assert running.holding
        assert (running.state.forces > 1.0).all()
    assert list(done) == ["approach", "grasp", "lift", "transfer", "align", "pivot", "insert"]
    for name in ("align", "pivot", "insert"):
        assert done[name]["axis_from_fulcrum_mm"] < 1.0
        assert done[name]["axis_deg"] < 0.5
    assert done["insert"]["tip_mm"] < 1.5
    assert abs(done["insert"]["depth_mm"]) < 1.0
    assert done["insert"]["ring_N"] == 0.0


@pytest.mark.long("machine")
def test_a_carried_tool_keeps_to_the_curves_of_the_hand():
    # along the tangent it would leave this curve by 1.7 mm
    scene = ArmScene.seeded(2, ToolBody().reaching(0.056), leaning(22.4, 108.0))
    with RunningScene(scene) as running:
        wanted = Insertion.known(scene, leaning(22.4, 108.0), 0.056, running.state.T_world_tool)
        done = phases(running, wanted, to="transfer")
    assert done["transfer"]["slip_mm"] < 0.6


@pytest.mark.long("machine")
def test_a_trocar_that_is_elsewhere_than_thought_is_pressed_or_missed():
    with RunningScene(SCENE) as running:
        known = Insertion.known(SCENE, DOWN, DEPTH, running.state.T_world_tool)
        beside = replace(known, fulcrum=known.fulcrum + [0.004, 0.0, 0.0])
        with pytest.raises(CarryError, match="pressed the trocar's ring with") as caught:
            phases(running, beside)
    assert caught.value.failure is CarryFailure.TOUCHED
    with RunningScene(SCENE) as running:
        known = Insertion.known(SCENE, DOWN, DEPTH, running.state.T_world_tool)
        above = replace(known, fulcrum=known.fulcrum + [0.0, 0.0, 0.04])
        with pytest.raises(CarryError, match="is not in the trocar") as caught:
            phases(running, above)
    assert caught.value.failure is CarryFailure.MISSED


def test_a_path_too_aslant_for_the_ring_is_refused_before_anything_moves():
    wanted = Insertion.known(SCENE, leaning(40.0), DEPTH)
    with pytest.raises(CarryError, match="leans 40° from the trocar's axis") as caught:
        plan(SCENE, wanted)
    assert caught.value.failure is CarryFailure.TOUCHED
    assert not could_carry(SCENE, leaning(40.0), DEPTH)


@pytest.mark.long("machine")
def test_a_plan_of_the_same_scene_is_the_same_and_can_be_broken_off():
    wanted = Insertion.known(SCENE, DOWN, DEPTH)
    first, again = plan(SCENE, wanted), plan(SCENE, wanted)
    times = np.linspace(0.0, first.duration, 60)
    assert all((first.at(float(t)) == again.at(float(t))).all() for t in times)
    asked = 0

    def check():
        nonlocal asked
        asked += 1
        if asked > 50:
            raise Cancelled("cancelled")

    with pytest.raises(Cancelled):
        plan(SCENE, wanted, check=check)
    assert asked == 51


def test_no_way_within_the_budget_is_said_so(monkeypatch):
    def none(*_, **__):
        raise SearchError("no way in 3000 tests")

    monkeypatch.setattr(pick_place, "search", none)
    with pytest.raises(CarryError, match="come to the tool: no way in 3000 tests") as caught:
        plan(SCENE, Insertion.known(SCENE, DOWN, DEPTH))
    assert caught.value.failure is CarryFailure.NO_WAY


def test_the_watch_sees_the_scene_every_20_ms():
    seen = []
    with RunningScene(SCENE, seen.append) as running:
        running.stay(0.2)
        last = running.state
    assert [state.time for state in seen] == pytest.approx(np.arange(11) * 0.02, abs=1e-9)
    assert (seen[-1].q == last.q).all()


@pytest.mark.long("machine")
def test_joint_2_lets_go_of_its_motor_when_pressed_hard_and_is_taken_along_again():
    with RunningScene(SCENE) as running:
        phases(running, to="grasp", force=9.0)
        state = running.state
        assert running.holding
        assert state.let_go[2]
        assert state.fingers[2, 1] > state.fingers[2, 0] * SCENE.hand.hand.coupling + 0.005
        running.release()
        running.stay(0.3)
        assert not running.holding
        assert running.state.let_go == (False, False, False)
        assert np.abs(running.state.fingers).max() < 0.02


@pytest.mark.long("machine")
@pytest.mark.parametrize(
    ("shift", "failure", "says"),
    [
        ([0.0, 0.9, 0.0], CarryFailure.UNREACHABLE, "cannot come down on the tool"),
        ([0.0, 0.0, -0.10], CarryFailure.COLLIDES, "rail comes to|comes to .* rail|tray|table"),
        ([0.0, 0.0, 0.06], CarryFailure.NOT_HELD, "does not hold the tool"),
    ],
)
def test_a_tool_that_is_not_where_it_is_thought_fails_by_name(shift, failure, says):
    with RunningScene(SCENE) as running:
        known = Insertion.known(SCENE, DOWN, DEPTH, running.state.T_world_tool)
        seen = SeenTool(known.tool.p_grip + shift, known.tool.axis_world)
        with pytest.raises(CarryError, match=says) as caught:
            phases(running, replace(known, tool=seen))
    assert caught.value.failure is failure


@pytest.mark.long("machine")
def test_a_slippery_tool_is_said_to_slip_or_to_fall():
    with (
        RunningScene(replace(SCENE, friction=0.02)) as running,
        pytest.raises(CarryError) as caught,
    ):
        phases(running)
    assert caught.value.failure in (
        CarryFailure.SLIPPED,
        CarryFailure.DROPPED,
        CarryFailure.NOT_HELD,
    )


def test_clearance_knows_what_is_near_and_moves_nothing():
    with RunningScene(SCENE) as running:
        clearance = running.clearance()
        before = running.state
        assert clearance.free(SCENE.home)
        assert clearance.distance(SCENE.home) > 0.05
        into_table = np.radians([0.0, 115.0, 0.0, 0.0, 0.0, 0.0, 0.0])
        distance, first, second = clearance.nearest(into_table)
        assert distance < 0.0
        assert not clearance.free(into_table)
        assert "table" in (first, second) or "skin" in (first, second)
        assert "comes to" in clearance.blocked([SCENE.home, into_table])
        folded = SCENE.home.copy()
        folded[3] = -2.2
        assert not clearance.free(folded)
        assert clearance.blocked([folded]) == "a joint's limit"
        after = running.state
    assert after.time == before.time
    assert after.q == pytest.approx(before.q, abs=0.0)


def test_the_distance_is_that_of_all_pairs():
    fingers = np.zeros(6)
    clearance = SceneClearance(SCENE, fingers, SCENE.T_world_tool)
    rng = np.random.default_rng(7)
    for _ in range(6):
        q = rng.uniform(0.5 * SCENE.arm.lower, 0.5 * SCENE.arm.upper)
        least = clearance.distance(q)
        data, model = clearance._data, clearance._model
        every = [
            mujoco.mj_geomDistance(model, data, int(i), int(j), 1.0, None)
            for i, j in clearance._pairs
        ]
        assert least == pytest.approx(min(every), abs=1e-12)
        assert clearance.free(q, least - 1e-6)
        assert not clearance.free(q, least + 1e-6)


def test_a_held_tool_moves_with_the_hand():
    held = RigidTransform(
        np.array([[0.0, 0, 1], [0, 1, 0], [-1, 0, 0]]), np.array([-0.12, 0, 0.09])
    )
    bare = SceneClearance(SCENE, np.zeros(6), SCENE.T_world_tool)
    holding = SceneClearance(SCENE, np.zeros(6), SCENE.T_world_tool, held)
    down = np.radians([0.0, 50.0, 0.0, -80.0, 0.0, 50.0, 0.0])
    assert holding.distance(down) < bare.distance(down)


def test_what_is_not_open_or_does_not_fit_is_refused():
    with pytest.raises(SimulationError, match="call open"):
        _ = RunningScene(SCENE).state
    with pytest.raises(SimulationError, match="does not lie on the skin"):
        replace(SCENE, trocar=TrocarRing(np.array([0.5, 0.0, 0.0]), np.array([0.0, 0.0, 1.0])))
    with pytest.raises(SimulationError, match="friction is 0"):
        replace(SCENE, friction=0.0)
    with pytest.raises(SimulationError, match="home"):
        replace(SCENE, home=np.full(7, 3.0))


def test_the_trocar_is_open_and_the_skin_is_not():
    model = mujoco.MjModel.from_xml_string(write_scene(SCENE))
    data = mujoco.MjData(model)
    mujoco.mj_forward(model, data)
    geom = np.zeros(1, dtype=np.int32)
    down, only = np.array([0.0, 0.0, -1.0]), np.array([1, 0, 0, 0, 0, 0], dtype=np.uint8)
    for aside, open_ in ((0.0, True), (0.006, True), (0.010, False), (0.030, False)):
        start = SCENE.trocar.p_world + [aside, 0.0, 0.05]
        reach = mujoco.mj_ray(model, data, start, down, only, 1, -1, geom, None)
        assert (reach < 0.0 or reach > 0.1) is open_


def test_in_the_trocar_the_held_tool_is_no_matter_of_ring_and_skin():
    place = RigidTransform(np.eye(3), SCENE.trocar.p_world)
    q = SCENE.home
    hand = SCENE.arm.tool_pose(forward(SCENE.arm, q))
    through = hand.inverse() @ place @ RigidTransform.from_translation([0.004, 0.0, -0.2])
    outside, inside = (
        SceneClearance(SCENE, np.zeros(6), SCENE.T_world_tool, through, in_trocar)
        for in_trocar in (False, True)
    )
    assert outside.nearest(q)[0] < 0.0
    assert "trocar" in outside.nearest(q)[1:]
    assert inside.distance(q) > 0.0
