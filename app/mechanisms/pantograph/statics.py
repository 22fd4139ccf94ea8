"""Lever and force relations between hand, tool point and joints, and the rates that go with them.

With d from hub to tip, P_u = P_I - L_out d and dd/dP3 = (I - d dᵀ)/L_in on x, y:

- measured L_out (independent of P3): dP_u = -(L_out/L_in)(I - d dᵀ) dP3 - d dL_out; only the part
  across the needle comes from the joints,
- printed mode (L_out = C - L_in): dL_out = -d·dP3, so dP_u = [d dᵀ - (L_out/L_in)(I - d dᵀ)] dP3.

Backwards, P3 is where the line from the hub through the fulcrum meets z = 0:
dP3 = -(L_in/L_out)(I - d ẑᵀ/d_z) dP_u, whatever the mode. Forces go the other way, by virtual work.
"""

from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.core.messages import sentence
from app.mechanisms import lever
from app.mechanisms.errors import DegenerateError, MechanismError, NoGripError, SingularError
from app.mechanisms.geometry import Geometry
from app.mechanisms.pantograph.kinematics import WORKING_MODE, forward, jacobian, pair
from app.mechanisms.pantograph.posture import Singularity, singularity
from app.mechanisms.pantograph.system import (
    LengthMode,
    NeedleState,
    system_forward,
    system_inverse,
)
from app.mechanisms.status import check


def lever_map(needle: NeedleState) -> FloatArray:
    """G_perp = -(L_out/L_in)(I - d dᵀ)[:, :2], shape (3, 2): velocity of P3 to that of the hub.

    The hub's velocity is the part perpendicular to the needle; along it the needle slides freely.
    """
    columns = [lever.hub_velocity_kernel(*e, *_lever(needle)) for e in ((1.0, 0.0), (0.0, 1.0))]
    return np.array(columns).T


def force_map(needle: NeedleState, force: ArrayLike) -> FloatArray:
    """Tool force γ = G_perpᵀ F [N], shape (2,), by virtual work; F at the hand [N], shape (3,)."""
    return np.array(lever.force_map_kernel(*_triple(force), *_lever(needle)))


def printed_force(needle: NeedleState, force: ArrayLike) -> FloatArray:
    """Tool force of equation 4.12 as printed [N], shape (2,), for comparison with `force_map`.

    Raises:
        DegenerateError: if the needle lies in the plane of the links.
    """
    return np.array(lever.printed_force_kernel(*_triple(force), *_lever(needle)))


def felt_force(needle: NeedleState, gamma: ArrayLike) -> FloatArray:
    """Force at the hand [N], shape (3,), perpendicular to the needle; tool force [N], shape (2,).

    Raises:
        DegenerateError: if the needle lies in the plane of the links.
    """
    return np.array(lever.felt_kernel(*pair(gamma, "gamma"), *_lever(needle)))


def joint_torques(jacobian: ArrayLike, gamma: ArrayLike) -> FloatArray:
    """Joint torques τ = Jᵀ γ [N·m], shape (2,), for the Jacobian (2, 2) and a tool force (2,)."""
    return np.array(lever.torque_kernel(*pair(gamma, "gamma"), *_entries(jacobian)))


def tool_force(jacobian: ArrayLike, torques: ArrayLike) -> FloatArray:
    """Tool force γ = J⁻ᵀ τ [N], shape (2,).

    Raises:
        SingularError: if the Jacobian has no inverse.
    """
    status, gx, gy = lever.tool_force_kernel(*pair(torques, "torques"), *_entries(jacobian))
    check(status, f"tool force for the Jacobian {np.asarray(jacobian).tolist()} m/rad")
    return np.array([gx, gy])


def _lever(needle: NeedleState) -> tuple[float, float, float, float, float]:
    dx, dy, dz = needle.axis.tolist()
    if not needle.l_out > 0.0:
        raise NoGripError(
            sentence(
                "no grip: L_out = {needle_l_out} m; a positive length is needed",
                needle_l_out=needle.l_out,
            )
        )
    if not dz < 0.0:
        raise DegenerateError(
            sentence(
                "degenerate: the needle direction {needle_axis} does not point down through"
                " the plane of the links",
                needle_axis=needle.axis.tolist(),
            )
        )
    return dx, dy, dz, needle.l_in, needle.l_out


def _entries(jacobian: ArrayLike) -> list[Any]:
    array = np.asarray(jacobian, dtype=np.float64)
    if array.shape != (2, 2):
        raise MechanismError(
            sentence("jacobian has shape {array_shape}; (2, 2) is needed", array_shape=array.shape)
        )
    return array.ravel().tolist()


def _triple(force: ArrayLike) -> list[Any]:
    array = np.asarray(force, dtype=np.float64)
    if array.shape != (3,):
        raise MechanismError(
            sentence("force has shape {array_shape}; (3,) is needed", array_shape=array.shape)
        )
    return array.tolist()


_CLOSED = 1e-9
"""Distance within which a tool point counts as reached [m]."""

_RELATIVE = 1e-12


@dataclass(frozen=True, slots=True, eq=False)
class SystemRates:
    """Derivatives of the hub point P_u at one state.

    Attributes:
        needle: the state.
        by_tool: dP_u/dP3, shape (3, 2).
        by_joints: dP_u/dq [m/rad], shape (3, 2).
        by_length: dP_u/dL_out = -d, shape (3,); zero in the printed mode, where L_out is no
            coordinate of its own.
    """

    needle: NeedleState
    by_tool: FloatArray
    by_joints: FloatArray
    by_length: FloatArray


def hub_by_tool(needle: NeedleState, mode: LengthMode) -> FloatArray:
    """dP_u/dP3, shape (3, 2).

    Raises:
        MechanismError: if the needle does not stand out of the fulcrum or lies in the plane.
    """
    across = lever_map(needle)
    if mode is LengthMode.MEASURED:
        return across
    return across + np.outer(needle.axis, needle.axis[:2])


def system_rates(
    geometry: Geometry,
    q: ArrayLike,
    l_out: float | None = None,
    mode: LengthMode = LengthMode.MEASURED,
    assembly: int = 1,
) -> SystemRates:
    """Differentiate the hub point at q [rad], shape (2,), and the measured L_out [m].

    Raises:
        MechanismError: as `system_forward`, and where the Jacobian is singular.
    """
    needle = system_forward(geometry, q, l_out, mode, assembly)
    by_tool = hub_by_tool(needle, mode)
    by_length = -needle.axis if mode is LengthMode.MEASURED else np.zeros(3)
    return SystemRates(
        needle=needle,
        by_tool=frozen(by_tool),
        by_joints=frozen(by_tool @ jacobian(geometry, q, assembly)),
        by_length=frozen(by_length),
    )


def tool_by_hub(needle: NeedleState) -> FloatArray:
    """dP3/dP_u, shape (2, 3); zero along the needle, which slides."""
    dx, dy, dz = needle.axis.tolist()
    gain = -needle.l_in / needle.l_out
    return np.array([[gain, 0.0, -gain * dx / dz], [0.0, gain, -gain * dy / dz]])


def joints_by_hub(
    geometry: Geometry,
    hub: ArrayLike,
    mode: tuple[int, int] = WORKING_MODE,
    assembly: int = 1,
) -> FloatArray:
    """dq/dP_u [rad/m], shape (2, 3), at a hub point [m], shape (3,).

    Raises:
        MechanismError: as `system_inverse`; if the mode does not close in the assembly, or an arm
            is stretched or folded (type 1), where joint rates have no bound.
    """
    q, needle = system_inverse(geometry, hub, mode)
    return _inverse(geometry, q, needle, assembly) @ tool_by_hub(needle)


def _inverse(geometry: Geometry, q: FloatArray, needle: NeedleState, assembly: int) -> FloatArray:
    reached = forward(geometry, q, assembly)
    if np.abs(reached - needle.p3).max() > _CLOSED:
        raise MechanismError(
            sentence(
                "P3 = {needle_p3} m: this working mode does not close there in assembly"
                " {assembly}, which puts P3 at {reached} m",
                needle_p3=needle.p3.tolist(),
                assembly=assembly,
                reached=reached.tolist(),
            )
        )
    kind = singularity(geometry, q, assembly, tolerance=_RELATIVE).kind
    if kind is not Singularity.REGULAR:
        raise SingularError(
            sentence(
                "singular ({kind}): joint rates at P3 = {needle_p3} m",
                kind=kind.value,
                needle_p3=needle.p3.tolist(),
            )
        )
    return np.asarray(np.linalg.inv(jacobian(geometry, q, assembly)), dtype=np.float64)
