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
its vertical; the needle's direction from hub to tip is -t.
"""

from app.mechanisms.tensegrity.cables import (
    CABLE_NAMES,
    Cables,
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
from app.mechanisms.tensegrity.dynamics import GuideMasses, GuideTerms, guide_dynamics
from app.mechanisms.tensegrity.frame import CurvedBars, remote_centre_stiffness
from app.mechanisms.tensegrity.geometry import JointReading, TensegrityGeometry
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
