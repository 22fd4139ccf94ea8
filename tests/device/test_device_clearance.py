"""What the device is cleared for: homing, the force cap, faults that stay, growth of the force."""

import numpy as np
import pytest
from device.device_rig import HAND_LIMIT, PROFILE, Rig

from app.core import state_vector as sv
from app.device.control import Fault
from app.device.control.safety import Safety


@pytest.fixture
def rig():
    rig = Rig()
    with rig.loop:
        yield rig


def torques(rig, ticks):
    return rig.loop.rows()[-ticks:, [sv.TORQUE_LEFT, sv.TORQUE_RIGHT]]


def test_without_homing_there_is_no_force_and_the_fault_says_so(rig):
    rig.write(homed=0.0)
    rig.arm()
    assert (rig.felt, rig.loop.latest().fault) == (0.0, Fault.NOT_HOMED)
    rig.write(homed=1.0)
    rig.step(1100)
    assert rig.felt == pytest.approx(HAND_LIMIT)


def test_an_unhomed_device_is_no_fault_while_disarmed(rig):
    rig.write(homed=0.0)
    rig.step(10)
    assert rig.loop.latest().fault is Fault.NONE


def test_a_sign_check_lets_only_a_small_force_pass(rig):
    rig.write(homed=0.5)
    rig.arm()
    state = rig.loop.latest()
    assert state.fault is Fault.NONE
    assert 0.0 < rig.felt <= 0.3 + 1e-12
    assert np.abs(state.torque).max() <= 0.03 + 1e-12
    assert np.isclose(rig.felt, 0.3) or np.isclose(np.abs(state.torque).max(), 0.03)


@pytest.mark.parametrize("cleared", [0.0, 0.2, 1.0, 50.0, -1.0])
def test_the_force_never_exceeds_what_the_device_is_cleared_for(rig, cleared):
    rig.write(force_cap=cleared)
    rig.arm()
    assert rig.felt == pytest.approx(min(max(cleared, 0.0), HAND_LIMIT))


def test_a_loop_that_nobody_cleared_gives_no_force():
    rig = Rig()
    rig.write(homed=0.0, force_cap=0.0)
    with rig.loop:
        rig.arm()
        assert rig.sent[3] == 0.0


@pytest.mark.parametrize(
    ("slot", "value", "fault"),
    [
        (sv.LINK_STATUS, 2.0, Fault.LINK_LOST),
        (sv.LINK_STATUS, np.nan, Fault.LINK_LOST),
        (sv.BOARD_ERROR, 5.0, Fault.BOARD_ERROR),
        (sv.LET_GO, 1.0, Fault.LET_GO),
    ],
)
def test_a_lost_link_a_board_error_and_letting_go_stay_until_disarmed(rig, slot, value, fault):
    rig.arm()
    rig.loop._state[slot] = value
    rig.step(1)
    assert (rig.felt, rig.loop.latest().fault) == (0.0, fault)
    rig.loop._state[slot] = 0.0
    rig.step(1500)
    assert (rig.felt, rig.loop.latest().fault) == (0.0, fault)
    rig.write(enabled=0.0)
    rig.step(1)
    assert rig.loop.latest().fault is Fault.NONE
    rig.write(enabled=1.0)
    rig.step(1100)
    assert rig.felt == pytest.approx(HAND_LIMIT)


def test_a_lost_link_is_shown_while_disarmed_and_goes_with_its_cause(rig):
    rig.loop._state[sv.LINK_STATUS] = 1.0
    rig.step(1)
    assert rig.loop.latest().fault is Fault.LINK_LOST
    rig.loop._state[sv.LINK_STATUS] = 0.0
    rig.step(1)
    assert rig.loop.latest().fault is Fault.NONE


def test_a_force_that_appears_at_once_grows_at_the_slew_limit_and_goes_at_once():
    rig = Rig(laws=[])
    step = 1e-3 * Safety.of(PROFILE).slew
    with rig.loop:
        rig.arm()
        rig.force[:] = 4.0, 2.0, 0.0
        rig.step(60)
        grown = torques(rig, 61)
        rig.force[:] = 0.0
        rig.step(1)
        assert rig.felt == 0.0
    assert np.diff(np.abs(grown), axis=0).max() <= step * (1.0 + 1e-9)
    assert np.abs(grown[-1]).max() > 5.0 * step
    assert np.abs(np.diff(grown[-20:], axis=0)).max() < 1e-12, "arrived"


def test_a_force_that_turns_round_passes_zero_and_never_jumps_across():
    rig = Rig(laws=[], force=(4.0, 0.0, 0.0))
    step = 1e-3 * Safety.of(PROFILE).slew
    with rig.loop:
        rig.arm()
        rig.force[0] = -4.0
        rig.step(60)
        sent = torques(rig, 61)
    assert np.abs(sent[1]).max() <= step * (1.0 + 1e-9)
    assert sent[-1] == pytest.approx(-sent[0])


def test_beyond_the_tilt_limit_nothing_pushes_further_out():
    out = np.array([np.cos(0.5), np.sin(0.5), 0.0])
    felt = {}
    for tilt in (PROFILE.tilt_limit - 0.001, PROFILE.tilt_limit + 0.05):
        for sign in (1.0, -1.0):
            rig = Rig(tilt=tilt, azimuth=0.5, laws=[], force=tuple(sign * 2.0 * out))
            with rig.loop:
                rig.arm()
                felt[tilt > PROFILE.tilt_limit, sign] = rig.felt
    # The hub moves against the tool: a force outwards at the hub tilts the needle back.
    assert felt[False, 1.0] == pytest.approx(felt[False, -1.0])
    assert felt[True, -1.0] < 1e-9
    assert felt[True, 1.0] > 1.0
