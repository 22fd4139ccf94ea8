"""The profile of a needle pantograph: its lengths, inertias and wiring."""

from math import atan2, cos, degrees, hypot, radians, sin, sqrt, tan
from pathlib import Path
from typing import Annotated, Final, Literal

from pydantic import Field, model_validator

from app.core.arrays import frozen
from app.core.errors import ConfigurationError
from app.core.messages import sentence
from app.mechanisms.dynamic_model import DynamicModel
from app.mechanisms.geometry import Geometry
from app.mechanisms.inertia import LumpedInertia
from app.mechanisms.profile.device import DeviceProfile, load_profile
from app.mechanisms.profile.mechanics import (
    CentreSection,
    Distance,
    Inertia,
    InertiaOrNone,
    Length,
    LinkMass,
    MassOrNone,
    NeedleSection,
)


class GeometrySection(CentreSection):
    """Lengths [m]; see `geometry.Geometry`."""

    proximal: Length
    distal: Length
    base: Length

    @model_validator(mode="after")
    def _possible(self) -> "GeometrySection":
        """Refuse links that cannot hold the needle upright, and a needle that ends in the fulcrum.

        Below the fulcrum both arms must reach and, elbows outwards, meet in assembly +1; behind the
        motors (y < 0) elbows outwards would cross.
        """
        x, y, height = self.fulcrum
        if not y > 0.0:
            raise ValueError(
                sentence(
                    "fulcrum stands at y = {y:g} m; it must be in front of the motors, y > 0", y=y
                )
            )
        low, high = abs(self.distal - self.proximal), self.distal + self.proximal
        elbows = []
        for side, name in ((-1.0, "left"), (1.0, "right")):
            motor = 0.5 * side * self.base
            away = hypot(x - motor, y)
            if not low < away < high:
                raise ValueError(
                    sentence(
                        "fulcrum stands over a point {away:.4g} m from the {name} motor axis;"
                        " proximal and distal reach from {low:.4g} to {high:.4g} m",
                        away=away,
                        name=name,
                        low=low,
                        high=high,
                    )
                )
            cosine = (self.proximal**2 + away**2 - self.distal**2) / (2.0 * self.proximal * away)
            opening = atan2((max(1.0 - cosine**2, 0.0)) ** 0.5, cosine)
            turn = atan2(y, x - motor) - side * opening
            elbows.append((motor + self.proximal * cos(turn), self.proximal * sin(turn)))
        (lx, ly), (rx, ry) = elbows
        if not (rx - lx) * (y - ly) - (ry - ly) * (x - lx) > 0.0:
            raise ValueError(
                sentence(
                    "fulcrum ({x:g}, {y:g}) m lies behind the elbows; with elbows outwards the "
                    "links meet on the far side of them (greater y)",
                    x=x,
                    y=y,
                )
            )
        if not self.needle_length > height:
            raise ValueError(
                sentence(
                    "needle_length {needle_length:g} m must be greater than the lever below the"
                    " fulcrum, {height:g} m, or nothing is left above it to hold",
                    needle_length=self.needle_length,
                    height=height,
                )
            )
        return self


class InertiaSection(NeedleSection):
    """Masses [kg], distances of the centres of mass [m], inertias about them [kg·m²]."""

    proximal_mass: LinkMass
    proximal_centre: Distance
    proximal_inertia: Inertia
    distal_mass: LinkMass
    distal_centre: Distance
    distal_inertia: Inertia
    tool_mass: MassOrNone
    rotor_inertia: InertiaOrNone
    gear: Annotated[float, Field(gt=0.0, le=1000.0)]

    @property
    def reflected_rotor(self) -> float:
        """Rotor inertia seen at the joint [kg·m²]: times the gear squared."""
        return self.rotor_inertia * self.gear**2


class PantographProfile(DeviceProfile):
    """One needle pantograph."""

    kind: Literal["pantograph"] = "pantograph"
    geometry: GeometrySection
    inertia: InertiaSection

    @model_validator(mode="after")
    def _links_reach(self) -> "PantographProfile":
        section = self.geometry
        x, y, height = section.fulcrum
        reach = section.proximal + section.distal + hypot(abs(x) + 0.5 * section.base, y)
        for name, tilt in self.workspace.tilt_limit_deg.items():
            if (away := height * tan(radians(tilt))) > reach:
                raise ValueError(
                    sentence(
                        "workspace.tilt_limit_deg of joint {name!r} is {tilt:g}: there the tool "
                        "would be {away:.3g} m from under the fulcrum, and the links reach "
                        "{reach:.3g} m at most; give at most {degrees:.1f}",
                        name=name,
                        tilt=tilt,
                        away=away,
                        reach=reach,
                        degrees=degrees(atan2(reach, height)),
                    )
                )
        return self

    @property
    def pantograph(self) -> Geometry:
        """Geometry for the functions of `mechanisms.pantograph`."""
        section = self.geometry
        return Geometry(
            section.proximal,
            section.distal,
            section.base,
            frozen(section.fulcrum),
            section.needle_length,
        )

    @property
    def lumped_inertia(self) -> LumpedInertia:
        """Constants of the equations of motion, rotor included."""
        part, lengths = self.inertia, self.geometry
        return LumpedInertia(
            driven=part.proximal_inertia
            + part.proximal_mass * part.proximal_centre**2
            + part.distal_mass * lengths.proximal**2
            + part.reflected_rotor,
            passive=part.distal_inertia + part.distal_mass * part.distal_centre**2,
            coupling=part.distal_mass * lengths.proximal * part.distal_centre,
            tool=part.tool_mass,
            driven_moment=part.proximal_mass * part.proximal_centre
            + part.distal_mass * lengths.proximal,
            passive_moment=part.distal_mass * part.distal_centre,
            needle_mass=part.needle_mass,
            needle_inertia=part.needle_inertia,
            needle_centre=part.needle_centre,
        )

    @property
    def dynamic_model(self) -> DynamicModel:
        """Constants of `pantograph.dynamics`: links, needle, gravity and joint friction."""
        return DynamicModel(
            self.pantograph,
            self.lumped_inertia,
            frozen(self.mounting.gravity),
            self.friction.coulomb,
            self.friction.viscous,
        )

    @property
    def joint_inertia(self) -> float:
        """Inertia of a driven link alone, rotor included [kg·m²]."""
        return self.lumped_inertia.driven

    @property
    def gear(self) -> float:
        """Motor turns per joint turn [-]."""
        return self.inertia.gear

    @property
    def shortest_needle(self) -> float:
        """Longer than the lever below the fulcrum, too: the tool holds the needle there [m]."""
        return max(super().shortest_needle, self.geometry.fulcrum[2])

    @property
    def links_potential_bound(self) -> float:
        """Bound of the magnitude of gravity's potential in links and tool, over all poses [J]."""
        gx, gy, _ = self.mounting.gravity
        part, lengths = self.lumped_inertia, self.geometry
        arms = 2.0 * (part.driven_moment + part.passive_moment)
        tool = part.tool * (lengths.proximal + lengths.distal + 0.5 * lengths.base)
        return sqrt(gx**2 + gy**2) * (arms + tool)


PROFILE: Final = PantographProfile
"""What a profile of this kind is read as."""


def load_pantograph(name_or_path: str | Path) -> PantographProfile:
    """Load a profile as `load_profile` does, for what is about pantographs alone.

    Raises:
        ConfigurationError: as `load_profile`, and if the device is of another kind.
    """
    return as_pantograph(load_profile(name_or_path))


def as_pantograph(profile: DeviceProfile) -> PantographProfile:
    """Return a profile that must be a pantograph's.

    Raises:
        ConfigurationError: if it is of another kind.
    """
    if not isinstance(profile, PantographProfile):
        raise ConfigurationError(
            sentence(
                "device {profile_name} is of kind {profile_kind}; this is about devices of kind"
                " pantograph alone",
                profile_name=profile.name,
                profile_kind=profile.kind,
            )
        )
    return profile
