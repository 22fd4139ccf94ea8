"""Fields of tissue from distances that are known everywhere, and a needle on a way in them."""

from collections.abc import Callable, Sequence

import numpy as np
from numpy.typing import ArrayLike

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.parameters import Stage
from app.core.transform import RigidTransform
from app.imaging.field import STEPS_PER_MM, FieldTissue, TissueField, TissueKind
from app.imaging.field.tissue_field import FARTHEST
from app.simulation.bound_field import BoundField
from app.simulation.consumers import Consumer, DevicePort
from app.simulation.plan import compile
from app.simulation.scene import EffectRequest, Needle, Scene, TissueLayer
from app.simulation.tissues import tissue_values

Distance = Callable[[FloatArray], FloatArray]
"""Signed distance of points [mm], (n, 3) -> (n,), from a tissue's boundary, positive inside."""

ALL = (
    *("tissue_field", "puncture", "cutting", "relaxation", "shaft_friction"),
    *("bone_contact", "bone_slide", "lateral_tissue", "dimpling"),
)
SIMULATED = DevicePort("icube", frozenset({"lateral", "axial"}), simulated=True)
LOOKS = Consumer(
    "the test looks",
    ("tissue", "tissue_ahead", "wall_x", "channel", "target_shift_x", "bone_crossed"),
)


def field_of(
    tissues: Sequence[tuple[str, str, Distance]],
    low: ArrayLike = (-30.0, -30.0, -70.0),
    high: ArrayLike = (30.0, 30.0, 20.0),
    spacing: float = 1.0,
) -> TissueField:
    """Return a field in which each voxel has the tissue that it lies deepest in.

    Args:
        tissues: (kind, name, distance) of the codes from 1 on.
        low, high: corners of the grid [mm].
        spacing: of the grid [mm].
    """
    axes = [np.arange(a, b + 1e-9, spacing) for a, b in zip(low, high, strict=True)]
    grid = np.stack(np.meshgrid(*axes, indexing="ij"), axis=-1)
    shape = grid.shape[:3]
    inside = np.stack([one(grid.reshape(-1, 3)) for _, _, one in tissues])
    order = np.argsort(-inside, axis=0, kind="stable")
    rows = np.arange(inside.shape[1])
    first, second = inside[order[0], rows], inside[order[1], rows]
    steps = np.clip(np.rint(STEPS_PER_MM * 0.5 * (first - second)), 0, FARTHEST)
    labels = (order[0] + 1).reshape(shape).transpose(2, 1, 0)
    distance = steps.reshape(shape).transpose(2, 1, 0)
    affine = np.diag([spacing, spacing, spacing, 1.0])
    affine[:3, 3] = low
    table = [FieldTissue(0, TissueKind.UNKNOWN)]
    table += [FieldTissue(n, TissueKind(k), name) for n, (k, name, _) in enumerate(tissues, 1)]
    return TissueField(
        np.ascontiguousarray(labels, np.uint8),
        np.ascontiguousarray(distance, np.int8),
        affine,
        tuple(table),
    )


def slab(top: float, bottom: float) -> Distance:
    """Return the tissue between two heights along z [mm], the needle going down."""
    return lambda points: np.minimum(top - points[:, 2], points[:, 2] - bottom)


def layered(
    *thicknesses: tuple[str, float], above: float = 100.0
) -> list[tuple[str, str, Distance]]:
    """Return air above z = 0 and tissues below, by kind and thickness [mm]; the last goes on."""
    found = [("air", "", slab(above, 0.0))]
    top = 0.0
    for kind, thickness in thicknesses:
        found.append((kind, "", slab(top, top - thickness)))
        top -= thickness
    return found


def scene_in(
    field: TissueField,
    *names: str,
    target: ArrayLike = (0.0, 0.0, -0.05),
    models: dict[str, str] | None = None,
    parameters: dict[str, dict[str, float]] | None = None,
    pose: RigidTransform | None = None,
    values: Sequence[TissueLayer] | None = None,
    needle: Needle | None = None,
) -> Scene:
    """Return a scene in a field; each effect by the model that it has there."""
    from app.exercises.scene import IN_FIELD

    bound = BoundField(field, pose or RigidTransform(np.eye(3), np.zeros(3)), np.array(target))
    chosen = {**IN_FIELD, **(models or {})}
    return Scene(
        tuple(EffectRequest(n, (parameters or {}).get(n, {}), chosen.get(n, "")) for n in names),
        tissues=tuple(values or tissue_values(field.tissues)),
        field=bound,
        needle=needle or Needle(),
        R_world_patient=bound.T_world_patient.rotation,
    )


def stages_in(scene: Scene, device: DevicePort = SIMULATED) -> list[Stage]:
    """Compile a scene of a field for somebody who looks at all of it."""
    plan = compile(scene, device, [LOOKS])
    left = {dropped.name for dropped in plan.dropped}
    assert left <= (set() if scene.bones else {"bone_contact", "bone_slide"}), plan.dropped
    return plan.stages()


def go(
    stages: Sequence[Stage],
    tips: ArrayLike,
    fulcrum: ArrayLike = (0.0, 0.0, 0.0),
    axis: ArrayLike | None = None,
    dt: float = 1e-3,
    state: FloatArray | None = None,
    before: Callable[[int, FloatArray], None] = lambda k, state: None,
) -> FloatArray:
    """Hold the straight needle's tip at points [m], one a tick; returns all states, (n, SLOTS).

    Args:
        stages: of the effects.
        tips: shape (n, 3).
        fulcrum: where the needle goes through.
        axis: of the needle, where its tip does not say it.
        dt: of a tick.
        state: to go on with.
        before: called with a tick's number and the state once the effects' slots are cleared.
    """
    state = sv.empty_state() if state is None else state
    points, centre = np.asarray(tips, np.float64), np.asarray(fulcrum, np.float64)
    rows = np.empty((len(points), sv.SLOTS))
    for k, tip in enumerate(points):
        way = tip - centre
        direction = np.array([0.0, 0.0, -1.0])
        if axis is not None:
            direction = np.asarray(axis, np.float64)
        elif np.linalg.norm(way) > 1e-9:
            direction = way / np.linalg.norm(way) * (-1.0 if way[2] > 0.0 else 1.0)
        depth = float(way @ direction)
        state[sv.SUMS,] = 0.0
        state[sv.AXIS], state[sv.TIP] = direction, tip
        state[sv.DEPTH] = state[sv.PLANT_DEPTH] = depth
        state[sv.DEPTH_SOURCE], state[sv.L_OUT] = 1.0, 0.2 - depth
        state[sv.DT], state[sv.TIME] = dt, state[sv.TIME] + dt
        state[sv.TARGET_Z] = -0.05
        for name, function, parameters in stages:
            function(state, parameters)
            if name == "clear_effects":
                before(k, state)
        rows[k] = state
    return rows


def straight(start: float, end: float, step: float) -> FloatArray:
    """Return points down the z axis from one depth to another [m], `step` a tick."""
    count = max(2, round(abs(end - start) / step) + 1)
    return np.column_stack([np.zeros((count, 2)), -np.linspace(start, end, count)])
