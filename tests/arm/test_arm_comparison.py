"""The arm in the table of machines: its numbers against differences and Pinocchio."""

import numpy as np
import pytest

from app.arm.comparisons.arm import ArmInTrocar, arm_stands
from app.arm.mechanics import forward, published_arm
from app.arm.motion.errors import FulcrumError
from app.arm.motion.pivot import LEAST_DEXTERITY
from app.arm.studies.references.programs import PinocchioArm
from app.core.rotation import rotation_exp
from app.mechanisms.errors import MechanismError, NoGripError, UnreachableError
from app.studies import machines
from app.studies.machines import DEPTH, L_OUT, across, ring

NAMES = ["pantograph (icube)", "tensegrity (paper)", "arm through a trocar (iiwa14)"]
HELD = ArmInTrocar.standing(L_OUT, DEPTH)
ARM = HELD.pivot.arm
DIRECTIONS = [ring(np.deg2rad(tilt))[k] for tilt, k in ((0, 0), (20, 7), (39, 15), (60, 22))]
POSTURES = [HELD.posture(d).q for d in DIRECTIONS]
GRAVITY = np.array([0.0, 0.0, -9.80665])


@pytest.mark.long("machine")
def test_it_is_the_third_machine_and_asked_what_all_are():
    found = {m.name: machines.at_tilt(m, np.deg2rad(20.0)) for m in machines.machines()}
    assert list(found) == NAMES
    first, second, third = found.values()
    assert third["reached"] == 1.0
    assert first["resolution"] < third["resolution"] < second["resolution"]
    assert third["force"] > second["force"] > first["force"]


@pytest.mark.long("statistics")
def test_it_is_held_to_the_trocars_tilt_by_every_turn():
    assert machines.by_turn(machines.machines()[2]).tolist() == [60.0] * 24


def test_the_arm_holds_the_shaft_in_the_fulcrum_at_the_hub_and_depth_of_all_machines():
    for d, q in zip(DIRECTIONS, POSTURES, strict=True):
        state = HELD.pivot.state(q)
        assert np.abs(state.axis_world - d).max() < 1e-12
        assert state.depth == pytest.approx(DEPTH, abs=1e-12)
        assert state.off < 1e-12
        assert ARM.allows(q)
        hub = ARM.tool_pose(forward(ARM, q)).translation
        assert np.linalg.norm(hub - HELD.pivot.p_world) == pytest.approx(L_OUT, abs=1e-12)


def test_it_stands_where_the_scene_has_it_and_grips_where_the_fingers_meet():
    scene = HELD.scene
    assert (ARM.T_world_base.matrix() == scene.arm.T_world_base.matrix()).all()
    above_hand = ARM.T_flange_tool.translation - scene.arm.T_flange_tool.translation
    assert above_hand[2] == pytest.approx(0.0908, abs=1e-4)
    assert np.abs(above_hand[:2]).max() == 0.0


@pytest.mark.parametrize("point", ["tip", "hub"])
def test_the_jacobians_are_the_derivatives_of_the_places(point):
    def place(q):
        if point == "tip":
            return HELD.pivot.tool.needle_pose(ARM, q).translation
        return ARM.tool_pose(forward(ARM, q)).translation

    given = HELD.pivot.tip_jacobian if point == "tip" else HELD.hub_jacobian
    for q in POSTURES:
        columns = [(place(q + h) - place(q - h)) / 2e-6 for h in 1e-6 * np.eye(7)]
        assert np.abs(np.stack(columns, axis=1) - given(q)).max() < 1e-9


def test_turning_is_how_the_shaft_turns_when_the_joints_keep_it_in_the_fulcrum():
    for d, q in zip(DIRECTIONS, POSTURES, strict=True):
        by_joints = HELD.turning(q)
        for way in across(d)[::6]:
            rates = np.linalg.pinv(by_joints) @ way
            there = HELD.pivot.state(q + 1e-6 * rates)
            assert np.abs((there.axis_world - d) / 1e-6 - way).max() < 1e-5
            assert there.off < 1e-10
            assert np.abs(by_joints @ rates - way).max() < 1e-12


def loaded():
    """Pinocchio's arm with hand and tool as one mass at the gripped point."""
    pin = pytest.importorskip("pinocchio")
    other = PinocchioArm(published_arm())
    flange = published_arm().flange.transform @ ARM.T_flange_tool.translation
    carried = HELD.scene.hand_mass + HELD.scene.tool.mass
    other.model.appendBodyToJoint(
        7, pin.Inertia(carried, flange, np.zeros((3, 3))), pin.SE3.Identity()
    )
    other.model.gravity.linear = ARM.T_world_base.rotation.T @ GRAVITY
    return pin, other.model, other.model.createData()


def test_the_torques_of_its_weight_are_those_of_pinocchio():
    pin, model, data = loaded()
    for q in [*POSTURES, *np.random.default_rng(3).uniform(ARM.lower, ARM.upper, (20, 7))]:
        theirs = pin.computeGeneralizedGravity(model, data, q)
        assert np.abs(HELD.weight(q) - theirs).max() < 1e-12


def test_the_torques_of_its_weight_are_the_slope_of_its_energy():
    published = published_arm()

    def energy(q):
        total, here = 0.0, np.eye(4)
        for joint, angle in zip(published.joints, q, strict=True):
            turn = np.eye(4)
            turn[:3, :3] = rotation_exp([0.0, 0.0, angle])
            here = here @ joint.transform.matrix() @ turn
            total -= joint.mass * GRAVITY @ (here @ [*joint.centre, 1.0])[:3]
        return total

    for q in POSTURES:
        slope = [(energy(q + h) - energy(q - h)) / 2e-5 for h in 1e-5 * np.eye(7)]
        assert np.abs(slope - published.weight_torques(q, GRAVITY)).max() < 1e-8


@pytest.mark.parametrize("point", ["tip", "hub"])
def test_the_largest_sideways_force_brings_one_joint_to_its_torque_limit_and_none_beyond(point):
    pin, model, data = loaded()
    for d, q in zip(DIRECTIONS, POSTURES, strict=True):
        at = HELD.pivot.tool.needle_pose(ARM, q).translation
        moved = HELD.pivot.tip_jacobian(q)
        if point == "hub":
            at, moved = ARM.tool_pose(forward(ARM, q)).translation, HELD.hub_jacobian(q)
        force, joint = HELD.sideways(q, moved, across(d))
        used = []
        for way in across(d):
            # what the arm presses with comes back on its last link
            pressed = ARM.T_world_base.rotation.T @ (-force * way)
            where = ARM.T_world_base.inverse() @ at
            pin.framesForwardKinematics(model, data, q)
            wrench = pin.Force(pressed, np.cross(where, pressed))
            outside = [pin.Force.Zero()] * 7 + [data.oMi[7].actInv(wrench)]
            torques = pin.rnea(model, data, q, np.zeros(7), np.zeros(7), outside)
            used.append(np.abs(torques) / ARM.torque)
        assert np.max(used) == pytest.approx(1.0, abs=1e-9)
        assert np.max(used, axis=0).argmax() == joint


@pytest.mark.long("machine")
def test_the_tip_repeats_as_the_flange_does_seen_through_the_jacobian():
    rng = np.random.default_rng(1)
    q = POSTURES[0]
    joints = q + 1e-6 * rng.standard_normal((4000, 7))
    flange = [(forward(ARM, one) @ ARM.T_wrist_flange).translation for one in joints]
    tip = [HELD.pivot.tool.needle_pose(ARM, one).translation for one in joints]
    spread = [np.sqrt(np.var(places, axis=0).sum()) for places in (flange, tip)]
    assert HELD.repeated(q) == pytest.approx(0.15e-3 * spread[1] / spread[0], rel=0.03)


def test_published_torques_and_repeatability_are_those_of_the_maker():
    assert ARM.torque.tolist() == [320.0, 320.0, 176.0, 176.0, 110.0, 40.0, 40.0]
    assert ARM.repeatability == 0.15e-3


@pytest.mark.long("machine")
def test_a_base_that_stands_further_away_holds_with_less_room_until_it_does_not_hold():
    rows = arm_stands((0.9, 1.3)).rows
    scenes, far, out = rows
    assert scenes[0].endswith("the scene's")
    assert scenes[1] == far[1] == 100.0
    assert far[2] < scenes[2]
    assert LEAST_DEXTERITY < far[3] < scenes[3]
    assert out[1] == 0.0
    assert out[2:] == ("-", "-")


def test_beyond_the_trocars_tilt_or_with_the_grip_at_the_skin_it_holds_nothing():
    with pytest.raises(UnreachableError, match="it grazes beyond 60°"):
        HELD.posture(ring(np.deg2rad(61.0))[0])
    with pytest.raises(FulcrumError, match="it grazes beyond 60°"):
        HELD.pivot.held(ring(np.deg2rad(61.0))[0], DEPTH)
    with pytest.raises(NoGripError, match="grip the tool further back"):
        HELD.pivot.held(DIRECTIONS[0], L_OUT + DEPTH)
    with pytest.raises(MechanismError, match="nearest that they reach is"):
        ArmInTrocar.standing(L_OUT, DEPTH, 1.5).posture(DIRECTIONS[0])
