"""How fast the simulated hand goes where mouse, wheel, keys, pen, gamepad or script want it.

HAND_* say where the hand is wanted, and UNSTEADY_* how far a hand that is not steady is from there
(`simulation.unsteady_hand`); GRIP_* are where it is. Between them stands a hand: its speed and its
acceleration are bounded, across the needle (at the hub) and along it, each on its own. At a
distance e from where it is wanted it aims for the speed

    v(e) = min(e / τ, √(2 a (e - a τ² / 2)), limit),

the fastest from which it still stops there with the acceleration a, four fifths of what it may
have; the first branch, below e = a τ², takes the chatter out of the end and nowhere asks for more
than a. So a step of any size is a movement with a beginning and an end, a slow one is followed
within v τ, and what the wanted point does meanwhile changes the way, never the bounds.

A hand that takes hold does so where the needle is, at rest.
"""

from typing import Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import Stage, numbered, packed


class HandPlaces(NamedTuple):
    """Bounds, then what the hand remembers between ticks; offsets into a stage's parameters."""

    speed: int
    acceleration: int
    axial_speed: int
    axial_acceleration: int
    held: int = 0
    vx: int = 0
    vy: int = 0
    vz: int = 0
    rate: int = 0


AT: Final = numbered(HandPlaces)
SIZE: Final = len(AT)

FASTEST: Final = 0.05
"""Speed of the hub across the needle [m/s]: what Perk Tutor counts as a movement of its own, 17° of
the needle in a second. The springs of a hand let the needle swing to half as much again; deep in
tissue the speed governor takes less than twice this for a needle let go (docs/decisions/0014)."""

FASTEST_ALONG: Final = 0.10
"""Speed along the needle [m/s]: five times that of an ordinary insertion (20 mm/s), twice what
Perk Tutor counts as a movement of its own (50 mm/s)."""

STRONGEST: Final = 1.0
"""Acceleration [m/s²], across and along: from rest to full speed in a tenth of a second."""

_REACTION: Final = 0.008  # τ [s]
_RESERVE: Final = 0.8  # share of the acceleration that stopping counts on: no running past
_NEAR: Final = 1e-9  # [m] nearer than this is there
_SLOW: Final = 1e-6  # [m/s]
_LONGEST: Final = 5e-3  # [s] as the loop clamps a step
_FLATTEST: Final = 0.98  # sine of the largest tilt that the hand may want


@njit
def wanted(state: FloatArray) -> tuple[bool, float, float, float]:
    """Direction that the hand is wanted to have, and whether it holds: (holds, wx, wy, wz)."""
    x, y = state[sv.HAND_X], state[sv.HAND_Y]
    sine = np.sqrt(x * x + y * y)
    if not (state[sv.HAND_HOLDS] > 0.5 and np.isfinite(sine + state[sv.HAND_DEPTH])):
        return False, 0.0, 0.0, -1.0
    if state[sv.UNSTEADY_X] != 0.0 or state[sv.UNSTEADY_Y] != 0.0:  # a steady hand's zero stays -0
        x, y = x + state[sv.UNSTEADY_X], y + state[sv.UNSTEADY_Y]
        sine = np.sqrt(x * x + y * y)
    if sine > _FLATTEST:
        x, y = x * (_FLATTEST / sine), y * (_FLATTEST / sine)
    return True, x, y, -np.sqrt(1.0 - x * x - y * y)


@njit
def grip_direction(state: FloatArray) -> tuple[float, float, float]:
    """Direction of the needle that the hand holds on to now: (gx, gy, gz), unit."""
    x, y = state[sv.GRIP_X], state[sv.GRIP_Y]
    return x, y, -np.sqrt(max(1.0 - x * x - y * y, 0.0))


@njit
def take_hold(
    state: FloatArray, p: FloatArray, at: int, holds: bool, x: float, y: float, depth: float
) -> bool:
    """Keep the hand at the needle's direction (x, y) and depth until it holds.

    Returns whether it has held since before this tick. `at`: where its part of `p` begins.
    """
    if holds and p[at + AT.held] > 0.5 and np.isfinite(state[sv.GRIP_X] + state[sv.GRIP_DEPTH]):
        return True
    p[at + AT.held] = 1.0 if holds else 0.0
    p[at + AT.vx] = p[at + AT.vy] = p[at + AT.vz] = p[at + AT.rate] = 0.0
    state[sv.GRIP_X], state[sv.GRIP_Y], state[sv.GRIP_DEPTH] = x, y, depth
    return False


@njit
def aimed(distance: float, speed: float, acceleration: float) -> float:
    """Fastest speed from which a hand still stops at a `distance` [m]."""
    acceleration *= _RESERVE
    knee = acceleration * _REACTION * _REACTION
    if distance <= knee:
        return min(distance / _REACTION, speed)
    return min(np.sqrt(2.0 * acceleration * (distance - 0.5 * knee)), speed)


@njit
def turn(
    state: FloatArray,
    p: FloatArray,
    at: int,
    h: float,
    wx: float,
    wy: float,
    wz: float,
    lever: float,
) -> None:
    """Move the hand across the needle for a step `h` [s] towards the direction w.

    `lever`: from the fulcrum to the hub, where the bounds hold [m].
    """
    gx, gy, gz = grip_direction(state)
    along = wx * gx + wy * gy + wz * gz
    tx, ty, tz = wx - along * gx, wy - along * gy, wz - along * gz
    sine = np.sqrt(tx * tx + ty * ty + tz * tz)
    distance = lever * np.arctan2(sine, along)
    vx, vy, vz = p[at + AT.vx], p[at + AT.vy], p[at + AT.vz]
    if distance < _NEAR and abs(vx) + abs(vy) + abs(vz) < _SLOW:
        state[sv.GRIP_X], state[sv.GRIP_Y] = wx, wy
        p[at + AT.vx] = p[at + AT.vy] = p[at + AT.vz] = 0.0
        return
    share = aimed(distance, p[at + AT.speed], p[at + AT.acceleration]) / sine if sine > 0.0 else 0.0
    ax, ay, az = share * tx - vx, share * ty - vy, share * tz - vz
    size, most = np.sqrt(ax * ax + ay * ay + az * az), p[at + AT.acceleration] * h
    share = most / size if size > most else 1.0
    vx, vy, vz = vx + share * ax, vy + share * ay, vz + share * az
    nx, ny, nz = gx + vx * h / lever, gy + vy * h / lever, gz + vz * h / lever
    size = np.sqrt(nx * nx + ny * ny + nz * nz)
    nx, ny, nz = nx / size, ny / size, min(nz / size, 0.0)
    sine = np.sqrt(nx * nx + ny * ny)
    if sine > _FLATTEST:
        nx, ny, vx, vy, vz = nx * _FLATTEST / sine, ny * _FLATTEST / sine, 0.0, 0.0, 0.0
    away = vx * nx + vy * ny + vz * nz
    state[sv.GRIP_X], state[sv.GRIP_Y] = nx, ny
    p[at + AT.vx], p[at + AT.vy], p[at + AT.vz] = vx - away * nx, vy - away * ny, vz - away * nz


@njit
def advance(state: FloatArray, p: FloatArray, at: int, h: float) -> None:
    """Move the hand along the needle for a step `h` [s] towards HAND_DEPTH."""
    depth = state[sv.HAND_DEPTH]
    if state[sv.UNSTEADY_DEPTH] != 0.0:
        depth += state[sv.UNSTEADY_DEPTH]
    way, rate = depth - state[sv.GRIP_DEPTH], p[at + AT.rate]
    if abs(way) < _NEAR and abs(rate) < _SLOW:
        state[sv.GRIP_DEPTH], p[at + AT.rate] = depth, 0.0
        return
    speed = aimed(abs(way), p[at + AT.axial_speed], p[at + AT.axial_acceleration])
    most = p[at + AT.axial_acceleration] * h
    rate += min(max((speed if way > 0.0 else -speed) - rate, -most), most)
    state[sv.GRIP_DEPTH] += rate * h
    p[at + AT.rate] = rate


@stage
def step(state: FloatArray, parameters: FloatArray) -> None:
    """Move GRIP_* where no simulated robot does: from the first wish on, at a hand's speed."""
    holds, wx, wy, wz = wanted(state)
    if not holds:
        parameters[AT.held] = 0.0
        return
    if take_hold(state, parameters, 0, holds, wx, wy, state[sv.HAND_DEPTH]) and state[sv.DT] > 0.0:
        h = min(state[sv.DT], _LONGEST)
        turn(state, parameters, 0, h, wx, wy, wz, parameters[SIZE])
        advance(state, parameters, 0, h)


def hand_stage(lever: float) -> Stage:
    """Build the stage that moves a simulated hand beside a robot that is not simulated.

    Args:
        lever: from the fulcrum to the hub, where the bounds hold [m].
    """
    parameters = packed(
        AT,
        (lever,),
        speed=FASTEST,
        acceleration=STRONGEST,
        axial_speed=FASTEST_ALONG,
        axial_acceleration=STRONGEST,
    )
    return Stage("hand", step, parameters)
