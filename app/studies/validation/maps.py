"""The mechanism's kernels over arrays of poses."""

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.mechanisms.geometry import Geometry
from app.mechanisms.pantograph.kernels import (
    axis_kernel,
    forward_kernel,
    inverse_kernel,
    jacobian_kernel,
    tool_kernel,
)


def disc(geometry: Geometry, tilt: float, points: int) -> FloatArray:
    """Tool points (n, 2) [m] on a square grid of `points` a side within a cone of `tilt` [rad]."""
    radius = geometry.fulcrum[2] * np.tan(tilt)
    line = np.linspace(-radius, radius, points)
    x, y = np.meshgrid(line, line)
    inside = np.hypot(x, y) <= radius
    return np.stack([x[inside], y[inside]], axis=1) + geometry.fulcrum[:2]


@njit
def _inverse(p3: FloatArray, a1: float, a2: float, base: float) -> FloatArray:
    q = np.full(p3.shape, np.nan)
    for k in range(len(p3)):
        status, left, right = inverse_kernel(p3[k, 0], p3[k, 1], a1, a2, base, 1.0, -1.0)
        if status == 0:
            q[k, 0], q[k, 1] = left, right
    return q


@njit
def _forward(q: FloatArray, a1: float, a2: float, base: float) -> FloatArray:
    p3 = np.full(q.shape, np.nan)
    for k in range(len(q)):
        status, x, y = forward_kernel(q[k, 0], q[k, 1], a1, a2, base, 1.0)
        if status == 0:
            p3[k, 0], p3[k, 1] = x, y
    return p3


@njit
def _jacobian(q: FloatArray, p3: FloatArray, a1: float, a2: float, base: float) -> FloatArray:
    out = np.full((len(q), 2, 2), np.nan)
    for k in range(len(q)):
        status, a, b, c, d = jacobian_kernel(q[k, 0], q[k, 1], p3[k, 0], p3[k, 1], a1, a2, base)
        if status == 0:
            out[k, 0, 0], out[k, 0, 1], out[k, 1, 0], out[k, 1, 1] = a, b, c, d
    return out


@njit
def _hub(p3: FloatArray, l_out: FloatArray, fx: float, fy: float, fz: float) -> FloatArray:
    hub = np.empty((len(p3), 3))
    for k in range(len(p3)):
        dx, dy, dz, _ = axis_kernel(p3[k, 0], p3[k, 1], fx, fy, fz)
        hub[k, 0] = fx - l_out[k] * dx
        hub[k, 1] = fy - l_out[k] * dy
        hub[k, 2] = fz - l_out[k] * dz
    return hub


@njit
def _tool(hub: FloatArray, fx: float, fy: float, fz: float) -> FloatArray:
    """P3 and L_out of hub points: (n, 3)."""
    out = np.full(hub.shape, np.nan)
    for k in range(len(hub)):
        status, x, y, _, l_out = tool_kernel(hub[k, 0], hub[k, 1], hub[k, 2], fx, fy, fz)
        if status == 0:
            out[k, 0], out[k, 1], out[k, 2] = x, y, l_out
    return out


@njit
def _closure(q: FloatArray, a1: float, a2: float, base: float) -> tuple[FloatArray, FloatArray]:
    """Forward, inverse in the pose's own mode, forward: errors (n, 2) [rad] and (n,) [m]."""
    angle, place = np.full(q.shape, np.nan), np.full(len(q), np.nan)
    for k in range(len(q)):
        q1, q2 = q[k, 0], q[k, 1]
        status, x, y = forward_kernel(q1, q2, a1, a2, base, 1.0)
        if status != 0:
            continue
        left = np.sin(q1) * (x + 0.5 * base) - np.cos(q1) * y
        right = np.sin(q2) * (x - 0.5 * base) - np.cos(q2) * y
        status, b1, b2 = inverse_kernel(x, y, a1, a2, base, np.sign(left), np.sign(right))
        if status != 0:
            continue
        angle[k, 0] = abs(np.arctan2(np.sin(b1 - q1), np.cos(b1 - q1)))
        angle[k, 1] = abs(np.arctan2(np.sin(b2 - q2), np.cos(b2 - q2)))
        status, u, v = forward_kernel(b1, b2, a1, a2, base, 1.0)
        if status == 0:
            place[k] = np.hypot(u - x, v - y)
    return angle, place


def inverse_many(geometry: Geometry, p3: FloatArray) -> FloatArray:
    """Joint angles (n, 2) of tool points (n, 2); NaN where there are none."""
    return np.asarray(_inverse(p3, *geometry.links))


def forward_many(geometry: Geometry, q: FloatArray) -> FloatArray:
    """Tool points (n, 2) of joint angles (n, 2); NaN where there are none."""
    return np.asarray(_forward(q, *geometry.links))


def jacobian_many(geometry: Geometry, q: FloatArray, p3: FloatArray) -> FloatArray:
    """Jacobians (n, 2, 2) of poses with their tool points; NaN where there are none."""
    return np.asarray(_jacobian(q, p3, *geometry.links))


def closure(geometry: Geometry, q: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Closure errors of poses (n, 2) in their own working mode: per joint (n, 2) [rad] after
    forward and inverse, and of the tool (n,) [m] after one more forward; NaN where FKM fails.
    """
    angle, place = _closure(q, *geometry.links)
    return np.asarray(angle), np.asarray(place)


def hub_many(geometry: Geometry, p3: FloatArray, l_out: FloatArray) -> FloatArray:
    """Hub points P_u (n, 3) of tool points (n, 2) and L_out (n,)."""
    return np.asarray(_hub(p3, l_out, *geometry.fulcrum_xyz))


def tool_many(geometry: Geometry, hub: FloatArray) -> tuple[FloatArray, FloatArray]:
    """Tool points (n, 2) and L_out (n,) of hub points (n, 3)."""
    found = _tool(hub, *geometry.fulcrum_xyz)
    return np.ascontiguousarray(found[:, :2]), np.ascontiguousarray(found[:, 2])


def elbows_apart(geometry: Geometry, q: FloatArray) -> FloatArray:
    """Vector from elbow to elbow l22' (n, 2) [m]."""
    a1, _, base = geometry.links
    return np.stack(
        [
            base + a1 * (np.cos(q[:, 1]) - np.cos(q[:, 0])),
            a1 * (np.sin(q[:, 1]) - np.sin(q[:, 0])),
        ],
        axis=1,
    )


def wrapped(angle: FloatArray) -> FloatArray:
    """Angles in (-π, π]."""
    return np.asarray(np.arctan2(np.sin(angle), np.cos(angle)))
