"""Lever and force relations between the hand, the tool point and the joints."""

from enum import StrEnum
from typing import Any

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray
from app.mechanisms.errors import DegenerateError, MechanismError, NoGripError
from app.mechanisms.pantograph import kernels
from app.mechanisms.pantograph.kinematics import pair
from app.mechanisms.pantograph.status import check
from app.mechanisms.pantograph.system import NeedleState


class ForceLaw(StrEnum):
    """How a wanted force at the hand becomes a force at the tool.

    `VIRTUAL_WORK` delivers it; `PRINTED` is equation 4.12 of the thesis, which delivers 1.66 times
    the force at 39° and twice at 45° in the tilt plane.
    """

    VIRTUAL_WORK = "virtual_work"
    PRINTED = "printed"


def lever_map(needle: NeedleState) -> FloatArray:
    """G_perp = -(L_out/L_in)(I - d dᵀ)[:, :2], shape (3, 2): velocity of P3 to that of the hub.

    The hub's velocity is the part perpendicular to the needle; along it the needle slides freely.
    """
    lever = _lever(needle)
    columns = [kernels.hub_velocity_kernel(*e, *lever) for e in ((1.0, 0.0), (0.0, 1.0))]
    return np.array(columns).T


def force_map(needle: NeedleState, force: ArrayLike) -> FloatArray:
    """Tool force γ = G_perpᵀ F [N], shape (2,), by virtual work; F at the hand [N], shape (3,)."""
    return np.array(kernels.force_map_kernel(*_triple(force), *_lever(needle)))


def printed_force(needle: NeedleState, force: ArrayLike) -> FloatArray:
    """Tool force of equation 4.12 as printed [N], shape (2,), for comparison with `force_map`.

    Raises:
        DegenerateError: if the needle lies in the plane of the links.
    """
    return np.array(kernels.printed_force_kernel(*_triple(force), *_lever(needle)))


def felt_force(needle: NeedleState, gamma: ArrayLike) -> FloatArray:
    """Force at the hand [N], shape (3,), perpendicular to the needle; tool force [N], shape (2,).

    Raises:
        DegenerateError: if the needle lies in the plane of the links.
    """
    return np.array(kernels.felt_kernel(*pair(gamma, "gamma"), *_lever(needle)))


def joint_torques(jacobian: ArrayLike, gamma: ArrayLike) -> FloatArray:
    """Joint torques τ = Jᵀ γ [N·m], shape (2,), for the Jacobian (2, 2) and a tool force (2,)."""
    return np.array(kernels.torque_kernel(*pair(gamma, "gamma"), *_entries(jacobian)))


def tool_force(jacobian: ArrayLike, torques: ArrayLike) -> FloatArray:
    """Tool force γ = J⁻ᵀ τ [N], shape (2,).

    Raises:
        SingularError: if the Jacobian has no inverse.
    """
    status, gx, gy = kernels.tool_force_kernel(*pair(torques, "torques"), *_entries(jacobian))
    check(status, f"tool force for the Jacobian {np.asarray(jacobian).tolist()} m/rad")
    return np.array([gx, gy])


def _lever(needle: NeedleState) -> tuple[float, float, float, float, float]:
    dx, dy, dz = needle.axis.tolist()
    if not needle.l_out > 0.0:
        raise NoGripError(f"no grip: L_out = {needle.l_out} m; a positive length is needed")
    if not dz < 0.0:
        raise DegenerateError(
            f"degenerate: the needle direction {needle.axis.tolist()} does not point down through"
            " the plane of the links"
        )
    return dx, dy, dz, needle.l_in, needle.l_out


def _entries(jacobian: ArrayLike) -> list[Any]:
    array = np.asarray(jacobian, dtype=np.float64)
    if array.shape != (2, 2):
        raise MechanismError(f"jacobian has shape {array.shape}; (2, 2) is needed")
    return array.ravel().tolist()


def _triple(force: ArrayLike) -> list[Any]:
    array = np.asarray(force, dtype=np.float64)
    if array.shape != (3,):
        raise MechanismError(f"force has shape {array.shape}; (3,) is needed")
    return array.tolist()
