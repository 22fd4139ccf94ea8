"""Compensation of gravity and joint friction by torques at the motors.

Gravity: a share of g(q, depth) of the equations of motion (links, mass at P3, needle); it is the
gradient of -U, U the potential of gravity, so it stores what gravity loses.

Friction: a share, below 1, of the profile's Coulomb and viscous friction, in the direction of the
motion. It is nothing below a speed, so that noise and rest are never driven, and grows linearly to
its full size at twice that speed. In every instant the joint's own friction takes more than it
gives; what it gives is counted in FRICTION_WORK.
"""

from collections.abc import Mapping
from math import isfinite, sqrt
from typing import Any, Final, NamedTuple

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import numbered, packed
from app.device.control.law_kernels import no_pose, store
from app.mechanisms import dynamic_model as dm
from app.mechanisms.pantograph.dynamics import dynamics_kernel
from app.mechanisms.pantograph.links import distal_kernel, turns_kernel
from app.mechanisms.pantograph.status import OK
from app.mechanisms.profile import DeviceProfile

DECLARATION: Final[dict[str, Any]] = {
    "title": "Compensation of gravity and joint friction",
    "reads": ("kinematics", "q", "qd", "p3", "axis", "l_out", "depth", "dt"),
    "writes": ("joint", "potential", "gain_work", "friction_work"),
    "energy": (
        "active",
        "gravity's share stores what gravity loses; friction's gives at most its share of what the"
        " joints' own friction takes in the same instant, counted in friction_work",
    ),
    "parameters": {
        "gravity": (1.0, "", 0.0, 1.0, "share of gravity that is carried"),
        "friction": (0.8, "", 0.0, 0.9, "share of the joints' friction that is made up for"),
        "still": (0.1, "rad/s", 0.02, 5.0, "joint speed below which no friction is made up for"),
        "fastest": (10.0, "rad/s", 0.1, 50.0, "joint speed beyond which it does not grow"),
    },
}


class _CompensationPlaces(NamedTuple):
    """Shares and speeds, and memory; the model of the dynamics follows."""

    gravity: int
    friction: int
    still: int
    fastest: int
    level: int
    last_depth: int = 0
    last_share: int = 0


_AT: Final = numbered(_CompensationPlaces)
_MODEL: Final = len(_AT)


def parameters(values: Mapping[str, float], profile: DeviceProfile) -> FloatArray:
    """Return a fresh parameters array, its memory included."""
    return packed(
        _AT,
        profile.dynamic_model.values,
        gravity=values["gravity"],
        friction=values["friction"],
        still=values["still"],
        fastest=values["fastest"],
        level=_level(profile),
    )


def energy_bound(values: Mapping[str, float], profile: DeviceProfile) -> float:
    """Return the largest difference of gravity's potential that is carried [J]."""
    return 2.0 * values["gravity"] * _level(profile)


def _level(profile: DeviceProfile) -> float:
    """Return a bound of |U| over all poses and depths [J]."""
    p = profile.dynamic_model.values
    plane = sqrt(p[dm.GX] ** 2 + p[dm.GY] ** 2)
    space = sqrt(plane**2 + p[dm.GZ] ** 2)
    low, high = profile.depth_range
    farthest = max(abs(low + p[dm.NEEDLE_OFFSET]), abs(high + p[dm.NEEDLE_OFFSET]))
    arms = 2.0 * (p[dm.DRIVEN_MOMENT] + p[dm.PASSIVE_MOMENT])
    tool = p[dm.TOOL] * (p[dm.A1] + p[dm.A2] + 0.5 * p[dm.BASE])
    return float(plane * (arms + tool) + space * p[dm.NEEDLE_MASS] * farthest)


@njit
def gravity_potential(
    q1: float,
    q2: float,
    x: float,
    y: float,
    axis: tuple[float, float, float],
    depth: float,
    p: FloatArray,
    first: int,
) -> float:
    """Potential of gravity [J] of links, mass at P3 and needle, up to a constant."""
    gx, gy, gz = p[first + dm.GX], p[first + dm.GY], p[first + dm.GZ]
    a1, a2, base = p[first + dm.A1], p[first + dm.A2], p[first + dm.BASE]
    c1, s1, c1r, s1r = turns = turns_kernel(q1, q2)
    ux, uy, rx, ry = distal_kernel(turns, x, y, a1, a2, base)
    driven, passive = p[first + dm.DRIVEN_MOMENT], p[first + dm.PASSIVE_MOMENT]
    mx = driven * (c1 + c1r) + passive * (ux + rx) + p[first + dm.TOOL] * x
    my = driven * (s1 + s1r) + passive * (uy + ry) + p[first + dm.TOOL] * y
    s = p[first + dm.NEEDLE_MASS] * (depth + p[first + dm.NEEDLE_OFFSET])
    fall = gx * axis[0] + gy * axis[1] + gz * axis[2]
    return -(mx * gx + my * gy) - s * fall


@njit
def friction_share(v: float, coulomb: float, viscous: float, still: float, fastest: float) -> float:
    """Friction of a joint [N·m] of the sign of v, left out near rest and held beyond `fastest`."""
    speed = min(abs(v), fastest)
    if not speed > still:
        return 0.0
    size = min(1.0, (speed - still) / still) * (coulomb + viscous * speed)
    return size if v > 0.0 else -size


@stage
def step(state: FloatArray, p: FloatArray) -> None:
    """Add the torques to JOINT_*, and count what they store and give."""
    q1, q2, v1, v2 = state[sv.Q_LEFT], state[sv.Q_RIGHT], state[sv.QD_LEFT], state[sv.QD_RIGHT]
    if state[sv.KINEMATICS] != OK or no_pose(state) or not isfinite(q1 + q2 + v1 + v2):
        return
    x, y, depth = state[sv.P3_X], state[sv.P3_Y], state[sv.DEPTH]
    terms = dynamics_kernel(q1, q2, 0.0, 0.0, x, y, depth, 0.0, p, _MODEL)
    g1, g2 = terms[5], terms[6]
    if not isfinite(g1 + g2):
        return  # the distal links are in line
    axis = (state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z])
    level, share = p[_AT.level], p[_AT.gravity]
    now = share * (level - gravity_potential(q1, q2, x, y, axis, depth, p, _MODEL))
    last = p[_AT.last_share] * (
        level - gravity_potential(q1, q2, x, y, axis, p[_AT.last_depth], p, _MODEL)
    )
    store(state, now, last)
    p[_AT.last_depth], p[_AT.last_share] = depth, share
    coulomb, viscous = p[_MODEL + dm.COULOMB], p[_MODEL + dm.VISCOUS]
    f1 = p[_AT.friction] * friction_share(v1, coulomb, viscous, p[_AT.still], p[_AT.fastest])
    f2 = p[_AT.friction] * friction_share(v2, coulomb, viscous, p[_AT.still], p[_AT.fastest])
    state[sv.FRICTION_WORK] += (f1 * v1 + f2 * v2) * max(state[sv.DT], 0.0)
    state[sv.JOINT_LEFT] += share * g1 + f1
    state[sv.JOINT_RIGHT] += share * g2 + f2
