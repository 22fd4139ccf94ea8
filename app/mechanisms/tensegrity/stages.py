"""The tensegrity needle holder in the loop: its pose and dynamics, and how the simulated one moves.

Joints are β1 and β2, the needle's direction is -t; the machine's x0 is world x turned by a heading
about the vertical. Cables pull with what their winches give (`cable_work`), so that the motors'
inertia is part of what the joints move.
"""

from math import cos, sqrt
from typing import Final, NamedTuple

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.parameters import numbered
from app.mechanisms.needle_motion import OWN, SUBSTEP, Pose, move_needle
from app.mechanisms.status import OK, SINGULAR
from app.mechanisms.tensegrity.cable_kernels import cable_kernel, pulled_kernel, stretch_kernel
from app.mechanisms.tensegrity.dynamics import dynamics_kernel
from app.mechanisms.tensegrity.kernels import (
    forward_kernel,
    jacobian_kernel,
    jacobian_rate_kernel,
    singularity_kernel,
)
from app.mechanisms.turning import ROD, SIZE, Axis, Terms, tool_of, write_drift, write_pose

NEAR: Final = 1e-6
"""Sine of β/2, or cosine, at which a pantograph counts as stretched or folded: its cables have no
lever left."""


class FramePlaces(NamedTuple):
    """Heading, mass of the bars, spheres and bars, winches; behind those of `turning.ROD`."""

    cosine: int
    sine: int
    density: int
    radius1: int
    radius2: int
    gain1: int
    gain2: int
    fold: int
    c10: int
    s10: int
    c20: int
    s20: int
    half_cos: int
    half_sin: int
    winch_mass: int


FRAME: Final = numbered(FramePlaces)
FRAME_SIZE: Final = len(FRAME)


@njit
def axis_of(p: FloatArray, own: int, b1: float, b2: float) -> Axis:
    """Return d = -t in world, hub to tip, and dd/dβ; `SINGULAR` where a cable has no lever."""
    status, tx, ty, tz = forward_kernel(
        b1,
        b2,
        p[own + FRAME.gain1],
        p[own + FRAME.gain2],
        p[own + FRAME.fold],
        p[own + FRAME.c10],
        p[own + FRAME.s10],
        p[own + FRAME.c20],
        p[own + FRAME.s20],
        p[own + FRAME.half_cos],
        p[own + FRAME.half_sin],
        1.0,
    )
    x1 = x2 = y1 = y2 = z1 = z2 = 0.0
    if status == OK:
        bars = (
            p[own + FRAME.gain1],
            p[own + FRAME.gain2],
            p[own + FRAME.fold],
            p[own + FRAME.c10],
            p[own + FRAME.s10],
            p[own + FRAME.c20],
            p[own + FRAME.s20],
            p[own + FRAME.half_cos],
            p[own + FRAME.half_sin],
        )
        status, x1, x2, y1, y2, z1, z2 = jacobian_kernel(b1, b2, tx, ty, tz, *bars)
        far1, near1, far2, near2, _ = singularity_kernel(b1, b2, tx, ty, tz, *bars)
        if status == OK and not min(far1, near1, far2, near2) > NEAR:
            status = SINGULAR
    c, s = p[own + FRAME.cosine], p[own + FRAME.sine]
    return (
        status,
        s * ty - c * tx,
        -s * tx - c * ty,
        -tz,
        s * y1 - c * x1,
        -s * x1 - c * y1,
        -z1,
        s * y2 - c * x2,
        -s * x2 - c * y2,
        -z2,
    )


@njit
def rates_of(
    p: FloatArray, own: int, b1: float, b2: float, v1: float, v2: float
) -> tuple[float, float, float, float, float, float]:
    """Rate of dd/dβ at β̇ = (v1, v2), in world."""
    bars = (
        p[own + FRAME.gain1],
        p[own + FRAME.gain2],
        p[own + FRAME.fold],
        p[own + FRAME.c10],
        p[own + FRAME.s10],
        p[own + FRAME.c20],
        p[own + FRAME.s20],
        p[own + FRAME.half_cos],
        p[own + FRAME.half_sin],
    )
    _, tx, ty, tz = forward_kernel(b1, b2, *bars, 1.0)
    _, x1, x2, y1, y2, z1, z2 = jacobian_rate_kernel(b1, b2, v1, v2, tx, ty, tz, *bars)
    c, s = p[own + FRAME.cosine], p[own + FRAME.sine]
    return s * y1 - c * x1, -s * x1 - c * y1, -z1, s * y2 - c * x2, -s * x2 - c * y2, -z2


@njit
def guide_terms(
    p: FloatArray,
    first: int,
    b1: float,
    b2: float,
    v1: float,
    v2: float,
    inertia: float,
    moment: float,
    rate: float,
    winches: float,
) -> tuple[int, Terms]:
    """Mass, velocity terms and weight of bars, guide, needle and a share of the winches.

    `inertia` Σ m r² and `moment` Σ m r of the needle along d, `rate` that of the first.
    """
    own = first + SIZE
    c, s = p[own + FRAME.cosine], p[own + FRAME.sine]
    gx, gy = p[first + ROD.gx], p[first + ROD.gy]
    status, m11, m12, m22, h1, h2, g1, g2 = dynamics_kernel(
        b1,
        b2,
        v1,
        v2,
        p[own + FRAME.density],
        p[first + ROD.guide] + inertia,
        -p[first + ROD.guide_moment] - moment,
        rate,
        c * gx + s * gy,
        c * gy - s * gx,
        p[first + ROD.gz],
        p[own + FRAME.radius1],
        p[own + FRAME.radius2],
        p[own + FRAME.gain1],
        p[own + FRAME.gain2],
        p[own + FRAME.fold],
        p[own + FRAME.c10],
        p[own + FRAME.s10],
        p[own + FRAME.c20],
        p[own + FRAME.s20],
        p[own + FRAME.half_cos],
        p[own + FRAME.half_sin],
    )
    mass = winches * p[own + FRAME.winch_mass]
    _, _, p1, q1, pp1, qq1 = cable_kernel(
        b1, p[own + FRAME.radius1], p[own + FRAME.gain1], p[own + FRAME.fold]
    )
    _, _, p2, q2, pp2, qq2 = cable_kernel(
        b2, p[own + FRAME.radius2], p[own + FRAME.gain2], p[own + FRAME.fold]
    )
    return status, (
        m11 + mass * (p1 * p1 + q1 * q1),
        m12,
        m22 + mass * (p2 * p2 + q2 * q2),
        h1 + mass * (p1 * pp1 + q1 * qq1) * v1 * v1,
        h2 + mass * (p2 * pp2 + q2 * qq2) * v2 * v2,
        g1,
        g2,
    )


@njit
def needle_along(
    p: FloatArray, first: int, depth: float, depth_rate: float
) -> tuple[float, float, float]:
    """Σ m r², Σ m r along d, and the rate of the first, of the needle at a depth."""
    mass, s = p[first + ROD.needle_mass], depth + p[first + ROD.needle_offset]
    return p[first + ROD.needle_inertia] + mass * s * s, mass * s, 2.0 * mass * s * depth_rate


@njit
def links_potential(p: FloatArray, first: int, b1: float, b2: float) -> float:
    """Potential of gravity in bars and guide [J], up to a constant.

    A bar between u and v has its middle of mass at R tan(s/2)/s (u + v). Over a rhombus A, B, T, D
    the sum of all u + v is 2 (A + T + B + D), with B + D = 2 (cos s A + sin s cos(β/2) e), e across
    A towards T; over two that meet in C it is 2 (A + T) + (4 + 8 cos s) C.
    """
    own = first + SIZE
    status, dx, dy, dz, _, _, _, _, _, _ = axis_of(p, own, b1, b2)
    if status != OK:
        return 0.0
    c, s = p[own + FRAME.cosine], p[own + FRAME.sine]
    gx, gy, gz = p[first + ROD.gx], p[first + ROD.gy], p[first + ROD.gz]
    hx, hy = c * gx + s * gy, c * gy - s * gx
    tx, ty, tz = -(c * dx + s * dy), -(c * dy - s * dx), -dz
    total = -p[first + ROD.guide_moment] * (gx * dx + gy * dy + gz * dz)
    for k in range(2):
        ax = p[own + FRAME.c10] if k == 0 else 0.0
        ay = 0.0 if k == 0 else p[own + FRAME.c20]
        az = p[own + FRAME.s10] if k == 0 else p[own + FRAME.s20]
        radius, gain = p[own + FRAME.radius1 + k], p[own + FRAME.gain1 + k]
        cosine = 1.0 / sqrt(1.0 + gain * gain)
        sine = gain * cosine
        # mass of a bar times R tan(s/2)/s: the side cancels
        share = p[own + FRAME.density] * radius * radius * sine / (1.0 + cosine)
        fall_a, fall_t = ax * hx + ay * hy + az * gz, tx * hx + ty * hy + tz * gz
        along = ax * tx + ay * ty + az * tz
        if p[own + FRAME.fold] == 1.0:
            half = cos(0.5 * (b1 if k == 0 else b2))
            across = sqrt(1.0 - along * along)
            middle = cosine * fall_a + sine * half * (fall_t - along * fall_a) / across
            fall = 2.0 * (fall_a + fall_t) + 4.0 * middle
        else:
            reach = sqrt(2.0 + 2.0 * along)
            fall = 2.0 * (fall_a + fall_t) + (4.0 + 8.0 * cosine) * (fall_a + fall_t) / reach
        total -= share * fall
    return total


@stage
def pose_stage(state: FloatArray, p: FloatArray) -> None:
    """Write KINEMATICS, and where it is OK P3_*, J_* and INERTIA_*."""
    write_pose(state, p, axis_of)
    if state[sv.KINEMATICS] != OK:
        return
    b1, b2 = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    status, terms = guide_terms(p, 0, b1, b2, 0.0, 0.0, 0.0, 0.0, 0.0, 1.0)
    state[sv.KINEMATICS] = status
    state[sv.INERTIA_LEFT] = terms[0]
    state[sv.INERTIA_CROSS] = terms[1]
    state[sv.INERTIA_RIGHT] = terms[2]


@stage
def dynamics_stage(state: FloatArray, p: FloatArray) -> None:
    """Write MASS_*, BIAS_*, DRIFT_*, WEIGHT_* and LINKS_POTENTIAL where the pose exists."""
    if state[sv.KINEMATICS] != OK:
        return
    write_drift(state, p, axis_of, rates_of)
    b1, b2, v1, v2 = state[sv.Q_LEFT], state[sv.Q_RIGHT], state[sv.QD_LEFT], state[sv.QD_RIGHT]
    inertia, moment, _ = needle_along(p, 0, state[sv.DEPTH], 0.0)
    _, terms = guide_terms(p, 0, b1, b2, v1, v2, inertia, moment, 0.0, 1.0)
    state[sv.MASS_LEFT], state[sv.MASS_CROSS], state[sv.MASS_RIGHT] = terms[0], terms[1], terms[2]
    state[sv.BIAS_LEFT], state[sv.BIAS_RIGHT] = terms[3], terms[4]
    state[sv.WEIGHT_LEFT], state[sv.WEIGHT_RIGHT] = terms[5], terms[6]
    state[sv.LINKS_POTENTIAL] = links_potential(p, 0, b1, b2)


class WinchPlaces(NamedTuple):
    """Law of a cable, winches at the cable, how tension is measured; and memory.

    `reel` is what is reeled in [m], `rest` the cable's length without load at the start, `held`
    and `given` the winch's speed as a0 - a1 β̇, and `torn` 1 for a cable that has broken.
    """

    k0: int
    c: int
    least: int
    most: int
    mass: int
    coulomb: int
    viscous: int
    fastest: int
    by_current: int
    started: int = 0
    reel1: int = 0
    reel2: int = 0
    reel3: int = 0
    reel4: int = 0
    rate1: int = 0
    rate2: int = 0
    rate3: int = 0
    rate4: int = 0
    rest1: int = 0
    rest2: int = 0
    rest3: int = 0
    rest4: int = 0
    held1: int = 0
    held2: int = 0
    held3: int = 0
    held4: int = 0
    given1: int = 0
    given2: int = 0
    given3: int = 0
    given4: int = 0
    torn1: int = 0
    torn2: int = 0
    torn3: int = 0
    torn4: int = 0


WINCH: Final = numbered(WinchPlaces, OWN + SIZE + FRAME_SIZE)

Levers = tuple[float, float, float, float, float, float, float, float]
"""Lengths of the four cables [m], and their derivatives by their joint."""


@njit
def _levers(p: FloatArray, b1: float, b2: float) -> Levers:
    own = OWN + SIZE
    fold = p[own + FRAME.fold]
    l1, l2, d1, d2, _, _ = cable_kernel(b1, p[own + FRAME.radius1], p[own + FRAME.gain1], fold)
    l3, l4, d3, d4, _, _ = cable_kernel(b2, p[own + FRAME.radius2], p[own + FRAME.gain2], fold)
    return l1, l2, l3, l4, d1, d2, d3, d4


@njit
def _tension(p: FloatArray, k: int, length: float) -> tuple[float, float]:
    """Tension [N] and stiffness [N/m] of a cable at its length between the joints."""
    if p[WINCH.torn1 + k] != 0.0:
        return 0.0, 0.0
    stretch = length + p[WINCH.reel1 + k] - p[WINCH.rest1 + k]
    tension, stiffness, _ = pulled_kernel(stretch, p[WINCH.k0], p[WINCH.c])
    return tension, stiffness


@njit
def _pull(
    state: FloatArray, p: FloatArray, h: float, k: int, length: float, lever: float
) -> tuple[float, float]:
    """Tension at the end of a substep as A + B β̇, with the winch's speed a0 - a1 β̇ eliminated.

    While it pulls, (m + h b + h² k) u = m u0 + h (T - t - k h l' β̇) less dry friction; while it
    holds, its speed is what is asked.
    """
    tension, stiffness = _tension(p, k, length)
    fastest, stuck = p[WINCH.fastest], False
    if state[sv.HOLDING] > 0.5:
        held, given = min(max(state[sv.REEL_RATE_1 + k], -fastest), fastest), 0.0
    else:
        asked = min(max(state[sv.TENSION_1 + k], 0.0), p[WINCH.most])
        mass = p[WINCH.mass] + h * p[WINCH.viscous] + h * h * stiffness
        impulse = p[WINCH.mass] * p[WINCH.rate1 + k] + h * (asked - tension)
        dry = h * p[WINCH.coulomb]
        stuck = not abs(impulse) > dry
        held = given = 0.0
        if not stuck:
            held = (impulse - dry if impulse > 0.0 else impulse + dry) / mass
            given = h * h * stiffness * lever / mass
            if abs(held) > fastest:
                held, given = (fastest if held > 0.0 else -fastest), 0.0
    p[WINCH.held1 + k], p[WINCH.given1 + k] = held, given
    at_end = tension + stiffness * h * held
    if not at_end > 0.0:
        return 0.0, 0.0
    return at_end, stiffness * h * (lever - given)


@njit
def drive(state: FloatArray, p: FloatArray, h: float) -> tuple[float, float, float, float, float]:
    """Torques of the four cables on the joints, and what of them grows with the joints' speeds."""
    l1, l2, l3, l4, d1, d2, d3, d4 = _levers(p, state[sv.PLANT_Q_LEFT], state[sv.PLANT_Q_RIGHT])
    if p[WINCH.started] == 0.0:
        rest = stretch_kernel(p[WINCH.least], p[WINCH.k0], p[WINCH.c])
        p[WINCH.rest1], p[WINCH.rest2] = l1 - rest, l2 - rest
        p[WINCH.rest3], p[WINCH.rest4] = l3 - rest, l4 - rest
        p[WINCH.started] = 1.0
    t1, k1 = _pull(state, p, h, 0, l1, d1)
    t2, k2 = _pull(state, p, h, 1, l2, d2)
    t3, k3 = _pull(state, p, h, 2, l3, d3)
    t4, k4 = _pull(state, p, h, 3, l4, d4)
    return (
        -t1 * d1 - t2 * d2,
        -t3 * d3 - t4 * d4,
        h * (k1 * d1 + k2 * d2),
        0.0,
        h * (k3 * d3 + k4 * d4),
    )


@njit
def settle(state: FloatArray, p: FloatArray, h: float) -> None:
    """Turn the winches, and measure what they have reeled in and how the cables pull."""
    v1, v2 = state[sv.PLANT_QD_LEFT], state[sv.PLANT_QD_RIGHT]
    l1, l2, l3, l4, _, _, _, _ = _levers(p, state[sv.PLANT_Q_LEFT], state[sv.PLANT_Q_RIGHT])
    for k in range(4):
        speed = p[WINCH.held1 + k] - p[WINCH.given1 + k] * (v1 if k < 2 else v2)
        p[WINCH.rate1 + k] = speed
        p[WINCH.reel1 + k] += h * speed
        state[sv.PLANT_REEL_1 + k] = p[WINCH.reel1 + k]
        length = l1 if k == 0 else (l2 if k == 1 else (l3 if k == 2 else l4))
        tension, _ = _tension(p, k, length)
        pulls = p[WINCH.by_current] != 0.0 and not state[sv.HOLDING] > 0.5
        state[sv.PLANT_CABLE_1 + k] = state[sv.TENSION_1 + k] if pulls else tension


@njit
def pose_of(p: FloatArray, q1: float, q2: float) -> Pose:
    """Tool point and Jacobian of the simulated machine."""
    return tool_of(p, OWN, q1, q2, axis_of)


@njit
def _terms(state: FloatArray, p: FloatArray, pose: Pose) -> Terms:
    inertia, moment, rate = needle_along(p, OWN, state[sv.PLANT_DEPTH], state[sv.PLANT_DEPTH_RATE])
    _, terms = guide_terms(
        p,
        OWN,
        state[sv.PLANT_Q_LEFT],
        state[sv.PLANT_Q_RIGHT],
        state[sv.PLANT_QD_LEFT],
        state[sv.PLANT_QD_RIGHT],
        inertia,
        moment,
        rate,
        0.0,
    )
    return terms


@stage
def plant_stage(state: FloatArray, p: FloatArray) -> None:
    """Move hand, machine, winches and needle by DT (at most 5 ms)."""
    move_needle(state, p, SUBSTEP, pose_of, _terms, drive, settle)
