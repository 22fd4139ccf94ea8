"""What a trial costs: processor time per 15 s of an attempt, beside what shows the same attempt.

Run as `python -m tests.bench.bench_trial`. Ours is `compose.trial.Trials`; beside it, in the same
run, the same attempt through a running trainer with sampled fixes (`attempt`), and that with both
cameras' pictures rendered and tracked as in the headless demonstration (slices and 3D, which it
draws too, are not counted). The aim is 0.1 s per 15 s.
"""

import time
from statistics import median
from time import process_time

from app.compose.exercise_field import trial_plan
from app.compose.needle import measured_axis, needle_scene
from app.compose.trainer import TrainerSetup, build_loop
from app.compose.trial import Trials, attempt
from app.core.clock import VirtualClock
from app.exercises.scene import device_of, placed_plan_of
from app.tracking.optics.rig import load_rig
from app.tracking.simulated.cameras import simulated_cameras
from app.tracking.simulated.sampled import SampledTracker
from app.tracking.tracker import Tracker
from tests.layered import layered

AIM = 0.1
SECONDS = 15.0


def per_15_s(skill: str, seeds: range) -> tuple[float, float, float]:
    """Processor time, median over the seeds, scaled to 15 s of virtual time [s].

    Returns:
        What is prepared once for an exercise (not scaled), a trial, the same by a trainer.
    """
    exercise = layered("first-insertion")
    placed = placed_plan_of(exercise, device_of(exercise), trial_plan(exercise))
    start = process_time()
    trials = Trials(exercise, placed)
    prepared = process_time() - start
    costs: tuple[list[float], list[float]] = ([], [])
    for seed in seeds:
        start = process_time()
        duration = trials.score(skill, seed).duration
        middle = process_time()
        attempt(exercise, placed, skill, seed)
        end = process_time()
        costs[0].append((middle - start) * SECONDS / duration)
        costs[1].append((end - middle) * SECONDS / duration)
    return prepared, median(costs[0]), median(costs[1])


def loop_alone() -> float:
    """Processor time of 15 s of the compiled loop alone [s]."""
    exercise = layered("first-insertion")
    profile, clock = device_of(exercise), VirtualClock(10.0)
    placed = placed_plan_of(exercise, profile, trial_plan(exercise))
    loop = build_loop(TrainerSetup(exercise, placed, skill="expert", clock=clock), profile)
    loop.open()
    loop.step(1000)
    start = process_time()
    for _ in range(750):
        loop.step(20)
    cost = process_time() - start
    loop.close()
    return cost


def pictures(count: int = 45) -> tuple[float, float]:
    """Processor time of 15 s of fixes [s]: rendered and tracked, and sampled."""
    exercise = layered("first-insertion")
    profile, clock, rig = device_of(exercise), VirtualClock(10.0), load_rig(exercise.rig)
    placed = placed_plan_of(exercise, profile, trial_plan(exercise))
    loop = build_loop(TrainerSetup(exercise, placed, clock=clock), profile)
    loop.open()
    loop.step(500)
    scene, axis = needle_scene(loop, profile, rig.needle.marker_offset), measured_axis(loop)
    cameras = simulated_cameras(rig, scene, clock, 1)
    tracker = Tracker(cameras, rig, clock, axis, profile.fulcrum)
    sampled = SampledTracker(rig, profile.fulcrum, scene, axis)
    for camera in cameras:
        camera.open()
    costs = [0.0, 0.0]
    for k in range(count + 5):
        loop.step(33)
        start = process_time()
        tracker.process(*(camera.read() for camera in cameras))
        middle = process_time()
        sampled.fix(clock.now())
        end = process_time()
        if k >= 5:  # the first ones search
            costs[0] += middle - start
            costs[1] += end - middle
    loop.close()
    scale = SECONDS * rig.rate_hz / count
    return costs[0] * scale, costs[1] * scale


def main() -> None:
    """Print all of it."""
    per_15_s("expert", range(1))  # kernels, imports
    began = time.perf_counter()
    found = {skill: per_15_s(skill, range(1, 8)) for skill in ("novice", "expert")}
    rendered, sampled = pictures()
    print(f"per {SECONDS:g} s of virtual time, processor time, aim {AIM} s:")
    for skill, (prepared, ours, trainer) in found.items():
        print(f"  {skill}: trial                    {ours:7.3f} s, {prepared:.2f} s once before")
        print(
            f"    through a trainer             {trainer:7.3f} s   {trainer / ours:.1f} × a trial"
        )
        whole = trainer - sampled + rendered
        print(f"    with rendered pictures        {whole:7.3f} s   {whole / ours:.1f} × a trial")
    print(f"  the loop's ticks alone          {loop_alone():7.3f} s")
    print(f"  fixes: sampled {sampled:.3f} s, from rendered pictures {rendered:.3f} s")
    print(f"  (measured in {time.perf_counter() - began:.0f} s)")


if __name__ == "__main__":
    main()
