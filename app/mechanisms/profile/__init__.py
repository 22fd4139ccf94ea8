"""Device profiles: every number of one robot, with where it comes from."""

from app.mechanisms.profile.control import (
    DEFAULT_VELOCITY,
    LET_GO_UNSTATED,
    Axis,
    EncoderSection,
    FixtureSection,
    HandSection,
    HaplySection,
    LetGoLimit,
    LimitSection,
    LoopSection,
    MotorSection,
    Protocol,
    VelocityMethod,
    WireSection,
)
from app.mechanisms.profile.device import DeviceProfile
from app.mechanisms.profile.files import load_profile, profile_names
from app.mechanisms.profile.mechanics import (
    FrictionSection,
    GeometrySection,
    InertiaSection,
    MountingSection,
    WorkspaceSection,
)
from app.mechanisms.profile.values import Provenance, Section

__all__ = [
    "DEFAULT_VELOCITY",
    "LET_GO_UNSTATED",
    "Axis",
    "DeviceProfile",
    "EncoderSection",
    "FixtureSection",
    "FrictionSection",
    "GeometrySection",
    "HandSection",
    "HaplySection",
    "InertiaSection",
    "LetGoLimit",
    "LimitSection",
    "LoopSection",
    "MotorSection",
    "MountingSection",
    "Protocol",
    "Provenance",
    "Section",
    "VelocityMethod",
    "WireSection",
    "WorkspaceSection",
    "load_profile",
    "profile_names",
]
