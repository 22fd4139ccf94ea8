"""The whole simulated tick, device and all, in virtual time: trainee, robot, effects, guidance."""

import numpy as np
import pytest
from virtual_fixture import VirtualFixture

from app.core import state_vector as sv
from app.core.arrays import FloatArray, unit
from app.device.control.table import machine_stages
from app.device.links.simulated import simulated_link
from app.mechanisms.profile import load_profile
from app.simulation.consumers import Consumer, DevicePort
from app.simulation.plan import Stage, compile
from app.simulation.plant import initial_plant, plant_stage
from app.simulation.scene import EffectRequest, Scene
from app.simulation.trainee import ScriptPhase, trainee_stage

PROFILE = load_profile("icube")
AXIS = unit(np.array([0.25, -0.15, -0.9]))
DEPTH = 0.08
FRAME = 33  # ticks between camera fixes
START = 10.0  # [s]; the loop's clock never stands at zero


def table(skill: str, seed: int) -> list[Stage]:
    effects = tuple(EffectRequest(n) for n in ("lateral_tissue", "shaft_friction", "breathing"))
    port = DevicePort(PROFILE.name, frozenset(a.value for a in PROFILE.renders), simulated=True)
    plan = compile(
        Scene(effects=effects),
        port,
        views=(Consumer("view target_motion shows it", ("target_shift_x",)),),
    )
    link = simulated_link(PROFILE, [plant_stage(PROFILE)])
    stages = machine_stages(PROFILE, [VirtualFixture.of(PROFILE).stage()], plan.stages(), link)
    return [
        trainee_stage(AXIS, DEPTH, skill, seed),
        *[(s.name, s.function, s.parameters) for s in stages],
    ]


def begin(assistance: float) -> FloatArray:
    state = sv.empty_state()
    start = initial_plant(PROFILE, (0.0, 0.0, -1.0), -0.015)
    for name, value in start.items():
        state[sv.INDEX[name]] = value
    state[sv.PATH] = AXIS
    state[sv.HOMED], state[sv.FORCE_CAP] = 1.0, PROFILE.limits.hand_force
    state[sv.ASSISTANCE], state[sv.ENABLED], state[sv.DT] = assistance, 1.0, 1e-3
    return state


def tick(stages: list[Stage], state: FloatArray, k: int) -> None:
    state[sv.TIME] = state[sv.HEARTBEAT] = START + 1e-3 * k
    state[sv.TICK] = k
    if k % FRAME == 0:  # the cameras see the marker
        state[sv.TRACKED_DEPTH], state[sv.TRACKED_TIME] = state[sv.PLANT_DEPTH], state[sv.TIME]
    for _, function, parameters in stages:
        function(state, parameters)


def attempt(skill: str, seed: int, assistance: float) -> FloatArray:
    """Rows of the state at every 10th tick until the trainee is done, shape (n, SLOTS)."""
    stages, state, rows = table(skill, seed), begin(assistance), []
    for k in range(40_000):
        tick(stages, state, k)
        if k % 10 == 0:
            rows.append(state.copy())
        if state[sv.TRAINEE_PHASE] == ScriptPhase.DONE:
            break
    return np.array(rows)


def miss(rows: FloatArray) -> tuple[float, float]:
    """Distance of the true tip from the target: across the path and along it [m]."""
    last = rows[-1]
    tip = PROFILE.fulcrum + last[sv.PLANT_DEPTH] * last[sv.AXIS]
    error = tip - PROFILE.fulcrum - DEPTH * AXIS
    along = float(error @ AXIS)
    return float(np.linalg.norm(error - along * AXIS)), along


@pytest.fixture(scope="module")
def guided_expert() -> FloatArray:
    return attempt("expert", 1, 1.0)


def test_the_guided_expert_reaches_the_target_within_tolerance(guided_expert: FloatArray) -> None:
    lateral, along = miss(guided_expert)
    assert lateral < 1.0e-3
    assert abs(along) < 1.5e-3  # the hand's spring gives by the friction at the end
    assert guided_expert[-1, sv.FAULT] == 0.0


@pytest.mark.long("statistics")
def test_guidance_brings_the_novice_nearer() -> None:
    assert miss(attempt("novice", 1, 1.0))[0] < 0.8 * miss(attempt("novice", 1, 0.0))[0]


@pytest.mark.long("machine")
def test_a_run_is_the_same_twice(guided_expert: FloatArray) -> None:
    np.testing.assert_array_equal(attempt("expert", 1, 1.0), guided_expert)


def test_nothing_ever_is_not_a_number_or_beyond_the_limits(guided_expert: FloatArray) -> None:
    assert np.isfinite(guided_expert).all()
    felt = np.linalg.norm(guided_expert[:, sv.FELT], axis=1)
    assert felt.max() <= PROFILE.limits.hand_force * 1.01
    torques = guided_expert[:, sv.TORQUE]
    assert np.abs(torques).max() <= PROFILE.limits.joint_torque * (1.0 + 1e-12)


def test_the_hand_feels_the_friction_of_the_shaft(guided_expert: FloatArray) -> None:
    inserting = guided_expert[:, sv.TRAINEE_PHASE] == ScriptPhase.INSERT
    deep = inserting & (guided_expert[:, sv.PLANT_DEPTH] > 0.06)
    assert guided_expert[deep, sv.AXIAL_FORCE].max() > 0.5
    assert guided_expert[deep, sv.PUSH].max() > 0.5


def test_the_target_breathes(guided_expert: FloatArray) -> None:
    shift = guided_expert[:, sv.TARGET_SHIFT]
    assert np.linalg.norm(shift, axis=1).max() == pytest.approx(0.0125, abs=5e-4)


def test_a_needle_that_is_let_go_deep_in_tissue_comes_to_rest() -> None:
    """The whole loop, encoder, tissue and guidance included, gives out no energy for ever."""
    stages, state = table("expert", 1)[1:], begin(1.0)
    state[sv.HAND_X], state[sv.HAND_Y], state[sv.HAND_HOLDS] = AXIS[0] + 0.03, AXIS[1], 1.0
    state[sv.HAND_DEPTH] = 0.08
    for k in range(3000):
        tick(stages, state, k)
    state[sv.HAND_HOLDS] = 0.0
    speeds = np.empty(4000)
    for k in range(len(speeds)):
        tick(stages, state, 3000 + k)
        speeds[k] = np.hypot(state[sv.PLANT_QD_LEFT], state[sv.PLANT_QD_RIGHT])
    assert state[sv.FAULT] == 0.0
    assert speeds[-1000:].max() < 0.2 * speeds.max()


def tilted_by_hand(joint: str) -> FloatArray:
    """Rows of every tick of a hand that tilts the needle by 0.1 rad in a second, then rests."""
    scene = Scene(effects=(EffectRequest("ball_joint"),) if joint else (), joint=joint)
    plan = compile(scene, DevicePort(PROFILE.name, simulated=True))
    link = simulated_link(PROFILE, [plant_stage(PROFILE)])
    stages = [*machine_stages(PROFILE, [], plan.stages(), link)]
    state, rows = begin(0.0), []
    state[sv.HAND_HOLDS], state[sv.HAND_DEPTH] = 1.0, -0.015
    for k in range(2500):
        state[sv.HAND_X] = 1e-4 * min(max(k - 500, 0), 1000)
        tick(stages, state, k)
        rows.append(state.copy())
    return np.array(rows)


def test_a_hand_feels_the_friction_of_the_printed_ball_joints_and_it_rests_calmly() -> None:
    free, held = tilted_by_hand(""), tilted_by_hand("old")
    moving, resting = slice(1000, 1450), slice(2200, 2500)
    more = np.mean(held[moving, sv.PULL_X]) - np.mean(free[moving, sv.PULL_X])
    level = 2.0 * 0.4 * 5.0 * 9.2e-3 / np.mean(held[moving, sv.L_OUT])
    assert abs(more) == pytest.approx(level, rel=0.2)
    # The motors carry it: as a torque of the joints, which no guard or limit takes away.
    assert np.abs(held[moving, sv.TORQUE]).max() > 0.5 * level * 0.09
    assert (held[moving, sv.LIMIT_SCALE] == 1.0).all()
    # No limit cycle on the encoders' counts: at rest, as without it.
    assert np.abs(held[resting, sv.PLANT_QD]).max() <= max(
        2.0 * np.abs(free[resting, sv.PLANT_QD]).max(), 0.01
    )
