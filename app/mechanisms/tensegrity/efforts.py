"""What the needle holder's four winches are told, and what of cables and encoders has failed.

*Pulling*: the two torques that laws, governor, guard and safety have let through become the least
tensions that give them (`cable_kernels.tensions_kernel`); what the cables cannot give within their
limits is the shortfall. *Holding*: where a law asks for it (HOLD), the winches do not pull but turn
as far as is told, and stand: no force of the program drives the needle then, only as much reeling
as brings it to the path at a bounded rate, and a push of the hand meets the cables' elasticity.

The direction is held more finely than the encoders count. A count says between which two angles β
is; reels and tensions say by how much it has changed since, as l_i = rest_i + x(t_i) - reel_i:

    Δβ = Σ l_i' Δl_i / Σ l_i'²,   kept within the count that is read,

so that every edge that passes corrects what has gathered. While the hand is pushed by more than
what it is cleared for, the guide does not turn towards a path; where it has arrived at one, it is
held there against any hand, which then feels its own push.

The *watch* compares the same three. A tension that is missing where the lengths say that the cable
is stretched is a broken cable, where they say that it hangs a slack one; cables that agree with
each other and not with an encoder tell that the encoder is lost, and so does one that is silent or
no number (one that jumps is judged before, as on every machine). It is found within 20 ms of
showing, and then nothing pulls until the forces are disarmed. A motor's current cannot tell a torn
cable from a taut one; its reel runs away.
"""

from math import isfinite, pi, sqrt
from typing import Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import Stage, numbered, packed
from app.mechanisms.lever import felt_kernel, tool_force_kernel
from app.mechanisms.status import OK
from app.mechanisms.tensegrity.cable_kernels import (
    cable_kernel,
    stretch_kernel,
    tensions_kernel,
    torques_kernel,
)
from app.mechanisms.tensegrity.kernels import inverse_kernel
from app.mechanisms.tensegrity.profile import TensegrityProfile, TensionFrom
from app.mechanisms.tensegrity.stages import FRAME, FRAME_SIZE, guide_terms, needle_along
from app.mechanisms.turning import SIZE

SLACK: Final = 14
BROKEN: Final = 15
LOST: Final = 16
"""Codes of `device.faults.Fault`, which stands in a room above; a test holds them together."""

_FRAME: Final = SIZE
"""Place of the frame's numbers behind those of `turning.ROD`, in the arrays of both stages."""


class CablePlaces(NamedTuple):
    """Law and limits of the cables, what holding does, what the watch tolerates; and memory."""

    k0: int
    c: int
    least: int
    most: int
    holding: int  # pretension while winches hold [N]
    asked: int  # stiffness of a joint asked of pretension [N·m/rad]
    fastest: int  # of a reel [m/s]
    one_count: int  # one count of the encoders [rad]
    hand_force: int  # beyond which the guide does not turn [N]
    tilt: int  # cosine of the largest tilt that is held
    known: int = 0
    est1: int = 0
    est2: int = 0
    free1: int = 0
    free2: int = 0
    free3: int = 0
    free4: int = 0
    arrived: int = 0  # 1 once the guide stood at the goal
    goal1: int = 0
    goal2: int = 0
    worst_end: int = 0  # 1: what is felt counts at the deepest that the needle can be


AT: Final = numbered(CablePlaces, SIZE + FRAME_SIZE)

_GAIN: Final = 10.0  # [1/s] of the guide towards the path
_RATE: Final = 0.25  # [rad/s] fastest of a joint while it turns by itself
_NEAR: Final = 0.02  # [rad] to the path: where it has arrived, it is held so near against any hand
_ARRIVED: Final = 0.005  # [rad] to the path: there it has arrived
_SHORTEST: Final = 0.005  # [m] no lever is taken for shorter
_TIGHTEN: Final = 0.01  # [m/s/N] of the reels towards the pretension

Slopes = tuple[float, float, float, float]
"""Derivatives of the four cables' lengths by their joint [m/rad]."""


@njit
def _slopes(p: FloatArray, b1: float, b2: float) -> Slopes:
    fold = p[_FRAME + FRAME.fold]
    _, _, p1, q1, _, _ = cable_kernel(b1, p[_FRAME + FRAME.radius1], p[_FRAME + FRAME.gain1], fold)
    _, _, p2, q2, _, _ = cable_kernel(b2, p[_FRAME + FRAME.radius2], p[_FRAME + FRAME.gain2], fold)
    return p1, q1, p2, q2


@njit
def _free(state: FloatArray, k: int, k0: float, c: float) -> float:
    """Length of a cable between its joints but for a constant [m], by tension and reel."""
    return stretch_kernel(state[sv.CABLE_1 + k], k0, c) - state[sv.REEL_1 + k]


@njit
def _inside(estimate: float, reading: float, count: float) -> float:
    return min(max(estimate, reading - 0.5 * count), reading + 0.5 * count)


@njit
def _estimate(state: FloatArray, p: FloatArray) -> None:
    """Keep the joints' angles within their counts, moved by what reels and tensions have done."""
    b1, b2, count = state[sv.Q_LEFT], state[sv.Q_RIGHT], p[AT.one_count]
    k0, c = p[AT.k0], p[AT.c]
    f1, f2 = _free(state, 0, k0, c), _free(state, 1, k0, c)
    f3, f4 = _free(state, 2, k0, c), _free(state, 3, k0, c)
    if not isfinite(f1 + f2 + f3 + f4 + b1 + b2):
        p[AT.known] = 0.0
        return
    if p[AT.known] == 0.0:
        p[AT.est1], p[AT.est2], p[AT.known] = b1, b2, 1.0
    else:
        d1, d2, d3, d4 = _slopes(p, p[AT.est1], p[AT.est2])
        first, second = d1 * d1 + d2 * d2, d3 * d3 + d4 * d4
        moved1 = (d1 * (f1 - p[AT.free1]) + d2 * (f2 - p[AT.free2])) / first
        moved2 = (d3 * (f3 - p[AT.free3]) + d4 * (f4 - p[AT.free4])) / second
        p[AT.est1] = _inside(p[AT.est1] + moved1, b1, count)
        p[AT.est2] = _inside(p[AT.est2] + moved2, b2, count)
    p[AT.free1], p[AT.free2], p[AT.free3], p[AT.free4] = f1, f2, f3, f4


@njit
def _goal(state: FloatArray, p: FloatArray) -> tuple[bool, float, float]:
    """Joint angles that point along the path: whether there are any, β1, β2."""
    x, y, z = state[sv.PATH_X], state[sv.PATH_Y], state[sv.PATH_Z]
    length = sqrt(x * x + y * y + z * z)
    if not (length > 0.0 and -z >= p[AT.tilt] * length):
        return False, 0.0, 0.0
    c, s = p[_FRAME + FRAME.cosine], p[_FRAME + FRAME.sine]
    status, b1, b2 = inverse_kernel(
        -(c * x + s * y),
        -(c * y - s * x),
        -z,
        p[_FRAME + FRAME.gain1],
        p[_FRAME + FRAME.gain2],
        p[_FRAME + FRAME.fold],
        p[_FRAME + FRAME.c10],
        p[_FRAME + FRAME.s10],
        p[_FRAME + FRAME.c20],
        p[_FRAME + FRAME.s20],
        p[_FRAME + FRAME.half_cos],
        p[_FRAME + FRAME.half_sin],
        1.0,
    )
    return status == OK, b1, b2


@njit
def _tell_what_is_felt(state: FloatArray, p: FloatArray, b1: float, b2: float) -> float:
    """Write FELT_* from the cables' tensions less the weight of guide and needle; return the
    largest that it can be [N].
    """
    left, right = torques_kernel(
        state[sv.CABLE_1],
        state[sv.CABLE_2],
        state[sv.CABLE_3],
        state[sv.CABLE_4],
        b1,
        b2,
        p[_FRAME + FRAME.radius1],
        p[_FRAME + FRAME.radius2],
        p[_FRAME + FRAME.gain1],
        p[_FRAME + FRAME.gain2],
        p[_FRAME + FRAME.fold],
        p[_FRAME + FRAME.c10],
        p[_FRAME + FRAME.s10],
        p[_FRAME + FRAME.c20],
        p[_FRAME + FRAME.s20],
        p[_FRAME + FRAME.half_cos],
        p[_FRAME + FRAME.half_sin],
    )
    inertia, moment, _ = needle_along(p, 0, state[sv.DEPTH], 0.0)
    _, terms = guide_terms(p, 0, b1, b2, 0.0, 0.0, inertia, moment, 0.0, 0.0)
    status, gx, gy = tool_force_kernel(
        left - terms[5],
        right - terms[6],
        state[sv.J_XL],
        state[sv.J_XR],
        state[sv.J_YL],
        state[sv.J_YR],
    )
    if status != OK:
        return np.inf
    dx, dy, dz = state[sv.AXIS_X], state[sv.AXIS_Y], state[sv.AXIS_Z]
    fx, fy, fz = felt_kernel(gx, gy, dx, dy, dz, state[sv.L_IN], state[sv.L_OUT])
    size = sqrt(fx * fx + fy * fy + fz * fz)
    if not isfinite(size):
        return np.inf
    state[sv.FELT_X], state[sv.FELT_Y], state[sv.FELT_Z] = fx, fy, fz
    if p[AT.worst_end] != 0.0:
        length = state[sv.L_OUT] + state[sv.DEPTH]
        shortest = min(max(length - state[sv.DEPTH_MOST], _SHORTEST), state[sv.L_OUT])
        size *= state[sv.L_OUT] / shortest
    state[sv.FELT_MOST] = size
    return size


@njit
def _reel_pair(
    state: FloatArray, p: FloatArray, first: int, speed: float, p1: float, q1: float
) -> None:
    """Turn two reels so that their joint moves at `speed` [rad/s] and both cables stay taut."""
    low = min(state[sv.CABLE_1 + first], state[sv.CABLE_2 + first])
    norm = sqrt(p1 * p1 + q1 * q1)
    high = max(state[sv.CABLE_1 + first], state[sv.CABLE_2 + first])
    tighten = _TIGHTEN * min(p[AT.holding] - low, p[AT.most] - high)
    fastest = p[AT.fastest]
    for k in range(2):
        slope, share = (p1, -q1 / norm) if k == 0 else (q1, p1 / norm)
        rate = -slope * speed + tighten * share
        state[sv.REEL_RATE_1 + first + k] = min(max(rate, -fastest), fastest)


@njit
def _hold(state: FloatArray, p: FloatArray, goal1: float, goal2: float) -> None:
    """Tell the reels to bring the guide to the goal, and to stand."""
    b1, b2 = p[AT.est1], p[AT.est2]
    felt = _tell_what_is_felt(state, p, state[sv.Q_LEFT], state[sv.Q_RIGHT])
    share = min(state[sv.SAFETY_SCALE], 1.0)
    cleared = min(p[AT.hand_force], state[sv.FORCE_CAP])
    way1, way2 = _GAIN * (goal1 - b1), _GAIN * (goal2 - b2)
    largest = max(abs(way1), abs(way2))
    share *= min(1.0, _RATE / largest) if largest > 0.0 else 1.0
    if goal1 != p[AT.goal1] or goal2 != p[AT.goal2]:
        p[AT.arrived], p[AT.goal1], p[AT.goal2] = 0.0, goal1, goal2
    if largest <= _GAIN * _ARRIVED and felt <= cleared:
        p[AT.arrived] = 1.0
    held = p[AT.arrived] != 0.0 and largest <= _GAIN * _NEAR
    if felt > cleared and not held:  # it does not turn against a hand like that
        share = 0.0
    p1, q1, p2, q2 = _slopes(p, b1, b2)
    _reel_pair(state, p, 0, share * way1, p1, q1)
    _reel_pair(state, p, 2, share * way2, p2, q2)
    state[sv.HOLDING] = 1.0
    state[sv.GUIDANCE_LIMIT], state[sv.GUIDANCE_LIMITED_BY] = cleared, 0.0  # winches do not push
    for k in range(4):
        state[sv.TENSION_1 + k] = state[sv.CABLE_1 + k]
    state[sv.TORQUE_LEFT] = state[sv.TORQUE_RIGHT] = 0.0
    state[sv.SHORTFALL_LEFT] = state[sv.SHORTFALL_RIGHT] = 0.0
    for k in range(3):  # no force of a law is had while winches stand
        state[sv.FORCE_X + k] = state[sv.GUIDE_X + k] = 0.0


@stage
def efforts_stage(state: FloatArray, p: FloatArray) -> None:
    """Write TENSION_*, or HOLDING and REEL_RATE_*; nothing pulls after a fault of the machine."""
    state[sv.HOLDING] = 0.0
    for k in range(4):
        state[sv.REEL_RATE_1 + k] = 0.0
    _estimate(state, p)
    b1, b2 = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    if state[sv.MACHINE_FAULT] != 0.0 or state[sv.KINEMATICS] != OK:
        for k in range(4):
            state[sv.TENSION_1 + k] = 0.0
        state[sv.SHORTFALL_LEFT] = state[sv.SHORTFALL_RIGHT] = 0.0
        return
    if (
        state[sv.HOLD] > 0.5
        and state[sv.ENABLED] > 0.5
        and state[sv.FAULT] == 0.0
        and state[sv.SAFETY_SCALE] > 0.0
        and p[AT.known] != 0.0
    ):
        there, goal1, goal2 = _goal(state, p)
        if there:
            _hold(state, p, goal1, goal2)
            return
    p[AT.arrived] = 0.0
    _, t1, t2, t3, t4, short1, short2 = tensions_kernel(
        b1,
        b2,
        state[sv.TORQUE_LEFT],
        state[sv.TORQUE_RIGHT],
        p[AT.asked],
        p[AT.asked],
        p[AT.k0],
        p[AT.c],
        p[AT.least],
        p[AT.most],
        p[_FRAME + FRAME.radius1],
        p[_FRAME + FRAME.radius2],
        p[_FRAME + FRAME.gain1],
        p[_FRAME + FRAME.gain2],
        p[_FRAME + FRAME.fold],
        p[_FRAME + FRAME.c10],
        p[_FRAME + FRAME.s10],
        p[_FRAME + FRAME.c20],
        p[_FRAME + FRAME.s20],
        p[_FRAME + FRAME.half_cos],
        p[_FRAME + FRAME.half_sin],
    )
    state[sv.TENSION_1], state[sv.TENSION_2] = t1, t2
    state[sv.TENSION_3], state[sv.TENSION_4] = t3, t4
    state[sv.SHORTFALL_LEFT], state[sv.SHORTFALL_RIGHT] = short1, short2


class WatchPlaces(NamedTuple):
    """What the watch knows of cables and encoders; and memory."""

    k0: int
    c: int
    least: int
    by_current: int
    found: int = 0
    armed: int = 0
    pulled: int = 0  # time for which all cables have been taut since they were asked to pull [s]
    waited: int = 0  # time for which they have been asked without being it [s]
    known: int = 0
    rest1: int = 0
    rest2: int = 0
    rest3: int = 0
    rest4: int = 0
    low1: int = 0
    low2: int = 0
    low3: int = 0
    low4: int = 0
    run1: int = 0
    run2: int = 0
    run3: int = 0
    run4: int = 0
    apart: int = 0


W: Final = numbered(WatchPlaces, SIZE + FRAME_SIZE)

PATIENCE: Final = 0.010
"""Time for which something must show before it is a fault [s]."""
RUNS: Final = 3e-3
"""Length that a reel must have taken in beyond any stretch to be called torn [m]."""
SILENT: Final = 0.018
"""Age of an encoder's reading that a machine with cables does not go on with [s]."""
CONTRADICTS: Final = 0.03
"""Angle by which cables and an encoder must differ [rad]."""

_STARTS: Final = 0.1  # [s] for which all cables are taut before they are compared
_TAUT_BY: Final = 1.0  # [s] after arming: one that is not taut by then does not get it
_HANGS: Final = -0.3e-3  # [m] of stretch: shorter by more than a count explains
_MISSING: Final = 0.25  # of the least tension


@njit
def _cables_say(
    state: FloatArray, p: FloatArray, dt: float, excess: tuple[float, float, float, float]
) -> int:
    """Look for cables that are torn or slack: the fault, or 0."""
    found = 0
    for k in range(4):
        beyond = excess[k]
        low = state[sv.CABLE_1 + k] < _MISSING * p[W.least]
        p[W.low1 + k] = p[W.low1 + k] + dt if low else 0.0
        others = 0.0
        for j in range(4):
            others = max(others, abs(excess[j]) if j != k else 0.0)
        runs = beyond > RUNS and others < 0.5 * RUNS
        p[W.run1 + k] = p[W.run1 + k] + dt if runs else 0.0
        if p[W.low1 + k] >= PATIENCE:
            found = SLACK if beyond < _HANGS else BROKEN
        elif p[W.run1 + k] >= 0.5 * PATIENCE:
            found = BROKEN
    return found


@njit
def _encoders_say(
    state: FloatArray, p: FloatArray, dt: float, excess: tuple[float, float, float, float]
) -> int:
    """Look for an encoder that both of its cables contradict: the fault, or 0."""
    d1, d2, d3, d4 = _slopes(p, state[sv.Q_LEFT], state[sv.Q_RIGHT])
    first = (d1 * excess[0] + d2 * excess[1]) / (d1 * d1 + d2 * d2)
    second = (d3 * excess[2] + d4 * excess[3]) / (d3 * d3 + d4 * d4)
    taut = True
    for k in range(4):
        taut = taut and state[sv.CABLE_1 + k] > _MISSING * p[W.least]
    wrong = taut and max(abs(first), abs(second)) > CONTRADICTS
    p[W.apart] = p[W.apart] + dt if wrong else 0.0
    return LOST if p[W.apart] >= PATIENCE else 0


@stage
def watch_stage(state: FloatArray, p: FloatArray) -> None:
    """Write MACHINE_FAULT; what is found stays until the forces are disarmed."""
    armed = 1.0 if state[sv.ENABLED] > 0.5 else 0.0
    if p[W.armed] > armed:  # disarmed just now: look anew
        p[W.found] = p[W.known] = p[W.pulled] = p[W.waited] = p[W.apart] = 0.0
        for k in range(4):
            p[W.low1 + k] = p[W.run1 + k] = 0.0
    p[W.armed] = armed
    dt = min(max(state[sv.DT], 0.0), 5e-3)
    b1, b2 = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    found, started = 0, p[W.known] != 0.0
    if not isfinite(b1 + b2):
        found = LOST
    elif state[sv.KINEMATICS] != OK:
        p[W.known] = 0.0
    else:
        if abs(state[sv.TIME] - state[sv.Q_TIME]) > SILENT and started:
            found = LOST
        least = min(
            min(state[sv.TENSION_1], state[sv.TENSION_2]),
            min(state[sv.TENSION_3], state[sv.TENSION_4]),
        )
        asked = armed > 0.0 and (state[sv.HOLDING] > 0.5 or least >= 0.99 * p[W.least])
        taut = True
        for k in range(4):
            taut = taut and state[sv.CABLE_1 + k] >= _MISSING * p[W.least]
        p[W.pulled] = p[W.pulled] + dt if asked and (taut or started) else 0.0
        p[W.waited] = p[W.waited] + dt if asked and not started else 0.0
        if p[W.waited] >= _TAUT_BY:
            found = BROKEN
        if p[W.pulled] >= _STARTS:
            fold = p[_FRAME + FRAME.fold]
            l1, l2, _, _, _, _ = cable_kernel(
                b1, p[_FRAME + FRAME.radius1], p[_FRAME + FRAME.gain1], fold
            )
            l3, l4, _, _, _, _ = cable_kernel(
                b2, p[_FRAME + FRAME.radius2], p[_FRAME + FRAME.gain2], fold
            )
            k0, c = p[W.k0], p[W.c]
            e1, e2 = l1 - _free(state, 0, k0, c), l2 - _free(state, 1, k0, c)
            e3, e4 = l3 - _free(state, 2, k0, c), l4 - _free(state, 3, k0, c)
            if not isfinite(e1 + e2 + e3 + e4):
                found = BROKEN
            elif not started:
                p[W.rest1], p[W.rest2], p[W.rest3], p[W.rest4] = e1, e2, e3, e4
                p[W.known] = 1.0
            else:
                excess = (e1 - p[W.rest1], e2 - p[W.rest2], e3 - p[W.rest3], e4 - p[W.rest4])
                said = _cables_say(state, p, dt, excess)
                if said == 0:
                    said = _encoders_say(state, p, dt, excess)
                found = found if found != 0 else said
    if found != 0 and p[W.found] == 0.0:
        p[W.found] = found
    state[sv.MACHINE_FAULT] = p[W.found]


def cable_stages(profile: TensegrityProfile, values: FloatArray) -> tuple[Stage, Stage]:
    """Return the watch and the efforts of a profile; `values` are those of its pose."""
    part, winches = profile.cables, profile.winches
    efforts = packed(
        numbered(CablePlaces),
        k0=part.stiffness,
        c=part.stiffening,
        least=part.least,
        most=part.most,
        holding=part.holding,
        asked=part.joint_stiffness,
        fastest=winches.fastest,
        one_count=2.0 * pi / profile.encoder.counts_per_turn,
        hand_force=profile.limits.hand_force,
        worst_end=1.0,
        tilt=float(np.cos(profile.tilt_limit + 0.01)),
    )
    watch = packed(
        numbered(WatchPlaces),
        k0=part.stiffness,
        c=part.stiffening,
        least=part.least,
        by_current=float(part.tension_from is TensionFrom.CURRENT),
    )
    return (
        Stage("cables", watch_stage, np.concatenate([values, watch])),
        Stage("tensions", efforts_stage, np.concatenate([values, efforts])),
    )
