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
from app.mechanisms.pantograph.posture import (
    ASSEMBLIES,
    WORKING_MODES,
    Branch,
    PassiveAngles,
    Singularity,
    SingularityMeasure,
    branches,
    dexterity,
    jacobian_rate,
    passive_angles,
    singularity,
    working_mode,
)
from app.mechanisms.pantograph.statics import (
    ForceLaw,
    SystemRates,
    felt_force,
    force_map,
    hub_by_tool,
    joint_torques,
    joints_by_hub,
    lever_map,
    printed_force,
    system_rates,
    tool_by_hub,
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
    "ASSEMBLIES",
    "WORKING_MODE",
    "WORKING_MODES",
    "Branch",
    "DynamicModel",
    "DynamicTerms",
    "ForceLaw",
    "Geometry",
    "LengthMode",
    "LumpedInertia",
    "NeedleState",
    "PassiveAngles",
    "Singularity",
    "SingularityMeasure",
    "Status",
    "SystemRates",
    "branches",
    "dexterity",
    "dynamic_terms",
    "felt_force",
    "force_map",
    "forward",
    "hub_by_tool",
    "inverse",
    "jacobian",
    "jacobian_rate",
    "joint_torques",
    "joints_by_hub",
    "lever_map",
    "mass_matrix",
    "needle_at",
    "passive_angles",
    "printed_force",
    "singularity",
    "system_forward",
    "system_inverse",
    "system_rates",
    "tool_by_hub",
    "tool_force",
    "velocity_terms",
    "working_mode",
]
