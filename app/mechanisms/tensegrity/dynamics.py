"""Inertia of the tensegrity needle holder: M β̈ + h + g = τ, compiled; every mass is *assumed*.

All bars are arcs about O, so a bar between joints u and v (unit vectors, the angle s apart) has its
points at r = R (sin(s - φ) u + sin φ v)/sin s, and being uniform the energy

    ½ m R² [A (u̇² + v̇²) + 2 B u̇·v̇],   A = (s - sin s cos s)/(2 s sin²s),
                                        B = (sin s - s cos s)/(2 s sin²s),

its middle of mass R tan(s/2)/s (u + v). Joints follow t: B and D turn about A at χ = ψ ± β/2, ψ the
azimuth of t about a; C is the middle of a and t, and the second rhombus of the scissor reading is
the first one turned by π about C, so that E = 2 cos s C - D and F = 2 cos s C - B. Guide and needle
are what they have along t: Σ m r² and Σ m r. Cables, winches and pulleys weigh nothing.
"""

from dataclasses import dataclass
from math import atan, cos, isfinite, sin, sqrt, tan

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.core.compiled import njit
from app.mechanisms.status import NOT_FINITE, OK, SINGULAR, check
from app.mechanisms.tensegrity.geometry import GuideMasses, TensegrityGeometry
from app.mechanisms.tensegrity.kernels import (
    forward_kernel,
    jacobian_kernel,
    jacobian_rate_kernel,
)
from app.mechanisms.tensegrity.kinematics import numbers

Vector = tuple[float, float, float]
"""Three numbers in machine axes."""

Moving = tuple[Vector, Vector, Vector]
"""Of a joint: its derivatives by β1 and β2, and its acceleration at constant rates."""

Terms = tuple[float, float, float, float, float, float, float]
"""(m11, m12, m22, h1, h2, g1, g2)."""

_STILL = 1e-9  # of |a × t|: nearer to its base joint a rhombus has no plane to turn in


@njit
def _dot(a: Vector, b: Vector) -> float:
    return a[0] * b[0] + a[1] * b[1] + a[2] * b[2]


@njit
def _cross(a: Vector, b: Vector) -> Vector:
    return a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0]


@njit
def _sum(x: float, a: Vector, y: float, b: Vector) -> Vector:
    return x * a[0] + y * b[0], x * a[1] + y * b[1], x * a[2] + y * b[2]


@njit
def _combined(x: float, u: Moving, y: float, v: Moving) -> Moving:
    return (
        _sum(x, u[0], y, v[0]),
        _sum(x, u[1], y, v[1]),
        _sum(x, u[2], y, v[2]),
    )


@njit
def _bar(terms: Terms, u: Moving, v: Moving, same: float, mixed: float, pull: Vector) -> Terms:
    # `same` and `mixed` are m R² A and m R² B, `pull` is m R tan(s/2)/s times gravity.
    m11, m12, m22, h1, h2, g1, g2 = terms
    own = _sum(same, u[2], mixed, v[2])
    other = _sum(mixed, u[2], same, v[2])
    return (
        m11 + same * (_dot(u[0], u[0]) + _dot(v[0], v[0])) + 2.0 * mixed * _dot(u[0], v[0]),
        m12
        + same * (_dot(u[0], u[1]) + _dot(v[0], v[1]))
        + mixed * (_dot(u[0], v[1]) + _dot(u[1], v[0])),
        m22 + same * (_dot(u[1], u[1]) + _dot(v[1], v[1])) + 2.0 * mixed * _dot(u[1], v[1]),
        h1 + _dot(u[0], own) + _dot(v[0], other),
        h2 + _dot(u[1], own) + _dot(v[1], other),
        g1 - _dot(pull, u[0]) - _dot(pull, v[0]),
        g2 - _dot(pull, u[1]) - _dot(pull, v[1]),
    )


@njit
def _turned(axis: Vector, place: Vector, by1: float, by2: float, rate: float, on: float) -> Moving:
    # A joint that turns about a base axis: derivatives of its angle, the angle's rate, and what the
    # rate gains at constant joint rates.
    around = _cross(axis, place)
    inwards = _sum(_dot(axis, place), axis, -1.0, place)
    return (
        _sum(by1, around, 0.0, around),
        _sum(by2, around, 0.0, around),
        _sum(on, around, rate * rate, inwards),
    )


@njit
def _pantograph(
    terms: Terms,
    first: bool,
    axis: Vector,
    t: Vector,
    guide: Moving,
    b: float,
    v1: float,
    v2: float,
    gain: float,
    fold: float,
    radius: float,
    density: float,
    gravity: Vector,
) -> tuple[int, Terms]:
    normal, k = _cross(axis, t), _dot(axis, t)
    square = _dot(normal, normal)
    if square <= _STILL * _STILL:
        return SINGULAR, terms
    size, side = sqrt(square), atan(gain)
    sine, cosine = sin(side), cos(side)
    mass = density * radius * side
    weight = mass * radius * radius / (2.0 * side * sine * sine)
    same, mixed = weight * (side - sine * cosine), weight * (sine - side * cosine)
    share = mass * radius * tan(0.5 * side) / side
    pull = _sum(share, gravity, 0.0, gravity)
    velocity = _sum(v1, guide[0], v2, guide[1])
    azimuth1, azimuth2 = _dot(normal, guide[0]) / square, _dot(normal, guide[1]) / square
    azimuth = azimuth1 * v1 + azimuth2 * v2
    on = (_dot(normal, guide[2]) + 2.0 * k * _dot(axis, velocity) * azimuth) / square
    half1, half2 = (0.5, 0.0) if first else (0.0, 0.5)
    opening = half1 * v1 + half2 * v2
    ahead = _sum(1.0 / size, t, -k / size, axis)
    middle = _sum(cosine, axis, sine * cos(0.5 * b), ahead)
    aside = sine * sin(0.5 * b) / size
    left = _turned(
        axis,
        _sum(1.0, middle, aside, normal),
        azimuth1 + half1,
        azimuth2 + half2,
        azimuth + opening,
        on,
    )
    right = _turned(
        axis,
        _sum(1.0, middle, -aside, normal),
        azimuth1 - half1,
        azimuth2 - half2,
        azimuth - opening,
        on,
    )
    rest = (0.0, 0.0, 0.0)
    base = (rest, rest, rest)
    terms = _bar(terms, base, left, same, mixed, pull)
    terms = _bar(terms, base, right, same, mixed, pull)
    if fold == 1.0:
        terms = _bar(terms, left, guide, same, mixed, pull)
        return OK, _bar(terms, right, guide, same, mixed, pull)
    reach = sqrt(2.0 + 2.0 * k)  # |a + t|
    c = _sum(1.0 / reach, axis, 1.0 / reach, t)
    growth, speed = _dot(c, velocity), 1.0 / reach
    c1 = _sum(speed, guide[0], -speed * _dot(c, guide[0]), c)
    c2 = _sum(speed, guide[1], -speed * _dot(c, guide[1]), c)
    moving = _sum(v1, c1, v2, c2)
    outwards = _dot(moving, velocity) + _dot(c, guide[2])
    on_c = _sum(speed, guide[2], -2.0 * growth * speed * speed, velocity)
    on_c = _sum(1.0, on_c, speed * (2.0 * growth * growth * speed - outwards), c)
    centre = (c1, c2, on_c)
    upper_left = _combined(2.0 * cosine, centre, -1.0, right)
    upper_right = _combined(2.0 * cosine, centre, -1.0, left)
    terms = _bar(terms, left, centre, same, mixed, pull)
    terms = _bar(terms, right, centre, same, mixed, pull)
    terms = _bar(terms, centre, upper_left, same, mixed, pull)
    terms = _bar(terms, centre, upper_right, same, mixed, pull)
    terms = _bar(terms, upper_left, guide, same, mixed, pull)
    return OK, _bar(terms, upper_right, guide, same, mixed, pull)


@njit
def dynamics_kernel(
    b1: float,
    b2: float,
    v1: float,
    v2: float,
    density: float,
    inertia: float,
    moment: float,
    inertia_rate: float,
    gx: float,
    gy: float,
    gz: float,
    radius1: float,
    radius2: float,
    gain1: float,
    gain2: float,
    fold: float,
    c10: float,
    s10: float,
    c20: float,
    s20: float,
    half_cos: float,
    half_sin: float,
) -> tuple[int, float, float, float, float, float, float, float]:
    """Terms of M β̈ + h + g = τ: (status, m11, m12, m22, h1, h2, g1, g2).

    `density` is the mass of a bar by its length [kg/m]; `inertia` Σ m r² [kg·m²], `moment` Σ m r
    [kg·m] (positive towards T) and `inertia_rate` the change of the first [kg·m²/s] are those of
    guide and needle along t. Gravity in machine axes [m/s²]. `SINGULAR` where the pose is flat or T
    stands on a base joint, otherwise as `forward_kernel`.
    """
    nothing = (0.0, 0.0, 0.0, 0.0, 0.0, 0.0, 0.0)
    status, tx, ty, tz = forward_kernel(
        b1, b2, gain1, gain2, fold, c10, s10, c20, s20, half_cos, half_sin, 1.0
    )
    if status != OK:
        return status, *nothing
    if not isfinite(v1 + v2 + inertia + moment + inertia_rate + gx + gy + gz):
        return NOT_FINITE, *nothing
    bars = (gain1, gain2, fold, c10, s10, c20, s20, half_cos, half_sin)
    status, x1, x2, y1, y2, z1, z2 = jacobian_kernel(b1, b2, tx, ty, tz, *bars)
    if status != OK:
        return status, *nothing
    _, dx1, dx2, dy1, dy2, dz1, dz2 = jacobian_rate_kernel(b1, b2, v1, v2, tx, ty, tz, *bars)
    t = (tx, ty, tz)
    by1, by2 = (x1, y1, z1), (x2, y2, z2)
    on = (dx1 * v1 + dx2 * v2, dy1 * v1 + dy2 * v2, dz1 * v1 + dz2 * v2)
    guide = (by1, by2, on)
    gravity = (gx, gy, gz)
    pushed = _sum(inertia, on, inertia_rate, _sum(v1, by1, v2, by2))
    terms = (
        inertia * _dot(by1, by1),
        inertia * _dot(by1, by2),
        inertia * _dot(by2, by2),
        _dot(by1, pushed),
        _dot(by2, pushed),
        -moment * _dot(gravity, by1),
        -moment * _dot(gravity, by2),
    )
    status, terms = _pantograph(
        terms,
        True,
        (c10, 0.0, s10),
        t,
        guide,
        b1,
        v1,
        v2,
        gain1,
        fold,
        radius1,
        density,
        gravity,
    )
    if status != OK:
        return status, *nothing
    status, terms = _pantograph(
        terms,
        False,
        (0.0, c20, s20),
        t,
        guide,
        b2,
        v1,
        v2,
        gain2,
        fold,
        radius2,
        density,
        gravity,
    )
    if status != OK:
        return status, *nothing
    return OK, *terms


@dataclass(frozen=True, slots=True, eq=False)
class GuideTerms:
    """Terms of M β̈ + h + g = τ at one state.

    Attributes:
        mass: M [kg·m²], shape (2, 2).
        velocity: h(β, β̇) [N·m], shape (2,).
        gravity: g(β) [N·m], shape (2,).
    """

    mass: FloatArray
    velocity: FloatArray
    gravity: FloatArray


def guide_dynamics(
    geometry: TensegrityGeometry,
    masses: GuideMasses,
    beta: ArrayLike,
    rates: ArrayLike = (0.0, 0.0),
    gravity: ArrayLike = (0.0, 0.0, -9.80665),
    needle: tuple[float, float, float] = (0.0, 0.0, 0.0),
) -> GuideTerms:
    """Terms of the motion of bars, guide and needle at β [rad] and β̇ [rad/s], shapes (2,).

    Args:
        geometry: lengths of the mechanism.
        masses: of bars and guide.
        beta: joint variables.
        rates: their rates.
        gravity: in machine axes [m/s²], shape (3,).
        needle: Σ m r², Σ m r (positive towards T) along t, and the rate of the first while it
            slides.

    Raises:
        SingularError: if the pose is flat, or T stands on a base joint.
        MechanismError: as `forward`.
    """
    (b1, b2), (v1, v2) = numbers(beta, 2, "beta"), numbers(rates, 2, "rates")
    inertia, moment = masses.along
    status, m11, m12, m22, h1, h2, g1, g2 = dynamics_kernel(
        b1,
        b2,
        v1,
        v2,
        masses.density,
        inertia + needle[0],
        moment + needle[1],
        needle[2],
        *numbers(gravity, 3, "gravity"),
        *geometry.radii,
        *geometry.bars,
    )
    check(status, f"dynamics at β = ({b1}, {b2}) rad, β̇ = ({v1}, {v2}) rad/s")
    return GuideTerms(
        frozen(np.array([[m11, m12], [m12, m22]])), frozen([h1, h2]), frozen([g1, g2])
    )
