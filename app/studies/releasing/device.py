"""A simulated robot whose needle is held under the largest force to be had, then let go.

Beside the run stands its twin: the same needle from the same state with the motors off, its weight
on. What the run has beyond it is what the program's forces gave.
"""

from collections.abc import Iterable
from dataclasses import dataclass
from enum import StrEnum
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import STAGE_TYPE, njit, stage
from app.core.parameters import Stage, numbered
from app.device.control import kernel, machine_stages
from app.device.links.simulated import simulated_link
from app.mechanisms import dynamic_model as dm
from app.mechanisms.lever import axis_kernel, hub_velocity_kernel
from app.mechanisms.pantograph.dynamics import dynamics_kernel
from app.mechanisms.pantograph.kernels import forward_kernel, jacobian_kernel
from app.mechanisms.pantograph.profile import PantographProfile
from app.simulation.plant import SimulatedHand, initial_plant, plant_stage
from app.studies.releasing.before import fixed_speed

from numba import types  # isort: skip  (after core.compiled)

HELD: Final = 80
"""Ticks under force before the hand lets go: what the growth of the torque needs, four times."""
RUNS: Final = 120
"""Ticks of the run: all but the slowest are noticed within 30."""
AFTER: Final = 50
"""Ticks for which a run counts after letting go was noticed: then the needle's weight rules."""
_CLAMP: Final = SimulatedHand(stiffness=5000.0, damping=50.0)
"""A hand of flesh would give way to a force that comes in 20 ms, fast enough to be noticed."""
_SPEED, _ENERGY, _TWIN_SPEED, _TWIN_ENERGY, _NOTICED, _COLUMNS = range(6)


class Rule(StrEnum):
    """What stands between transmission and safety."""

    TORQUE_ALONE = "torque alone"
    BEFORE = "fixed 0.25 m/s"
    PROFILE = "limit of the profile"


class _WantPlaces(NamedTuple):
    """Force at the hub that is wanted [N]."""

    x: int
    y: int
    z: int


_WANT: Final = numbered(_WantPlaces)


@stage
def want_stage(state: FloatArray, p: FloatArray) -> None:
    """Want a force at the hub: its part across the needle is what can be had."""
    state[sv.FORCE_X] += p[_WANT.x]
    state[sv.FORCE_Y] += p[_WANT.y]
    state[sv.FORCE_Z] += p[_WANT.z]


@njit
def motion_kernel(state: FloatArray, model: FloatArray, length: float) -> tuple[float, float]:
    """Speed of the hub across the needle [m/s], kinetic energy but that of sliding [J]: the truth.

    Args:
        state: with the plant's slots.
        model: see `mechanisms.dynamic_model`.
        length: of the needle [m].
    """
    q1, q2 = state[sv.PLANT_Q_LEFT], state[sv.PLANT_Q_RIGHT]
    v1, v2 = state[sv.PLANT_QD_LEFT], state[sv.PLANT_QD_RIGHT]
    depth = state[sv.PLANT_DEPTH]
    a1, a2, base = model[dm.A1], model[dm.A2], model[dm.BASE]
    _, x, y = forward_kernel(q1, q2, a1, a2, base, 1.0)
    _, jxl, jxr, jyl, jyr = jacobian_kernel(q1, q2, x, y, a1, a2, base)
    dx, dy, dz, l_in = axis_kernel(x, y, model[dm.FX], model[dm.FY], model[dm.FZ])
    vx, vy = jxl * v1 + jxr * v2, jyl * v1 + jyr * v2
    wx, wy, wz = hub_velocity_kernel(vx, vy, dx, dy, dz, l_in, length - depth)
    m11, m12, m22, _, _, _, _ = dynamics_kernel(q1, q2, v1, v2, x, y, depth, 0.0, model, 0)
    energy = 0.5 * (m11 * v1 * v1 + 2.0 * m12 * v1 * v2 + m22 * v2 * v2)
    return (wx * wx + wy * wy + wz * wz) ** 0.5, energy


@kernel.compiled(
    types.UniTuple(types.float64, 2)(
        types.float64[::1],
        kernel.STAGES,
        kernel.PARAMETERS,
        STAGE_TYPE,
        types.float64[::1],
        types.float64[::1],
        types.float64,
        types.float64,
        types.boolean,
        types.int64,
        types.float64[:, ::1],
    )
)
def let_go(
    state: Any,
    stages: Any,
    parameters: Any,
    plant: Any,
    plant_parameters: Any,
    model: Any,
    length: float,
    step: float,
    measured: bool,
    held: int,
    track: Any,
) -> tuple[float, float]:
    """Hold for `held` ticks, let go, run len(track) ticks beside the twin; fill `track`.

    Returns, just before: the force that the loop believes to be felt, the hand's force [N].
    """
    twin = state.copy()
    felt = pull = 0.0
    for k in range(held + len(track)):
        if k == held:
            state[sv.HAND_HOLDS] = 0.0
            pull = (state[sv.PULL_X] ** 2 + state[sv.PULL_Y] ** 2 + state[sv.PULL_Z] ** 2) ** 0.5
            felt = (state[sv.FELT_X] ** 2 + state[sv.FELT_Y] ** 2 + state[sv.FELT_Z] ** 2) ** 0.5
            twin[:] = state
            twin[sv.TORQUE_LEFT] = twin[sv.TORQUE_RIGHT] = 0.0
        state[sv.TIME] += step
        state[sv.DT] = step
        state[sv.HEARTBEAT] = state[sv.TIME]
        if measured:
            state[sv.TRACKED_TIME] = state[sv.TIME]
        kernel.run_stages(state, stages, parameters)
        plant(state, plant_parameters)
        if k >= held:
            twin[sv.DT] = step
            plant(twin, plant_parameters)
            row = track[k - held]
            row[_SPEED], row[_ENERGY] = motion_kernel(state, model, length)
            row[_TWIN_SPEED], row[_TWIN_ENERGY] = motion_kernel(twin, model, length)
            row[_NOTICED] = state[sv.LET_GO]
    return felt, pull


@dataclass(frozen=True, slots=True)
class Release:
    """A needle that was held under force and let go.

    Attributes:
        felt: force that the loop believes the hand felt [N].
        pull: force with which the hand held, the needle's weight included [N].
        speed: most of the hub beyond the twin's [m/s].
        energy: most kinetic energy beyond the twin's [J].
        noticed: ticks until letting go was noticed; None if never.
    """

    felt: float
    pull: float
    speed: float
    energy: float
    noticed: int | None


@dataclass(frozen=True, slots=True)
class Pose:
    """Where the needle is held and where the force pulls its hub.

    Attributes:
        axis: hub to tip.
        force: direction of the wanted force.
        depth: of the tip [m].
    """

    axis: tuple[float, float, float]
    force: tuple[float, float, float]
    depth: float


def scaled(profile: PantographProfile, factor: float) -> PantographProfile:
    """Return the profile with all its inertias times a factor."""
    names = (
        "proximal_mass",
        "proximal_inertia",
        "distal_mass",
        "distal_inertia",
        "tool_mass",
        "needle_mass",
        "needle_inertia",
        "rotor_inertia",
    )
    changed = {name: factor * getattr(profile.inertia, name) for name in names}
    return profile.model_copy(update={"inertia": profile.inertia.model_copy(update=changed)})


def release(
    profile: PantographProfile,
    pose: Pose,
    rule: Rule,
    factor: float = 1.0,
    measured: bool = True,
    runs: int = RUNS,
) -> Release:
    """Hold, push as hard as the rule allows, let go.

    Args:
        profile: what the program takes the robot for.
        pose: where it is held.
        rule: that bounds the force.
        factor: of the true inertias.
        measured: whether the cameras measure the depth, newly in every tick.
        runs: ticks of the run.
    """
    body = scaled(profile, factor)
    plant = plant_stage(body, pose.axis, pose.depth, _CLAMP)
    state = sv.empty_state()
    for name, value in initial_plant(profile, pose.axis, pose.depth).items():
        state[sv.INDEX[name]] = value
    for slot in (sv.ENABLED, sv.HOMED, sv.ARMING, sv.HAND_HOLDS):
        state[slot] = 1.0
    state[sv.FORCE_CAP], state[sv.TIME] = profile.limits.hand_force, 1.0
    state[sv.HAND_X], state[sv.HAND_Y], state[sv.HAND_DEPTH] = *pose.axis[:2], pose.depth
    state[sv.TRACKED_DEPTH] = pose.depth
    functions, values = kernel.no_stages(), kernel.no_parameters()
    want = 10.0 * profile.limits.hand_force * np.array(pose.force)
    for item in _stages(profile, rule, want):
        kernel.append(functions, values, item.function, item.parameters)
    track = np.zeros((runs, _COLUMNS))
    felt, pull = let_go(
        state,
        functions,
        values,
        plant[1],
        plant[2],
        np.array(body.dynamic_model.values),
        profile.geometry.needle_length,
        1.0 / profile.rate_hz,
        measured,
        HELD,
        track,
    )
    seen = np.flatnonzero(track[:, _NOTICED] > 0.0)
    noticed = int(seen[0]) if len(seen) else None
    watched = track if noticed is None else track[: noticed + AFTER]
    speed = (watched[:, _SPEED] - watched[:, _TWIN_SPEED]).max(initial=0.0)
    energy = (watched[:, _ENERGY] - watched[:, _TWIN_ENERGY]).max(initial=0.0)
    return Release(felt, pull, float(speed), float(energy), noticed)


def _stages(profile: PantographProfile, rule: Rule, want: FloatArray) -> Iterable[Stage]:
    """Stages of a tick up to safety, with the rule in the governor's place."""
    law = Stage("want", want_stage, want)
    for item in machine_stages(profile, [law], [], simulated_link(profile, [])):
        if item.name != "governor" or rule is Rule.PROFILE:
            yield item
        elif rule is Rule.BEFORE:
            yield Stage(*fixed_speed(profile))


def directions(axis: FloatArray, number: int) -> list[tuple[float, float, float]]:
    """Evenly spread unit vectors across an axis."""
    across = np.cross(axis, (0.0, 1.0, 0.0))
    across /= np.linalg.norm(across)
    beside = np.cross(axis, across)
    turns = np.linspace(0.0, 2.0 * np.pi, number, endpoint=False)
    found = [np.cos(t) * across + np.sin(t) * beside for t in turns]
    return [(float(v[0]), float(v[1]), float(v[2])) for v in found]


def poses(profile: PantographProfile, depth: float, number: int, around: int) -> list[Pose]:
    """Random poses, evenly over the cone of tilts, each with forces `around` it."""
    rng = np.random.default_rng(8)
    found = []
    for _ in range(number):
        cosine = 1.0 - rng.random() * (1.0 - np.cos(profile.tilt_limit))
        found += upright(depth, around, float(np.arccos(cosine)), float(rng.uniform(-3.1, 3.1)))
    return found


def upright(depth: float, around: int, tilt: float = 0.0, azimuth: float = 0.0) -> list[Pose]:
    """One pose, upright by default, with forces `around` it."""
    sine = np.sin(tilt)
    axis = np.array([sine * np.cos(azimuth), sine * np.sin(azimuth), -np.cos(tilt)])
    held = (float(axis[0]), float(axis[1]), float(axis[2]))
    return [Pose(held, force, depth) for force in directions(axis, around)]
