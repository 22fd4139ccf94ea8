"""The whole tick, governor and guard included, at its worst: time, rest, wrap, faults."""

from time import perf_counter

import numpy as np
import pytest
from hard.let_go_rig import LetGoRig, direction
from hard.port_rig import PortRig

from app.core import state_vector as sv
from app.device.control import Fault
from app.mechanisms.profile import load_profile

PROFILE = load_profile("icube")
LIMIT = PROFILE.limits.hand_force
SENT = [sv.TORQUE_LEFT, sv.TORQUE_RIGHT]


def held(stiffness: float = 1.0) -> LetGoRig:
    """A rig under force, held still, in tissue."""
    rig = LetGoRig(PROFILE, direction(0.3, 1.0), direction(0.1, 1.0), 0.06, 1.0, stiffness, True)
    rig.loop.open()
    rig.arm()
    return rig


def assert_bounded(rows) -> None:
    assert np.isfinite(rows).all()
    assert np.linalg.norm(rows[:, sv.FELT], axis=1).max() <= LIMIT + 1e-9
    assert np.abs(rows[:, SENT]).max() <= PROFILE.limits.joint_torque + 1e-12


def slots(fault: Fault) -> dict[int, float]:
    """What makes a fault, written between two ticks."""
    return {
        Fault.LINK_LOST: {sv.LINK_STATUS: 2.0},
        Fault.BOARD_ERROR: {sv.BOARD_ERROR: 3.0},
        Fault.LET_GO: {sv.LET_GO: 1.0},
    }[fault]


INPUTS = {
    Fault.INPUT_NOT_FINITE: {"path_x": np.nan},
    Fault.NOT_HOMED: {"homed": 0.0},
    Fault.HEARTBEAT_LOST: {"heartbeat": 1.0},
}


@pytest.mark.promise("README.md: zero force on any fault")
@pytest.mark.promise("docs/troubleshooting.md: With any fault they are zero")
@pytest.mark.parametrize("fault", [*INPUTS, Fault.LINK_LOST, Fault.BOARD_ERROR, Fault.LET_GO])
def test_every_fault_is_zero_force_in_its_tick_and_after_closing(fault):
    rig = held()
    assert rig.loop.latest().torque.any()
    if fault in INPUTS:
        rig.loop.inbox.write(**INPUTS[fault])
    else:
        for slot, value in slots(fault).items():
            rig.loop._state[slot] = value
    rig.loop.step(1)
    state = rig.loop.latest()
    assert (state.fault, state.torque.any()) == (fault, False)
    rig.loop.close()
    assert not rig.loop.latest().torque.any()


@pytest.mark.parametrize("late", [0.005, 0.020, 0.100])
def test_a_late_tick_is_no_letting_go_and_the_force_comes_back_as_fast_as_it_may_grow(late):
    """Nothing is known of the time missed, and the board may have stopped: it starts from below."""
    rig = held()
    before = rig.loop.latest().torque.copy()
    for _ in range(5):
        rig.clock.sleep(late)
        rig.step(100)
    rows = rig.loop.rows()[-500:]
    rig.loop.close()
    assert_bounded(rows)
    assert not rows[:, sv.LET_GO].any()
    grown = np.diff(np.abs(rows[:, SENT]), axis=0).max()
    assert grown <= 1e-3 * PROFILE.limits.joint_torque / 0.020 * (1.0 + 1e-9)
    assert np.abs(rows[-1, SENT]).max() == pytest.approx(np.abs(before).max(), rel=0.05)


def test_a_clock_that_stands_still_keeps_the_force_bounded_and_spends_nothing():
    rig = held()
    now = rig.clock.now()
    for _ in range(200):
        rig.loop._tick(now - 1e-3, 1)
    rows = rig.loop.rows()[-200:]
    rig.loop.close()
    assert_bounded(rows)
    assert np.ptp(rows[:, sv.TIME]) == pytest.approx(0.0, abs=1e-9)


def test_a_turn_of_the_encoders_is_no_motion_and_no_force_from_it():
    rig = PortRig(bound=0.5)
    rig.hand[1:3] = 0.0, 1e9  # a hand at rest
    with rig.loop:
        rig.loop.inbox.write(enabled=1.0, path_x=0.2)
        for _ in range(13):
            rig.step(100, 0.05)
        assert rig.loop.latest().torque.any()
        rig.hand[3:7] += 2.0 * np.pi
        rig.step(300, 0.05)
        rows = rig.loop.rows()[-300:]
    assert_bounded(rows)
    assert abs(rows[-1, sv.ENERGY_OUT]) < 0.06
    assert rows[-1, sv.ENERGY_TANK] > 0.4


@pytest.mark.parametrize("stiffness", [10.0, 34.0])
def test_a_law_so_stiff_that_the_tick_is_unstable_stays_bounded_and_slow(stiffness):
    rig = held(stiffness)
    rig.step(1000)
    rows = rig.loop.rows()[-1000:]
    run = rig.run_away(1000)
    rig.loop.close()
    assert_bounded(rows)
    assert_bounded(run.rows)
    assert run.excess_speed <= PROFILE.let_go.speed


@pytest.mark.long("statistics")
def test_ten_minutes_of_rest_do_not_slow_the_tick():
    """Subnormal numbers would: decaying memories are snapped to zero."""
    rig = held()

    def cost(ticks: int) -> float:
        start = perf_counter()
        rig.step(ticks)
        return (perf_counter() - start) / ticks

    first = min(cost(2000) for _ in range(8))
    rig.loop.inbox.write(assistance=0.0)
    for _ in range(60):
        rig.loop.step(10_000)
    last = min(cost(2000) for _ in range(8))
    memories = np.concatenate([s.parameters for s in rig.loop.table])
    rig.loop.close()
    tiny = (memories != 0.0) & (np.abs(memories) < np.finfo(float).tiny)
    assert not tiny.any()
    assert not ((rig.loop._state != 0.0) & (np.abs(rig.loop._state) < 1e-300)).any()
    assert last < 3.0 * first  # 1.1 on a quiet machine; 17 and more with subnormal numbers
