"""Energy at the device's own port: never more than declared, whatever hand, dial and delay do."""

import numpy as np
import pytest
from hard.port_rig import MOTIONS, PROFILE, RISE, PortRig

from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.core.compiled import stage
from app.device.control import Loop, Table, machine_stages
from app.device.control.passivity import PassivityGuard
from app.device.control.safety import _AT as SAFETY
from app.device.links.simulated import simulated_link
from app.simulation.plant import initial_plant, plant_stage

ROUNDING = 1e-9  # J


def wild_run(rig: PortRig, motions: int, seed: int) -> None:
    """Step until the hand has made so many motions, while everything else changes too."""
    rng = np.random.default_rng(seed)
    depth = 0.0
    with rig.loop:
        rig.loop.inbox.write(enabled=1.0)
        while rig.hand[MOTIONS] < motions:
            choice = rng.integers(6)
            if choice == 0:
                rig.loop.inbox.write(assistance=rng.uniform(-1.0, 1.0))
            elif choice == 1:
                tilt, azimuth = rng.uniform(0.0, 0.4), rng.uniform(-3.1, 3.1)
                x, y = np.sin(tilt) * np.cos(azimuth), np.sin(tilt) * np.sin(azimuth)
                rig.loop.inbox.write(path_x=x, path_y=y, path_z=-np.cos(tilt))
            elif choice == 2:
                depth = rng.uniform(-0.02, 0.12)
            elif choice == 3:
                rig.loop.inbox.write(enabled=float(rng.uniform() < 0.9))
            rig.step(int(rng.integers(20, 300)), depth)
        rows = rig.loop.rows()
    assert np.isfinite(rows).all()


@pytest.mark.parametrize("counts", [True, False])
@pytest.mark.parametrize("requests", [{"fixture": {}}, {"impedance": {}, "compensation": {}}])
def test_in_a_hundred_thousand_wild_motions_no_window_lets_out_more_than_declared(requests, counts):
    """Beside what the joints' own friction takes, where a law makes up for it."""
    rig = PortRig(seed=3, requests=requests, counts=counts)
    wild_run(rig, 30_000, 4)
    assert rig.hand[RISE] <= rig.bound + ROUNDING
    assert rig.hand[RISE] > 0.01, "the hand did get energy out"


@pytest.mark.long("statistics")
def test_a_small_tank_holds_as_well_and_without_the_guard_it_would_not():
    small = 0.05
    guarded, free = PortRig(seed=5, bound=small), PortRig(seed=5, guarded=False)
    wild_run(guarded, 10_000, 6)
    wild_run(free, 10_000, 6)
    assert guarded.hand[RISE] <= small + ROUNDING
    assert free.hand[RISE] > 4.0 * small


@pytest.mark.long("statistics")
@pytest.mark.parametrize("bound", [None, 0.05])
def test_over_a_wire_that_brings_the_angles_a_tick_late_no_more_gets_out(bound):
    rig = PortRig(seed=3, bound=bound, late=True)
    wild_run(rig, 20_000, 4)
    assert rig.hand[RISE] <= rig.bound + ROUNDING
    assert rig.hand[RISE] > 0.2 * rig.bound, "the hand did get energy out"


def test_no_declared_energy_is_no_force():
    rig = PortRig(bound=0.0)
    with rig.loop:
        rig.loop.inbox.write(enabled=1.0)
        rig.step(1500, 0.05)
        rows = rig.loop.rows()
    assert not rows[:, [sv.TORQUE_LEFT, sv.TORQUE_RIGHT]].any()
    assert rig.hand[RISE] <= 0.0


@stage
def late_spring(state, p):
    """A spring at each joint that sees the angles of `p[1]` ticks ago; it says what it stores."""
    size = int(p[1]) + 1
    at = 4 + 2 * (int(state[sv.TICK]) % size)
    first = state[sv.TICK] <= size
    p[at], p[at + 1] = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    old = 4 + 2 * ((int(state[sv.TICK]) + 1) % size)
    left = (state[sv.Q_LEFT] if first else p[old]) - p[2]
    right = (state[sv.Q_RIGHT] if first else p[old + 1]) - p[3]
    state[sv.JOINT_LEFT] -= p[0] * left
    state[sv.JOINT_RIGHT] -= p[0] * right
    now = (state[sv.Q_LEFT] - p[2]) ** 2 + (state[sv.Q_RIGHT] - p[3]) ** 2
    state[sv.POTENTIAL] += 0.5 * p[0] * now


def swing(stiffness: float, delay: int, guarded: bool, ticks: int = 3000):
    """Rows of a robot that nobody holds, let go 0.02 rad beside a late spring's rest."""
    profile = PROFILE.model_copy(
        update={"mounting": PROFILE.mounting.model_copy(update={"gravity": (0.0, 0.0, 0.0)})}
    )
    start = initial_plant(profile, (0.0, 0.0, -1.0), 0.0)
    rest = start["plant_q_left"] + 0.02, start["plant_q_right"] + 0.01
    memory = np.array([stiffness, delay, *rest, *np.zeros(2 * delay + 2)])
    bound = 0.5 * stiffness * (0.02**2 + 0.01**2)
    table = machine_stages(
        profile,
        [("late_spring", late_spring, memory)],
        [],
        simulated_link(profile, [plant_stage(profile, depth=0.0)]),
        energy_bound=bound if guarded else None,
    )
    clock = VirtualClock(10.0)
    stages = [s for s in table.compute if s.name != "governor"]
    safety = stages[-1].parameters
    safety[SAFETY.arming] = 1e-3  # no arming ramp: let go under full force
    with Loop(Table.of(stages, table.write), profile.rate_hz, clock, initial=start) as loop:
        loop.inbox.write(homed=1.0, force_cap=5.0, enabled=1.0)
        for _ in range(ticks // 100):
            now = clock.now()
            loop.inbox.write(heartbeat=now, tracked_depth=0.0, tracked_time=now)
            loop.step(100)
        rows = loop.rows()
    away = np.hypot(rows[:, sv.PLANT_Q_LEFT] - rest[0], rows[:, sv.PLANT_Q_RIGHT] - rest[1])
    return away, rows, bound


@pytest.mark.parametrize(("stiffness", "delay"), [(20.0, 2), (40.0, 1), (40.0, 2), (60.0, 0)])
def test_a_spring_too_stiff_for_its_delay_is_unstable_without_and_bounded_with_the_guard(
    stiffness, delay
):
    free, _, _ = swing(stiffness, delay, guarded=False)
    held, rows, bound = swing(stiffness, delay, guarded=True)
    assert free[-500:].max() > 1.5 * free[:50].max(), "it grows"
    assert held.max() <= 1.2 * free[:50].max()
    assert held[-500:].max() < 0.5 * held[:50].max(), "it dies away"
    assert rows[:, sv.ENERGY_OUT].max() <= bound + ROUNDING
    assert rows[:, sv.ENERGY_TANK].min() >= -ROUNDING
    assert not rows[:, sv.FAULT].any()


@pytest.mark.parametrize("declared", [1.0, 0.0, np.nan])
def test_what_the_joints_friction_takes_passes_where_it_is_declared_and_only_there(
    declared,
):
    """Motors that make up for friction, minute after minute."""
    _, guard, memory = PassivityGuard.of(PROFILE, 0.2).stage()
    state, torque, speed, dt = sv.empty_state(), 0.003, 1.0, 1e-3
    state[sv.DT], state[sv.ENABLED] = dt, 1.0
    state[sv.LIMIT_SCALE] = state[sv.LET_GO_SCALE] = 1.0
    for tick in range(100_000):
        state[sv.Q_LEFT], state[sv.QD_LEFT] = tick * speed * dt, speed
        state[sv.Q_TIME] = state[sv.TIME] = tick * dt
        state[[sv.TORQUE_LEFT, sv.TORQUE_RIGHT]] = torque, 0.0
        state[sv.FRICTION_WORK] = declared * torque * speed * dt
        guard(state, memory)
        state[[sv.SENT_LEFT, sv.SENT_RIGHT]] = state[[sv.TORQUE_LEFT, sv.TORQUE_RIGHT]]
    assert state[sv.ENERGY_TANK] > 0.198
    if declared == 1.0:
        assert state[sv.TORQUE_LEFT] == pytest.approx(torque, rel=1e-6)
    else:
        assert abs(state[sv.TORQUE_LEFT]) < 0.1 * torque
