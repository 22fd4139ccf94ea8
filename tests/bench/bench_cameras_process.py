"""Simulated cameras and tracker as threads, as a process of their own, and as good as nothing.

Three windows in turns, each in a process of its own, each with five slice panes and the 3D view or
the bull's-eye, an exercise running and the simulated hand going to and fro as in `needle_age`:

- `threads`: cameras and tracker are threads of the program, as it is;
- `process`: they are in a child (`cameras_apart`): loop's history and pictures in shared memory,
  the fix as latest value;
- `nothing`: thirty invented fixes a second, no camera and no picture. What any other way of having
  cameras may gain at most.

Printed for each: processor time of the window's thread for each look at the trainer, states painted
a second and their age in the slowest pane, rate of the tracker and time from capture to fix,
lateness of the loop, processor time of program and child. The decision is docs/decisions/0016.

`ACUS_BENCH_SECONDS` is how long each is watched. The first argument `alone` or `busy` (beside a
program that keeps one core busy) does one of both only, the second is the number of rounds.
"""

import json
import os
import subprocess
import sys
import time
from pathlib import Path
from typing import Any

import numpy as np

from app.compose import trainer
from app.compose.cameras import AttachedCameras
from app.core import state_vector as sv
from app.device.control import loop as loops
from tests.bench import bench_needle_age as needle_age
from tests.bench.cameras_apart import (
    ApartTracker,
    CheapTracker,
    LoopSeen,
    SharedHistory,
    Wanted,
    picture_ring,
)
from tests.bench.window_load import Session, pump

SECONDS = float(os.environ.get("ACUS_BENCH_SECONDS", "10"))
ROOT = Path(__file__).resolve().parents[2]
WAYS = ("threads", "process", "nothing")
WORTH = 0.10
"""Share of the window's thread for each look from which a process would be worth its keep."""


class Made:
    """What the program was given in place of its own tracker."""

    tracker: Any = None


def put_in_place(way: str) -> None:
    """Let the next trainer have its cameras in this way."""
    if way == "threads":
        return
    histories: list[SharedHistory] = []
    seeds: list[int] = []

    def history() -> SharedHistory:
        histories.append(SharedHistory())
        return histories[-1]

    def without_pictures(rig: Any, scene_of: Any, clock: Any, seed: int) -> Any:
        seeds.append(seed)
        nobody: Any = (None, None)
        return AttachedCameras(nobody, rig, {"name": rig.name, "simulated": "yes"})

    def tracker(_cameras: Any, rig: Any, *_: Any, fulcrum: Any, on_fix: Any, **__: Any) -> Any:
        profile = profiles[-1]
        if way == "nothing":
            seen = LoopSeen(histories[-1], profile.rate_hz)
            Made.tracker = CheapTracker(rig, seen, fulcrum, on_fix)
        else:
            pictures, ring = picture_ring(rig)
            wanted = Wanted(profile, rig, seeds[-1], histories[-1].descriptor, pictures)
            Made.tracker = ApartTracker(wanted, ring, on_fix)
        return Made.tracker

    profiles: list[Any] = []
    device_of = trainer.device_of

    def profile_of(exercise: Any) -> Any:
        profiles.append(device_of(exercise))
        return profiles[-1]

    places: Any = trainer
    loops.TickHistory = history  # type: ignore[misc, assignment]
    places.device_of, places.simulated_on, places.Tracker = profile_of, without_pictures, tracker


def watch(session: Session, hand: Any, counters: dict[str, Any]) -> dict[str, Any]:
    """Count for a while in the panes that are seen."""
    trainer = session.window.conductor.controller.run.trainer
    child = Made.tracker.processor_seconds if Made.tracker is not None else lambda: 0.0
    loop, begin = trainer._loop, trainer._loop.latest().tick
    start, looks = time.monotonic(), hand.looks
    window, whole, apart = time.thread_time(), time.process_time(), child()
    pump(lambda: False, SECONDS)
    window, whole, apart = (
        time.thread_time() - window, time.process_time() - whole, child() - apart
    )  # fmt: skip
    took, looks = time.monotonic() - start, hand.looks - looks
    late = 1e3 * loop.rows(begin)[:, sv.LATENESS]
    rates, ages, old = [], [], []
    for counter in counters.values():
        times = np.array(counter.times)
        inside = (times >= start) & (times <= start + took)
        if not inside.any():
            continue  # not seen now
        found = 1e3 * np.array(counter.ages)[inside]
        rates.append(float(inside.sum() / took))
        ages.append(float(np.median(found)))
        old.append(float(np.percentile(found, 99)))
    tracker = trainer.snapshot().tracker
    return {
        "looks": looks / took, "window": 1e3 * window / max(looks, 1), "rate": min(rates),
        "age": max(ages), "age99": max(old), "late99": float(np.percentile(late, 99)),
        "fixes": tracker.rate, "valid": tracker.valid_share, "latency": 1e3 * tracker.latency,
        "program": whole / took, "child": apart / took,
    }  # fmt: skip


def side(way: str) -> None:
    """Watch one way; print a line of JSON for each picture of the window."""
    put_in_place(way)
    needle_age._tell_paintings()
    session = Session()
    session.open_exercise()
    window = session.window
    pump(lambda: window.conductor.settled, 60.0)
    workspace = window.workspace
    workspace.show_bullseye(False)
    workspace.show_layout("6-up")
    workspace.viewing.set_follows_tip(True)
    hand, kept = needle_age.Hand(session), []
    counters = {}
    for pane in (*workspace.panes, *workspace.needle_panes):
        if pane.isVisible():
            counters[str(pane.pane)] = needle_age.Painted(hand)
            kept.append(needle_age.SlicePaintings(pane, hand, counters[str(pane.pane)]))
    pad = counters["bull's-eye"] = needle_age.Painted(hand)
    needle_age.PADDED.append(lambda canvas: pad.note(canvas._view, hand.tick_time))
    for sixth in ("3D view", "bull's-eye"):
        workspace.show_bullseye(sixth == "bull's-eye")
        pump(lambda: False, 3.0)
        print("FOUND " + json.dumps({"sixth": sixth} | watch(session, hand, counters)), flush=True)
    session.close()


def run(way: str) -> list[dict[str, Any]]:
    """What a window finds that has its cameras in this way."""
    done = subprocess.run(
        [sys.executable, "-m", "tests.bench.bench_cameras_process", "side", way],
        cwd=ROOT, capture_output=True, text=True, check=False,
    )  # fmt: skip
    found = [
        json.loads(line.removeprefix("FOUND "))
        for line in done.stdout.splitlines()
        if line.startswith("FOUND ")
    ]
    if len(found) != 2:
        sys.exit(f"{way} gave no figures:\n{done.stdout[-2000:]}\n{done.stderr[-4000:]}")
    return found


def show(name: str, way: str, result: dict[str, Any]) -> None:
    """Print one line."""
    print(
        f"{name:<6}{result['sixth']:<12}{way:<9}{result['window']:6.2f} ms/look"
        f"{result['looks']:6.1f} looks/s   panes ≥{result['rate']:6.1f}/s, "
        f"age {result['age']:5.1f} (p99 {result['age99']:5.1f}) ms   "
        f"tracker {result['fixes']:5.1f}/s, {result['latency']:5.1f} ms, "
        f"{result['valid']:4.0%} valid   loop late p99 {result['late99']:.3f} ms   "
        f"cores {result['program']:.2f} + {result['child']:.2f}",
        flush=True,
    )


def main() -> None:
    """All ways in turns, then their medians and what the child gains."""
    if sys.argv[1:2] == ["side"]:
        return side(sys.argv[2])
    wanted = sys.argv[1:2] or ["alone", "busy"]
    rounds = int(sys.argv[2]) if len(sys.argv) > 2 else 2
    for name in wanted:
        all_found: dict[tuple[str, str], list[dict[str, Any]]] = {}
        for number in range(rounds):
            for way in WAYS if number % 2 == 0 else WAYS[::-1]:
                other = None
                if name == "busy":
                    other = subprocess.Popen([sys.executable, "-c", "while True: pass"])
                try:
                    for found in run(way):
                        show(name, way, found)
                        all_found.setdefault((found["sixth"], way), []).append(found)
                finally:
                    if other is not None:
                        other.kill()
                        other.wait()
        for sixth in ("3D view", "bull's-eye"):
            cost = {
                way: float(np.median([one["window"] for one in all_found[sixth, way]]))
                for way in WAYS
            }
            gain = {way: 1.0 - cost[way] / cost["threads"] for way in WAYS[1:]}
            print(
                f"{name}, with the {sixth}: of the window's thread for each look a process saves "
                f"{gain['process']:.0%}, nothing at all {gain['nothing']:.0%}; "
                f"worth it from {WORTH:.0%}",
                flush=True,
            )


if __name__ == "__main__":
    main()
