"""The board's program behind a terminal answers the real program: on this computer and in QEMU."""

import json
import subprocess
import sys
import time
from contextlib import contextmanager

import numpy as np
import pytest
from device.wire_process import want_torque
from firmware_rig import ROOT, board_process, built, need

from app.core import state_vector as sv
from app.device.control import Loop, Table
from app.device.link_test import measure_link
from app.device.links.serial_link import SerialLink
from app.mechanisms.profile import load_profile


def acus(*words):
    """Run the real program; return its answer."""
    command = [sys.executable, "-m", "app", *words, "--json"]
    done = subprocess.run(command, cwd=ROOT, capture_output=True, text=True, check=False)
    assert done.returncode == 0, done.stderr
    return json.loads(done.stdout)["facts"]


@contextmanager
def in_qemu():
    """The program for the STM32F405, run by an emulator of the chip; gives its terminal's path."""
    need("qemu-system-arm", "arm-none-eabi-gcc")
    command = ["qemu-system-arm", "-M", "netduinoplus2", "-nographic", "-monitor", "none"]
    command += ["-serial", "pty", "-kernel", str(built("qemu"))]
    process = subprocess.Popen(
        command, stdin=subprocess.DEVNULL, stdout=subprocess.PIPE, stderr=subprocess.STDOUT,
        text=True,
    )  # fmt: skip
    try:
        line = next(line for line in process.stdout if "/dev/pts/" in line)
        yield next(word for word in line.split() if word.startswith("/dev/"))
    finally:
        process.kill()
        process.wait()
        process.stdout.close()


@pytest.mark.long("journey")
@pytest.mark.parametrize(("device", "version"), [("icube", 1), ("tensegrity", 2)])
def test_device_show_knows_it(tmp_path, device, version):
    with board_process(tmp_path, device) as board:
        found = acus("device", "show", board.path, "--profile", device)
    assert (found["profile"], found["serial"]) == (device, "A0001")
    assert (found["protocol"], found["emulated"]) == (f"acus {version}", True)


@pytest.mark.long("machine")
@pytest.mark.parametrize("device", ["icube", "tensegrity"])
def test_a_thousand_commands_a_second_are_all_answered(tmp_path, device):
    with board_process(tmp_path, device) as board:
        found = measure_link(board.path, load_profile(device), 3.0)
    assert found.commands > 2000
    assert (found.lost, found.errors) == (0, 0)


@pytest.mark.long("machine")
def test_the_loops_torque_arrives_and_ends_when_the_loop_ends(tmp_path):
    profile = load_profile("icube")
    per_ampere = profile.inertia.gear * profile.motor.torque_constant
    with board_process(tmp_path) as board:
        link = SerialLink(board.path, profile)
        stages = link.stages()
        want = ("want", want_torque, np.array([0.05, -0.04]))
        loop = Loop(Table.of([*stages.read, want], stages.write), profile.rate_hz, link=link)
        with loop:
            loop.inbox.write(enabled=1.0)
            time.sleep(0.3)
            given = np.array(board.order("torques").split(), float)
            turned = loop.latest().row[[sv.Q_LEFT, sv.Q_RIGHT]] - profile.encoder.home_offsets
            board.order("freeze 1")
            time.sleep(0.03)
            hanging = np.array(board.order("torques").split(), float)
            board.order("freeze 0")
            board.order("hot 95")
            time.sleep(0.05)
            error = loop.latest().row[sv.BOARD_ERROR]
    assert given == pytest.approx(np.array([0.05, -0.04]) / per_ampere, rel=1e-5)
    assert turned[0] > 0.01 > -0.01 > turned[1]
    assert hanging.tolist() == [0.0, 0.0]
    assert error == 6


@pytest.mark.long("journey")
def test_in_qemu_it_answers_who_it_is_and_is_heard_for_a_second():
    profile = load_profile("icube")
    with in_qemu() as path:
        found = acus("device", "show", path)
        assert (found["profile"], found["firmware"], found["emulated"]) == ("icube", "1.0", True)
        link = SerialLink(path, profile)
        stages = link.stages()
        loop = Loop(Table.of(stages.read, stages.write), 200.0, link=link)
        with loop:
            time.sleep(1.5)
            row = loop.latest().row
    assert row[sv.LINK_REPLIES] > 100
    assert row[sv.LINK_ERRORS] == 0
    assert row[sv.BOARD_ERROR] == 0
