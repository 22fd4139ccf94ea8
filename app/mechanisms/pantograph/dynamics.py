"""Closed-chain dynamics in the motor angles: M(q) q̈ + h(q, q̇) + g(q) + friction(q̇) = τ.

Links (`links`), mass at P3 and needle (`mechanisms.lever`, at the depth given), in closed form. For
compiled code (call them only where `jacobian_kernel` says `OK`, with (x, y) the tool point):

- `dynamics_kernel(q1, q2, v1, v2, x, y, depth, depth_rate, p, first)
  -> (m_left, m_cross, m_right, h_left, h_right, g_left, g_right)`: everything at once. `p[first:]`
  are the values of a `DynamicModel` (`profile.dynamic_model.values`, MODEL_SIZE numbers that a
  stage keeps in its own parameters). With `depth_rate` = 0 the Coriolis term of a sliding needle
  is left out.
- `friction_kernel(v, coulomb, viscous, smooth) -> torque`: opposes the motor, of the sign of v.
- `links_potential_kernel(q1, q2, x, y, p, first) -> potential` of links and mass at P3 [J].
- `axial_load_kernel(vx, vy, x, y, depth, p, first) -> force` along the needle, inwards [N].
- `mass_matrix_kernel(q1, q2, x, y, a1, a2, base, driven, passive, coupling, tool)
  -> (m_left, m_cross, m_right)` and
  `velocity_terms_kernel(q1, q2, v1, v2, x, y, a1, a2, base, driven, passive, coupling, tool)
  -> (h_left, h_right)`: links and mass at P3 only.
"""

from math import tanh

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.core.compiled import njit
from app.mechanisms import dynamic_model as dm
from app.mechanisms import lever
from app.mechanisms.dynamic_model import DynamicModel
from app.mechanisms.geometry import Geometry
from app.mechanisms.inertia import LumpedInertia
from app.mechanisms.pantograph import kernels, links
from app.mechanisms.pantograph.kinematics import forward, pair
from app.mechanisms.remote_centre import DynamicTerms
from app.mechanisms.status import check


@njit
def mass_matrix_kernel(
    q1: float,
    q2: float,
    x: float,
    y: float,
    a1: float,
    a2: float,
    base: float,
    driven: float,
    passive: float,
    coupling: float,
    tool: float,
) -> tuple[float, float, float]:
    """Mass matrix of links and tool [kg·m²]: (m_left, m_cross, m_right), positive definite."""
    turns = links.turns_kernel(q1, q2)
    u = links.distal_kernel(turns, x, y, a1, a2, base)
    rates = links.passive_rates_kernel(turns, u, a1, a2)
    jxl, jxr, jyl, jyr = links.tool_jacobian_kernel(turns, u, rates, a1, a2)
    left, cross, right = links.link_mass_kernel(turns, u, rates, driven, passive, coupling)
    return (
        left + tool * (jxl * jxl + jyl * jyl),
        cross + tool * (jxl * jxr + jyl * jyr),
        right + tool * (jxr * jxr + jyr * jyr),
    )


@njit
def velocity_terms_kernel(
    q1: float,
    q2: float,
    v1: float,
    v2: float,
    x: float,
    y: float,
    a1: float,
    a2: float,
    base: float,
    driven: float,
    passive: float,
    coupling: float,
    tool: float,
) -> tuple[float, float]:
    """Centrifugal and Coriolis torques of links and tool [N·m]: (h_left, h_right)."""
    turns = links.turns_kernel(q1, q2)
    u = links.distal_kernel(turns, x, y, a1, a2, base)
    rates = links.passive_rates_kernel(turns, u, a1, a2)
    speeds = links.speeds_kernel(rates, v1, v2)
    alpha, alpha_r, ax, ay = links.passive_acceleration_kernel(turns, u, speeds, a1, a2)
    left, right = links.link_velocity_kernel(
        turns, u, rates, speeds, alpha, alpha_r, passive, coupling
    )
    jxl, jxr, jyl, jyr = links.tool_jacobian_kernel(turns, u, rates, a1, a2)
    t_left, t_right = lever.torque_kernel(tool * ax, tool * ay, jxl, jxr, jyl, jyr)
    return left + t_left, right + t_right


@njit
def dynamics_kernel(
    q1: float,
    q2: float,
    v1: float,
    v2: float,
    x: float,
    y: float,
    depth: float,
    depth_rate: float,
    p: FloatArray,
    first: int,
) -> tuple[float, float, float, float, float, float, float]:
    """Mass matrix, velocity terms and gravity: (m_left, m_cross, m_right, h_, h_, g_, g_)."""
    a1, a2, tool = p[first + dm.A1], p[first + dm.A2], p[first + dm.TOOL]
    passive, coupling = p[first + dm.PASSIVE], p[first + dm.COUPLING]
    gx, gy, gz = p[first + dm.GX], p[first + dm.GY], p[first + dm.GZ]
    mass, inertia, s = (
        p[first + dm.NEEDLE_MASS],
        p[first + dm.NEEDLE_INERTIA],
        depth + p[first + dm.NEEDLE_OFFSET],
    )
    turns = links.turns_kernel(q1, q2)
    u = links.distal_kernel(turns, x, y, a1, a2, p[first + dm.BASE])
    rates = links.passive_rates_kernel(turns, u, a1, a2)
    speeds = links.speeds_kernel(rates, v1, v2)
    alpha, alpha_r, ax, ay = links.passive_acceleration_kernel(turns, u, speeds, a1, a2)
    jxl, jxr, jyl, jyr = links.tool_jacobian_kernel(turns, u, rates, a1, a2)
    dx, dy, dz, l_in = lever.axis_kernel(x, y, p[first + dm.FX], p[first + dm.FY], p[first + dm.FZ])

    m11, m12, m22 = links.link_mass_kernel(turns, u, rates, p[first + dm.DRIVEN], passive, coupling)
    xx, xy, yy = lever.needle_mass_kernel(dx, dy, l_in, s, mass, inertia)
    n11, n12, n22 = links.at_joints_kernel(tool + xx, xy, tool + yy, jxl, jxr, jyl, jyr)

    h1, h2 = links.link_velocity_kernel(turns, u, rates, speeds, alpha, alpha_r, passive, coupling)
    vx, vy = jxl * v1 + jxr * v2, jyl * v1 + jyr * v2
    fx, fy = lever.needle_velocity_kernel(
        vx, vy, ax, ay, dx, dy, l_in, s, depth_rate, mass, inertia
    )
    i1, i2 = lever.torque_kernel(tool * ax + fx, tool * ay + fy, jxl, jxr, jyl, jyr)

    moment, moment_2 = p[first + dm.DRIVEN_MOMENT], p[first + dm.PASSIVE_MOMENT]
    g1, g2 = links.link_gravity_kernel(turns, u, rates, moment, moment_2, gx, gy)
    wx, wy = lever.needle_gravity_kernel(gx, gy, gz, dx, dy, dz, l_in, s, mass)
    k1, k2 = lever.torque_kernel(wx - tool * gx, wy - tool * gy, jxl, jxr, jyl, jyr)
    return m11 + n11, m12 + n12, m22 + n22, h1 + i1, h2 + i2, g1 + k1, g2 + k2


@njit
def links_potential_kernel(
    q1: float, q2: float, x: float, y: float, p: FloatArray, first: int
) -> float:
    """Potential of gravity [J] of links and mass at P3, up to a constant."""
    gx, gy = p[first + dm.GX], p[first + dm.GY]
    a1, a2, base = p[first + dm.A1], p[first + dm.A2], p[first + dm.BASE]
    c1, s1, c1r, s1r = turns = links.turns_kernel(q1, q2)
    ux, uy, rx, ry = links.distal_kernel(turns, x, y, a1, a2, base)
    driven, passive = p[first + dm.DRIVEN_MOMENT], p[first + dm.PASSIVE_MOMENT]
    mx = driven * (c1 + c1r) + passive * (ux + rx) + p[first + dm.TOOL] * x
    my = driven * (s1 + s1r) + passive * (uy + ry) + p[first + dm.TOOL] * y
    return -(mx * gx + my * gy)


@njit
def axial_load_kernel(
    vx: float, vy: float, x: float, y: float, depth: float, p: FloatArray, first: int
) -> float:
    """Force on the needle along its axis, inwards [N], at tool velocity (vx, vy)."""
    dx, dy, dz, l_in = lever.axis_kernel(x, y, p[first + dm.FX], p[first + dm.FY], p[first + dm.FZ])
    gx, gy, gz = p[first + dm.GX], p[first + dm.GY], p[first + dm.GZ]
    s = depth + p[first + dm.NEEDLE_OFFSET]
    return lever.needle_axial_kernel(
        vx, vy, gx, gy, gz, dx, dy, dz, l_in, s, p[first + dm.NEEDLE_MASS]
    )


@njit
def friction_kernel(v: float, coulomb: float, viscous: float, smooth: float) -> float:
    """Friction torque of a joint [N·m] at speed v [rad/s]: Coulomb smoothed by tanh, viscous."""
    return coulomb * tanh(v / smooth) + viscous * v


def dynamic_terms(
    model: DynamicModel, q: ArrayLike, qd: ArrayLike, depth: float, depth_rate: float = 0.0
) -> DynamicTerms:
    """All terms at q [rad] and q̇ [rad/s], shapes (2,), needle tip at `depth` [m] moving along.

    Raises:
        MechanismError: where the pose does not exist or is singular.
    """
    q1, q2, x, y = _regular_pose(model.geometry, q)
    v1, v2 = pair(qd, "qd")
    m11, m12, m22, h1, h2, g1, g2 = dynamics_kernel(
        q1, q2, v1, v2, x, y, depth, depth_rate, model.values, 0
    )
    how = model.coulomb, model.viscous, model.smooth_speed
    return DynamicTerms(
        mass=frozen([[m11, m12], [m12, m22]]),
        velocity=frozen([h1, h2]),
        gravity=frozen([g1, g2]),
        friction=frozen([friction_kernel(v1, *how), friction_kernel(v2, *how)]),
    )


def mass_matrix(geometry: Geometry, inertia: LumpedInertia, q: ArrayLike) -> FloatArray:
    """Mass matrix of links and tool [kg·m²], shape (2, 2), at q [rad], shape (2,).

    Raises:
        MechanismError: where the pose does not exist or is singular.
    """
    q1, q2, x, y = _regular_pose(geometry, q)
    left, cross, right = mass_matrix_kernel(q1, q2, x, y, *geometry.links, *inertia.values)
    return np.array([[left, cross], [cross, right]])


def velocity_terms(
    geometry: Geometry, inertia: LumpedInertia, q: ArrayLike, qd: ArrayLike
) -> FloatArray:
    """Torques h(q, q̇) of links and tool [N·m], shape (2,), at q [rad] and q̇ [rad/s], shapes (2,).

    Raises:
        MechanismError: where the pose does not exist or is singular.
    """
    q1, q2, x, y = _regular_pose(geometry, q)
    v1, v2 = pair(qd, "qd")
    return np.array(velocity_terms_kernel(q1, q2, v1, v2, x, y, *geometry.links, *inertia.values))


def _regular_pose(geometry: Geometry, q: ArrayLike) -> tuple[float, float, float, float]:
    q1, q2 = pair(q, "q")
    x, y = forward(geometry, q).tolist()
    check(kernels.jacobian_kernel(q1, q2, x, y, *geometry.links)[0], f"pose q = ({q1}, {q2}) rad")
    return q1, q2, x, y
