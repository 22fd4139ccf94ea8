"""The loop: inbox, history, timing, hosts, leaving."""

import subprocess
import sys
import threading
import time

import numpy as np
import pytest
from device.device_rig import PROFILE, Rig, keep_what_was_sent

from app.core import state_vector as sv
from app.core.clock import SystemClock, VirtualClock
from app.core.compiled import stage
from app.device.control import INPUT_NAMES, Host, Loop, Priority, Table, stage_cost
from app.device.control.kernel import HEAD, receive
from app.device.control.shared import TickHistory
from app.device.errors import DeviceError, LoopError, UnknownInputError

HOSTS = [Host.THREAD] + ([Host.COMPILED] if sys.platform == "linux" else [])


@stage
def want_torque(state, p):
    """A stage that always asks for a torque, for tests of leaving."""
    state[sv.TORQUE_LEFT] = p[0]
    state[sv.TORQUE_RIGHT] = -p[0]


@stage
def compare_inputs(state, p):
    """Count ticks in which two inputs that are always written together differ."""
    if state[sv.HAND_X] != -state[sv.HAND_Y]:
        p[0] += 1.0


def wait_for(condition, seconds=60.0):
    end = time.monotonic() + seconds
    while not condition():
        assert time.monotonic() < end, "waited too long"
        time.sleep(0.005)


@pytest.mark.parametrize("host", HOSTS)
def test_a_loop_ticks_by_itself_and_sends_zero_when_it_ends(host):
    sent = np.zeros(4)
    table = Table.of([("want", want_torque, np.array([0.3]))], [("send", keep_what_was_sent, sent)])
    loop = Loop(table, 1000.0, host=host, priority=Priority.NORMAL)
    loop.open()
    loop.open()
    wait_for(lambda: loop.latest().tick > 20)
    assert sent[0] == 0.3
    loop.close()
    loop.close()
    assert sent[:2].tolist() == [0.0, 0.0]
    ticks = loop.latest().tick
    time.sleep(0.05)
    assert loop.latest().tick == ticks
    assert not loop.latest().torque.any()


@pytest.mark.parametrize("host", HOSTS)
def test_ticks_lie_on_a_grid_and_are_numbered_without_gaps(host):
    with Loop([], 200.0, host=host, priority=Priority.NORMAL) as loop:
        wait_for(lambda: loop.latest().tick >= 30)
        rows = loop.rows()
    assert rows[:, sv.TICK].tolist() == list(range(1, len(rows) + 1))
    assert (np.diff(rows[:, sv.TIME]) > 0.0).all()
    assert (rows[:, sv.LATENESS] >= 0.0).all()
    assert set(np.round(rows[:, sv.DT] * 200.0, 6)) <= {1.0, 2.0}


def test_the_plain_thread_declares_a_lower_rate():
    assert Loop([], 1000.0, host=Host.THREAD).rate_hz == 250.0
    assert Loop([], 100.0, host=Host.THREAD).rate_hz == 100.0


@pytest.mark.parametrize("platform", ["win32", "darwin"])
def test_elsewhere_than_on_linux_the_plain_thread_is_the_host(monkeypatch, platform):
    monkeypatch.setattr(sys, "platform", platform)
    loop = Loop([], 1000.0)
    assert (loop.host, loop.rate_hz) == (Host.THREAD, 250.0)
    with loop:
        wait_for(lambda: loop.latest().tick > 3)
    assert not loop.timing().realtime


def test_the_linux_kernel_is_loaded_by_the_loops_own_thread_only():
    code = "import sys, app.device.control; assert 'app.device.control.realtime' not in sys.modules"
    assert subprocess.run([sys.executable, "-c", code], timeout=110, check=False).returncode == 0


def test_timing_counts_ticks_and_orders_its_percentiles():
    with Loop([], 500.0) as loop:
        assert loop.timing().ticks >= 0
        wait_for(lambda: loop.latest().tick >= 50)
        timing = loop.timing()
    assert timing.ticks >= 50
    assert 0.0 <= timing.median <= timing.p90 <= timing.p99 <= timing.maximum
    assert timing.missed >= 0
    assert timing.rate_hz == 500.0


def test_an_exception_in_the_thread_is_said_by_latest_and_the_torque_is_zero(monkeypatch):
    sent = np.full(4, 9.0)
    loop = Loop(Table.of([], [("send", keep_what_was_sent, sent)]), host=Host.THREAD)

    def broken(*_):
        raise RuntimeError("the clock stopped")

    monkeypatch.setattr(loop, "_tick", broken)
    loop.open()
    wait_for(lambda: sent[0] == 0.0)
    wait_for(lambda: loop._failure is not None)
    with pytest.raises(LoopError, match="the clock stopped"):
        loop.latest()
    loop.close()


def test_stepping_advances_the_virtual_clock_by_whole_periods():
    clock = VirtualClock(3.0)
    with Loop([], 500.0, clock) as loop:
        loop.step(10)
        assert clock.now() == pytest.approx(3.02)
        state = loop.latest()
        assert (state.tick, state.time) == (10, pytest.approx(3.02))


def test_two_runs_of_the_same_inputs_are_the_same_to_the_last_bit():
    rows = []
    for _ in range(2):
        rig = Rig()
        with rig.loop:
            rig.arm(hand_x=0.1)
            rows.append(rig.loop.rows())
    assert np.array_equal(rows[0], rows[1])


def test_stepping_needs_an_open_loop_on_a_virtual_clock():
    with pytest.raises(LoopError, match="call open"):
        Loop([], clock=VirtualClock()).step()
    with pytest.raises(LoopError, match="VirtualClock"):
        Loop([], clock=SystemClock()).step()


def test_an_unknown_input_names_the_valid_ones():
    loop = Loop([], clock=VirtualClock())
    with pytest.raises(UnknownInputError, match=r"'asistance'.*assistance, enabled") as caught:
        loop.inbox.write(asistance=1.0)
    assert isinstance(caught.value, DeviceError)
    with pytest.raises(UnknownInputError):
        loop.inbox.write(torque_left=1.0)
    assert "hand_holds" in INPUT_NAMES


def test_an_unknown_initial_slot_names_the_valid_ones():
    with pytest.raises(LoopError, match="plant_q_left"):
        Loop([], clock=VirtualClock(), initial={"plant_q": 1.0})


def test_inputs_written_together_are_never_seen_apart():
    torn = np.zeros(1)
    with Loop([("compare", compare_inputs, torn)], 5000.0, priority=Priority.NORMAL) as loop:

        def writer(sign):
            for k in range(3000):
                loop.inbox.write(hand_x=sign * k, hand_y=-sign * k)

        threads = [threading.Thread(target=writer, args=(s,)) for s in (1.0, -1.0)]
        for thread in threads:
            thread.start()
        for thread in threads:
            thread.join()
        wait_for(lambda: loop.latest().tick > 5)
    assert torn[0] == 0.0


def test_during_a_write_the_last_whole_copy_stays():
    state, scratch = sv.empty_state(), sv.empty_state()
    inbox, sequence = np.full(sv.INPUTS, 2.0), np.array([4])
    receive(state, inbox, scratch, sequence)
    assert (state[: sv.INPUTS] == 2.0).all()
    sequence[0], inbox[:] = 5, 3.0
    receive(state, inbox, scratch, sequence)
    assert (state[: sv.INPUTS] == 2.0).all()


def test_the_history_gives_only_ticks_that_are_still_there():
    history = TickHistory(capacity=8)
    for tick in range(1, 21):
        history.ring[(tick - 1) % 8, sv.TICK] = tick
        history.counters[HEAD] = tick
    assert history.rows(0)[:, sv.TICK].tolist() == list(range(14, 21))
    assert history.rows(18)[:, sv.TICK].tolist() == [19, 20]
    assert history.rows(20).shape == (0, sv.SLOTS)
    assert history.last()[sv.TICK] == 20
    assert history.column(sv.TICK, 3).tolist() == [18, 19, 20]


def test_before_the_first_tick_the_state_is_zero():
    state = Loop([], clock=VirtualClock()).latest()
    assert state.tick == 0
    assert not state.row.any()
    with pytest.raises(ValueError, match="read-only"):
        state.axis[0] = 1.0


def test_a_table_is_swapped_only_while_the_loop_is_closed():
    loop = Loop([], clock=VirtualClock())
    loop.open()
    with pytest.raises(LoopError, match="close it first"):
        loop.swap([])
    loop.close()
    loop.swap([("want", want_torque, np.array([0.1]))])
    with loop:
        loop.step()
        assert loop.latest().torque.tolist() == [0.1, -0.1]
    assert loop.names == ("want",)


def test_the_table_runs_in_the_order_of_the_contract():
    rig = Rig()
    assert rig.loop.names == (
        "encoders", "plausibility", "velocity", "depth", "machine", "kinematics", "keep", "fixture",
        "push", "give back", "transmission", "governor", "safety", "motors",
    )  # fmt: skip


def test_measuring_a_stages_cost_changes_nothing():
    rig = Rig()
    with rig.loop:
        rig.arm()
        row = rig.loop.latest().row
    for item in rig.table:
        before = item.parameters.copy()
        assert 0.0 < stage_cost(item.function, item.parameters, row) < 1e-3
        assert np.array_equal(item.parameters, before)


@pytest.mark.long("machine")
def test_the_end_of_the_program_closes_the_loop():
    """A program that forgets to close ends by itself, without hanging and with code 0."""
    code = (
        "import time; from app.device.control import Loop\n"
        "loop = Loop([], 500.0); loop.open(); time.sleep(0.05)"
    )
    done = subprocess.run([sys.executable, "-c", code], timeout=100, check=False)
    assert done.returncode == 0


@pytest.mark.long("machine")
def test_every_kernel_of_a_second_start_comes_from_the_disk():
    code = (
        "import numba.core.dispatcher as d\n"
        "made = []; start = d.Dispatcher.__init__\n"
        "d.Dispatcher.__init__ = lambda s, *a, **k: (start(s, *a, **k), made.append(s))[0]\n"
        "from app.device.control import Loop\n"
        "ours = [k for k in made if k.py_func.__module__.startswith('app.')]\n"
        "misses = [k.py_func.__name__ for k in ours if k.stats.cache_misses]\n"
        "assert not misses, misses\n"
        "assert sum(len(k.stats.cache_hits) for k in ours) > 8"
    )
    for _ in range(2):  # the first start compiles what this session has not
        done = subprocess.run(
            [sys.executable, "-c", code], capture_output=True, timeout=110, check=False
        )
    assert done.returncode == 0, done.stderr.decode()


def test_a_loop_at_the_profiles_rate_is_what_the_profile_says():
    assert Loop([], PROFILE.rate_hz, VirtualClock()).rate_hz == 1000.0
