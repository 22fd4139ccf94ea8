"""Loss of the wire by the emulator's own record, and how a robot is found again."""

import os
import signal
import subprocess
import sys
from pathlib import Path

import numpy as np
import pytest
from device.wire_process import (
    CLIENT,
    emulator,
    pushing,
    time_to_zero,
    wait_for,
    want_torque,
)

from app.core import state_vector as sv
from app.device.control import Loop, Table
from app.device.errors import LinkError
from app.device.links.link import LinkStatus
from app.device.links.serial_link import SerialLink
from app.mechanisms.profile import load_profile

ICUBE = load_profile("icube")
TESTS = Path(__file__).parents[1]


@pytest.fixture(scope="module")
def process(tmp_path_factory):
    with emulator(tmp_path_factory.mktemp("emulator"), "icube", "--hand", "rest") as started:
        yield started


@pytest.fixture
def robot(process):
    """The emulator, sound and plugged in before and after each test."""
    process.skip()
    yield process
    for order in ("unplug off", "freeze off", "version 1"):
        process.order(order)


class Client:
    """A program that pushes with constant torques."""

    def __init__(self, process):
        self.met = []
        self.link = SerialLink(process.path, ICUBE, on_connect=self.met.append)
        stages = self.link.stages()
        want = ("want", want_torque, np.array([0.05, -0.04]))
        self.loop = Loop(
            Table.of([*stages.read, want], stages.write), ICUBE.rate_hz, link=self.link
        )

    def __getitem__(self, slot):
        return self.loop.latest().row[sv.INDEX[slot]]

    def said(self):
        return " | ".join(event.message for event in self.link.events.drain())


@pytest.mark.long("machine")
@pytest.mark.promise("docs/protocol.md: at most 20 ms later: torque 0, tripped")
def test_a_killed_program_leaves_the_motors_at_zero_within_the_watchdogs_time(robot):
    environment = dict(os.environ, PYTHONPATH=f"{TESTS.parent}:{TESTS}")
    client = subprocess.Popen(
        [sys.executable, "-c", CLIENT, robot.path, "icube"],
        stdout=subprocess.PIPE,
        env=environment,
        text=True,
    )
    assert client.stdout.readline().strip() == "pushing"
    robot.rows_until(lambda rows: pushing(rows).sum() > 400)
    client.send_signal(signal.SIGKILL)
    client.wait()
    client.stdout.close()
    rows = robot.rows_until(lambda rows: pushing(rows).any() and rows["tripped"][-1] > 0)
    assert time_to_zero(rows) <= 0.020
    assert not pushing(rows[-1])


@pytest.mark.long("machine")
def test_an_unplugged_robot_stops_and_is_driven_again_when_it_is_plugged_in(robot):
    client = Client(robot)
    with client.loop:
        client.loop.inbox.write(enabled=1.0)
        robot.rows_until(lambda rows: pushing(rows).sum() > 200)
        robot.order("unplug on")
        rows = robot.rows_until(lambda rows: (rows["tripped"] * rows["unplugged"]).sum() > 5)
        due = rows["time"] - rows["lateness"]  # a busy machine wakes the emulated board late
        unplugged = due[rows["unplugged"] > 0][0]
        assert due[pushing(rows)].max() - unplugged <= 0.020
        assert time_to_zero(rows) <= 0.020
        wait_for(lambda: client["link_status"] == LinkStatus.CONNECTING)
        seen = client["q_time"]
        robot.order("unplug off")
        wait_for(lambda: client["link_status"] == LinkStatus.FINE, what="the robot to come back")
        wait_for(lambda: client["q_time"] > seen)
        robot.rows_until(lambda rows: pushing(rows).sum() > 200)
        assert [info.boot for info in client.met] == [client.link.info().boot] * 2
        assert "is gone" in client.said()
    robot.rows_until(lambda rows: len(rows) > 20 and not pushing(rows[-5:]).any())


@pytest.mark.long("machine")
def test_a_robot_that_restarts_is_greeted_again_and_is_not_homed(robot):
    client = Client(robot)
    with client.loop:
        client.link.home()
        client.loop.inbox.write(homed=1.0)
        wait_for(lambda: client.link.is_homed)
        wait_for(lambda: client["homed"] == 1)
        robot.order("reset")
        wait_for(lambda: len(client.met) == 2)
        assert client.met[1].boot != client.met[0].boot
        wait_for(lambda: client["link_status"] == LinkStatus.FINE)
        assert client["homed"] == 0
        assert not client.link.is_homed


@pytest.mark.long("machine")
def test_two_programs_on_one_board_are_told_apart_by_name_of_the_port(robot):
    with Client(robot).loop, pytest.raises(LinkError, match=r"busy.*another program"):
        SerialLink(robot.path, ICUBE).open()


@pytest.mark.long("machine")
def test_a_frozen_board_is_said_to_be_silent_and_comes_back(robot):
    client = Client(robot)
    with client.loop:
        wait_for(lambda: client["link_replies"] > 50)
        robot.order("freeze on")
        wait_for(lambda: client["link_status"] != LinkStatus.FINE)
        robot.order("freeze off")
        wait_for(lambda: client["link_status"] == LinkStatus.FINE)


@pytest.mark.long("machine")
def test_a_board_of_another_version_is_named_with_both_versions(robot):
    robot.order("version 9")
    link = SerialLink(robot.path, ICUBE)
    with pytest.raises(LinkError, match=r"version 9 .*version 1.*update the program") as told:
        link.open()
    assert str(told.value).startswith(f"{robot.path}: ")  # there may be several robots
    link.close()


@pytest.mark.long("machine")
def test_a_board_of_another_robot_is_refused_with_its_name(robot):
    other = ICUBE.model_copy(update={"name": "other"})
    with pytest.raises(LinkError, match=r"'icube'.*'other'"):
        SerialLink(robot.path, other).open()
