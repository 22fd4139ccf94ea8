"""The profile of a tensegrity needle holder: bars, cables, winches and what they weigh."""

from enum import StrEnum
from math import radians
from typing import Annotated, Final, Literal

from pydantic import Field, model_validator

from app.core.messages import sentence, sentence_of
from app.mechanisms.errors import MechanismError
from app.mechanisms.profile.device import DeviceProfile
from app.mechanisms.profile.mechanics import (
    CentreSection,
    Distance,
    InertiaOrNone,
    Length,
    MassOrNone,
    NeedleSection,
    Section,
)
from app.mechanisms.tensegrity.geometry import (
    Cables,
    GuideMasses,
    JointReading,
    TensegrityGeometry,
)

Tension = Annotated[float, Field(ge=0.0, le=1000.0)]
"""[N]"""
Tilt = Annotated[float, Field(ge=-89.0, le=89.0)]
"""[°]"""

_ABOVE_GUIDE: Final = 0.01
"""Needle that must stand out of the guide to be held [m]."""


class TensegritySection(CentreSection):
    """Both spherical pantographs about the remote centre; see `tensegrity.geometry`.

    `heading_deg` turns the machine's x0 from world x about the vertical; z0 is world z.
    """

    first_radius: Length
    second_radius: Length
    first_reach: Length
    second_reach: Length
    first_tilt_deg: Tilt
    second_tilt_deg: Tilt
    heading_deg: Annotated[float, Field(ge=-180.0, le=180.0)]
    reading: JointReading

    @property
    def bars(self) -> TensegrityGeometry:
        """The machine in its own axes."""
        return TensegrityGeometry(
            self.first_radius,
            self.second_radius,
            self.first_reach,
            self.second_reach,
            radians(self.first_tilt_deg),
            radians(self.second_tilt_deg),
            self.reading,
        )

    @model_validator(mode="after")
    def _possible(self) -> "TensegritySection":
        try:
            _ = self.bars
        except MechanismError as error:
            raise ValueError(sentence_of(error)) from error
        return self


class GuideSection(NeedleSection):
    """What moves: bars by their length [kg/m], the guide at a distance from the centre [kg, m]."""

    bar_density: Annotated[float, Field(gt=0.0, le=20.0)]
    guide_mass: MassOrNone
    guide_centre: Distance
    guide_inertia: InertiaOrNone


class TensionFrom(StrEnum):
    """How a tension is known: by a sensor in the cable, or by the current of its motor."""

    SENSOR = "sensor"
    CURRENT = "current"


class CableSection(Section):
    """Four alike cables: dt/dx = stiffness + stiffening t [N/m, 1/m], limits of tension [N].

    `holding` is the pretension while winches hold the direction [N], `joint_stiffness` the
    stiffness that is asked of pretension while they pull, 0 for none [N·m/rad].
    """

    stiffness: Annotated[float, Field(gt=0.0, le=1e7)]
    stiffening: Annotated[float, Field(ge=0.0, le=1e5)]
    least: Annotated[float, Field(gt=0.0, le=1000.0)]
    most: Tension
    holding: Tension
    joint_stiffness: Annotated[float, Field(ge=0.0, le=1e5)]
    tension_from: TensionFrom

    @model_validator(mode="after")
    def _in_order(self) -> "CableSection":
        if not self.least < self.holding < self.most:
            raise ValueError(
                sentence(
                    "tensions must rise from least ({least:g} N) over holding"
                    " ({holding:g} N) to most ({most:g} N)",
                    least=self.least,
                    holding=self.holding,
                    most=self.most,
                )
            )
        return self


class WinchSection(Section):
    """Four alike winches, at the cable: mass that turning parts are worth [kg], friction
    [N, N·s/m], fastest reeling [m/s].
    """

    mass: Annotated[float, Field(gt=0.0, le=20.0)]
    coulomb: Tension
    viscous: Annotated[float, Field(ge=0.0, le=1000.0)]
    fastest: Annotated[float, Field(gt=0.0, le=2.0)]


class TensegrityProfile(DeviceProfile):
    """One tensegrity needle holder."""

    kind: Literal["tensegrity"]
    geometry: TensegritySection
    inertia: GuideSection
    cables: CableSection
    winches: WinchSection

    @property
    def masses(self) -> GuideMasses:
        """Masses of bars and guide."""
        part = self.inertia
        return GuideMasses(part.bar_density, part.guide_mass, part.guide_centre, part.guide_inertia)

    @property
    def strings(self) -> Cables:
        """Law and limits of the cables."""
        part = self.cables
        return Cables(part.stiffness, part.stiffening, part.least, part.most)

    @property
    def joint_inertia(self) -> float:
        """Least inertia of a joint: that of the cables' winches, which weigh most there [kg·m²]."""
        lever = 0.05 * min(self.geometry.first_radius, self.geometry.second_radius)
        return self.winches.mass * lever**2 + 1e-4

    @property
    def links_potential_bound(self) -> float:
        """Bound of gravity's potential in bars and guide: all of it at the sphere [J]."""
        part, lengths = self.inertia, self.geometry
        bars = 0.0
        for radius, reach in (
            (lengths.first_radius, lengths.first_reach),
            (lengths.second_radius, lengths.second_reach),
        ):
            bars += 8.0 * part.bar_density * radius * reach  # an arc is no longer than f
        size = float(sum(g * g for g in self.mounting.gravity)) ** 0.5
        return size * (bars + self.masses.along[1])

    @property
    def shortest_needle(self) -> float:
        """The guide stands over the remote centre, and the hub over it [m]."""
        guide = max(self.geometry.first_radius, self.geometry.second_radius) + _ABOVE_GUIDE
        return max(super().shortest_needle, self.workspace.depth_max + guide)

    @property
    def tension_range(self) -> tuple[float, float]:
        """Least and largest tension of its cables [N]."""
        return self.cables.least, self.cables.most

    @property
    def fastest_reel(self) -> float:
        """Fastest that its winches reel in [m/s]."""
        return self.winches.fastest

    @property
    def holds_direction(self) -> bool:
        """Winches hold what they have reeled in."""
        return True


PROFILE: Final = TensegrityProfile
"""What a profile of this kind is read as."""
