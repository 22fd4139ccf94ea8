"""Defects of the needle holder's hard cases: differences, pseudoinverses, the other root."""

from dataclasses import replace
from math import acos, sqrt
from typing import Any

import numpy as np

from app.core.arrays import FloatArray
from app.mechanisms.tensegrity import (
    Cables,
    GuideMasses,
    TensegrityGeometry,
    forward,
    inverse,
    jacobian,
    joint_stiffness,
    length_jacobian,
    machine_points,
    tensions,
    torques,
    trilaterate,
)
from app.mechanisms.tensegrity.dynamics import guide_dynamics
from app.mechanisms.tensegrity.numerical import newton_kernel
from app.studies.hard_cases.tensegrity import PAPER, SCISSOR
from tests.hard.defects import Defect


def other(geometry: TensegrityGeometry) -> TensegrityGeometry:
    return PAPER if geometry is SCISSOR else SCISSOR


def joints_by_acos(geometry: TensegrityGeometry, t: Any) -> FloatArray:
    # Equations 1 and 2 as printed: acos of a dot product that is nearly one.
    found, fold = [], 2.0 * geometry.rhombi
    for base, gain in zip(geometry.bases, geometry.bars[:2], strict=True):
        theta = acos(min(1.0, float(np.dot(base, t))))
        found.append(2.0 * acos(min(1.0, float(np.tan(theta / fold)) / gain)))
    return np.array(found)


def by_cancelled_discriminant(geometry: TensegrityGeometry, beta: Any) -> FloatArray:
    (a1, a2), fold = geometry.bases, 2.0 * geometry.rhombi
    k1, k2 = (
        np.cos(fold * np.arctan(gain * np.cos(0.5 * b)))
        for gain, b in zip(geometry.bars[:2], beta, strict=True)
    )
    g, normal = float(a1 @ a2), np.cross(a1, a2)
    left = 1.0 - g * g - k1 * k1 - k2 * k2 + 2.0 * g * k1 * k2
    foot = (k1 - g * k2) * a1 + (k2 - g * k1) * a2
    with np.errstate(invalid="ignore"):
        return np.asarray((foot + np.sqrt(left) * normal) / (1.0 - g * g))


def iterated(geometry: TensegrityGeometry, beta: Any) -> FloatArray:
    # Newton's method to a residual that looks small.
    start = forward(geometry, beta) + 1e-3 * np.cross(*geometry.bases)
    return np.array(newton_kernel(*beta, *start, 1e-12, *geometry.bars)[1:4])


def jacobian_by_differences(geometry: TensegrityGeometry, beta: Any) -> FloatArray:
    step = 1e-9 * np.eye(2)
    return np.column_stack(
        [(forward(geometry, beta + h) - forward(geometry, beta - h)) / 2e-9 for h in step]
    )


def rate_by_differences(geometry: TensegrityGeometry, beta: Any, rates: Any) -> FloatArray:
    step = 1e-7 * rates
    return (jacobian(geometry, beta + step) - jacobian(geometry, beta - step)) / 2e-7


def higher(geometry: TensegrityGeometry, beta: Any) -> FloatArray:
    both = [forward(geometry, beta, side) for side in (-1, 1)]
    return next(t for t in both if t[2] > 0.0)


def by_pseudoinverse(geometry: TensegrityGeometry, beta: Any) -> FloatArray:
    return np.asarray(np.linalg.pinv(jacobian(geometry, beta), rcond=1e-5))


def by_trilateration(geometry: TensegrityGeometry, t: Any) -> Any:
    shown, radius = machine_points(geometry, t), geometry.first_radius
    bar = 2.0 * radius * np.sin(0.5 * geometry.sides[0])
    centres = [np.zeros(3), shown.points["A1"], shown.points["T1"]]
    found = trilaterate(centres, [radius, bar, bar])
    return replace(shown, points={"B1": found.point})


def untouched(centres: Any, radii: Any) -> Any:
    found = trilaterate(centres, radii)
    return replace(found, point=found.point * sqrt(1.0 - 1e-12))


def by_first_rim(geometry: TensegrityGeometry, t: Any) -> FloatArray:
    base, angle = geometry.bases[0], geometry.largest[0]
    aside = t - (t @ base) * base
    return np.asarray(np.cos(angle) * base + np.sin(angle) * aside / np.linalg.norm(aside))


def least_squares(geometry: TensegrityGeometry, cables: Cables, beta: Any, load: Any) -> Any:
    lever = -length_jacobian(geometry, beta).T
    found = np.linalg.pinv(lever, rcond=1e-5) @ np.asarray(load)
    return replace(tensions(geometry, cables, beta, load), tensions=found)


def clipped(geometry: TensegrityGeometry, cables: Cables, beta: Any, load: Any) -> Any:
    lever = -length_jacobian(geometry, beta).T
    free = np.linalg.pinv(lever) @ np.asarray(load)
    found = np.clip(free, cables.least, cables.most)
    short = np.asarray(load) - torques(geometry, beta, found)
    return replace(tensions(geometry, cables, beta, load), tensions=found, shortfall=short)


def without_least(geometry: TensegrityGeometry, cables: Cables, beta: Any) -> FloatArray:
    lever = length_jacobian(geometry, beta)
    return np.array([[-lever[0, 0] * cables.most, -lever[1, 0] * cables.most]])


def curvature_by_differences(geometry: TensegrityGeometry, beta: Any) -> FloatArray:
    h = 1e-4 * np.eye(2)
    lever = [length_jacobian(geometry, beta + s * d) for d in h for s in (1.0, -1.0)]
    return np.column_stack([(lever[0] - lever[1])[:, 0] / 2e-4, (lever[2] - lever[3])[:, 1] / 2e-4])


def all_taut(geometry: TensegrityGeometry, cables: Cables, beta: Any, t: Any) -> FloatArray:
    return joint_stiffness(geometry, cables, beta, np.maximum(t, 1e-9))


def without_bars(geometry: TensegrityGeometry, masses: GuideMasses, beta: Any) -> Any:
    return guide_dynamics(geometry, replace(masses, density=0.0), beta)


MIRRORED = Defect("the mirror image", lambda g, b: forward(g, b, -1))

DEFECTS = {
    "kinematics": {
        **dict.fromkeys(
            (
                f"joint variables of a {reading} holder {short} rad inside its cone's edge (β → 0)"
                for reading in ("rhombus", "scissor")
                for short in ("1e-3", "1e-6")
            ),
            Defect("the other reading of the joints", lambda g, t: inverse(other(g), t)),
        ),
        **dict.fromkeys(
            (
                f"joint variables of a {reading} holder with T {gap} rad from A1 (β → π)"
                for reading in ("rhombus", "scissor")
                for gap in ("1e-3", "1e-9")
            ),
            Defect("equations 1 and 2 by acos", joints_by_acos),
        ),
        "direction of a guide 1e-3 over the plane of both base axes": MIRRORED,
        "direction of a guide 1e-6 over the plane of both base axes": Defect(
            "Newton's method to a residual of 1e-12", iterated
        ),
        **dict.fromkeys(
            (
                f"Jacobian of a guide {height} over the plane of both base axes"
                for height in ("1e-3", "1e-6")
            ),
            Defect("central differences of 1e-9 rad", jacobian_by_differences),
        ),
        "rate of the Jacobian of a guide 1e-3 over the plane of both base axes": Defect(
            "central differences of the Jacobian", rate_by_differences
        ),
        "direction of a guide 1e-6 rad from A1": Defect(
            "the discriminant as a sum, which cancels", by_cancelled_discriminant
        ),
        "the right one of two directions that both look up": Defect(
            "the first root in the upper hemisphere", higher
        ),
        "direction where the discriminant is +1e-15": MIRRORED,
        "direction where the discriminant is -1e-15": Defect(
            "the root of a negative number", by_cancelled_discriminant
        ),
        "joint rates of a pantograph 1e-6 rad from stretched": Defect(
            "a pseudoinverse that drops what is below 1e-5", by_pseudoinverse
        ),
        "joint B of a pantograph 1e-6 rad from stretched": Defect(
            "trilateration, whose spheres almost touch", by_trilateration
        ),
        "joint C by trilateration: three spheres that touch in one point": Defect(
            "a height of √1e-12 where they miss each other", untouched
        ),
        "nearest direction of one far out of reach: the corner of two cones": Defect(
            "the foot on the first cone", by_first_rim
        ),
    },
    "statics": {
        **dict.fromkeys(
            (
                "tensions of least norm, β1 = 1e-6",
                "tensions of least norm, D = 1e-6: both pantographs in one plane,"
                " cables B1D1 and B2D2 parallel",
            ),
            Defect("a pseudoinverse, which pushes with cables", least_squares),
        ),
        "a cable's limit met exactly, and a load 1e-9 N·m outside the tension polytope": Defect(
            "the unlimited solution, clipped", clipped
        ),
        "the load that four cables can just hold": Defect(
            "the other cable without its least tension", without_least
        ),
        "curvature of the cables where one has almost none: pretension always softens": Defect(
            "differences of the lever", curvature_by_differences
        ),
        "stiffness with slack cables: one of the first pantograph's, both of the second's": Defect(
            "a slack cable as stiff as a taut one", all_taut
        ),
    },
    "dynamics": {
        **dict.fromkeys(
            (
                "mass matrix of the needle holder, β1 = 1e-6",
                "mass matrix of the needle holder, D = 1e-3",
            ),
            Defect("bars without mass", without_bars),
        ),
    },
}
