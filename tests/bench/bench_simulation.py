"""Cost of the simulated world per tick, of whole scenes, and of oblique slices against scipy's.

Stages and slices: processor time of this thread, medians and p99 of repeated runs. Scenes: tables
of compiled functions as the loop runs them, timed in turn, chunk after chunk; the shortest chunk of
each, so that what else the computer does falls out. Each figure stands with its ratio to the limit.
"""

import time
from collections.abc import Callable, Sequence
from dataclasses import replace
from functools import partial
from typing import Any

import numpy as np
from scipy.ndimage import map_coordinates

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import VirtualClock
from app.core.compiled import njit, stage
from app.device.control import Loop, kernel, machine_stages
from app.device.control.table import protected
from app.device.links.simulated import simulated_link
from app.imaging.interpolation import Interpolation
from app.imaging.oblique import oblique_image
from app.mechanisms.profile import load_profile
from app.simulation.consumers import Consumer, DevicePort
from app.simulation.effects import declaration, effect_names
from app.simulation.effects.lateral_tissue import BIN
from app.simulation.plan import SimulationPlan, Stage, compile
from app.simulation.plant import initial_plant, plant_stage
from app.simulation.scene import EffectRequest, Scene
from app.simulation.trainee import trainee_stage
from app.studies.slice_interpolation import oblique_plane, sampled
from tests.simulation.effect_rig import whole_scene

_TICKS = 2000
_CHUNK, _CHUNKS = 1000, 200
EVERYTHING = Consumer("this benchmark reads it", tuple(sv.INDEX))
DEVICE = DevicePort("icube", frozenset({"lateral", "axial"}), simulated=True)
BONE = 0.13
"""Depth of the bone [m]: the hand's needle does not come there."""

LIMITS = {"empty": 20.0, "closed form": 150.0, "beam": 5000.0}
"""More than the bare loop [ns a tick]."""

CHANGE_MS = 50.0


@njit
def _repeat(stage: Any, state: FloatArray, parameters: FloatArray, ticks: int) -> None:
    for _ in range(ticks):
        state[sv.TIME] += 1e-3
        stage(state, parameters)


def _times(run: Callable[[], object], repeats: int) -> FloatArray:
    run()
    times = np.empty(repeats)
    for k in range(repeats):
        start = time.thread_time()
        run()
        times[k] = time.thread_time() - start
    return times


def _stages() -> list[Stage]:
    names = ("lateral_tissue", "shaft_friction", "breathing")
    scene = Scene(effects=tuple(EffectRequest(name) for name in names))
    plan = compile(scene, DevicePort("icube", simulated=True), views=(EVERYTHING,))
    axis = np.array([0.2, 0.0, -(0.96**0.5)])
    trainee = trainee_stage(axis, 0.08, "novice")
    return [trainee, *plan.stages(), plant_stage(load_profile("icube"))]


@stage
def hand(state: FloatArray, p: FloatArray) -> None:
    """Go on by a tick: in and out by 20 mm/s about 60 mm, tilting; clear what effects add to."""
    state[sv.TIME] += 1e-3
    state[sv.TICK] += 1.0
    p[0] += p[1]
    if abs(p[0]) > 0.01:
        p[1] = -p[1]
    depth, tilt = 0.06 + p[0], 0.2 + p[0]
    state[sv.DEPTH], state[sv.PLANT_DEPTH], state[sv.L_OUT] = depth, depth, 0.2 - depth
    state[sv.AXIS_X], state[sv.AXIS_Z] = tilt, -np.sqrt(1.0 - tilt * tilt)
    for slot in sv.SUMS:
        state[slot] = 0.0


def loop_effects() -> list[str]:
    """Names of the effects that run in the tick; all but those on camera pictures."""
    return [name for name in effect_names() if not declaration(name).pictures]


def scene_of(names: Sequence[str], tissue: str = "winkler", organ: str = "") -> SimulationPlan:
    """Plan of a scene of effects, the tissue by a model; breathing of an organ."""
    requests = [
        EffectRequest(
            name,
            model=tissue if name == "lateral_tissue" else "",
            organ=organ if name == "breathing" else "",
        )
        for name in names
    ]
    scene = whole_scene(requests, BONE)
    return compile(replace(scene, target_organ="liver"), DEVICE, (EVERYTHING,))


class Table:
    """The bare loop with stages behind its hand, as the loop has them."""

    def __init__(self, stages: Sequence[Stage]) -> None:
        self.functions, self.values = kernel.no_stages(), kernel.no_parameters()
        for _, function, parameters in [Stage("hand", hand, np.array([0.0, 2e-5])), *stages]:
            kernel.append(self.functions, self.values, function, parameters)
        self.state = _state()
        self.best = np.inf

    def time(self) -> float:
        """Time a chunk of ticks; ns a tick."""
        start = time.perf_counter()
        kernel.repeat(self.state, self.functions, self.values, _CHUNK)
        found = (time.perf_counter() - start) / _CHUNK * 1e9
        self.best = min(self.best, found)
        return found


def scenes() -> None:
    """Print what whole scenes cost of a tick, over the bare loop and in turn with it."""
    names = loop_effects()
    others = [name for name in names if name != "breathing"]
    alone = {name: Table(scene_of([name]).stages()) for name in names}
    tables = {
        "bare loop": Table([]),
        "empty": Table(scene_of([]).stages()),
        "closed form": Table(scene_of(names).stages()),
        "kept apart": Table(protected(scene_of(names).stages())),
        "beam": Table(scene_of(names, "beam").stages()),
        "not asked for": Table(scene_of(others).stages()),
        "switched off": Table(scene_of(names, organ="lung").stages()),
    }
    for _ in range(_CHUNKS):
        for table in (*tables.values(), *alone.values()):
            table.time()
    best = {name: table.best for name, table in tables.items()}
    bare = best["bare loop"]
    nodes = round(0.2 / BIN)
    words = {
        "empty": "empty scene",
        "closed form": f"{len(names)} closed-form effects",
        "beam": f"all effects, needle as a beam of {nodes} bins of {1e3 * BIN:g} mm",
    }
    print(f"\nscenes, shortest of {_CHUNKS} chunks in turn; bare loop {bare:.1f} ns a tick")
    for name, text in words.items():
        more, limit = best[name] - bare, LIMITS[name]
        print(
            f"{text:58} {more:8.1f} ns more  × {best[name] / bare:6.2f}   "
            f"{more / limit:5.2f} of {limit:g} ns"
        )
    costs = sorted(((one.best - bare, name) for name, one in alone.items()), reverse=True)
    print("  each alone: " + ", ".join(f"{name} {cost:.0f}" for cost, name in costs) + " ns")
    apart = best["kept apart"] - best["closed form"]
    print(f"{'  and keeping the state from what they may not write':58} {apart:8.1f} ns more")
    ratio = best["switched off"] / best["not asked for"]
    print(f"{'an effect switched off / not asked for (reach 1.00 ± 0.02)':58} {ratio:8.3f}")


def change() -> None:
    """Print how long a running loop takes to go on in another scene, kernels cached on disk."""
    profile = load_profile("icube")

    def table(names: Sequence[str]) -> Any:
        link = simulated_link(profile, [plant_stage(profile)])
        return machine_stages(profile, [], scene_of(names).stages(), link)

    names = loop_effects()
    loop = Loop(table([]), profile.rate_hz, VirtualClock(10.0))
    loop.open()
    loop.step(20)
    times = []
    for asked in (names, *([], names) * 5):
        start = time.perf_counter()
        loop.exchange(loop.table.continued(table(asked))[0])
        loop.step(1)
        times.append(1e3 * (time.perf_counter() - start))
    loop.close()
    first, again = times[0], min(times[2::2])
    print("\na running loop goes on in a scene of all effects")
    for text, found in (
        ("effects loaded from the cache", first),
        ("once more, shortest of five", again),
    ):
        print(f"{text:58} {found:8.1f} ms        {found / CHANGE_MS:5.2f} of {CHANGE_MS:g} ms")


def _state() -> FloatArray:
    state = sv.empty_state()
    for name, value in initial_plant(load_profile("icube"), (0.2, 0.0, -0.98), 0.06).items():
        state[sv.INDEX[name]] = value
    state[sv.DT], state[sv.TIME], state[sv.DEPTH], state[sv.L_OUT] = 1e-3, 1.0, 0.06, 0.14
    state[sv.ENABLED] = 1.0
    state[sv.DEPTH_SOURCE], state[sv.AXIS_X], state[sv.AXIS_Z] = 1.0, 0.2, -0.98
    return state


def main() -> None:
    """Print the figures."""
    change()  # first: nothing of the effects is loaded yet
    scenes()
    print("\nstage of the tick              median      p99   [ns]")
    for name, function, parameters in _stages():
        state = _state()
        times = _times(partial(_repeat, function, state, parameters, _TICKS), 100) / _TICKS * 1e9
        print(f"{name:28} {np.median(times):8.1f} {np.percentile(times, 99):8.1f}")
    volume, plane = sampled(10.0), oblique_plane()
    coordinates = volume.voxel(plane.points_mm().reshape(-1, 3)).T[::-1].copy()
    print(
        "\noblique 512 x 512              ours    scipy  [ms]  ratio (smaller is better; reach 0.5)"
    )
    for way, order in ((Interpolation.NEAREST, 0), (Interpolation.TRILINEAR, 1)):
        ours = np.median(_times(partial(oblique_image, volume, plane, way), 15)) * 1e3
        peer = np.median(_times(partial(map_coordinates, volume.hu, coordinates, order=order), 7))
        print(f"{way.value:28} {ours:6.2f} {peer * 1e3:8.2f}        {ours / (peer * 1e3):.2f}")


if __name__ == "__main__":
    main()
