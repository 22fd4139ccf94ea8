"""Friction and play of the two ball joints that carry the needle, felt when it tilts.

One ball sits at the fulcrum, one at the pantograph's tool; both turn with the needle, each pressed
into its cage by a force N. With the coefficient μ and the ball's radius r they hold the needle with

    g = 2 μ N r (1 + (b - 1) exp(-(ω / ω_s)²)),

b break-away over kinetic level, ω the speed of the tilt; at the hub that is the force g / L_out
against the motion. Two designs (thesis 2.2 and 7.3): printed in one piece, resin on resin, with a
gap all round the ball so that the parts do not fuse; and the redesign, a steel ball of 8 mm between
two washers of PTFE that an O-ring holds against it, without play.

Play is a backlash: a gap of c at either ball lets the needle turn by 2 c / H to each side, H from
ball to ball, before the cages take the load. With z the tilt since the balls last followed,

    M = σ max(|z| - 2 c / H, 0) along z,   σ = 2 μ N r / presliding angle,

a spring behind a dead zone, so M is continuous and no more than g; its energy is ½ σ (|z| - …)².
The balls follow (z relaxes) by one of the laws of `dry_friction`, in two dimensions:

- `kikuuwe` (default): only so far that M is g; stuck it is a spring and nothing else;
- `dahl`: dz/ds = e - M / g, s the way of the tilt and e its direction: exact for a straight step,
  through the play and out on its other side, for which the dead zone is turned with z;
- `lugre`: the same, and the bristles' damping σ₁ exp(-(ω / ω_s)²) dM/dt / σ, the whole within g.

The joint follows what the encoders measure, so play is lost motion in the force; it does not move
the measured needle.

Energy: dissipative but for the spring, which gives back g²/(2σ), and where one tick goes through
the play, the force held over it: g · 2 c / H.
"""

from collections.abc import Mapping
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.messages import sentence
from app.core.parameters import numbered, packed
from app.simulation.along_needle import SNAP, approach, keep_memory, smoothed_speed
from app.simulation.dry_friction import DAHL, KIKUUWE, LUGRE, dahl, kikuuwe, stribeck
from app.simulation.scene import Binding

DECLARATION: Final[dict[str, Any]] = {
    "title": "Friction and play of the ball joints",
    "reads": ("axis", "l_out", "kinematics", "dt"),
    "writes": ("force", "potential"),
    "consumers": ("device axis lateral", "score of felt force"),
    "needs": (),
    "models": {
        "kikuuwe": "a spring that slides at the Stribeck level; calm on encoder counts",
        "dahl": "Dahl with Stribeck level, exponential update exact at any step",
        "lugre": "the same with damped bristles, within the Stribeck level",
    },
    "energy": (
        "dissipative",
        "presliding returns at most g²/(2σ) of what it took, a tick through the play g times it",
    ),
    "cost_class": "A",
    "parameters": {
        "design": (0.0, "-", 0.0, 2.0, "0 the mounted joint, 1 printed, 2 redesigned"),
        "clamping": (5.0, "N", 0.0, 50.0, "force that presses a ball into its cage (estimate)"),
        "printed_coefficient": (0.4, "-", 0.0, 2.0, "of resin on resin (estimate)"),
        "printed_breakaway": (1.3, "-", 1.0, 3.0, "break-away over kinetic, resin (estimate)"),
        "printed_play": (1e-4, "m", 0.0, 1e-3, "gap on each side of a printed ball (estimate)"),
        "redesigned_coefficient": (0.04, "-", 0.0, 2.0, "of steel on PTFE"),
        "joint_distance": (0.09, "m", 0.02, 0.5, "between the two balls, needle upright"),
        "presliding_angle": (0.01, "rad", 1e-5, 0.1, "tilt before a ball slides (estimate)"),
        "stribeck_speed": (0.05, "rad/s", 1e-4, 10.0, "at which break-away is gone (estimate)"),
        "speed_smoothing": (0.03, "s", 0.0, 1.0, "time constant of the tilt's speed"),
        "bristle_damping": (1e-3, "N·m·s/rad", 0.0, 1.0, "of both joints (lugre; estimate)"),
        "shortest_lever": (0.02, "m", 0.005, 0.2, "L_out below which the force stops growing"),
    },
    "published": {
        "redesigned_coefficient": (0.04, 0.04, "steel on PTFE, chapter 7.3 of the thesis"),
        "joint_distance": (0.09, 0.09, "pantograph_model.hpp of the thesis' device"),
    },
}

MOUNTED, PRINTED, REDESIGNED = 0, 1, 2
"""Values of `design`; one between two is taken as the nearer."""

PRINTED_RADIUS: Final = 9.2e-3
REDESIGNED_RADIUS: Final = 8e-3
"""Of the balls [m], chapter 7.3 of the thesis."""

_NAMES: Final = {"old": PRINTED, "printed": PRINTED, "new": REDESIGNED, "redesigned": REDESIGNED}

COUNT: Final = 3.7e-4
"""A count of the encoders of the thesis' device as a tilt, the coarser of two directions [rad]."""


class _JointPlaces(NamedTuple):
    """Law, levels [N·m], stiffness [N·m/rad], dead zone [rad]; then the tilt before and z."""

    law: int
    kinetic: int
    static: int
    stiffness: int
    play: int
    stribeck: int
    smoothing: int
    damping: int
    lever: int
    speed: int = 0
    axis_x: int = 0
    axis_y: int = 0
    axis_z: int = 0
    z_x: int = 0
    z_y: int = 0
    z_z: int = 0


_AT: Final = numbered(_JointPlaces)
_INSIDE: Final = 1.0 - 1e-12  # of the play: where the balls are left, rounding must not hold them


def design_of(values: Mapping[str, float], joint: str) -> int:
    """Return which of the two designs it is: the one asked for, else that of the mounted joint."""
    return round(values["design"]) or _NAMES.get(joint, REDESIGNED)


def parameters(values: Mapping[str, float], binding: Binding) -> FloatArray:
    """Return a fresh parameters array: needle at rest in the middle of the play."""
    designs = {
        PRINTED: (
            values["printed_coefficient"] * PRINTED_RADIUS,
            values["printed_breakaway"],
            values["printed_play"],
        ),
        REDESIGNED: (values["redesigned_coefficient"] * REDESIGNED_RADIUS, 1.0, 0.0),
    }
    lever, breakaway, play = designs[design_of(values, binding.scene.joint)]
    kinetic = 2.0 * values["clamping"] * lever
    return packed(
        _AT,
        law={"dahl": DAHL, "lugre": LUGRE}.get(binding.model, KIKUUWE),
        kinetic=kinetic,
        static=kinetic * breakaway,
        stiffness=kinetic / values["presliding_angle"],
        play=2.0 * play / values["joint_distance"],
        stribeck=values["stribeck_speed"],
        smoothing=values["speed_smoothing"],
        damping=values["bristle_damping"],
        lever=values["shortest_lever"],
        axis_x=np.nan,
    )


def warnings(values: Mapping[str, float], binding: Binding) -> tuple[str, ...]:
    """Return what a joint of another name, a real robot and encoder counts make of it."""
    found = []
    joint = binding.scene.joint
    if round(values["design"]) == MOUNTED and joint not in _NAMES:
        found.append(
            sentence(
                "joint {joint!r} is none of the two that are known ({names}); it is taken "
                "as redesigned: give design 1 for printed, or 2",
                joint=joint,
                names=", ".join(_NAMES),
            )
        )
    if binding.depth_slot != sv.PLANT_DEPTH:
        found.append(sentence("the robot's own joints are felt beside it"))
    if binding.model in ("dahl", "lugre"):
        found.append(
            sentence(
                "model {binding_model} changes sign with every encoder count, a tilt of "
                "{count:g} mrad; kikuuwe does not",
                binding_model=binding.model,
                count=1e3 * COUNT,
            )
        )
    elif values["presliding_angle"] < COUNT:
        found.append(
            sentence(
                "presliding_angle {presliding_angle:g} rad is less than an encoder count of "
                "{count:g} rad: a still hand feels the force change sign; give {count:g} rad or "
                "more",
                presliding_angle=values["presliding_angle"],
                count=COUNT,
            )
        )
    return tuple(found)


def carry(old: FloatArray, new: FloatArray) -> None:
    """Go on by another model from the same moment."""
    keep_memory(_AT, old, new)


@njit
def _dot(a: tuple[float, float, float], b: tuple[float, float, float]) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@njit
def _plus(
    a: tuple[float, float, float], k: float, b: tuple[float, float, float]
) -> tuple[float, float, float]:
    """Return a + k b."""
    return a[0] + k * b[0], a[1] + k * b[1], a[2] + k * b[2]


@njit
def _times(k: float, a: tuple[float, float, float]) -> tuple[float, float, float]:
    return k * a[0], k * a[1], k * a[2]


@njit
def _length(a: tuple[float, float, float]) -> float:
    return np.sqrt(_dot(a, a))


@njit
def moment(
    z: tuple[float, float, float], play: float, level: float, stiffness: float
) -> tuple[float, float, float]:
    """Moment behind the dead zone, along z and no more than the level [N·m]."""
    length = _length(z)
    if not length > play:
        return 0.0, 0.0, 0.0
    return _times(kikuuwe(0.0, length - play, level, stiffness) / length, z)


@njit
def follow(
    z: tuple[float, float, float],
    way: tuple[float, float, float],
    play: float,
    level: float,
    stiffness: float,
) -> tuple[float, float, float]:
    """Balls that follow only as far as the level makes them: z after a tilt `way`."""
    z = _plus(z, 1.0, way)
    length, most = _length(z), play + (level / stiffness if stiffness > 0.0 else 0.0)
    return _times(most / length, z) if length > most else z


@njit
def creep(
    z: tuple[float, float, float],
    way: tuple[float, float, float],
    play: float,
    level: float,
    stiffness: float,
) -> tuple[float, float, float]:
    """Balls that follow by Dahl's law: z after a tilt `way`; in a plane exact at any step.

    In turn free within the play, and against its edge, whose direction is held meanwhile.
    """
    left = _length(way)
    if not (left > 0.0 and stiffness > 0.0 and level > 0.0):
        return z
    e, reach = _times(1.0 / left, way), level / stiffness
    for _ in range(3):  # off one edge, through the play, against the other one
        length, along = _length(z), _dot(z, e)
        if length < play or (length == play and along < 0.0):
            free = np.sqrt(max(along * along + play * play - length * length, 0.0)) - along
            free = min(free, left)
            z, left = _plus(z, free, e), left - free
            length = _length(z)
        if not left > 0.0:
            break
        edge = _times(play / length, z) if length > 0.0 else (0.0, 0.0, 0.0)
        w, go = _plus(z, -1.0, edge), left
        leaves = _dot(edge, e) / play if play > 0.0 else 0.0
        if leaves < 0.0:  # w · edge falls to 0 on the way
            radial = max(_dot(w, edge) / play, 0.0)
            go = min(left, reach * np.log1p(radial / (-leaves * reach)))
        before = _dot(w, e)
        after = dahl(stiffness * before, go, level, stiffness) / stiffness
        rest = _plus(w, -before, e)
        share = approach(1.0, 0.0, go / reach)
        z = _plus(_plus(edge, share, rest), after, e)
        left -= go
        if leaves < 0.0 and left > 0.0:
            length = _length(z)
            z = _times(min(_INSIDE * play / length, 1.0), z) if length > 0.0 else z
    return z


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Add the joints' force at the hub point to FORCE_*; nothing without valid kinematics."""
    p = parameters
    axis = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z]
    lever = state[sv.L_OUT]
    if state[sv.KINEMATICS] != 0.0 or not np.isfinite(axis[0] + axis[1] + axis[2] + lever):
        return
    if np.isnan(p[_AT.axis_x]):  # the first tick has no tilt yet
        p[_AT.axis_x], p[_AT.axis_y], p[_AT.axis_z] = axis
    way = axis[0] - p[_AT.axis_x], axis[1] - p[_AT.axis_y], axis[2] - p[_AT.axis_z]
    p[_AT.axis_x], p[_AT.axis_y], p[_AT.axis_z] = axis
    way = _plus(way, -_dot(way, axis), axis)
    speed = smoothed_speed(p[_AT.speed], _length(way), state[sv.DT], p[_AT.smoothing])
    p[_AT.speed] = speed
    late = stribeck(speed, p[_AT.stribeck])
    level = p[_AT.kinetic] + (p[_AT.static] - p[_AT.kinetic]) * late
    play, stiffness = p[_AT.play], p[_AT.stiffness]
    z = p[_AT.z_x], p[_AT.z_y], p[_AT.z_z]
    z = _plus(z, -_dot(z, axis), axis)  # turned with the needle
    z = follow(z, (0.0, 0.0, 0.0), play, level, stiffness)  # the level may have fallen
    before = moment(z, play, level, stiffness)
    if p[_AT.law] == KIKUUWE:
        z = follow(z, way, play, level, stiffness)
    else:
        z = creep(z, way, play, level, stiffness)
    p[_AT.z_x] = z[0] if abs(z[0]) > SNAP else 0.0
    p[_AT.z_y] = z[1] if abs(z[1]) > SNAP else 0.0
    p[_AT.z_z] = z[2] if abs(z[2]) > SNAP else 0.0
    held = moment(z, play, level, stiffness)
    if stiffness > 0.0:
        state[sv.POTENTIAL] += 0.5 * _dot(held, held) / stiffness
    dt = state[sv.DT]
    if p[_AT.law] == LUGRE and dt > 0.0 and stiffness > 0.0 and _length(z) > play:
        damping = p[_AT.damping] * late / (stiffness * dt)
        held = _plus(held, damping, _plus(held, -1.0, before))
        length = _length(held)
        held = _times(level / length, held) if length > level else held
    scale = 1.0 / max(lever, p[_AT.lever])
    state[sv.FORCE_X] += scale * held[0]
    state[sv.FORCE_Y] += scale * held[1]
    state[sv.FORCE_Z] += scale * held[2]


def energy_bound(parameters: FloatArray) -> float:
    """Return the most that can be given back [J]: g²/(2σ), and g times the play to each side."""
    level, stiffness = float(parameters[_AT.static]), float(parameters[_AT.stiffness])
    spring = 0.5 * level**2 / stiffness if stiffness > 0.0 else 0.0
    return spring + level * float(parameters[_AT.play])
