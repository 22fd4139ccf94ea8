"""Version 2 of the protocol: four channels, the board's own program, the holder behind it."""

import numpy as np
import pytest
from device.wire_process import emulator, wait_for
from tensegrity_rig import PROFILE, HolderRig, leaning

from app.core import state_vector as sv
from app.core.arrays import angle_between
from app.device.control import Loop, laws, machine_stages
from app.device.errors import BoardVersionError
from app.device.faults import Fault
from app.device.links import acus_protocol as acus
from app.device.links import board_layout as at
from app.device.links.board_layout import new_board
from app.device.links.serial_link import SerialLink
from app.mechanisms.profile import load_profile

HOLDS, PULLS = {"hold_direction": {}}, {"fixture": {}}


def test_tensions_and_reels_come_in_and_tensions_go_out():
    rig = HolderRig(PULLS, leaning(10.0, 40.0), wired=True)
    rows = rig.run(2.5)
    assert not rows[-500:, sv.FAULT].any()
    assert not rows[:, sv.LINK_ERRORS].any()
    sent = rig.board._box[at.PULL : at.PULL + 4]
    assert sent == pytest.approx(rows[-1, sv.TENSION], rel=1e-6)
    assert (rows[-500:, sv.CABLE] > 0.5 * PROFILE.cables.least).all()
    assert np.abs(rows[-1, sv.REEL]).max() > 0.0
    assert np.abs(rows[-500:, sv.TORQUE]).max() > 1e-3


def test_a_direction_is_held_over_the_wire():
    path = leaning(15.0, 120.0)
    rig = HolderRig(HOLDS, path, wired=True)
    rows = rig.run(6.0)
    assert rows[-1, sv.HOLDING] == 1.0
    assert rig.board._box[at.HOLDS] == 1.0
    assert angle_between(rig.axis, path) < np.radians(0.2)
    assert not rows[-1000:, sv.FAULT].any()


def test_a_cable_torn_behind_the_wire_ends_the_force():
    rig = HolderRig(HOLDS, leaning(10.0, 30.0), wired=True)
    rig.run(4.0)
    rig.tear(3)
    rows = rig.run(0.2)
    ended = int(np.argmax(rows[:, sv.FAULT] != 0.0))
    assert rows[ended, sv.FAULT] == Fault.CABLE_BROKEN
    assert 0 < ended <= 22
    assert not rig.board._box[at.PULL : at.PULL + 4].any()


def test_without_commands_the_board_lets_all_four_motors_go_within_its_watchdog():
    rig = HolderRig(PULLS, leaning(10.0, 40.0), wired=True)
    rig.run(2.0)
    assert rig.board._box[at.PULL : at.PULL + 4].min() > 0.0
    rig.board.faults.set("cut", 1.0)
    rig.run(PROFILE.wire.watchdog_ms * 1e-3)
    assert not rig.board._box[at.PULL : at.PULL + 4].any()
    assert rig.run(0.05)[-1, sv.FAULT] in (Fault.LINK_LOST, Fault.ENCODER_LOST)


def test_the_board_keeps_its_limits_whatever_it_is_told():
    box = new_board(PROFILE)
    assert box[at.VERSION] == 2.0
    assert box[at.LIMIT] == PROFILE.cables.most
    assert box[at.FASTEST] == PROFILE.winches.fastest
    assert new_board(load_profile("icube"))[at.CHANNELS] == 0.0


def test_a_board_of_the_other_version_is_refused_with_both():
    one = acus.pack_info(load_profile("icube"), "A", 1, gauge=False)
    two = acus.pack_info(PROFILE, "B", 1, gauge=False)
    assert acus.read_info(two, 2)[2] == pytest.approx(PROFILE.cables.most)
    with pytest.raises(BoardVersionError, match=r"version 2 of .* program version 1"):
        acus.read_info(two)
    with pytest.raises(BoardVersionError, match=r"version 1 of .* program version 2"):
        acus.read_info(one, 2)


@pytest.mark.long("machine")
def test_the_emulated_machine_behind_a_terminal_is_homed_armed_and_holds(tmp_path):
    with emulator(tmp_path, "tensegrity", "--hand", "rest") as process:
        link = SerialLink(process.path, PROFILE)
        forces = laws.stages_of(HOLDS, PROFILE)
        table = machine_stages(PROFILE, forces, [], link.stages(), energy_bound=0.0)
        loop = Loop(table, PROFILE.rate_hz, link=link)
        loop.open()
        assert link.info().protocol == "acus 2"
        assert link.info().emulated
        loop.inbox.write(assistance=1.0, path_z=-1.0, homed=1.0, force_cap=5.0)
        wait_for(lambda: loop.latest().row[sv.LINK_REPLIES] > 10)
        link.home()
        wait_for(lambda: link.is_homed)

        def holds() -> bool:
            now = loop.clock.now()
            loop.inbox.write(
                heartbeat=now, tracked_depth=0.02, tracked_time=now, homed=1.0, enabled=1.0
            )
            return bool(loop.latest().row[sv.HOLDING])

        wait_for(holds)
        assert loop.latest().row[sv.FAULT] == 0.0
        assert (loop.latest().row[sv.TENSION] >= 0.0).all()
        loop.close()
