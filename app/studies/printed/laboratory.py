"""WRONG ON PURPOSE: what the laboratory's public C++ computes, rebuilt from its known defects."""

import numpy as np

from app.core.arrays import FloatArray
from app.mechanisms.geometry import Geometry
from app.studies.printed.thesis import interior_angle


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
