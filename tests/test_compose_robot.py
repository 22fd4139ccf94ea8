"""A real device in the trainer, over the emulated board: commissioned, then a whole attempt."""

import time
from contextlib import suppress
from dataclasses import replace

import numpy as np
import pytest
from memory_link import MemoryLink

from app.compose.desktop import DesktopRun
from app.compose.emulator import Emulator, EmulatorSetup
from app.compose.needle import UPRIGHT
from app.compose.robot import Robot
from app.compose.trainer import TrainerSetup, build_rig, device_of
from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.device.commissioning.bench import Bench
from app.device.commissioning.records import records_folder
from app.device.commissioning.results import RoutineName
from app.device.errors import LinkError, RecordError
from app.device.links import host_end as host
from app.device.links.link import LinkStatus
from app.device.links.serial_link import SerialLink
from app.exercises.scene import placed_plan_of
from app.planning.plan import Plan
from app.scoring.conditions import DeviceKind
from app.session.errors import IllegalTransitionError, NotReadyError
from app.session.machine import State
from app.session.recording import read_recording
from app.simulation.plant import initial_plant, plant_stage
from tests.layered import layered

PLAN = Plan(np.array([0.0, -100.0, 0.0]), np.array([15.0, -35.0, 10.0]), "test")
EXERCISE = layered("first-insertion")
PROFILE = device_of(EXERCISE)


@pytest.fixture
def emulator(tmp_path, monkeypatch):
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "data"))
    emulator = Emulator(EmulatorSetup(PROFILE, hand="none", parked=True, serial="E-1"))
    emulator.open()
    wait(lambda: emulator._loop.latest().tick > 0, 300.0)  # a first start compiles its kernels
    yield emulator
    emulator.close()


def setup(port, tmp_path):
    placed = placed_plan_of(EXERCISE, PROFILE, PLAN)
    return TrainerSetup(EXERCISE, placed, sessions=tmp_path / "sessions", port=port)


def commission(emulator):
    """Home against the stops, check the signs by pulses; what a person does, the emulator does."""
    bench = Bench(SerialLink(emulator.path, PROFILE), PROFILE)
    with bench:
        wait(lambda: bench.loop.latest().row[sv.Q_TIME] > 0.0)

        def answer(report):
            if "upright by eye" in report.needs:
                emulator.switch("park off")
                time.sleep(0.7)
            return 0.0

        for step in (RoutineName.HOMING, RoutineName.SIGNS):
            for _ in range(10):  # a busy computer may lose the wire for a moment
                report = bench.run(bench.routine(step, by_hand=False), answer)
                if "does not answer" not in report.failure:
                    break
            assert report.failure == ""
            bench.keep(report.result)
        return bench.clearance()


def wait(ready, seconds=60.0):
    end = time.monotonic() + seconds
    while not ready():
        assert time.monotonic() < end
        time.sleep(0.01)


def attempt(rig, seconds=2.5):
    """Hold the key for a while; the result, and the forces felt."""
    rig.trainer.begin("tester")
    with suppress(IllegalTransitionError):  # where its depth was measured outside already
        rig.trainer.confirm_outside()
    felt, end = [], time.monotonic() + seconds
    while time.monotonic() < end:
        rig.trainer.heartbeat()
        rig.trainer.arm()
        felt.append(float(np.linalg.norm(rig.loop.latest().felt)))
        time.sleep(0.02)
    with suppress(IllegalTransitionError):  # where the attempt was aborted
        rig.trainer.end()
    wait(lambda: rig.trainer.result is not None)
    return rig.trainer.result, max(felt)


@pytest.mark.long("machine")
@pytest.mark.timeout(600)  # a first start compiles the board's and the loop's kernels
def test_a_whole_attempt_on_a_device_that_was_commissioned_over_the_wire(emulator, tmp_path):
    clearance = commission(emulator)
    assert (clearance.homed, clearance.force_cap) == (1.0, 1.0)
    emulator._loop.inbox.write(hand_holds=1.0, hand_depth=-0.015)  # a hand takes the needle
    for _ in range(10):  # as above; it ends an attempt
        rig = build_rig(setup(emulator.path, tmp_path))
        try:
            rig.trainer.open()
            wait(lambda: rig.loop.latest().row[sv.Q_TIME] > 0.0)  # noqa: B023
            assert rig.loop.latest().axis[2] < -0.99
            rig.trainer._dial = 1.0
            result, felt = attempt(rig)
        finally:
            rig.close()
        if result.state is State.ENDED:
            break
    assert result.state is State.ENDED
    assert 0.3 < felt <= 1.0 + 1e-9
    metadata = read_recording(result.record).metadata
    device = metadata["device"]
    assert device["simulated"] == "no"
    assert metadata["trainee"]["hand"] == "robot"
    assert device["serial"] == "E-1"
    assert device["force_cap"] == "1"
    assert "force scale" in device["clearance"]
    no_noise(rig, result)


def no_noise(rig, result):
    """A hand on a robot is somebody's own: nothing is added to it, whatever the exercise says."""
    assert rig.trainer._beginnings is None
    assert "unsteady_hand" not in [stage.name for stage in rig.loop.table]
    assert not rig.loop.latest().row[[sv.UNSTEADY_X, sv.UNSTEADY_Y, sv.UNSTEADY_DEPTH]].any()
    recording = read_recording(result.record)
    assert not recording.inputs.column("hand_level").any()
    assert not recording.inputs.column("hand_seed").any()


class KeptOn(MemoryLink):
    """A board in memory that stays switched on between two connections."""

    def open(self):
        if not hasattr(self, "_info"):
            super().open()


@pytest.mark.long("machine")
def test_an_attempt_on_a_board_in_memory_stays_below_the_cap(tmp_path, monkeypatch):
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "data"))
    start = initial_plant(PROFILE, UPRIGHT, -0.015)
    q = start["plant_q_left"], start["plant_q_right"]
    link = KeptOn(PROFILE, [plant_stage(PROFILE, UPRIGHT, -0.015)], q, homed=False)
    clock = VirtualClock(10.0)
    with Bench(link, PROFILE, clock, initial=start) as bench:
        bench.advance(0.1)
        for step in (RoutineName.OFFSETS, RoutineName.SIGNS):
            report = bench.run(bench.routine(step, by_hand=False), lambda _: 0.0)
            assert report.failure == ""
            bench.keep(report.result)
        assert "directions" in bench.clearance().reason
        stops = bench.record.newest(RoutineName.OFFSETS).result
        bench.keep(stops.model_copy(update={"step": RoutineName.HOMING, "reference": "stops"}))
        assert bench.clearance().force_cap == 1.0
    link._end[host.STATUS] = LinkStatus.FINE  # as after greeting it again
    robot = Robot.connect(link, PROFILE)
    wished = EXERCISE.model_copy(update={"unsteady_hand": 5})
    rig = build_rig(replace(setup(None, tmp_path), exercise=wished, clock=clock), robot)
    rig.loop.open()
    rig.trainer.step()
    rig.trainer.begin("tester", hand="mouse")  # a mouse that says how deep the robot's needle is
    rig.trainer.assistance(1.0)
    rig.trainer.step()
    rig.trainer.confirm_outside()
    felt, most = [], []
    for _ in range(150):
        rig.trainer.arm()
        device = rig.trainer.step().device
        felt.append(float(np.linalg.norm(device.felt)))
        most.append(device.felt_most)
    result = rig.trainer.end()
    rig.loop.close()
    rig.close()
    assert result.state is State.ENDED
    assert 0.5 < max(felt) <= max(most), "no camera has measured the depth"
    assert max(most) == pytest.approx(1.0, abs=1e-6)
    no_noise(rig, result)
    device = read_recording(result.record).metadata["device"]
    assert device["simulated"] == "no"
    assert device["kind"] == "emulated"  # by its own word; a real board never says so
    conditions = result.summary.conditions
    assert conditions is not None
    assert conditions.kind is DeviceKind.EMULATED


@pytest.mark.long("machine")
def test_a_device_that_was_not_commissioned_refuses_an_attempt_and_says_why(emulator, tmp_path):
    rig = build_rig(setup(emulator.path, tmp_path))
    try:
        rig.trainer.open()
        wait(lambda: rig.loop.latest().tick > 0)
        with pytest.raises(NotReadyError, match="homed"):
            rig.trainer.begin("tester")
    finally:
        rig.close()
    rig.close()


def test_a_damaged_record_is_told_and_the_port_let_go(emulator, tmp_path):
    records_folder().mkdir(parents=True)
    (records_folder() / "E-1.yaml").write_text("[")
    with pytest.raises(RecordError, match="damaged"):
        build_rig(setup(emulator.path, tmp_path))
    (records_folder() / "E-1.yaml").unlink()
    build_rig(setup(emulator.path, tmp_path)).close()


def test_a_port_that_is_not_there_is_told(tmp_path):
    absent = setup(str(tmp_path / "absent"), tmp_path)
    with pytest.raises(LinkError, match="absent"):
        build_rig(absent)
    assert build_rig(replace(absent, port=None)).robot is None


@pytest.mark.long("machine")
def test_the_window_is_told_who_answers_and_what_is_commissioned(emulator, tmp_path):
    rig = build_rig(setup(emulator.path, tmp_path))
    run = DesktopRun(rig).run
    try:
        assert run.is_real
        assert run.interactive
        assert (run.board.serial, run.port, run.velocity) == ("E-1", emulator.path, "foaw")
        assert run.clearance.force_cap == 0.0
        assert run.readiness.homed_boot is None
    finally:
        rig.close()
