"""Forces on the simulated robot: the hand's spring-dampers and the tilt stop."""

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.mechanisms.dynamic_model import FX, FY
from app.mechanisms.pantograph.kernels import force_map_kernel
from app.simulation.plant_layout import AT, System


@njit
def spring(
    p: FloatArray, gx: float, gy: float, gz: float, dx: float, dy: float, dz: float, l_out: float
) -> tuple[float, float, float, float]:
    """Spring of a hand at g, at the hub, across the needle: (stiffness in effect, fx, fy, fz)."""
    sx, sy, sz = -l_out * (gx - dx), -l_out * (gy - dy), -l_out * (gz - dz)
    along = sx * dx + sy * dy + sz * dz
    sx, sy, sz = sx - along * dx, sy - along * dy, sz - along * dz
    stretch = np.sqrt(sx * sx + sy * sy + sz * sz)
    k = p[AT.hand_k]
    if k * stretch > p[AT.hand_most]:
        k = p[AT.hand_most] / stretch
    return k, k * sx, k * sy, k * sz


@njit
def axial_spring(state: FloatArray, p: FloatArray) -> tuple[float, float]:
    """Hand spring along the needle: (stiffness in effect [N/m], force inwards [N])."""
    stretch = state[sv.GRIP_DEPTH] - state[sv.PLANT_DEPTH]
    k = p[AT.hand_axial_k]
    if k * abs(stretch) > p[AT.hand_most]:
        k = p[AT.hand_most] / abs(stretch)
    return k, k * stretch


@njit
def hand_at_tool(
    p: FloatArray,
    h: float,
    hx: float,
    hy: float,
    hz: float,
    dx: float,
    dy: float,
    dz: float,
    l_in: float,
    l_out: float,
) -> System:
    """Hand force at the tool and its part of the system matrix: (gx, gy, xx, xy, yy)."""
    k, fx, fy, fz = spring(p, hx, hy, hz, dx, dy, dz, l_out)
    gx, gy = force_map_kernel(fx, fy, fz, dx, dy, dz, l_in, l_out)
    c = (h * p[AT.hand_b] + h * h * k) * (l_out / l_in) ** 2
    return gx, gy, c * (1.0 - dx * dx), -c * dx * dy, c * (1.0 - dy * dy)


@njit
def stop_at_tool(p: FloatArray, h: float, x: float, y: float, vx: float, vy: float) -> System:
    """Force of the tilt stop at the tool, likewise; it only pushes inwards."""
    ex, ey = x - p[FX], y - p[FY]
    radius = np.sqrt(ex * ex + ey * ey)
    beyond = radius - p[AT.radius]
    if not beyond > 0.0:
        return 0.0, 0.0, 0.0, 0.0, 0.0
    ex, ey = ex / radius, ey / radius
    damping = p[AT.stop_b] if ex * vx + ey * vy > 0.0 else 0.0
    c = h * damping + h * h * p[AT.stop_k]
    push = -p[AT.stop_k] * beyond
    return push * ex, push * ey, c * ex * ex, c * ex * ey, c * ey * ey
