"""Effects along the needle on a given motion of the tip: each one's own force, tick by tick."""

from collections.abc import Sequence
from typing import NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.parameters import Stage
from app.simulation.consumers import Consumer, DevicePort
from app.simulation.plan import compile
from app.simulation.scene import DEFAULT_LAYERS, EffectRequest, Needle, Scene, TissueLayer

ALL = ("puncture", "cutting", "relaxation", "shaft_friction", "bone_contact", "dimpling")
SIMULATED = DevicePort("icube", simulated=True)
MOTION = Consumer("view target_motion shows it", ("target_shift_x",))


class Motion(NamedTuple):
    """What came of a motion: each effect's force [N], shape (n,); all states, shape (n, SLOTS)."""

    force: dict[str, FloatArray]
    states: FloatArray
    stages: dict[str, Stage]


def stages_of(
    *names: str,
    models: dict[str, str] | None = None,
    layers: Sequence[TissueLayer] = DEFAULT_LAYERS,
    diameter: float = 1.270e-3,
    parameters: dict[str, dict[str, float]] | None = None,
) -> list[Stage]:
    """Compile effects for a simulated needle and for a view of the target's motion."""
    requests = tuple(
        EffectRequest(name, (parameters or {}).get(name, {}), (models or {}).get(name, ""))
        for name in names
    )
    scene = Scene(requests, tuple(layers), Needle(outer_diameter=diameter))
    plan = compile(scene, SIMULATED, [MOTION])
    assert {kept.name for kept in plan.kept} == set(names), plan.dropped
    return plan.stages()


def follow(stages: list[Stage], depths: ArrayLike, steps: ArrayLike = 1e-3) -> Motion:
    """Move the tip through depths [m], one a tick of `steps` [s], the needle upright."""
    path = np.asarray(depths, np.float64)
    times = np.broadcast_to(np.asarray(steps, np.float64), path.shape)
    state, rows = sv.empty_state(), np.empty((len(path), sv.SLOTS))
    force = {stage.name: np.zeros(len(path)) for stage in stages}
    state[sv.AXIS_Z], state[sv.TARGET_Z] = -1.0, -0.08
    for k, (depth, dt) in enumerate(zip(path, times, strict=True)):
        state[sv.PLANT_DEPTH], state[sv.DEPTH], state[sv.TIP_Z] = depth, depth, -depth
        state[sv.DT] = dt
        for name, function, parameters in stages:
            before = 0.0 if name == "clear_effects" else state[sv.AXIAL_FORCE]
            function(state, parameters)
            force[name][k] = state[sv.AXIAL_FORCE] - before
        rows[k] = state
    return Motion(force, rows, {stage.name: stage for stage in stages})


def given_out(force: FloatArray, depths: ArrayLike) -> FloatArray:
    """Energy that an axial force has given to the needle until each tick [J], shape (n,)."""
    mean = 0.5 * (force[1:] + force[:-1])
    return np.concatenate([[0.0], np.cumsum(-mean * np.diff(np.asarray(depths, np.float64)))])
