"""Lateness of the 1 kHz loop beside a thread that never yields the interpreter.

Ours: the compiled loop with the whole force path. Peer: a Python thread that sleeps to the same
absolute deadlines and does nothing else. Both idle and beside a busy pure-Python thread of the same
process. The ratio is taken at normal priority, so that it does not rest on rights that a desktop
may not have; the loop with real-time priority is printed too, where it is granted.

Run as `python -m tests.bench.bench_loop [SECONDS]` (default 6 for each line).
"""

import sys
import threading
import time
from collections.abc import Iterator
from contextlib import contextmanager

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.device.control import Loop, Priority, machine_stages
from app.device.links.simulated import simulated_link
from app.mechanisms.pantograph import inverse
from app.mechanisms.profile import load_profile
from tests.virtual_fixture import VirtualFixture

RATE_HZ = 1000.0
RATIO = 10.0


@contextmanager
def busy_interpreter() -> Iterator[None]:
    """Keep a pure-Python thread busy that gives up the interpreter only when it must."""
    stop = threading.Event()

    def work() -> None:
        total = 0
        while not stop.is_set():
            for k in range(1000):
                total += k * k

    thread = threading.Thread(target=work, daemon=True)
    thread.start()
    try:
        yield
    finally:
        stop.set()
        thread.join()


@contextmanager
def nothing() -> Iterator[None]:
    """No load."""
    yield


def compiled_lateness(seconds: float, priority: Priority) -> tuple[FloatArray, int]:
    """Lateness [s] of every tick of the compiled loop, and the deadlines it missed."""
    profile = load_profile("icube")
    link = simulated_link(profile, [])
    table = machine_stages(profile, [VirtualFixture.of(profile).stage()], [], link)
    left, right = inverse(profile.pantograph, (0.03, 0.18))
    initial = {"plant_q_left": left, "plant_q_right": right}
    with Loop(table, RATE_HZ, initial=initial, priority=priority) as loop:
        while loop.latest().tick == 0:  # the kernel is being compiled or loaded
            time.sleep(0.01)
        end = time.monotonic() + seconds
        while time.monotonic() < end:
            loop.inbox.write(homed=1.0, force_cap=5.0)
            loop.inbox.write(enabled=1.0, assistance=1.0, path_z=-1.0, heartbeat=time.monotonic())
            time.sleep(0.05)
        rows = loop.rows()
        timing = loop.timing()
    if priority is Priority.REALTIME and not timing.realtime:
        print("  (real-time priority was refused: the next line ran at normal priority)")
    return rows[20:, sv.LATENESS], timing.missed


def thread_lateness(seconds: float) -> tuple[FloatArray, int]:
    """Lateness [s] of a Python thread at the same deadlines, and the deadlines it missed."""
    lateness: list[float] = []
    missed = 0

    def run() -> None:
        nonlocal missed
        period = 1.0 / RATE_HZ
        deadline = time.monotonic() + period
        end = time.monotonic() + seconds
        while deadline < end:
            time.sleep(max(0.0, deadline - time.monotonic()))
            late = time.monotonic() - deadline
            lateness.append(late)
            skipped = int(max(late, 0.0) / period)
            missed += skipped
            deadline += (1 + skipped) * period

    thread = threading.Thread(target=run)
    thread.start()
    thread.join()
    return np.array(lateness[20:]), missed


def show(label: str, lateness: FloatArray, missed: int) -> float:
    """Print one distribution in milliseconds and return its median."""
    median, p90, p99, largest = np.percentile(np.maximum(lateness, 0.0), (50, 90, 99, 100)) * 1e3
    print(f"{label:46}{median:9.3f}{p90:9.3f}{p99:9.3f}{largest:9.3f}{missed:8d}")
    return float(median)


def main() -> None:
    """Print all distributions and the ratio of the medians beside the load."""
    seconds = float(sys.argv[1]) if len(sys.argv) > 1 else 6.0
    print(
        f"{f'lateness [ms] at {RATE_HZ:g} Hz':46}"
        f"{'median':>9}{'p90':>9}{'p99':>9}{'max':>9}{'missed':>8}"
    )
    medians = {}
    for name, load in (("idle", nothing), ("busy interpreter", busy_interpreter)):
        with load():
            show(
                f"compiled loop, real-time priority, {name}",
                *compiled_lateness(seconds, Priority.REALTIME),
            )
            medians["ours"] = show(
                f"compiled loop, normal priority, {name}",
                *compiled_lateness(seconds, Priority.NORMAL),
            )
            medians["peer"] = show(f"Python thread, {name}", *thread_lateness(seconds))
    ratio = medians["peer"] / medians["ours"]
    verdict = "reached" if ratio >= RATIO else "NOT reached"
    print(f"median beside the busy interpreter: {ratio:.0f}x better than a Python thread", end="")
    print(f" (to reach: {RATIO:.0f}x: {verdict}; normal priority on both sides)")


if __name__ == "__main__":
    main()
