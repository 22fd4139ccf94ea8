"""WRONG ON PURPOSE: formulas as the thesis prints them. Arrays in, arrays out; angles in rad."""

import numpy as np

from app.core.arrays import FloatArray
from app.mechanisms.geometry import Geometry


def interior_angle(a1: float, a2: float, length: FloatArray) -> FloatArray:
    """Angle at the motor in the triangle motor, elbow, tool (law of cosines; this one is right)."""
    cosine = (a1 * a1 + length * length - a2 * a2) / (2.0 * a1 * length)
    return np.asarray(np.arccos(np.clip(cosine, -1.0, 1.0)))


def printed_left_angle(geometry: Geometry, p3: FloatArray) -> FloatArray:
    """q1 with β1 = atan2(y3, x1 - x3); right is x3 - x1 (errata A5). Tool points (n, 2) -> (n,)."""
    a1, a2, base = geometry.links
    x, y = p3[:, 0] + 0.5 * base, p3[:, 1]
    return np.asarray(np.arctan2(y, -x) + interior_angle(a1, a2, np.hypot(x, y)))


def printed_right_angle(geometry: Geometry, p3: FloatArray) -> FloatArray:
    """q2 = π - α1' + β1' (eq. 4.3); right is - β1' (errata A4). Tool points (n, 2) -> (n,)."""
    a1, a2, base = geometry.links
    x, y = 0.5 * base - p3[:, 0], p3[:, 1]
    inner = interior_angle(a1, a2, np.hypot(x, y))
    return np.asarray(np.pi - inner + np.arctan2(y, x))


def distal_angles(geometry: Geometry, q: FloatArray, p3: FloatArray) -> tuple[FloatArray, ...]:
    """Absolute angles θ2, θ2' of the distal links (right), for poses (n, 2) and tool points."""
    a1, _, base = geometry.links
    return tuple(
        np.arctan2(
            p3[:, 1] - a1 * np.sin(q[:, arm]),
            p3[:, 0] - a1 * np.cos(q[:, arm]) - side * 0.5 * base,
        )
        for arm, side in ((0, -1.0), (1, 1.0))
    )


def printed_jacobian(geometry: Geometry, q: FloatArray, p3: FloatArray) -> FloatArray:
    """Jacobian of eq. 4.7, (n, 2, 2) [m/rad]: three of its four entries are wrong (errata A3)."""
    a1, a2, _ = geometry.links
    t1 = q[:, 0]
    t2, t2r = distal_angles(geometry, q, p3)
    closing = np.sin(t2r - t2)
    j11 = -a1 * (np.sin(t1) + np.sin(t2) * np.sin(t1 - t2r) / closing)  # right
    j12 = a2 * np.sin(t2) * np.sin(t2 - t2r) / closing
    j21 = a1 * (np.cos(t1) + np.sin(t2) * np.sin(t1 - t2r) / closing)
    j22 = -a2 * np.cos(t2) * np.sin(t2 - t2r) / closing
    return np.moveaxis(np.array([[j11, j12], [j21, j22]]), 2, 0)


def azimuth_elevation(geometry: Geometry, hub: FloatArray) -> tuple[FloatArray, FloatArray]:
    """θ and φ of the needle, P3 to P_I (right); no azimuth exists for a vertical one."""
    needle = hub - geometry.fulcrum
    across = np.hypot(needle[:, 0], needle[:, 1])
    return np.arctan2(needle[:, 1], needle[:, 0]), np.arctan2(needle[:, 2], across)


def printed_tool_point(geometry: Geometry, hub: FloatArray) -> FloatArray:
    """P3 of section 4.2.4, (n, 2) [m], with cos θ for sin θ in its second row (errata A6)."""
    theta, phi = azimuth_elevation(geometry, hub)
    lever = geometry.fulcrum[2] / np.sin(phi) * np.cos(phi)
    return np.stack(
        [geometry.fulcrum[0] - lever * np.cos(theta), geometry.fulcrum[1] - lever * np.cos(theta)],
        axis=1,
    )


def printed_display_point(geometry: Geometry, hub: FloatArray) -> FloatArray:
    """P3 of eq. 4.5, (n, 2) [m]: P_I + L_in cos φ' (cos θ, sin θ), φ' = π/2 - φ (errata A7).

    Mirrored, and at the constant distance H from the fulcrum's foot. The laboratory's C++ has it.
    """
    theta, phi = azimuth_elevation(geometry, hub)
    lever = geometry.fulcrum[2] / np.sin(phi) * np.cos(0.5 * np.pi - phi)
    return np.stack(
        [geometry.fulcrum[0] + lever * np.cos(theta), geometry.fulcrum[1] + lever * np.sin(theta)],
        axis=1,
    )


def printed_angle_error(needle: FloatArray, path: FloatArray) -> FloatArray:
    """Angle between unit vectors (n, 3) by acos (eq. 4.9): loses half the digits (errata B10)."""
    return np.asarray(np.arccos(np.clip(np.einsum("ij,ij->i", needle, path), -1.0, 1.0)))


def code_left_angle(geometry: Geometry, p3: FloatArray) -> FloatArray:
    """q1 with |x3 - x1|: right only where the tool is right of the left motor."""
    a1, a2, base = geometry.links
    x, y = np.abs(p3[:, 0] + 0.5 * base), p3[:, 1]
    return np.asarray(np.arctan2(y, x) + interior_angle(a1, a2, np.hypot(x, y)))


def code_right_angle(geometry: Geometry, p3: FloatArray) -> FloatArray:
    """q2 = π - β - (angle at the elbow) instead of the angle at the motor."""
    a1, a2, base = geometry.links
    x, y = np.abs(0.5 * base - p3[:, 0]), p3[:, 1]
    square = x * x + y * y
    elbow = np.arccos(np.clip((a1 * a1 + a2 * a2 - square) / (2.0 * a1 * a2), -1.0, 1.0))
    return np.asarray(np.pi - np.arctan2(y, x) - elbow)


def code_jacobian(geometry: Geometry, q: FloatArray) -> FloatArray:
    """Jacobian (n, 2, 2) [m/rad] with (…)/2*l*a where (…)/(2*l*a) is meant.

    The angle of the right distal link comes from the triangle of the elbows and the tool; divided
    wrongly its cosine is nearly zero, so that the link stands square to the elbows' line.
    """
    a1, a2, base = geometry.links
    c1, s1, c1r, s1r = np.cos(q[:, 0]), np.sin(q[:, 0]), np.cos(q[:, 1]), np.sin(q[:, 1])
    ex, ey = base + a1 * (c1r - c1), a1 * (s1r - s1)
    apart = np.hypot(ex, ey)
    slope = np.arctan2(ey, ex)
    t2 = slope + np.arccos(np.clip(apart / (2.0 * a2), -1.0, 1.0))
    corner = np.pi - np.arccos(np.clip(apart**2 / 2.0 * apart * a2, -1.0, 1.0))
    t2r = np.pi - corner + slope
    closing = np.sin(t2r - t2)
    left = a1 * np.sin(t2 - q[:, 0]) / closing
    right = a1 * np.sin(t2r - q[:, 1]) / closing
    rows = [
        [np.sin(t2r) * left, -np.sin(t2) * right],
        [-np.cos(t2r) * left, np.cos(t2) * right],
    ]
    return np.moveaxis(np.array(rows), 2, 0)


def printed_stereo_error(jacobians: FloatArray, variance_px: float) -> float:
    """E_stereo = √(S₁₁ + S₂₂ + S₃₃) / 3 with the first camera's Σ for both (errata B15 to B18).

    Right is √trace for the 3D RMS, and each camera's own Σ. What the annex's K(1:2,1:1) and
    J = [J₁, J₂]ᵀ would give has no shape that can be computed; the right ones stand in for them.

    Args:
        jacobians: of both pixels by the point [px/m], shape (2, 2, 3).
        variance_px: of the first camera's pixels, per axis [px²].

    Returns:
        E_stereo [m].
    """
    stacked = jacobians.reshape(4, 3)
    spread = np.linalg.inv(stacked.T @ stacked / variance_px)
    return float(np.sqrt(np.trace(spread))) / 3.0
