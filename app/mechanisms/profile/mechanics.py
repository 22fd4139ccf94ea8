"""Sections of a profile that describe the mechanism: lengths, workspace, inertias, friction."""

from enum import StrEnum
from typing import Annotated

from pydantic import Field, model_validator

from app.core.configuration import Strict
from app.core.messages import sentence

Length = Annotated[float, Field(gt=0.0, le=2.0)]
"""[m]"""
Distance = Annotated[float, Field(ge=0.0, le=2.0)]
"""[m], may be zero"""
Coordinate = Annotated[float, Field(ge=-2.0, le=2.0)]
"""[m], of either sign"""
Mass = Annotated[float, Field(gt=0.0, le=20.0)]
"""[kg]"""
LinkMass = Annotated[float, Field(ge=1e-3, le=20.0)]
"""[kg] of a link; less than a gram holds no needle and breaks the equations"""
MassOrNone = Annotated[float, Field(ge=0.0, le=20.0)]
"""[kg], may be zero"""
Inertia = Annotated[float, Field(gt=0.0, le=5.0)]
"""[kg·m²]"""
InertiaOrNone = Annotated[float, Field(ge=0.0, le=5.0)]
"""[kg·m²], may be zero"""
Torque = Annotated[float, Field(gt=0.0, le=20.0)]
"""[N·m]"""
Angle = Annotated[float, Field(ge=-12.6, le=12.6)]
"""[rad], two turns either way"""
Acceleration = Annotated[float, Field(ge=-25.0, le=25.0)]
"""[m/s²]"""


class Provenance(StrEnum):
    """Where a value comes from.

    `MEASURED`: on this device. `PUBLISHED`: by whoever built it. `ESTIMATED`: by whoever wrote the
    profile. `IMPORTED`: from a file that does not say, such as a URDF. `ASSUMED`: nobody says it,
    and no robot was there to look at; a sensible value so that the rest can be tried.
    """

    MEASURED = "measured"
    PUBLISHED = "published"
    ESTIMATED = "estimated"
    IMPORTED = "imported"
    ASSUMED = "assumed"


class Section(Strict):
    """Part of a profile; `provenance` names the origin of each value that the file gives."""

    provenance: dict[str, Provenance]

    @model_validator(mode="after")
    def _every_value_has_one(self) -> "Section":
        fields = set(type(self).model_fields) - {"provenance"}
        wanted = {name for name in fields if getattr(self, name) is not None}
        if missing := sorted(wanted - set(self.provenance)):
            raise ValueError(sentence("no provenance for {missing}", missing=", ".join(missing)))
        if unknown := sorted(set(self.provenance) - wanted):
            raise ValueError(
                sentence(
                    "provenance of {unknown}, which the section does not have",
                    unknown=", ".join(unknown),
                )
            )
        return self


class CentreSection(Section):
    """Lengths [m] that every machine has: where its remote centre stands in world, and the needle.

    A machine's own section adds what it is made of.
    """

    fulcrum: tuple[Coordinate, Coordinate, Length]
    needle_length: Length


class WorkspaceSection(Section):
    """Where the needle may go: tilt limits of the named ball joints [°], depth range [m]."""

    joint: str
    tilt_limit_deg: dict[str, Annotated[float, Field(gt=0.0, lt=90.0)]]
    depth_min: Coordinate
    depth_max: Coordinate

    @model_validator(mode="after")
    def _consistent(self) -> "WorkspaceSection":
        if self.joint not in self.tilt_limit_deg:
            raise ValueError(
                sentence(
                    "joint {joint!r} is not one of {tilt_limit_deg}",
                    joint=self.joint,
                    tilt_limit_deg=", ".join(sorted(self.tilt_limit_deg)),
                )
            )
        if self.depth_min >= self.depth_max:
            raise ValueError(
                sentence(
                    "depth_min {least_depth} must be below depth_max {largest_depth}",
                    least_depth=self.depth_min,
                    largest_depth=self.depth_max,
                )
            )
        return self


class NeedleSection(Section):
    """The needle's mass [kg], centre of mass from the hub [m], inertia about it [kg·m²].

    A machine's own section adds what else moves.
    """

    needle_mass: MassOrNone
    needle_centre: Distance
    needle_inertia: InertiaOrNone


class FrictionSection(Section):
    """Friction of each joint: Coulomb [N·m] and viscous [N·m·s/rad]."""

    coulomb: Annotated[float, Field(ge=0.0, le=20.0)]
    viscous: Annotated[float, Field(ge=0.0, le=20.0)]


class MountingSection(Section):
    """How the base stands: gravity in the robot's frame [m/s²]; (0, 0, -9.80665) upright."""

    gravity: tuple[Acceleration, Acceleration, Acceleration]
