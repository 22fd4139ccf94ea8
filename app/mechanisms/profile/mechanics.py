"""Sections of a profile that describe the mechanism: lengths, workspace, inertias, friction."""

from enum import StrEnum
from math import atan2, cos, hypot, sin
from typing import Annotated

from pydantic import Field, model_validator

from app.core.configuration import Strict

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
    profile. `IMPORTED`: from a file that does not say, such as a URDF.
    """

    MEASURED = "measured"
    PUBLISHED = "published"
    ESTIMATED = "estimated"
    IMPORTED = "imported"


class Section(Strict):
    """Part of a profile; `provenance` names the origin of each value that the file gives."""

    provenance: dict[str, Provenance]

    @model_validator(mode="after")
    def _every_value_has_one(self) -> "Section":
        fields = set(type(self).model_fields) - {"provenance"}
        wanted = {name for name in fields if getattr(self, name) is not None}
        if missing := sorted(wanted - set(self.provenance)):
            raise ValueError(f"no provenance for {', '.join(missing)}")
        if unknown := sorted(set(self.provenance) - wanted):
            raise ValueError(f"provenance of {', '.join(unknown)}, which the section does not have")
        return self


class GeometrySection(Section):
    """Lengths [m]; see `geometry.Geometry`."""

    proximal: Length
    distal: Length
    base: Length
    fulcrum: tuple[Coordinate, Coordinate, Length]
    needle_length: Length

    @model_validator(mode="after")
    def _possible(self) -> "GeometrySection":
        """Refuse links that cannot hold the needle upright, and a needle that ends in the fulcrum.

        Below the fulcrum both arms must reach and, elbows outwards, meet in assembly +1; behind the
        motors (y < 0) elbows outwards would cross.
        """
        x, y, height = self.fulcrum
        if not y > 0.0:
            raise ValueError(
                f"fulcrum stands at y = {y:g} m; it must be in front of the motors, y > 0"
            )
        low, high = abs(self.distal - self.proximal), self.distal + self.proximal
        elbows = []
        for side, name in ((-1.0, "left"), (1.0, "right")):
            motor = 0.5 * side * self.base
            away = hypot(x - motor, y)
            if not low < away < high:
                raise ValueError(
                    f"fulcrum stands over a point {away:.4g} m from the {name} motor axis;"
                    f" proximal and distal reach from {low:.4g} to {high:.4g} m"
                )
            cosine = (self.proximal**2 + away**2 - self.distal**2) / (2.0 * self.proximal * away)
            opening = atan2((max(1.0 - cosine**2, 0.0)) ** 0.5, cosine)
            turn = atan2(y, x - motor) - side * opening
            elbows.append((motor + self.proximal * cos(turn), self.proximal * sin(turn)))
        (lx, ly), (rx, ry) = elbows
        if not (rx - lx) * (y - ly) - (ry - ly) * (x - lx) > 0.0:
            raise ValueError(
                f"fulcrum ({x:g}, {y:g}) m lies behind the elbows; with elbows outwards the links"
                " meet on the far side of them (greater y)"
            )
        if not self.needle_length > height:
            raise ValueError(
                f"needle_length {self.needle_length:g} m must be greater than the lever below the"
                f" fulcrum, {height:g} m, or nothing is left above it to hold"
            )
        return self


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
                f"joint {self.joint!r} is not one of {', '.join(sorted(self.tilt_limit_deg))}"
            )
        if self.depth_min >= self.depth_max:
            raise ValueError(f"depth_min {self.depth_min} must be below depth_max {self.depth_max}")
        return self


class InertiaSection(Section):
    """Masses [kg], distances of the centres of mass [m], inertias about them [kg·m²]."""

    proximal_mass: LinkMass
    proximal_centre: Distance
    proximal_inertia: Inertia
    distal_mass: LinkMass
    distal_centre: Distance
    distal_inertia: Inertia
    tool_mass: MassOrNone
    needle_mass: MassOrNone
    needle_centre: Distance
    needle_inertia: InertiaOrNone
    rotor_inertia: InertiaOrNone
    gear: Annotated[float, Field(gt=0.0, le=1000.0)]

    @property
    def reflected_rotor(self) -> float:
        """Rotor inertia seen at the joint [kg·m²]: times the gear squared."""
        return self.rotor_inertia * self.gear**2


class FrictionSection(Section):
    """Friction of each joint: Coulomb [N·m] and viscous [N·m·s/rad]."""

    coulomb: Annotated[float, Field(ge=0.0, le=20.0)]
    viscous: Annotated[float, Field(ge=0.0, le=20.0)]


class MountingSection(Section):
    """How the base stands: gravity in the robot's frame [m/s²]; (0, 0, -9.80665) upright."""

    gravity: tuple[Acceleration, Acceleration, Acceleration]
