"""The needle pantograph: a planar five-bar under a fulcrum that points a sliding needle.

Names are imported when they are first asked for: a profile is read without compiled code.
"""

from importlib import import_module
from typing import TYPE_CHECKING, Any

if TYPE_CHECKING:
    from app.mechanisms.dynamic_model import DynamicModel
    from app.mechanisms.geometry import Geometry
    from app.mechanisms.inertia import LumpedInertia
    from app.mechanisms.lever import ForceLaw
    from app.mechanisms.pantograph.dynamics import (
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
    from app.mechanisms.pantograph.system import (
        LengthMode,
        NeedleState,
        needle_at,
        system_forward,
        system_inverse,
    )
    from app.mechanisms.remote_centre import DynamicTerms
    from app.mechanisms.status import Status

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

_MODULES = {
    "ASSEMBLIES": "pantograph.posture",
    "Branch": "pantograph.posture",
    "DynamicModel": "dynamic_model",
    "DynamicTerms": "remote_centre",
    "ForceLaw": "lever",
    "Geometry": "geometry",
    "LengthMode": "pantograph.system",
    "LumpedInertia": "inertia",
    "NeedleState": "pantograph.system",
    "PassiveAngles": "pantograph.posture",
    "Singularity": "pantograph.posture",
    "SingularityMeasure": "pantograph.posture",
    "Status": "status",
    "SystemRates": "pantograph.statics",
    "WORKING_MODE": "pantograph.kinematics",
    "WORKING_MODES": "pantograph.posture",
    "branches": "pantograph.posture",
    "dexterity": "pantograph.posture",
    "dynamic_terms": "pantograph.dynamics",
    "felt_force": "pantograph.statics",
    "force_map": "pantograph.statics",
    "forward": "pantograph.kinematics",
    "hub_by_tool": "pantograph.statics",
    "inverse": "pantograph.kinematics",
    "jacobian": "pantograph.kinematics",
    "jacobian_rate": "pantograph.posture",
    "joint_torques": "pantograph.statics",
    "joints_by_hub": "pantograph.statics",
    "lever_map": "pantograph.statics",
    "mass_matrix": "pantograph.dynamics",
    "needle_at": "pantograph.system",
    "passive_angles": "pantograph.posture",
    "printed_force": "pantograph.statics",
    "singularity": "pantograph.posture",
    "system_forward": "pantograph.system",
    "system_inverse": "pantograph.system",
    "system_rates": "pantograph.statics",
    "tool_by_hub": "pantograph.statics",
    "tool_force": "pantograph.statics",
    "velocity_terms": "pantograph.dynamics",
    "working_mode": "pantograph.posture",
}


def __getattr__(name: str) -> Any:
    """Import a name of this package from its module."""
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    value = getattr(import_module(f"app.mechanisms.{_MODULES[name]}"), name)
    globals()[name] = value
    return value
