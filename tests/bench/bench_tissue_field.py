"""What a field of tissue costs: the whole tick beside layers, making it, loading it, its record.

Run as `make bench BENCH=tissue_field`. Built-in patients and, of the shared data, a chest of CT.
Every effect acts, the patient breathes, the needle goes in and out of skin, wall and organ at 20
mm/s while it tilts, and once at 1 m/s. Tables are timed in turn, chunk after chunk, the processor
time of this thread, the shortest of each. To keep: the tick at most 2 x that of layers in the same
run; the field from its cache in 0.5 s, first made in 10 s of processor time; at most 96 MB.
"""

import os
import time
from collections.abc import Sequence
from pathlib import Path
from typing import Any

import numpy as np

from app.compose.exercise_ct import load_field
from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import VirtualClock
from app.core.compiled import stage
from app.core.parameters import Stage
from app.device.control import Loop, kernel
from app.exercises.library import load_exercise
from app.exercises.scene import IN_FIELD, device_of
from app.imaging.body import find_body
from app.imaging.field import TissueField, to_bytes
from app.imaging.phantom.anatomy import anatomy
from app.imaging.phantom.series import phantom_series
from app.imaging.reading import load_ct
from app.imaging.volume import Volume
from app.planning.paths import demonstration_plan
from app.planning.placement import PlacedPlan
from app.planning.plan import Plan
from app.simulation.bound_field import BoundField
from app.simulation.consumers import Consumer, DevicePort
from app.simulation.plan import compile
from app.simulation.scene import EffectRequest, Scene
from app.simulation.tissues import FAT, LIVER, MUSCLE, SKIN

_CHUNK, _CHUNKS = 2000, 100
TICKS, LOAD_S, MAKE_S, MEGABYTES = 2.0, 0.5, 10.0, 96.0
DEVICE = DevicePort("icube", frozenset({"lateral", "axial"}), simulated=True)
EVERYTHING = Consumer("this benchmark reads it", tuple(sv.INDEX))
EFFECTS = (
    *("breathing", "lateral_tissue", "puncture", "cutting", "relaxation", "shaft_friction"),
    *("bone_contact", "dimpling", "bevel"),
)


@stage
def hand(state: FloatArray, p: FloatArray) -> None:
    """Go on by a tick: in and out between two depths, tilting; clear what effects add to."""
    state[sv.TIME] += 1e-3
    p[0] += p[1]
    if p[0] > p[3] or p[0] < p[2]:
        p[1] = -p[1]
    depth, tilt = p[0], 0.05 * np.sin(2.0 * state[sv.TIME])
    state[sv.DEPTH], state[sv.PLANT_DEPTH], state[sv.L_OUT] = depth, depth, 0.2 - depth
    x, y, z = p[4] + tilt * p[7], p[5] + tilt * p[8], p[6] + tilt * p[9]
    size = np.sqrt(x * x + y * y + z * z)
    x, y, z = x / size, y / size, z / size
    state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z] = x, y, z
    state[sv.TIP_X], state[sv.TIP_Y] = p[10] + depth * x, p[11] + depth * y
    state[sv.TIP_Z] = p[12] + depth * z
    for slot in sv.SUMS:
        state[slot] = 0.0


def stages_of(placed: PlacedPlan, field: TissueField | None) -> list[Stage]:
    """Every effect of the measured models, in layers or in the field."""
    more = ("tissue_field", "bone_slide") if field is not None else ()
    bound, values = None, ()
    if field is not None:
        from app.simulation.tissues import tissue_values

        bound = BoundField(field, placed.T_world_patient, placed.p_target)
        values = tissue_values(field.tissues)
    scene = Scene(
        tuple(EffectRequest(name, model=IN_FIELD.get(name, "")) for name in (*EFFECTS, *more)),
        layers=(SKIN, FAT, MUSCLE, LIVER),
        R_world_patient=placed.T_world_patient.rotation,
        target_organ="liver",
        tissues=values,
        field=bound,
    )
    return compile(scene, DEVICE, (EVERYTHING,)).stages()


class Table:
    """Stages behind a hand, as the loop has them; the shortest time of a tick [ns]."""

    def __init__(self, placed: PlacedPlan, stages: Sequence[Stage], speed: float) -> None:
        axis = placed.axis
        side = np.cross(axis, [0.3, 1.0, 0.2])
        length = float(np.linalg.norm(placed.p_target - placed.p_entry))
        moves = np.array([0.0, 1e-3 * speed, -0.005, length, *axis, *side, *placed.p_entry])
        self.functions, self.values = kernel.no_stages(), kernel.no_parameters()
        for _, function, parameters in [Stage("hand", hand, moves), *stages]:
            kernel.append(self.functions, self.values, function, parameters)
        self.state = sv.empty_state()
        self.state[sv.DT], self.state[sv.DEPTH_SOURCE] = 1e-3, 1.0
        self.state[sv.TARGET], self.best = placed.p_target, np.inf

    def time(self) -> None:
        """Time a chunk."""
        start = time.thread_time()
        kernel.repeat(self.state, self.functions, self.values, _CHUNK)
        self.best = min(self.best, (time.thread_time() - start) / _CHUNK * 1e9)


def ticks(name: str, placed: PlacedPlan, field: TissueField) -> None:
    """Print what a tick costs by layers and by the field."""
    for speed in (0.02, 1.0):
        own = {"layers": stages_of(placed, None), "field": stages_of(placed, field)}
        tables = {kind: Table(placed, stages, speed) for kind, stages in own.items()}
        bare = Table(placed, [], speed)
        for _ in range(_CHUNKS):
            for table in (bare, *tables.values()):
                table.time()
        layers, in_field = (tables[kind].best - bare.best for kind in ("layers", "field"))
        print(
            f"{name}, {speed:g} m/s: every effect {layers:.0f} ns a tick in layers, {in_field:.0f}"
            f" in the field: x {in_field / layers:.2f} (at most {TICKS:g})"
        )


def loop_of(placed: PlacedPlan, field: TissueField) -> None:
    """Print what a checkpoint of a loop that looks into a field holds and takes."""
    loop = Loop(stages_of(placed, field), clock=VirtualClock(1.0))
    loop.open()
    loop.step(10)
    times = []
    for _ in range(20):
        start = time.perf_counter()
        size = loop.checkpoint().parameters.nbytes
        times.append(time.perf_counter() - start)
    loop.close()
    print(
        f"  a checkpoint: {size / 1e3:.0f} kB of {field.megabytes:.0f} MB, in"
        f" {1e3 * float(np.median(times)):.2f} ms"
    )


def patient(name: str, exercise: Any, volume: Volume, plan: Plan) -> None:
    """Print all figures of a patient."""
    from app.imaging.field.making import make

    placed = PlacedPlan.of(plan, exercise.placement.placement(), device_of(exercise).fulcrum)
    size = "x".join(map(str, volume.size))
    start = time.process_time()
    made = make(volume, (), plan.entry_mm)
    took = time.process_time() - start
    load_field(exercise, volume, plan)
    start = time.perf_counter()
    field = load_field(exercise, volume, plan)
    load = time.perf_counter() - start
    assert field is not None
    start = time.perf_counter()
    packed = len(to_bytes(field))
    pack = time.perf_counter() - start
    print(
        f"\n{name}, CT {size}: made in {took:.1f} s of processor time (at most {MAKE_S:g}), from"
        f" the cache in {load:.2f} s (at most {LOAD_S:g}), {field.megabytes:.0f} MB (at most"
        f" {MEGABYTES:g}; within reach alone {made.megabytes:.0f}), packed {packed / 1e6:.2f} MB in"
        f" {pack:.1f} s"
    )
    ticks(name, placed, field)
    loop_of(placed, field)


def main() -> None:
    """Print the figures of two built-in patients and of the chest."""
    exercise = load_exercise("first-insertion")
    for seed in (6, 1001):
        known = anatomy(seed)
        plan = Plan(np.array(known.entry_mm), np.array(known.lesion_mm), "bench")
        patient(f"built-in patient {seed}", exercise, load_ct(phantom_series(seed)), plan)
    chest = Path(os.environ.get("ACUS_TEST_DATA", "../shared/data")) / "ct_chest_lidc0314"
    if chest.is_dir():
        volume = load_ct(chest)
        patient("chest", exercise, volume, demonstration_plan(volume, find_body(volume)))
    else:
        print("\nno chest: ACUS_TEST_DATA names the folder of the shared data")


if __name__ == "__main__":
    main()
