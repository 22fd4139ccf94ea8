"""Cost of the simulated world per tick, and of oblique slices against scipy's.

Processor time of this thread: medians and p99 of repeated runs.
"""

import time
from collections.abc import Callable
from functools import partial
from typing import Any

import numpy as np
from scipy.ndimage import map_coordinates

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.imaging.interpolation import Interpolation
from app.imaging.oblique import oblique_image
from app.mechanisms.profile import load_profile
from app.simulation.consumers import DevicePort
from app.simulation.plan import Stage, compile
from app.simulation.plant import initial_plant, plant_stage
from app.simulation.scene import EffectRequest, Scene
from app.simulation.trainee import trainee_stage
from app.studies.slice_interpolation import oblique_plane, sampled

_TICKS = 2000


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
    plan = compile(scene, DevicePort("icube", simulated=True), views=("target_motion",))
    axis = np.array([0.2, 0.0, -(0.96**0.5)])
    trainee = trainee_stage(axis, 0.08, "novice")
    return [trainee, *plan.stages(), plant_stage(load_profile("icube"))]


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
    print("stage of the tick              median      p99   [ns]")
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
