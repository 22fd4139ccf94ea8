"""One contract for every robot: simulated, in memory, and on a serial port over the emulator."""

import numpy as np
import pytest
from device.wire_process import emulator, wait_for, want_torque
from device.wire_rig import free_arms
from memory_link import MemoryLink

from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.device.control import Loop, Table
from app.device.links.link import BoardInfo, DeviceLink, LinkStatus
from app.device.links.serial_link import SerialLink
from app.device.links.simulated import simulated_link
from app.mechanisms.profile import load_profile
from app.simulation.plant import initial_plant

KINDS = ("simulated", "memory icube", "memory haply-2diy", "serial icube", "serial haply-2diy")
WANTED = (0.03, -0.02)


@pytest.fixture(scope="module")
def processes(tmp_path_factory):
    """Emulators, parked, started when first asked for and kept for the module."""
    from contextlib import ExitStack

    with ExitStack() as stack:
        started = {}

        def get(profile):
            if profile not in started:
                folder = tmp_path_factory.mktemp("emulator")
                started[profile] = stack.enter_context(
                    emulator(folder, profile, "--hand", "rest", "--parked")
                )
            return started[profile]

        yield get


class SimulatedLink(DeviceLink):
    """Encoders and plant of a simulated robot, in the shape of a real one's link."""

    def __init__(self, profile, plant):
        self.profile, self._link = profile, simulated_link(profile, plant)

    def open(self):
        """Nothing to connect."""

    def close(self):
        """Nothing to let go of."""

    def stages(self):
        return self._link

    def info(self):
        serial = f"simulated-{self.profile.name}"
        return BoardInfo(self.profile.name, serial, "0", "memory", 1, simulated=True)


class Robot:
    """A link of one kind, its loop, and a look at what its motors do."""

    def __init__(self, kind, processes):
        kind, _, name = kind.partition(" ")
        self.profile = load_profile(name or "icube")
        self.start = initial_plant(self.profile, (0.0, 0.0, -1.0), -0.015)
        self.upright = (self.start["plant_q_left"], self.start["plant_q_right"])
        self.process = processes(name) if kind == "serial" else None
        plant = [("plant", free_arms, np.array(self.upright))]
        if kind == "serial":
            self.link = SerialLink(self.process.path, self.profile)
        elif kind == "memory":
            self.link = MemoryLink(self.profile, plant, self.upright)
        else:
            self.link = SimulatedLink(self.profile, plant)
        stages = self.link.stages()
        want = ("want", want_torque, np.array(WANTED))
        self.loop = Loop(
            Table.of([*stages.read, want], stages.write),
            self.profile.rate_hz,
            None if self.process else VirtualClock(10.0),
            initial=self.start,
            link=self.link,
        )

    def run(self, seconds):
        if self.process:
            ticks = self.loop.latest().tick
            wait_for(lambda: self.loop.latest().tick > ticks + seconds * 1e3)
        else:
            self.loop.step(round(seconds * 1e3))

    def home(self):
        """Home a robot whose arms rest at the home angles, and put them under the needle."""
        if self.process:
            self.process.order("park on")
            self.run(0.6)
            self.link.home()
            wait_for(lambda: self.link.is_homed)
            self.process.order("park off")
            self.run(3.0)  # the emulated hand brings them there no faster than hands move

    def torques(self):
        if self.process:
            return self.process.torques()
        if isinstance(self.link, MemoryLink):
            return self.link.torque
        row = self.loop.latest().row
        return row[sv.TORQUE_LEFT], row[sv.TORQUE_RIGHT]


@pytest.fixture(params=KINDS)
def robot(request, processes):
    return Robot(request.param, processes)


@pytest.mark.long("machine")
def test_every_robot_opens_reads_angles_sends_torques_and_ends_at_zero(robot):
    with robot.loop:
        assert robot.link.info().protocol
        robot.home()
        robot.run(0.1)
        row = robot.loop.latest().row
        assert row[sv.LINK_STATUS] == LinkStatus.FINE
        assert row[sv.TIME] - row[sv.Q_TIME] < 0.05
        count = 2.0 * np.pi / robot.profile.encoder.counts_per_turn
        bend = 0.05  # the constant torque holds the arms a little to the side once it acts
        assert row[sv.Q_LEFT] == pytest.approx(robot.upright[0], abs=count + bend)
        assert row[sv.Q_RIGHT] == pytest.approx(robot.upright[1], abs=count + bend)
        robot.loop.inbox.write(enabled=1.0)
        robot.run(0.1)
        assert robot.torques() == pytest.approx(WANTED, rel=1e-4)
    assert robot.torques() == (0.0, 0.0)


@pytest.mark.long("machine")
def test_every_robot_ends_at_zero_after_an_exception_and_can_be_opened_again(robot):
    def attempt():
        with robot.loop:
            robot.loop.inbox.write(enabled=1.0)
            robot.run(0.1)
            assert robot.torques() == pytest.approx(WANTED, rel=1e-4)
            raise KeyError

    for _ in range(2):
        with pytest.raises(KeyError):
            attempt()
        assert robot.torques() == (0.0, 0.0)
    robot.loop.close()
