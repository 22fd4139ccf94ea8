"""The needle pantograph: a planar five-bar under a fulcrum that points a sliding needle."""

from app.mechanisms.dynamic_model import DynamicModel
from app.mechanisms.geometry import Geometry
from app.mechanisms.inertia import LumpedInertia
from app.mechanisms.pantograph.dynamics import (
    DynamicTerms,
    dynamic_terms,
    mass_matrix,
    velocity_terms,
)
from app.mechanisms.pantograph.kinematics import WORKING_MODE, forward, inverse, jacobian
from app.mechanisms.pantograph.statics import (
    ForceLaw,
    felt_force,
    force_map,
    joint_torques,
    lever_map,
    printed_force,
    tool_force,
)
from app.mechanisms.pantograph.status import Status
from app.mechanisms.pantograph.system import (
    LengthMode,
    NeedleState,
    needle_at,
    system_forward,
    system_inverse,
)

__all__ = [
    "WORKING_MODE",
    "DynamicModel",
    "DynamicTerms",
    "ForceLaw",
    "Geometry",
    "LengthMode",
    "LumpedInertia",
    "NeedleState",
    "Status",
    "dynamic_terms",
    "felt_force",
    "force_map",
    "forward",
    "inverse",
    "jacobian",
    "joint_torques",
    "lever_map",
    "mass_matrix",
    "needle_at",
    "printed_force",
    "system_forward",
    "system_inverse",
    "tool_force",
    "velocity_terms",
]
