"""What force laws share: shapes of springs and hills, shares within a limit, where forces go."""

from math import atan2, cos, isfinite, radians, sin, sqrt
from typing import Final

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.device.control.vectors import norm_kernel
from app.mechanisms.profile import DeviceProfile

HALF_PI: Final = 1.5707963267948966
HILL: Final = 256.0 / 27.0
"""One over the maximum of x (1 - x)³, which lies at x = 1/4."""

STOP_GIVES: Final = radians(2.0)
"""How far the joint's mechanical stop yields to a strong hand: bounds hold up to there."""


def longest_lever(profile: DeviceProfile) -> float:
    """Largest L_out of a device [m]: the needle's length, and what it may be drawn out."""
    return profile.needle_length - min(profile.workspace.depth_min, 0.0)


@njit
def across_kernel(
    dx: float, dy: float, dz: float, px: float, py: float, pz: float
) -> tuple[float, float, float, float]:
    """Part of p perpendicular to d, and the angle between them: (ax, ay, az, angle).

    Unit vectors in. d x (p x d) is p - (p·d) d without its cancellation; its length is the sine.
    """
    cx, cy, cz = py * dz - pz * dy, pz * dx - px * dz, px * dy - py * dx
    angle = atan2(norm_kernel(cx, cy, cz), px * dx + py * dy + pz * dz)
    return dy * cz - dz * cy, dz * cx - dx * cz, dx * cy - dy * cx, angle


@njit
def over_sine(angle: float) -> float:
    """Return angle / sin(angle), 1 at zero; for angles up to 90°."""
    sine = sin(angle)
    return angle / sine if sine > 0.0 else 1.0


@njit
def spring_kernel(angle: float, stiffness: float, limit: float) -> tuple[float, float]:
    """Saturated angular spring: (force over sine [N], potential per lever [J/m]).

    The force is f(ε) = min(K ε, F) up to 90° and f(ε) sin ε beyond, which ends at zero at 180°,
    where no direction is better than another. The potential over L_out is its integral.
    """
    free = limit >= stiffness * angle
    if angle <= HALF_PI:
        if free:
            return stiffness * over_sine(angle), 0.5 * stiffness * angle * angle
        bend = limit / stiffness
        return limit / sin(angle), limit * (angle - 0.5 * bend)
    bend = min(limit / stiffness, angle) if stiffness > 0.0 else angle
    if bend <= HALF_PI:
        return limit, limit * (HALF_PI - 0.5 * bend - cos(angle))
    stored = stiffness * (0.5 * HALF_PI * HALF_PI - 1.0 + sin(bend) - bend * cos(bend))
    return min(stiffness * angle, limit), stored + limit * max(0.0, cos(bend) - cos(angle))


@njit
def hill_kernel(angle: float, reach: float, slope: float) -> tuple[float, float]:
    """Bounded hill around zero: (force over sine [N], potential per lever [J/m]).

    The force away from zero is slope · ε (1 - ε/reach)³: it grows from nothing, is largest at a
    quarter of the reach and ends there smoothly.
    """
    if not angle < reach:
        return 0.0, 0.0
    rest = 1.0 - angle / reach
    cube = rest * rest * rest
    stored = slope * reach * reach * cube * rest * (0.25 - 0.2 * rest)
    return slope * cube * over_sine(angle), stored


@njit
def speed_fade(speed: float, start: float, end: float) -> float:
    """Factor on a force for the hand's speed *along it* [m/s]: 1 up to `start`, 0 from `end`.

    Against the force it stays 1: what a hand pays to store is what the law may give back, and a
    faster hand gets back less. Fading both ways would let a law be loaded cheaply.
    """
    if not speed > start:
        return 1.0
    return max(0.0, (end - speed) / (end - start)) if end > start else 0.0


@njit
def damper_share(
    fx: float, fy: float, fz: float, bx: float, by: float, bz: float, limit: float
) -> float:
    """Largest share of b in [0, 1] with |f + share b| <= limit, for |f| <= limit.

    So the elastic part of a force stays the gradient of its potential when the sum is limited.
    """
    square = bx * bx + by * by + bz * bz
    room = max(0.0, limit * limit - (fx * fx + fy * fy + fz * fz))
    if not (square > 0.0 and isfinite(square)):
        return 0.0
    along = fx * bx + fy * by + fz * bz
    root = sqrt(along * along + square * room)
    # Of the two forms of the root, the one that does not subtract like numbers.
    share = room / (along + root) if along > 0.0 else (root - along) / square
    return min(1.0, share)


@njit
def hub_velocity(state: FloatArray) -> tuple[float, float, float]:
    """Velocity of the hub across the needle [m/s]; zero if it is not known."""
    vx, vy, vz = state[sv.HUB_VX], state[sv.HUB_VY], state[sv.HUB_VZ]
    if not isfinite(vx + vy + vz):
        return 0.0, 0.0, 0.0
    return vx, vy, vz


@njit
def no_pose(state: FloatArray) -> bool:
    """Return whether direction or lever of the needle is not finite: no law can answer."""
    direction = state[sv.AXIS_X] + state[sv.AXIS_Y] + state[sv.AXIS_Z]
    return not isfinite(direction + state[sv.L_OUT] + state[sv.DEPTH])


@njit
def push(state: FloatArray, fx: float, fy: float, fz: float) -> None:
    """Add a force at the hub point [N] to the laws' share GUIDE_* and to the sum FORCE_*."""
    state[sv.GUIDE_X] += fx
    state[sv.GUIDE_Y] += fy
    state[sv.GUIDE_Z] += fz
    state[sv.FORCE_X] += fx
    state[sv.FORCE_Y] += fy
    state[sv.FORCE_Z] += fz


@njit
def store(state: FloatArray, now: float, before: float) -> None:
    """Account for a potential [J]: `now`, and `before` at the same needle direction.

    `before` has dial, lever, path and depth of the last tick. The difference was added by
    something other than a motion across the needle, which is all that the motors feel.
    """
    state[sv.POTENTIAL] += now
    state[sv.GAIN_WORK] += now - before
