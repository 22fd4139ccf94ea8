"""Differential kinematics of the complete system: joint rates, depth rate and the hub's velocity.

With d from hub to tip, P_u = P_I - L_out d and dd/dP3 = (I - d dᵀ)/L_in on x, y:

- measured L_out (independent of P3): dP_u = -(L_out/L_in)(I - d dᵀ) dP3 - d dL_out; only the part
  across the needle comes from the joints,
- printed mode (L_out = C - L_in): dL_out = -d·dP3, so dP_u = [d dᵀ - (L_out/L_in)(I - d dᵀ)] dP3.

Backwards, P3 is where the line from the hub through the fulcrum meets z = 0:
dP3 = -(L_in/L_out)(I - d ẑᵀ/d_z) dP_u, whatever the mode.
"""

from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.mechanisms.errors import MechanismError, SingularError
from app.mechanisms.geometry import Geometry
from app.mechanisms.pantograph.kinematics import WORKING_MODE, forward, jacobian
from app.mechanisms.pantograph.posture import Singularity, singularity
from app.mechanisms.pantograph.statics import lever_map
from app.mechanisms.pantograph.system import (
    LengthMode,
    NeedleState,
    system_forward,
    system_inverse,
)

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
            f"P3 = {needle.p3.tolist()} m: this working mode does not close there in assembly"
            f" {assembly}, which puts P3 at {reached.tolist()} m"
        )
    kind = singularity(geometry, q, assembly, tolerance=_RELATIVE).kind
    if kind is not Singularity.REGULAR:
        raise SingularError(f"singular ({kind.value}): joint rates at P3 = {needle.p3.tolist()} m")
    return np.asarray(np.linalg.inv(jacobian(geometry, q, assembly)), dtype=np.float64)
