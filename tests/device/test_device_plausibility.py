"""Readings that neither hand nor motors can have caused are missing ones; many of them a fault."""

from math import pi, radians

import numpy as np
import pytest
from device.wire_rig import PROFILES, MemoryRig

from app.core import state_vector as sv
from app.device.control.plausibility import Plausibility
from app.device.faults import Fault
from app.mechanisms.profile import load_profile

COUNT = 2.0 * pi / 20_000
START = np.array([radians(146.7), radians(33.3)])


class Encoders:
    """The stage alone, on readings that are given one by one."""

    def __init__(self, count=COUNT):
        self.state = sv.empty_state()
        self.state[sv.HOMED] = 1.0
        self.stage = Plausibility(count).stage()
        self.time = 10.0

    def read(self, angles, after=1e-3, stamp=None):
        """One tick; returns whether the reading was believed."""
        self.time += after
        self.state[sv.TIME] = self.time
        if angles is not None:
            self.state[sv.Q] = angles
            self.state[sv.Q_TIME] = self.time - 2e-4 if stamp is None else stamp
        before = self.state[sv.UNBELIEVED]
        self.stage.function(self.state, self.stage.parameters)
        return self.state[sv.UNBELIEVED] == before

    def settle(self, angles=START, ticks=20):
        for _ in range(ticks):
            assert self.read(angles)

    @property
    def fault(self):
        return Fault(int(self.state[sv.ENCODER_FAULT]))


def test_a_jump_of_2_to_the_16_counts_is_a_missing_reading_and_after_20_ms_a_wrap():
    encoders = Encoders()
    encoders.settle()
    stamp = encoders.state[sv.Q_TIME]
    jumped = START + (2**16 * COUNT + radians(0.25), 0.0)  # to 1326.6°
    for _ in range(20):
        assert not encoders.read(jumped)
        np.testing.assert_array_equal(encoders.state[sv.Q], START)
        assert encoders.state[sv.Q_TIME] == stamp
    assert encoders.fault is Fault.NONE
    encoders.read(jumped)
    assert encoders.fault is Fault.ENCODER_WRAPPED


@pytest.mark.parametrize("joint", [0, 1])
@pytest.mark.parametrize("jump_deg", [3.6, -3.6, 5.5, 50.0, -170.0])
def test_a_jump_of_3_6_degrees_that_stays_is_no_motion_however_near_it_is_by_then(joint, jump_deg):
    encoders = Encoders()
    encoders.settle()
    jumped = START.copy()
    jumped[joint] += radians(jump_deg)
    for _ in range(21):
        assert not encoders.read(jumped)
    assert encoders.fault is Fault.ENCODER_JUMPED


@pytest.mark.parametrize("bits", [8, 10, 12, 13, 14, 16, 18, 20, 24, 31])
def test_a_jump_by_a_power_of_two_counts_is_called_a_wrap(bits):
    encoders = Encoders()
    encoders.settle()
    for _ in range(30):
        encoders.read(START - (2.0**bits * COUNT, 0.0))
    assert encoders.fault is Fault.ENCODER_WRAPPED


@pytest.mark.parametrize("count", [2.0 * pi / 2000, 2.0 * pi / 4880, COUNT])
def test_a_jump_by_a_turn_is_called_a_wrap_whatever_the_encoder(count):
    encoders = Encoders(count)
    encoders.settle()
    for _ in range(30):
        encoders.read(START + (0.0, 2.0 * pi))
    assert encoders.fault is Fault.ENCODER_WRAPPED


def moved(time, speed_deg, amplitude_deg=60.0):
    """Joint angles of a swing whose fastest is `speed_deg` [°/ms], rounded to counts."""
    rate = speed_deg * 1e3 / amplitude_deg
    swing = radians(amplitude_deg) * np.array([np.sin(rate * time), np.cos(rate * time)])
    return np.round((START + swing) / COUNT) * COUNT


@pytest.mark.parametrize("speed", [0.3, 1.0, 2.0, 2.9, 3.0])
def test_swings_up_to_the_bound_are_believed_to_the_last_reading(speed):
    encoders = Encoders()
    for k in range(4_000):
        assert encoders.read(moved(1e-3 * k, speed)), k
    assert encoders.fault is Fault.NONE


@pytest.mark.parametrize("seed", range(4))
def test_a_swing_of_a_hand_is_believed_through_late_ticks_and_stalls_of_the_host(seed):
    # The fastest arm movements of people turn these joints by some 15 rad/s: 0.9° in a millisecond.
    rng = np.random.default_rng(seed)
    encoders, time = Encoders(), 0.0
    for k in range(4_000):
        late, often = [0.3, 1.0, 1.7, 5.0, 30.0, 200.0], [0.1, 0.7, 0.1, 0.06, 0.03, 0.01]
        after = 1e-3 * rng.choice(late, p=often)
        time += after
        assert encoders.read(moved(time, 0.9), after), k
        if k % 7 == 0:
            assert encoders.read(None)  # a tick without a reading changes nothing
    assert encoders.fault is Fault.NONE


@pytest.mark.parametrize("seed", range(4))
def test_single_wrong_readings_in_a_fast_swing_cost_nothing_but_themselves(seed):
    rng = np.random.default_rng(seed)
    encoders, missed = Encoders(), 0
    for k in range(4_000):
        angles = moved(1e-3 * k, 0.9)
        wrong = k > 10 and rng.random() < 0.02
        if wrong:
            angles = angles + radians(rng.choice([-1.0, 1.0]) * rng.uniform(4.5, 500.0))
        believed = encoders.read(angles)
        missed += believed == wrong
        assert encoders.fault is Fault.NONE
    assert missed <= 5  # a jump of 4.5° against the motion is told a reading late


def test_a_burst_of_19_ms_is_bridged_and_one_of_21_is_not():
    for length, fault in ((19, Fault.NONE), (21, Fault.ENCODER_JUMPED)):
        encoders = Encoders()
        encoders.settle()
        for k in range(length):
            encoders.read(START + radians(40.0 if k % 2 else -33.0))
        if fault is Fault.NONE:
            assert encoders.read(START)
        assert encoders.fault is fault


def test_every_second_reading_wrong_is_a_fault_in_the_end():
    encoders = Encoders()
    encoders.settle()
    for k in range(100):
        encoders.read(START + (radians(20.0) if k % 2 else 0.0))
    assert encoders.fault is Fault.ENCODER_JUMPED


def test_a_wrong_reading_before_a_stall_of_the_host_is_no_fault_after_it():
    encoders = Encoders()
    encoders.settle()
    assert not encoders.read(START + (2**16 * COUNT, 0.0))
    assert encoders.read(START + radians(60.0), after=0.2)
    assert encoders.fault is Fault.NONE


def test_a_first_reading_that_is_wrong_is_forgotten_at_once():
    encoders = Encoders()
    encoders.read(START + radians(700.0))
    encoders.settle(ticks=50)
    np.testing.assert_array_equal(encoders.state[sv.Q], START)


def test_the_fault_stays_until_homing_and_readings_pass_while_the_robot_is_not_homed():
    encoders = Encoders()
    encoders.settle()
    jumped = START + radians(90.0)
    for _ in range(30):
        encoders.read(jumped)
    for _ in range(100):
        encoders.read(START)  # back where it was, and armed anew: nobody knows its zero
        assert encoders.fault is Fault.ENCODER_JUMPED
    encoders.state[sv.HOMED] = 0.0
    encoders.read(jumped)
    np.testing.assert_array_equal(encoders.state[sv.Q], jumped)
    assert encoders.fault is Fault.ENCODER_JUMPED
    encoders.state[sv.HOMED] = 0.5
    encoders.read(jumped)
    assert encoders.fault is Fault.NONE


def test_stamps_that_go_back_give_no_room():
    encoders = Encoders()
    encoders.settle()
    assert not encoders.read(START + radians(10.0), stamp=encoders.time - 5.0)


# --- through the whole loop, from the bytes of a board --------------------------------------------
def counts(name, angle_deg):
    return round(angle_deg / 360.0 * load_profile(name).encoder.counts_per_turn)


@pytest.mark.parametrize("name", PROFILES)
@pytest.mark.parametrize(("counted", "fault"), [(2**16, 17), (None, 18)])
def test_a_board_whose_count_jumps_gets_no_torque_until_it_is_homed(name, counted, fault):
    rig = MemoryRig(name)
    with rig.loop:
        rig.arm()
        assert rig.torque > 0.0
        if counted == 2**16 and name == "haply-2diy":
            counted = load_profile(name).encoder.counts_per_turn  # more than two turns are refused
        jump = counts(name, 3.6) + 1 if counted is None else counted
        rig.link.faults.set("jump", jump)
        before = rig.loop.latest().q.copy()
        rig.step(19)
        np.testing.assert_allclose(rig.loop.latest().q, before, atol=radians(1.0))
        rig.step(10)
        assert (rig["fault"], rig.torque) == (fault, 0.0)
        rig.link.faults.set("jump", 0)
        rig.rearm()
        assert (rig["fault"], rig.torque) == (fault, 0.0)
        rig.loop.inbox.write(homed=0.0, enabled=0.0)
        rig.step(10)
        rig.arm()
        assert rig["fault"] == 0
        assert rig.torque > 0.0


@pytest.mark.parametrize("name", PROFILES)
@pytest.mark.parametrize(
    "faults",
    [{"flip": 0.02}, {"repeat": 0.3, "overtake": 0.3, "delay": 2.0}],
    ids=["bits", "order"],
)
def test_flipped_bits_or_answers_twice_late_and_out_of_order_give_no_impossible_pose(name, faults):
    rig = MemoryRig(name, seed=3)
    with rig.loop:
        rig.arm()
        for fault, value in faults.items():
            rig.link.faults.set(fault, value)
        for _ in range(200):
            rig.step(20)
            row = rig.loop.latest().row
            # As far as a joint could have turned since the answer before.
            assert np.abs(row[sv.Q] - row[sv.PLANT_Q]).max() < radians(3.1)
        assert "flip" not in faults or rig["unbelieved"] + rig["link_errors"] > 5
        assert rig["fault"] in (0, Fault.LET_GO)  # nobody holds these arms: a twitch may look so


def test_a_board_that_loses_its_counts_in_a_brown_out_gives_no_pose_and_no_torque():
    rig = MemoryRig("icube")
    with rig.loop:
        rig.arm()
        rig.link.faults.set("reset", 1)
        rig.step(60)
        assert rig["fault"] in (Fault.LINK_LOST, Fault.NOT_HOMED)
        assert rig.torque == 0.0


def test_a_board_that_counts_from_zero_again_and_says_nothing_is_found_out():
    rig = MemoryRig("icube")
    with rig.loop:
        rig.arm()
        rig.link.faults.set("jump", counts("icube", 31.0))
        rig.step(30)
        assert Fault(int(rig["fault"])) is Fault.ENCODER_JUMPED
