"""Device profiles: every number of one robot, with where it comes from."""

from enum import StrEnum
from math import radians
from pathlib import Path
from typing import Annotated

from pydantic import Field, model_validator

from app.core import paths
from app.core.arrays import frozen
from app.core.configuration import Strict, load
from app.core.errors import ConfigurationError
from app.mechanisms.dynamic_model import DynamicModel
from app.mechanisms.geometry import Geometry
from app.mechanisms.inertia import LumpedInertia

Positive = Annotated[float, Field(gt=0.0)]
NotNegative = Annotated[float, Field(ge=0.0)]


class Provenance(StrEnum):
    """Where a value comes from."""

    MEASURED = "measured"
    PUBLISHED = "published"
    ESTIMATED = "estimated"


class Axis(StrEnum):
    """A direction in which a device can push the needle."""

    LATERAL = "lateral"
    AXIAL = "axial"


class Section(Strict):
    """Part of a profile; `provenance` names the origin of each of its values."""

    provenance: dict[str, Provenance]

    @model_validator(mode="after")
    def _every_value_has_one(self) -> "Section":
        wanted = set(type(self).model_fields) - {"provenance"}
        if missing := sorted(wanted - set(self.provenance)):
            raise ValueError(f"no provenance for {', '.join(missing)}")
        if unknown := sorted(set(self.provenance) - wanted):
            raise ValueError(f"provenance of {', '.join(unknown)}, which the section does not have")
        return self


class GeometrySection(Section):
    """Lengths [m]; see `geometry.Geometry`."""

    proximal: Positive
    distal: Positive
    base: Positive
    fulcrum: tuple[float, float, Positive]
    needle_length: Positive


class WorkspaceSection(Section):
    """Where the needle may go: tilt limits of the named ball joints [°], depth range [m]."""

    joint: str
    tilt_limit_deg: dict[str, Annotated[float, Field(gt=0.0, lt=90.0)]]
    depth_min: float
    depth_max: float

    @model_validator(mode="after")
    def _consistent(self) -> "WorkspaceSection":
        if self.joint not in self.tilt_limit_deg:
            raise ValueError(
                f"joint {self.joint!r} is not one of {', '.join(sorted(self.tilt_limit_deg))}"
            )
        if self.depth_min >= self.depth_max:
            raise ValueError(f"depth_min {self.depth_min} must be below depth_max {self.depth_max}")
        return self


class EncoderSection(Section):
    """Joint encoders: counts per turn of the joint, joint angles at zero counts [rad]."""

    counts_per_turn: Annotated[int, Field(gt=0)]
    home_offsets: tuple[float, float]


class LimitSection(Section):
    """Largest joint torque [N·m] and largest force at the hand [N], never above 5 N."""

    joint_torque: Positive
    hand_force: Annotated[float, Field(gt=0.0, le=5.0)]


class FixtureSection(Section):
    """Defaults of the virtual fixture: stiffness [N/rad] and damping [N·s/m] at the hub."""

    stiffness: NotNegative
    damping: NotNegative


class InertiaSection(Section):
    """Masses [kg], distances of the centres of mass [m], inertias about them [kg·m²]."""

    proximal_mass: Positive
    proximal_centre: NotNegative
    proximal_inertia: Positive
    distal_mass: Positive
    distal_centre: NotNegative
    distal_inertia: Positive
    tool_mass: NotNegative
    needle_mass: NotNegative
    needle_centre: NotNegative
    needle_inertia: NotNegative
    rotor_inertia: NotNegative
    gear: Positive

    @property
    def reflected_rotor(self) -> float:
        """Rotor inertia seen at the joint [kg·m²]: times the gear squared."""
        return self.rotor_inertia * self.gear**2


class FrictionSection(Section):
    """Friction of each joint: Coulomb [N·m] and viscous [N·m·s/rad]."""

    coulomb: NotNegative
    viscous: NotNegative


class MotorSection(Section):
    """Motors and amplifiers, behind the board: what a torque is in amperes and volts.

    Torque constant of the motor shaft [N·m/A], amplifier [A/V], largest current [A].
    """

    torque_constant: Positive
    amplifier_gain: Positive
    largest_current: Positive


class MountingSection(Section):
    """How the base stands: gravity in the robot's frame [m/s²]; (0, 0, -9.80665) upright."""

    gravity: tuple[float, float, float]


class Protocol(StrEnum):
    """Language on the wire, see docs/protocol.md."""

    ACUS = "acus"
    HAPLY = "haply"


class WireSection(Section):
    """The serial line: protocol, speed [baud], time without commands until the board stops [ms]."""

    protocol: Protocol
    baud: Annotated[int, Field(ge=1200, le=12_000_000)]
    watchdog_ms: Annotated[float, Field(gt=0.0, le=100.0)]


class HaplySection(Section):
    """Ports of a Haply board for (left, right): numbers, and whether counter-clockwise is positive.

    Angles on its wire are in degrees; `encoder_offset_deg` are those at zero counts.
    """

    device_id: Annotated[int, Field(ge=0, le=255)]
    motor_ports: tuple[int, int]
    motor_ccw: tuple[bool, bool]
    encoder_ports: tuple[int, int]
    encoder_ccw: tuple[bool, bool]
    encoder_offset_deg: tuple[float, float]


class LoopSection(Section):
    """Rate of the control loop [Hz] and the directions in which the device can push."""

    rate_hz: Annotated[float, Field(ge=1.0, le=10_000.0)]
    renders: tuple[Axis, ...]


class DeviceProfile(Strict):
    """One robot. Values are SI; each section carries the provenance of its values."""

    name: str
    description: str
    geometry: GeometrySection
    workspace: WorkspaceSection
    encoder: EncoderSection
    limits: LimitSection
    fixture: FixtureSection
    inertia: InertiaSection
    friction: FrictionSection
    motor: MotorSection
    mounting: MountingSection
    wire: WireSection
    loop: LoopSection
    haply: HaplySection | None = None

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
    def tilt_limit_deg(self) -> float:
        """Tilt limit of the mounted joint [°]."""
        return self.workspace.tilt_limit_deg[self.workspace.joint]

    @property
    def tilt_limit(self) -> float:
        """Tilt limit of the mounted joint [rad]."""
        return radians(self.tilt_limit_deg)

    @property
    def depth_range(self) -> tuple[float, float]:
        """Depths of the tip beyond the fulcrum that the device allows [m]."""
        return self.workspace.depth_min, self.workspace.depth_max

    @property
    def rate_hz(self) -> float:
        """Rate of the control loop [Hz]."""
        return self.loop.rate_hz

    @property
    def renders(self) -> tuple[Axis, ...]:
        """Directions in which the device can push the needle."""
        return self.loop.renders

    def with_joint(self, joint: str) -> "DeviceProfile":
        """Return the profile with another of its ball joints mounted.

        Raises:
            ConfigurationError: if the profile has no such joint; names those it has.
        """
        names = sorted(self.workspace.tilt_limit_deg)
        if joint not in names:
            raise ConfigurationError(
                f"device {self.name}: no joint {joint!r}; valid names: {', '.join(names)}"
            )
        workspace = self.workspace.model_copy(update={"joint": joint})
        return self.model_copy(update={"workspace": workspace})


def profile_names() -> list[str]:
    """Names of the shipped device profiles."""
    return sorted(path.stem for path in _folder().glob("*.yaml"))


def load_profile(name_or_path: str | Path) -> DeviceProfile:
    """Load a shipped profile by name, or any profile by the path of its YAML file.

    Raises:
        ConfigurationError: if there is none (names the valid names), or the file is wrong.
    """
    text = str(name_or_path)
    if text in profile_names():
        return load(_folder() / f"{text}.yaml", DeviceProfile)
    path = Path(name_or_path)
    if path.suffix not in (".yaml", ".yml"):
        raise ConfigurationError(
            f"no device profile {text!r}; valid names: {', '.join(profile_names())},"
            " or the path of a .yaml file"
        )
    return load(path, DeviceProfile)


def _folder() -> Path:
    return paths.resources() / "devices"
