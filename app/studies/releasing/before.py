"""The speed governor as it was before the profile said how far a needle let go may get.

A fixed 0.25 m/s at the hub, planned for as 0.235, with the profile's inertias as they are, links
and tool only, and the depth as the loop took it (decision 0008). Kept as the peer that the study
`let_go` and its benchmark compare with; nothing that drives a robot uses it.
"""

from math import isfinite, pi, sqrt
from typing import Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import Stage, numbered, packed
from app.device.control.speed_bounds import speed_bounds, stoppable
from app.device.control.vectors import norm_kernel, snapped
from app.mechanisms.lever import hub_velocity_kernel
from app.mechanisms.pantograph.dynamics import mass_matrix_kernel
from app.mechanisms.pantograph.profile import PantographProfile
from app.mechanisms.status import OK

_SHORTEST = 1e-4  # [s] of a tick
_BEYOND = 1.2  # times the speed that the force can have caused: a hand
_HAND_STAYS = 0.2  # [s] for which a hand that was seen is taken to hold on
_JUMP = 0.5  # [rad] between two readings: no motion, a fresh start
_PEAK_LASTS = 0.1  # [s] over which the largest push of late is forgotten
_WINDOW = 24


class _BeforePlaces(NamedTuple):
    """Lengths and inertias of the links, limits, memory."""

    a1: int
    a2: int
    base: int
    driven: int
    passive: int
    coupling: int
    tool: int
    resolution: int
    limit: int
    hand: int
    run_away: int
    patience: int
    cause: int
    governed: int = 0
    acceleration: int = 0
    caused: int = 0
    running: int = 0
    hand_seen: int = 0
    samples: int = 0
    head: int = 0
    peak: int = 0


_AT: Final = numbered(_BeforePlaces)
_RING = len(_AT)  # rows of (q_left, q_right, time, largest acceleration sent after it)


@njit
def free_acceleration(
    state: FloatArray, p: FloatArray, left: float, right: float
) -> tuple[float, float, float, float, float, float]:
    """Hub acceleration of the free mechanism under two torques, and how the hub travels.

    Returns its size [m/s²]; the hub's travel in its direction per angle of each joint [m/rad];
    the Gram matrix (ll, lr, rr) [m²/rad²] of the travels per joint. Zeros where there is none; a
    size of infinity where it cannot be told.

    Links and tool only, with the profile's inertias as they are.
    """
    m11, m12, m22 = mass_matrix_kernel(
        state[sv.Q_LEFT],
        state[sv.Q_RIGHT],
        state[sv.P3_X],
        state[sv.P3_Y],
        p[_AT.a1],
        p[_AT.a2],
        p[_AT.base],
        p[_AT.driven],
        p[_AT.passive],
        p[_AT.coupling],
        p[_AT.tool],
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
def _age(state: FloatArray) -> float:
    """Age of the newest reading [s]: on a wire about a tick."""
    return max(state[sv.TIME] - state[sv.Q_TIME], 0.0)


@njit
def _remember(state: FloatArray, p: FloatArray) -> None:
    """Note what was sent since the newest reading, and the reading if there is a newer one."""
    head = int(p[_AT.head])
    sent = max(abs(state[sv.SENT_LEFT]), abs(state[sv.SENT_RIGHT]))
    pushed = sent / p[_AT.governed] * p[_AT.acceleration] if p[_AT.governed] > 0.0 else 0.0
    p[_AT.caused] = snapped(p[_AT.caused] + (pushed - p[_AT.caused] / p[_AT.cause]) * state[sv.DT])
    p[_AT.peak] = max(pushed, p[_AT.peak] * (1.0 - min(state[sv.DT] / _PEAK_LASTS, 1.0)))
    row = _RING + 4 * head
    p[row + 3] = max(p[row + 3], pushed)
    if p[_AT.samples] > 0.0:
        if state[sv.Q_TIME] == p[row + 2]:
            return
        left, right = abs(state[sv.Q_LEFT] - p[row]), abs(state[sv.Q_RIGHT] - p[row + 1])
        if not (left < _JUMP and right < _JUMP and state[sv.Q_TIME] > p[row + 2]):
            p[_AT.samples] = 0.0
        head = (head + 1) % _WINDOW
        row = _RING + 4 * head
    p[_AT.head] = head
    p[_AT.samples] = min(p[_AT.samples] + 1.0, _WINDOW)
    p[row], p[row + 1] = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    # What was sent before it came acts after it, if it was read before now.
    p[row + 2], p[row + 3] = state[sv.Q_TIME], p[_AT.peak] if _age(state) > 0.0 else 0.0


@njit
def _watch(state: FloatArray, p: FloatArray, speed: float) -> None:
    """Set LET_GO once the hub has run, as the force alone can have made it run, for long enough.

    A speed beyond what was pushed proves a hand that moves the needle, or a blow.
    """
    step = max(state[sv.DT], 0.0)
    p[_AT.hand_seen] = max(p[_AT.hand_seen] - step, 0.0)
    if speed > _BEYOND * p[_AT.caused] + p[_AT.hand]:
        p[_AT.hand_seen] = _HAND_STAYS
    running = speed > p[_AT.run_away] and p[_AT.hand_seen] == 0.0
    p[_AT.running] = p[_AT.running] + step if running else 0.0
    if p[_AT.running] >= p[_AT.patience]:
        state[sv.LET_GO] = 1.0


@njit
def _let_nothing_pass(state: FloatArray, p: FloatArray) -> None:
    """Zero torque; a fresh start of the windows afterwards."""
    p[_AT.samples] = p[_AT.governed] = p[_AT.running] = 0.0
    state[sv.LET_GO_SCALE] = state[sv.TORQUE_LEFT] = state[sv.TORQUE_RIGHT] = 0.0


@stage
def fixed_speed_stage(state: FloatArray, p: FloatArray) -> None:
    """Scale TORQUE_* so that a needle let go stays slow; write LET_GO_SCALE and LET_GO."""
    left, right = state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT]
    if not state[sv.ENABLED] > 0.5:
        state[sv.LET_GO] = 0.0
        p[_AT.running] = p[_AT.caused] = 0.0
    state[sv.LET_GO_SCALE] = 1.0
    if state[sv.KINEMATICS] != OK or not isfinite(left + right + state[sv.Q_TIME]):
        p[_AT.samples] = p[_AT.governed] = 0.0  # safety lets nothing pass; a fresh start afterwards
        return
    _remember(state, p)
    size, along_left, along_right, ll, lr, rr = free_acceleration(state, p, left, right)
    if not isfinite(size):  # what cannot be bounded is not let through
        _let_nothing_pass(state, p)
        return
    scale = 1.0
    if size > 0.0:
        step, age = max(state[sv.DT], _SHORTEST), _age(state)
        doubt = p[_AT.resolution] * sqrt(ll + rr + 2.0 * abs(lr))  # both joints one count out
        cap = min(stoppable(p[_AT.limit] - p[_AT.hand], doubt, step + age) / size, 1.0)
        least, most = speed_bounds(
            p[_RING:],
            int(p[_AT.head]),
            int(p[_AT.samples]),
            along_left,
            along_right,
            ll,
            lr,
            rr,
            p[_AT.resolution],
        )
        # A first reading bounds nothing: no force yet. Since the newest, the force went on.
        since = p[_RING + 4 * int(p[_AT.head]) + 3] * age
        room = (p[_AT.limit] - max(most + since, 0.0)) / step
        state[sv.LET_GO_SCALE] = min(max(room / (cap * size), 0.0), 1.0)
        state[sv.LIMIT_SCALE] *= cap
        scale = cap * state[sv.LET_GO_SCALE]
        _watch(state, p, least)
    p[_AT.acceleration] = scale * size
    p[_AT.governed] = scale * max(abs(left), abs(right))
    state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = scale * left, scale * right


def fixed_speed(profile: PantographProfile) -> Stage:
    """Return the stage for a loop's table, under the name of the one it stands for."""
    a1, a2, base = profile.pantograph.links
    part = profile.lumped_inertia
    parameters = packed(
        _AT,
        np.zeros(4 * _WINDOW),
        a1=a1,
        a2=a2,
        base=base,
        driven=part.driven,
        passive=part.passive,
        coupling=part.coupling,
        tool=part.tool,
        resolution=2.0 * pi / profile.encoder.counts_per_turn,
        limit=0.235,
        hand=0.08,
        run_away=0.14,
        patience=0.004,
        cause=0.3,
    )
    return Stage("governor", fixed_speed_stage, parameters)
