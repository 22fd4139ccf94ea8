"""The trainer on simulated robot and cameras: at rest it computes nothing, and it comes back."""

import threading
import time

import numpy as np
import pytest

from app.compose.trainer import TrainerSetup, build_rig, device_of
from app.core.clock import SystemClock
from app.core.paced_clock import PacedClock
from app.exercises.scene import placed_plan_of
from app.planning.plan import Plan
from app.session.machine import State
from app.session.recording import read_recording
from tests.layered import layered

PLAN = Plan(np.array([0.0, -100.0, 0.0]), np.array([15.0, -35.0, 10.0]), "test")
EXERCISE = layered("first-insertion")
OUT = -0.015


def built(folder, **changes):
    placed = placed_plan_of(EXERCISE, device_of(EXERCISE), PLAN)
    return build_rig(TrainerSetup(EXERCISE, placed, sessions=folder, **changes))


def wait(ready, seconds=300.0):  # a first start compiles its kernels
    end = time.monotonic() + seconds
    while not ready():
        assert time.monotonic() < end
        time.sleep(0.01)


@pytest.fixture(params=[SystemClock, PacedClock], ids=["wall", "paced"])
def rig(tmp_path, request):
    rig = built(tmp_path, clock=request.param())
    rig.trainer.open()

    def measured():
        rig.trainer.heartbeat()
        return rig.trainer.snapshot().pose.measured

    wait(measured)
    yield rig
    rig.close()


def cost(seconds):
    """Share of a core that this process computes for a while."""
    began, wall = time.process_time(), time.monotonic()
    time.sleep(seconds)
    return (time.process_time() - began) / (time.monotonic() - wall)


@pytest.mark.long("machine")
def test_at_rest_nothing_ticks_or_draws_and_little_is_computed(rig):
    threads = threading.active_count()
    assert rig.trainer.resting.rest()
    assert threading.active_count() < threads
    tick, shown = rig.loop.latest().tick, rig.trainer.snapshot()
    assert cost(2.0) < 0.02
    assert rig.loop.latest().tick == tick
    assert rig.trainer.snapshot() is shown


@pytest.mark.long("machine")
def test_a_moved_hand_has_them_run_and_the_needle_measured_again(rig):
    rig.trainer.resting.rest()
    depth = float(rig.trainer.snapshot().pose.depth)
    time.sleep(2.5)  # longer than what would count as a computer that slept
    rig.trainer.hand(0.0, 0.0, OUT - 0.01)
    assert not rig.trainer.resting.rests
    wait(lambda: rig.trainer.snapshot().pose.depth < depth - 0.005)
    assert not [event for event in rig.trainer.events.drain() if event.kind == "slept"]


@pytest.mark.long("machine")
def test_an_attempt_begins_out_of_a_rest_and_none_rests_while_it_runs(rig):
    rig.trainer.resting.rest()
    time.sleep(2.5)
    rig.trainer.begin("student", "mouse")
    assert not rig.trainer.resting.rest()

    def ready():
        rig.trainer.heartbeat()
        return rig.trainer.snapshot().ready

    wait(ready)
    x, y, _ = rig.trainer.snapshot().pose.axis
    rig.trainer.hand(float(x), float(y), OUT + 0.005)

    def aligning():
        rig.trainer.heartbeat()
        return rig.trainer.snapshot().state is State.ALIGNING

    wait(aligning)
    result = rig.trainer.end()
    assert read_recording(result.record).inputs.lost == 0
    assert rig.trainer.resting.rest()


@pytest.mark.long("machine")
def test_a_plan_that_is_moved_out_of_a_rest_is_seen(rig):
    rig.trainer.resting.rest()
    other = Plan(np.array([0.0, -100.0, 0.0]), np.array([-12.0, -40.0, 4.0]), "other")
    moved = rig.place(placed_plan_of(EXERCISE, device_of(EXERCISE), other))
    assert not moved.trainer.resting.rests
    wait(lambda: np.allclose(rig.trainer.snapshot().p_target, moved.setup.placed.p_target))


@pytest.mark.long("machine")
def test_a_real_robot_and_a_script_in_paced_time_never_rest(tmp_path):
    from app.compose.emulator import Emulator, EmulatorSetup

    paced = built(tmp_path, skill="expert", clock=PacedClock())
    assert not paced.trainer.resting.may
    paced.close()
    emulator = Emulator(EmulatorSetup(device_of(EXERCISE), hand="none", parked=True, serial="E-1"))
    emulator.open()
    try:
        wait(lambda: emulator._loop.latest().tick > 0)
        real = built(tmp_path, port=str(emulator.path))
        assert not real.trainer.resting.may
        real.trainer.open()
        assert not real.trainer.resting.rest()
        real.close()
    finally:
        emulator.close()
