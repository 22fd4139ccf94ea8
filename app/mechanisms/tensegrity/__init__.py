"""The tensegrity needle holder: two spherical pantographs, drawn by cables, over a remote centre.

For the loop (compiled, no allocation; `bars = geometry.bars`, nine numbers given one by one;
status integers of `pantograph/status.py`):

- `kernels.forward_kernel(b1, b2, *bars, assembly) -> (status, tx, ty, tz)`
- `kernels.inverse_kernel(tx, ty, tz, *bars, assembly) -> (status, b1, b2)`
- `kernels.jacobian_kernel(b1, b2, tx, ty, tz, *bars) -> (status, six entries of dt/dβ by rows)`
- `kernels.joint_rates_kernel`, `kernels.jacobian_rate_kernel`, `kernels.singularity_kernel`

For everybody else: the functions and values below. The remote centre is the machine's origin, z0
its vertical; the needle's direction from hub to tip is -t.
"""

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
    CABLES,
    MachinePoints,
    Trilateration,
    machine_points,
    trilaterate,
)

__all__ = [
    "CABLES",
    "EDGES_PER_LINE",
    "ENCODER_LINES",
    "GuideConditioning",
    "GuideSingularity",
    "JointReading",
    "MachinePoints",
    "TensegrityGeometry",
    "Trilateration",
    "conditioning",
    "encoder_error",
    "forward",
    "guide_angles",
    "guide_direction",
    "inverse",
    "jacobian",
    "jacobian_rate",
    "joint_rates",
    "machine_points",
    "nearest",
    "reaches",
    "trilaterate",
]
