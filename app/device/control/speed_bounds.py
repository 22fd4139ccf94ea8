"""How fast the hub can be: what torques can do to it, and what the encoders prove of it.

Pure functions; `governor` decides by them.
"""

from math import isfinite, sqrt
from typing import Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.device.control.vectors import norm_kernel
from app.mechanisms.pantograph.dynamics import mass_matrix_kernel
from app.mechanisms.pantograph.kernels import hub_velocity_kernel

_A1, _A2, _BASE, _DRIVEN, _PASSIVE, _COUPLING, _TOOL = range(7)
OWN: Final = 7
"""Entries of the governor's parameters that belong to `free_acceleration`."""

_SIDEWAYS = 0.1  # cosine to the force below which a motion counts less and less
_SHORT = 6  # every window up to this is looked at, then every fourth


@njit
def free_acceleration(
    state: FloatArray, p: FloatArray, left: float, right: float
) -> tuple[float, float, float, float, float, float]:
    """Hub acceleration of the free mechanism under two torques, and how the hub travels.

    Returns its size [m/s²]; the hub's travel in its direction per angle of each joint [m/rad];
    the Gram matrix (ll, lr, rr) [m²/rad²] of the travels per joint. Zeros where there is none; a
    size of infinity where it cannot be told. Links and tool only: needle and hand make it slower.

    Args:
        state: pose of the mechanism, see `core.state_vector`.
        p: links and inertias, the first `OWN` entries of the governor's parameters.
        left: torque of the left motor [N·m].
        right: likewise of the right motor.
    """
    m11, m12, m22 = mass_matrix_kernel(
        state[sv.Q_LEFT],
        state[sv.Q_RIGHT],
        state[sv.P3_X],
        state[sv.P3_Y],
        p[_A1],
        p[_A2],
        p[_BASE],
        p[_DRIVEN],
        p[_PASSIVE],
        p[_COUPLING],
        p[_TOOL],
    )
    determinant = m11 * m22 - m12 * m12
    q1 = (m22 * left - m12 * right) / determinant
    q2 = (m11 * right - m12 * left) / determinant
    dx, dy, dz = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z]
    l_in, l_out = state[sv.L_IN], state[sv.L_OUT]
    lx, ly, lz = hub_velocity_kernel(state[sv.J_XL], state[sv.J_YL], dx, dy, dz, l_in, l_out)
    rx, ry, rz = hub_velocity_kernel(state[sv.J_XR], state[sv.J_YR], dx, dy, dz, l_in, l_out)
    ax, ay, az = lx * q1 + rx * q2, ly * q1 + ry * q2, lz * q1 + rz * q2
    size = norm_kernel(ax, ay, az)
    if not isfinite(size):
        return np.inf, 0.0, 0.0, 0.0, 0.0, 0.0
    if not size > 1e-9:
        return 0.0, 0.0, 0.0, 0.0, 0.0, 0.0
    ax, ay, az = ax / size, ay / size, az / size
    return (
        size,
        ax * lx + ay * ly + az * lz,
        ax * rx + ay * ry + az * rz,
        lx * lx + ly * ly + lz * lz,
        lx * rx + ly * ry + lz * rz,
        rx * rx + ry * ry + rz * rz,
    )


@njit
def counted(along: float, size: float) -> float:
    """Travel that counts [m]: its `size` where it goes with the force, `along` where against it.

    `along` is its part in the direction of the force's acceleration; continuous in both.
    """
    if along <= 0.0:
        return along
    return min(along / _SIDEWAYS, size)


@njit
def speed_bounds(
    ring: FloatArray,
    head: int,
    samples: int,
    along_left: float,
    along_right: float,
    ll: float,
    lr: float,
    rr: float,
    count: float,
) -> tuple[float, float]:
    """Bounds of the hub's counted speed now [m/s]: (at least, at most).

    Args:
        ring: rows (q_left, q_right, time, largest acceleration sent after it), flat.
        head: row of the newest reading.
        samples: rows that hold readings.
        along_left: travel of the hub along the force per angle of the left joint [m/rad].
        along_right: likewise of the right joint.
        ll: Gram matrix of its travels per joint angle, left with left [m²/rad²].
        lr: left with right.
        rr: right with right.
        count: one encoder count [rad].
    """
    rows = len(ring) // 4
    newest = 4 * head
    doubt = count * sqrt(ll + rr + 2.0 * abs(lr))
    least, most = -np.inf, np.inf
    gained, moment = 0.0, 0.0  # ∫ a dt, ∫ a (t - t_start) dt over the window
    end = ring[newest + 2]
    later = end
    row = newest
    for k in range(1, samples):
        row = row - 4 if row > 0 else 4 * (rows - 1)
        step = later - ring[row + 2]
        later = ring[row + 2]
        moment += step * gained + 0.5 * ring[row + 3] * step * step
        gained += ring[row + 3] * step
        width = end - later
        if (k > _SHORT and k & 3 != 3) or not width > 0.0:
            continue
        left, right = ring[newest] - ring[row], ring[newest + 1] - ring[row + 1]
        size = sqrt(max(ll * left * left + 2.0 * lr * left * right + rr * right * right, 0.0))
        travel = counted(along_left * left + along_right * right, size)
        least = max(least, (travel - doubt) / width)
        most = min(most, (travel + doubt + moment) / width)
    return least, most


@njit
def stoppable(room: float, doubt: float, step: float) -> float:
    """Largest acceleration a [m/s²] with 2 √(doubt a) + a step <= room [m/s]."""
    root = (sqrt(doubt + step * max(room, 0.0)) - sqrt(doubt)) / step
    return root * root
