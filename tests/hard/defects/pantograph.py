"""Defects of the pantograph's hard cases: differences, angles by arc cosines, parts left out."""

from dataclasses import replace
from math import acos, cos, sin, sqrt
from typing import Any

import numpy as np

from app.core.arrays import FloatArray
from app.mechanisms.pantograph import (
    Geometry,
    dynamic_terms,
    forward,
    inverse,
    jacobian,
    needle_at,
    singularity,
    system_rates,
)
from app.studies.hard_cases.pantograph import HEIGHT, X, Y, virtual_work
from tests.hard.defects import Defect


def tool_by_expanded_squares(geometry: Geometry, q: Any) -> FloatArray:
    # The distance of the elbows by |P|² - 2 P·Q + |Q|², which cancels.
    (q1, q2), (a1, a2, base) = q, geometry.links
    x, y = a1 * cos(q1) - 0.5 * base, a1 * sin(q1)
    xr, yr = a1 * cos(q2) + 0.5 * base, a1 * sin(q2)
    l2 = x * x + y * y - 2.0 * (x * xr + y * yr) + xr * xr + yr * yr
    ratio = sqrt(max(a2 * a2 - 0.25 * l2, 0.0) / max(l2, 1e-300))
    return np.array([0.5 * (x + xr) - ratio * (yr - y), 0.5 * (y + yr) + ratio * (xr - x)])


def joints_of_the_laboratory(geometry: Geometry, p3: Any) -> FloatArray:
    # The right arm with the left arm's opening, as the laboratory's code had it.
    q1, _ = inverse(geometry, p3)
    x, y, half = p3[0], p3[1], 0.5 * geometry.base
    opening = q1 - np.arctan2(y, x + half)
    return np.array([q1, np.arctan2(y, x - half) - opening])


def jacobian_by_differences(geometry: Geometry, q: Any) -> FloatArray:
    return np.column_stack(
        [(forward(geometry, q + h) - forward(geometry, q - h)) / 2e-7 for h in 1e-7 * np.eye(2)]
    )


def rate_by_differences(geometry: Geometry, q: Any, qd: Any) -> FloatArray:
    h = 1e-6 * np.asarray(qd)
    return (jacobian(geometry, q + h) - jacobian(geometry, q - h)) / 2e-6


def needle_by_angles(geometry: Geometry, p3: Any, l_out: float) -> Any:
    e = np.array([p3[0] - X, p3[1] - Y, -HEIGHT])
    l_in = float(np.linalg.norm(e))
    elevation, azimuth = acos(min(HEIGHT / l_in, 1.0)), np.arctan2(e[1], e[0])
    axis = sin(elevation) * np.array([cos(azimuth), sin(azimuth), 0.0])
    return replace(needle_at(geometry, p3, l_out), axis=axis - [0.0, 0.0, cos(elevation)])


def force_by_angles(needle: Any, force: Any) -> Any:
    """Equation 4.12 with 1/√(1 - (cos φ cos(θ - α))²), singular where cos β → 1."""
    fx, fy = -np.asarray(force)[:2]
    phi = np.arcsin(-needle.axis[2])
    theta, alpha = np.arctan2(-needle.axis[1], -needle.axis[0]), np.arctan2(fy, fx)
    beta = cos(phi) * cos(theta - alpha)
    size = np.linalg.norm(force) * needle.l_out * np.sin(phi) / HEIGHT / sqrt(1.0 - beta**2)
    return size * np.array([cos(alpha), sin(alpha)])


def hub_rates_by_differences(geometry: Geometry, q: Any, l_out: float) -> Any:
    rates = system_rates(geometry, q, l_out)
    hubs = [
        (system_rates(geometry, q + h, l_out).needle.hub - rates.needle.hub) / 1e-8
        for h in 1e-8 * np.eye(2)
    ]
    return replace(rates, by_joints=np.column_stack(hubs))


def by_gram(j: FloatArray) -> float:
    values = np.linalg.eigvalsh(j.T @ j)
    return float(np.sqrt(abs(values[0]) / values[1]))


def without_coupling(*arguments: Any) -> Any:
    terms = dynamic_terms(*arguments)
    return replace(terms, mass=np.diag(np.diag(terms.mass)))


def stuck(v: float, coulomb: float, viscous: float, smooth: float) -> float:
    return coulomb * np.sign(v) + viscous * v


DEFECTS = {
    "kinematics": {
        **dict.fromkeys(
            (
                f"tool point where the elbows are {gap} rad from meeting"
                for gap in ("1e-3", "1e-6", "1e-8")
            ),
            Defect("distance of the elbows by expanded squares", tool_by_expanded_squares),
        ),
        **dict.fromkeys(
            (
                f"Jacobian where the elbows are {gap} rad from meeting"
                for gap in ("1e-3", "1e-6", "1e-8")
            ),
            Defect("central differences of 1e-7 rad", jacobian_by_differences),
        ),
        **dict.fromkeys(
            (
                f"joint angles of an arm {how} to {short} of its length"
                for how in ("stretched", "folded")
                for short in ("1e-06", "1e-12")
            ),
            Defect("the right arm with the left arm's opening", joints_of_the_laboratory),
        ),
        "rate of the Jacobian where the elbows are 1e-3 rad from meeting": Defect(
            "central differences of the Jacobian", rate_by_differences
        ),
        "direction of a needle 1 pm beside the vertical": Defect(
            "elevation by acos, azimuth by atan2", needle_by_angles
        ),
        "distal links 1e-6 rad from being in line (θ2 = θ4)": Defect(
            "the sum of the angles instead of their difference",
            lambda g, q, a, t: replace(singularity(g, q, a, t), parallel=sin(q[0] + q[1])),
        ),
        "an arm stretched to its very end is named, and its angles are finite": Defect(
            "no tolerance", lambda g, q: singularity(g, q, tolerance=1e-300)
        ),
    },
    "statics": {
        **dict.fromkeys(
            (
                f"{law} with the needle tilted by {tilt}°"
                for law in ("tool force", "printed law 4.12")
                for tilt in ("45", "89", "89.99")
            ),
            Defect("magnitude by angles, as equation 4.12 is printed", force_by_angles),
        ),
        "what the hand feels of the force asked for, at 80° of tilt": Defect(
            "the tool's force as it is, without the lever", lambda n, g: np.array([*(-g), 0.0])
        ),
        "tool force where the Jacobian has lost rank to 1e-9": Defect(
            "least squares that drops what is below 1e-8",
            lambda j, t: np.linalg.lstsq(j.T, t, rcond=1e-8)[0],
        ),
        "rates of the hub with the needle 1e-9 rad from vertical": Defect(
            "differences of 1e-8 rad", hub_rates_by_differences
        ),
        "condition of a Jacobian whose columns are almost parallel": Defect(
            "eigenvalues of JᵀJ, which squares the condition", by_gram
        ),
        "force felt at 34° of tilt, in MuJoCo's constraints": Defect(
            "virtual work with the reciprocal lever", lambda: 2.0 * virtual_work()
        ),
    },
    "dynamics": {
        **dict.fromkeys(
            (
                f"mass matrix where the elbows are {gap} rad from meeting"
                for gap in ("1e-2", "1e-5")
            ),
            Defect("the joints' coupling left out", without_coupling),
        ),
        "velocity terms where the elbows are 1e-2 rad from meeting": Defect(
            "the needle's own speed left out",
            lambda m, q, qd, depth, rate: dynamic_terms(m, q, qd, depth, 0.0),
        ),
        "gravity with the needle 1e-6 rad from vertical": Defect(
            "exactly vertical: no lever", lambda m, q, qd, s: dynamic_terms(m, q + 1e-6, qd, s)
        ),
        "friction of a joint that turns at 1e-9 rad/s": Defect("the sign of the speed", stuck),
    },
}
