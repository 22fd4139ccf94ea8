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
from app.mechanisms.profile import DeviceProfile
from app.mechanisms.status import OK

DECLARATION: Final[dict[str, Any]] = {
    "title": "Compensation of gravity and joint friction",
    "reads": ("kinematics", "q", "qd", "axis", "l_out", "depth", "dt", "weight", "links_potential"),
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
    """Shares and speeds; friction, needle and gravity by the profile; and memory."""

    gravity: int
    friction: int
    still: int
    fastest: int
    level: int
    coulomb: int
    viscous: int
    needle_mass: int
    needle_offset: int
    gx: int
    gy: int
    gz: int
    last_depth: int = 0
    last_share: int = 0


_AT: Final = numbered(_CompensationPlaces)


def parameters(values: Mapping[str, float], profile: DeviceProfile) -> FloatArray:
    """Return a fresh parameters array, its memory included."""
    gx, gy, gz = profile.mounting.gravity
    return packed(
        _AT,
        gravity=values["gravity"],
        friction=values["friction"],
        still=values["still"],
        fastest=values["fastest"],
        level=_level(profile),
        coulomb=profile.friction.coulomb,
        viscous=profile.friction.viscous,
        needle_mass=profile.inertia.needle_mass,
        needle_offset=_needle_offset(profile),
        gx=gx,
        gy=gy,
        gz=gz,
    )


def energy_bound(values: Mapping[str, float], profile: DeviceProfile) -> float:
    """Return the largest difference of gravity's potential that is carried [J]."""
    return 2.0 * values["gravity"] * _level(profile)


def _needle_offset(profile: DeviceProfile) -> float:
    """Centre of the needle beyond the remote centre at zero depth [m]."""
    return profile.inertia.needle_centre - profile.needle_length


def _level(profile: DeviceProfile) -> float:
    """Return a bound of |U| over all poses and depths [J]."""
    gx, gy, gz = profile.mounting.gravity
    space = sqrt(sqrt(gx**2 + gy**2) ** 2 + gz**2)
    low, high = profile.depth_range
    offset = _needle_offset(profile)
    farthest = max(abs(low + offset), abs(high + offset))
    return profile.links_potential_bound + space * profile.inertia.needle_mass * farthest


@njit
def gravity_potential(
    links: float, dx: float, dy: float, dz: float, depth: float, p: FloatArray
) -> float:
    """Potential of gravity [J], up to a constant: `links` of all but the needle, and the needle."""
    s = p[_AT.needle_mass] * (depth + p[_AT.needle_offset])
    fall = p[_AT.gx] * dx + p[_AT.gy] * dy + p[_AT.gz] * dz
    return links - s * fall


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
    g1, g2 = state[sv.WEIGHT_LEFT], state[sv.WEIGHT_RIGHT]
    if not isfinite(g1 + g2):
        return  # the distal links are in line
    links, depth = state[sv.LINKS_POTENTIAL], state[sv.DEPTH]
    dx, dy, dz = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z]
    level, share = p[_AT.level], p[_AT.gravity]
    now = share * (level - gravity_potential(links, dx, dy, dz, depth, p))
    last = p[_AT.last_share] * (level - gravity_potential(links, dx, dy, dz, p[_AT.last_depth], p))
    store(state, now, last)
    p[_AT.last_depth], p[_AT.last_share] = depth, share
    coulomb, viscous = p[_AT.coulomb], p[_AT.viscous]
    f1 = p[_AT.friction] * friction_share(v1, coulomb, viscous, p[_AT.still], p[_AT.fastest])
    f2 = p[_AT.friction] * friction_share(v2, coulomb, viscous, p[_AT.still], p[_AT.fastest])
    state[sv.FRICTION_WORK] += (f1 * v1 + f2 * v2) * max(state[sv.DT], 0.0)
    state[sv.JOINT_LEFT] += share * g1 + f1
    state[sv.JOINT_RIGHT] += share * g2 + f2
