"""Joints, bars and cables of the tensegrity needle holder as points, for whoever draws it.

Two ways lead to a joint. `machine_points` uses the sphere: a rhombus A, B, X, D of side s with the
angle β at A has its middle on the arc A X, and B and D at the arc e from it to both sides,
sin e = sin s sin(β/2); nothing is lost where the rhombus is stretched. `trilaterate` is the
paper's (equations 6 and 7): the point that has given distances from O, A and T. For C, the arc's
midpoint, its three spheres touch in one point, which rounding pulls apart in every other pose
(errata C7); there the height over the plane of the centres is lost to half of its digits.
"""

from collections.abc import Mapping
from dataclasses import dataclass
from itertools import pairwise
from math import cos, sin, sqrt
from types import MappingProxyType
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, cross, frozen, unit
from app.core.messages import sentence
from app.mechanisms.errors import DegenerateError, NotFiniteError, UnreachableError
from app.mechanisms.tensegrity.cables import CABLE_NAMES
from app.mechanisms.tensegrity.geometry import TensegrityGeometry
from app.mechanisms.tensegrity.kinematics import inverse

CABLE_ENDS: Final = tuple((name[:2], name[2:]) for name in CABLE_NAMES)
"""The joints between which the four cables run straight, in the order of every array of four."""

_TOUCHING: Final = 1e-12


@dataclass(frozen=True, slots=True, eq=False)
class Trilateration:
    """A point at three given distances.

    Attributes:
        point: where it is [m], shape (3,).
        height: distance from the plane of the centres [m]; 0 where the spheres only touch.
        tangent: whether they touch, to 1e-12 of the size squared; a point that stands up to 1e-6
            of the size off the plane of the centres is then put into it.
    """

    point: FloatArray
    height: float
    tangent: bool


@dataclass(frozen=True, slots=True, eq=False)
class MachinePoints:
    """All joints of a pose in machine axes, and what joins them.

    Attributes:
        points: name -> position [m], shape (3,): O, and of each pantograph A, B, C, D, T (B1 ...
            T2), with two rhombi also E and F.
        bars: pairs of names; each pair keeps its distance in all poses and is an arc about O.
        cables: pairs of names, in the order of every array of four.
    """

    points: Mapping[str, FloatArray]
    bars: tuple[tuple[str, str], ...]
    cables: tuple[tuple[str, str], ...] = CABLE_ENDS


def machine_points(geometry: TensegrityGeometry, t: ArrayLike) -> MachinePoints:
    """Joints of the pose with the direction t, shape (3,), of any length.

    B (and E) stand on the side of a × t, D (and F) on the other. T of each pantograph lies on its
    own sphere (errata C3). With one rhombus C is no joint but the middle of the arc A T, where the
    paper's second cable is attached.

    Raises:
        DegenerateError: if T stands on a base joint: the plane of that rhombus is not defined.
        MechanismError: as `inverse`.
    """
    beta, direction = inverse(geometry, t), unit(t)
    points: dict[str, FloatArray] = {"O": frozen(np.zeros(3))}
    bars: list[tuple[str, str]] = []
    parts = zip((1, 2), geometry.bases, geometry.radii, geometry.sides, beta.tolist(), strict=True)
    for number, base, radius, side, angle in parts:
        aside = cross(base, direction)
        if np.linalg.norm(aside) < _TOUCHING:
            raise DegenerateError(
                sentence(
                    "degenerate: T stands on A{base_number}; its rhombus has no plane there, "
                    "turn the guide away",
                    base_number=number,
                )
            )
        middle, outwards = unit(base + direction), unit(aside)
        corners = [base, direction] if geometry.rhombi == 1 else [base, middle, direction]
        names = ["B", "D", "E", "F"][: 2 * geometry.rhombi]
        ends = ["A", "T"] if geometry.rhombi == 1 else ["A", "C", "T"]
        here = {"A": base, "C": middle, "T": direction}
        for k, (near, far) in enumerate(pairwise(corners)):
            left, right = _tips(near, far, outwards, side, angle)
            b, d = names[2 * k], names[2 * k + 1]
            here |= {b: left, d: right}
            bars += [
                (f"{x}{number}", f"{y}{number}")
                for x, y in ((ends[k], b), (b, ends[k + 1]), (ends[k], d), (d, ends[k + 1]))
            ]
        points |= {f"{name}{number}": frozen(radius * place) for name, place in here.items()}
    return MachinePoints(MappingProxyType(points), tuple(bars))


def _tips(
    near: FloatArray, far: FloatArray, outwards: FloatArray, side: float, angle: float
) -> tuple[FloatArray, FloatArray]:
    middle = unit(near + far)
    half = float(np.dot(near, middle))  # cos of half the diagonal; cos e = cos s / cos(half)
    sine, cosine = sin(side) * sin(0.5 * angle), cos(side) / half
    return unit(cosine * middle + sine * outwards), unit(cosine * middle - sine * outwards)


def trilaterate(centres: ArrayLike, radii: ArrayLike, side: int = 1) -> Trilateration:
    """Point on three spheres (equations 6 and 7), on one side of the plane of their centres.

    Args:
        centres: shape (3, 3) [m], one per row.
        radii: shape (3,) [m].
        side: +1 for the side of (c1 - c0) × (c2 - c0), -1 for the other.

    Spheres that miss each other by less than 1e-12 of the size squared are taken as touching.

    Raises:
        DegenerateError: if the centres lie in one line (T on A, or opposite).
        UnreachableError: if the spheres have no point in common.
        NotFiniteError: if a number is NaN or infinite.
    """
    c, r = np.asarray(centres, dtype=np.float64), np.asarray(radii, dtype=np.float64)
    if not (np.isfinite(c).all() and np.isfinite(r).all()):
        raise NotFiniteError(
            sentence("not finite: spheres at {c} with radii {r}", c=c.tolist(), r=r.tolist())
        )
    first, second = c[1] - c[0], c[2] - c[0]
    u = float(np.linalg.norm(first))
    size2 = max(u * u, float(second @ second), float(r.max()) ** 2)
    aside = cross(first, second)
    if not float(np.linalg.norm(aside)) > 1e-10 * size2:
        raise DegenerateError(
            sentence("degenerate: the centres of the spheres lie in one line: {c}", c=c.tolist())
        )
    x_axis, z_axis = first / u, unit(aside)
    y_axis = cross(z_axis, x_axis)
    vx, vy = float(second @ x_axis), float(second @ y_axis)
    x = (r[0] ** 2 - r[1] ** 2 + u * u) / (2.0 * u)
    y = (r[0] ** 2 - r[2] ** 2 + vx * vx + vy * vy - 2.0 * vx * x) / (2.0 * vy)
    height2 = float(r[0] ** 2 - x * x - y * y)
    if height2 < -_TOUCHING * size2:
        raise UnreachableError(
            sentence(
                "unreachable: spheres with radii {r} m at {c} m have no point in common",
                r=r.tolist(),
                c=c.tolist(),
            )
        )
    tangent = height2 <= _TOUCHING * size2
    height = 0.0 if tangent else sqrt(height2)
    point = c[0] + x * x_axis + y * y_axis + side * height * z_axis
    return Trilateration(frozen(point), height, tangent)
