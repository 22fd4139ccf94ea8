"""The protocols' own bytes and the board's own program, in memory, on a virtual clock."""

import numpy as np
import pytest
from device.wire_rig import PROFILES, MemoryRig
from memory_link import MemoryLink

from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.device.control import Loop, Table
from app.device.control.corrections import Corrections
from app.device.errors import LinkError
from app.device.links import board_layout as at
from app.device.links.link import LinkStatus
from app.mechanisms.profile import load_profile

MINUTES = 10


@pytest.mark.parametrize("name", PROFILES)
def test_angles_come_in_and_torques_go_out(name):
    rig = MemoryRig(name)
    with rig.loop:
        rig.arm()
        count = 2.0 * np.pi / rig.profile.encoder.counts_per_turn
        for side in ("left", "right"):
            assert abs(rig[f"q_{side}"] - rig[f"plant_q_{side}"]) < count
        assert rig["fault"] == 0
        assert rig["link_status"] == LinkStatus.FINE
        assert rig["round_trip"] == pytest.approx(1e-3)
        assert rig["link_lost"] == rig["link_errors"] == 0
        assert rig.torque > 0.01
        wanted = (rig["torque_left"], rig["torque_right"])
        assert rig.link.torque == pytest.approx(wanted, rel=1e-6)
    assert rig.link.torque == (0.0, 0.0)


def test_the_corrections_alone_put_angles_and_gauge_of_a_link_right():
    link = MemoryLink(load_profile("icube"))
    link._box[at.GAUGE] = 1.0
    stages, corrections = link.stages(), Corrections((0.1, -0.2), (0.5, 2.0))
    q = link.profile.encoder.home_offsets
    initial = {"plant_q_left": q[0], "plant_q_right": q[1], "pull_x": 1.25}
    table = Table.of([*stages.read, corrections.stage()], stages.write)
    loop = Loop(table, 1000.0, VirtualClock(1.0), initial=initial, link=link)
    with loop:
        loop.step(50)
        rows = loop.rows()[-30:]
    assert rows[:, sv.Q_LEFT] == pytest.approx(q[0] + 0.1, abs=4e-4)
    assert rows[:, sv.Q_RIGHT] == pytest.approx(q[1] - 0.2, abs=4e-4)
    assert rows[:, sv.GAUGE_FORCE] == pytest.approx((1.25 - 0.5) * 2.0)


@pytest.mark.parametrize("name", PROFILES)
def test_an_exception_in_the_block_ends_at_zero(name):
    rig = MemoryRig(name)

    def attempt():
        with rig.loop:
            rig.arm()
            assert rig.torque > 0.01
            raise KeyError(name)

    with pytest.raises(KeyError):
        attempt()
    assert rig.link.torque == (0.0, 0.0)


@pytest.mark.promise(
    "docs/protocol.md: torque zero no later than `watchdog_ms` (20 ms) after the last "
    "valid COMMAND with enable"
)
@pytest.mark.parametrize("name", PROFILES)
@pytest.mark.parametrize("fault", ["cut", "freeze"])
def test_without_commands_the_board_is_at_zero_after_its_watchdogs_time(name, fault):
    rig = MemoryRig(name)
    with rig.loop:
        rig.arm()
        assert rig.torque > 0.01
        rig.link.faults.set(fault, 1)
        rig.step(15)
        assert rig.torque > 0.01
        rig.step(5)
        assert rig.torque == 0.0
        rig.step(100)
        assert rig["link_status"] == LinkStatus.SILENT
        assert rig["fault"] != 0
        rig.link.faults.set(fault, 0)
        rig.step(50)
        rig.rearm()
        assert rig["link_status"] == LinkStatus.FINE
        assert rig.torque > 0.01


def test_a_board_that_restarts_gives_no_torque_and_clears_homed():
    rig = MemoryRig()
    with rig.loop:
        rig.arm()
        before = rig["q_left"]
        rig.link.faults.set("reset", 1)
        rig.step(50)
        assert rig.torque == 0.0
        assert rig["homed"] == 0
        assert rig["link_status"] == LinkStatus.CONNECTING
        assert rig["q_left"] == before  # its new counters are not believed


@pytest.mark.parametrize("name", PROFILES)
def test_homing_makes_the_present_pose_the_home_angles(name):
    rig = MemoryRig(name, homed=False)
    with rig.loop:
        rig.loop.inbox.write(homed=1.0)
        rig.step(10)
        assert rig["homed"] == 0
        rig.link.home()
        rig.step(10)
        assert rig["homed"] == 1
        home = rig.profile.encoder.home_offsets
        count = 2.0 * np.pi / rig.profile.encoder.counts_per_turn
        assert rig["q_left"] == pytest.approx(home[0], abs=count)
        assert rig["q_right"] == pytest.approx(home[1], abs=count)


def test_a_damaged_wire_is_counted_and_the_robot_goes_on():
    rig = MemoryRig()
    with rig.loop:
        rig.arm()
        rig.link.faults.set("garble", 0.05)
        rig.link.faults.set("drop", 0.05)
        rig.step(3000)
        assert rig["link_errors"] > 20
        assert rig["link_lost"] > 100
        assert rig["link_status"] == LinkStatus.FINE
        assert rig.torque > 0.0


def test_a_delay_on_the_wire_shows_in_the_round_trip():
    rig = MemoryRig()
    with rig.loop:
        rig.link.faults.set("delay", 3)
        rig.step(100)
        assert rig["round_trip"] == pytest.approx(7e-3, abs=1.5e-3)


def test_an_error_of_the_board_stops_its_motors_and_is_said():
    rig = MemoryRig()
    with rig.loop:
        rig.arm()
        rig.link.faults.set("error", 5)
        rig.step(5)
        assert rig.torque == 0.0
        assert rig["board_error"] == 5


def test_a_board_of_another_version_is_named_with_both_versions():
    rig = MemoryRig()
    rig.link.faults.set("version", 9)
    with pytest.raises(LinkError, match=r"version 9 .* version 1"):
        rig.loop.open()
    assert not rig.loop.is_open


def test_an_unknown_fault_names_the_valid_ones():
    rig = MemoryRig()
    with pytest.raises(LinkError, match="drop, garble, delay"):
        rig.link.faults.set("dorp", 0.1)
    with pytest.raises(LinkError, match="from 0 to 1"):
        rig.link.faults.set("drop", 10)
