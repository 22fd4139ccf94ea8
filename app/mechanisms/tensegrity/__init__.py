"""The tensegrity needle holder: two spherical pantographs, drawn by cables, over a remote centre.

For the loop (compiled, no allocation; status integers of `mechanisms.status`). Numbers are given
one by one: `bars` the nine of `geometry.bars`, `radii` the two of `geometry.radii`, `law` the four
of `cables.law`; `assembly` is +1 as built:

- `kernels.forward_kernel(b1, b2, *bars, assembly) -> (status, tx, ty, tz)`
- `kernels.inverse_kernel(tx, ty, tz, *bars, assembly) -> (status, b1, b2)`
- `kernels.jacobian_kernel(b1, b2, tx, ty, tz, *bars) -> (status, six entries of dt/dβ by rows)`
- `kernels.joint_rates_kernel`, `kernels.jacobian_rate_kernel`, `kernels.singularity_kernel`
- `cable_kernels.tensions_kernel(b1, b2, τ1, τ2, k1, k2, *law, *radii, *bars) -> (status, t1, t2,
  t3, t4, shortfall 1, shortfall 2)`; tensions are within the limits whatever the status
- `cable_kernels.hub_torque_kernel`, `hub_force_kernel`, `lengths_kernel`, `pulled_kernel`, ...
- `dynamics.dynamics_kernel(b1, b2, v1, v2, density, inertia, moment, inertia_rate, gx, gy, gz,
  *radii, *bars) -> (status, m11, m12, m22, h1, h2, g1, g2)`

For everybody else: the functions and values below. The remote centre is the machine's origin, z0
its vertical; the needle's direction from hub to tip is -t. Names are imported when they are first
asked for: a profile is read without compiled code.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from app.mechanisms.tensegrity.cables import (
        CABLE_NAMES,
        CableTensions,
        TensionVerdict,
        force_limit,
        guide_stiffness,
        hub_force,
        hub_torques,
        joint_stiffness,
        length_curvature,
        length_jacobian,
        lengths,
        slack,
        tensions,
        torque_limits,
        torques,
    )
    from app.mechanisms.tensegrity.dynamics import GuideTerms, guide_dynamics
    from app.mechanisms.tensegrity.frame import remote_centre_stiffness
    from app.mechanisms.tensegrity.geometry import (
        Cables,
        CurvedBars,
        GuideMasses,
        JointReading,
        TensegrityGeometry,
    )
    from app.mechanisms.tensegrity.kinematics import (
        EDGES_PER_LINE,
        ENCODER_LINES,
        GuideConditioning,
        GuideSingularity,
        conditioning,
        encoder_error,
        forward,
        guide_angles,
        guide_direction,
        inverse,
        jacobian,
        jacobian_rate,
        joint_rates,
        nearest,
        reaches,
    )
    from app.mechanisms.tensegrity.points import (
        CABLE_ENDS,
        MachinePoints,
        Trilateration,
        machine_points,
        trilaterate,
    )

__all__ = [
    "CABLE_ENDS",
    "CABLE_NAMES",
    "EDGES_PER_LINE",
    "ENCODER_LINES",
    "CableTensions",
    "Cables",
    "CurvedBars",
    "GuideConditioning",
    "GuideMasses",
    "GuideSingularity",
    "GuideTerms",
    "JointReading",
    "MachinePoints",
    "TensegrityGeometry",
    "TensionVerdict",
    "Trilateration",
    "conditioning",
    "encoder_error",
    "force_limit",
    "forward",
    "guide_angles",
    "guide_direction",
    "guide_dynamics",
    "guide_stiffness",
    "hub_force",
    "hub_torques",
    "inverse",
    "jacobian",
    "jacobian_rate",
    "joint_rates",
    "joint_stiffness",
    "length_curvature",
    "length_jacobian",
    "lengths",
    "machine_points",
    "nearest",
    "reaches",
    "remote_centre_stiffness",
    "slack",
    "tensions",
    "torque_limits",
    "torques",
    "trilaterate",
]

_MODULES = {
    "CABLE_ENDS": "points",
    "CABLE_NAMES": "cables",
    "CableTensions": "cables",
    "Cables": "geometry",
    "CurvedBars": "geometry",
    "EDGES_PER_LINE": "kinematics",
    "ENCODER_LINES": "kinematics",
    "GuideConditioning": "kinematics",
    "GuideMasses": "geometry",
    "GuideSingularity": "kinematics",
    "GuideTerms": "dynamics",
    "JointReading": "geometry",
    "MachinePoints": "points",
    "TensegrityGeometry": "geometry",
    "TensionVerdict": "cables",
    "Trilateration": "points",
    "conditioning": "kinematics",
    "encoder_error": "kinematics",
    "force_limit": "cables",
    "forward": "kinematics",
    "guide_angles": "kinematics",
    "guide_direction": "kinematics",
    "guide_dynamics": "dynamics",
    "guide_stiffness": "cables",
    "hub_force": "cables",
    "hub_torques": "cables",
    "inverse": "kinematics",
    "jacobian": "kinematics",
    "jacobian_rate": "kinematics",
    "joint_rates": "kinematics",
    "joint_stiffness": "cables",
    "length_curvature": "cables",
    "length_jacobian": "cables",
    "lengths": "cables",
    "machine_points": "points",
    "nearest": "kinematics",
    "reaches": "kinematics",
    "remote_centre_stiffness": "frame",
    "slack": "cables",
    "tensions": "cables",
    "torque_limits": "cables",
    "torques": "cables",
    "trilaterate": "points",
}


def __getattr__(name: str) -> Any:
    """Import a name of this package from its module."""
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f"{__name__}.{_MODULES[name]}"), name)
    globals()[name] = value
    return value
