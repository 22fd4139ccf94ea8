"""What a trial costs: processor time per 15 s of an attempt, beside what shows the same attempt.

Run as `python -m tests.bench.bench_trial`. Ours is `compose.trial`; beside it, in the same run, the
headless demonstration's own parts: the same attempt with both cameras' pictures rendered and
tracked, which is what the trial leaves out (slices and 3D, which it draws too, are not counted).
The aim is 0.1 s per 15 s.
"""

import time
from time import process_time

from app.compose.needle import measured_axis, needle_scene
from app.compose.trainer import TrainerSetup, build_loop
from app.compose.trial import SampledTracker, attempt, trial_plan
from app.core.clock import VirtualClock
from app.exercises.library import load_exercise
from app.exercises.scene import device_of, placed_plan_of
from app.tracking.optics.rig import load_rig
from app.tracking.simulated.cameras import simulated_cameras
from app.tracking.tracker import Tracker

AIM = 0.1
SECONDS = 15.0


def per_15_s(skill: str, seeds: range) -> float:
    """Processor time of whole trials, scaled to 15 s of virtual time [s]: the least of all."""
    exercise = load_exercise("first-insertion")
    placed = placed_plan_of(exercise, device_of(exercise), trial_plan(exercise))
    costs = []
    for seed in seeds:
        start = process_time()
        result = attempt(exercise, placed, skill, seed)
        costs.append((process_time() - start) * SECONDS / result.duration)
    return min(costs)


def loop_alone() -> float:
    """Processor time of 15 s of the compiled loop alone [s]."""
    exercise = load_exercise("first-insertion")
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
    exercise = load_exercise("first-insertion")
    profile, clock, rig = device_of(exercise), VirtualClock(10.0), load_rig(exercise.rig)
    placed = placed_plan_of(exercise, profile, trial_plan(exercise))
    loop = build_loop(TrainerSetup(exercise, placed, clock=clock), profile)
    loop.open()
    loop.step(500)
    scene, axis = needle_scene(loop, profile, rig.needle.marker_offset), measured_axis(loop)
    cameras = simulated_cameras(rig, scene, clock, 1)
    tracker = Tracker(cameras, rig, clock, axis, profile.pantograph.fulcrum)
    sampled = SampledTracker(rig, profile.pantograph.fulcrum, scene, axis)
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
    ours = per_15_s("expert", range(1, 6))
    rendered, sampled = pictures()
    print(f"per {SECONDS:g} s of virtual time, processor time:")
    print(f"  trial, whole                     {ours:7.3f} s   aim {AIM} s")
    print(f"    of it the loop's ticks         {loop_alone():7.3f} s")
    print(f"    of it the sampled fixes        {sampled:7.3f} s")
    print(f"  fixes from rendered pictures     {rendered:7.3f} s")
    whole = ours - sampled + rendered
    print(f"  the same attempt, rendered       {whole:7.3f} s   {whole / ours:.1f} × a trial")
    print(f"  (measured in {time.perf_counter() - began:.0f} s)")


if __name__ == "__main__":
    main()
