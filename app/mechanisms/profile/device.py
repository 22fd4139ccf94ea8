"""One robot: its sections, and what the other rooms ask of it."""

from math import atan2, degrees, hypot, radians, tan
from pathlib import Path
from typing import Final

from pydantic import model_validator

from app.core import paths
from app.core.arrays import frozen
from app.core.configuration import Strict, load
from app.core.errors import ConfigurationError
from app.mechanisms.dynamic_model import DynamicModel
from app.mechanisms.geometry import Geometry
from app.mechanisms.inertia import LumpedInertia
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
    VelocityMethod,
    WireSection,
)
from app.mechanisms.profile.mechanics import (
    FrictionSection,
    GeometrySection,
    InertiaSection,
    MountingSection,
    WorkspaceSection,
)

LONGEST_NEEDLE: Final = 0.5
"""No needle for this work is longer [m]."""


class DeviceProfile(Strict):
    """One robot. Values are SI; each section carries the provenance of its values.

    `velocity` is how joint velocities come from its encoders' angles.
    """

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
    hand: HandSection = HandSection()
    velocity: VelocityMethod = DEFAULT_VELOCITY
    haply: HaplySection | None = None

    @model_validator(mode="after")
    def _fits_the_needle(self) -> "DeviceProfile":
        length, deepest = self.geometry.needle_length, self.workspace.depth_max
        if deepest >= length:
            raise ValueError(
                f"workspace.depth_max {deepest:g} m must be below geometry.needle_length"
                f" {length:g} m: the hub stays outside the fulcrum"
            )
        section = self.geometry
        x, y, height = section.fulcrum
        reach = section.proximal + section.distal + hypot(abs(x) + 0.5 * section.base, y)
        for name, tilt in self.workspace.tilt_limit_deg.items():
            if (away := height * tan(radians(tilt))) > reach:
                raise ValueError(
                    f"workspace.tilt_limit_deg of joint {name!r} is {tilt:g}: there the tool would"
                    f" be {away:.3g} m from under the fulcrum, and the links reach {reach:.3g} m at"
                    f" most; give at most {degrees(atan2(reach, height)):.1f}"
                )
        if self.inertia.needle_centre > length:
            raise ValueError(
                f"inertia.needle_centre {self.inertia.needle_centre:g} m must lie on the needle of"
                f" geometry.needle_length {length:g} m"
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
    def let_go(self) -> LetGoLimit:
        """Limit of a needle that is let go: the profile's, or that of a profile which states none.

        `limits.let_go` is None in the latter case.
        """
        return self.limits.let_go or LET_GO_UNSTATED

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

    def with_needle(self, length: float) -> "DeviceProfile":
        """Return the profile with a needle of another length mounted [m].

        Raises:
            ConfigurationError: if the device cannot hold or use it; says what would be valid.
        """
        least = max(self.geometry.fulcrum[2], self.workspace.depth_max, self.inertia.needle_centre)
        if not least < length < LONGEST_NEEDLE:
            raise ConfigurationError(
                f"device {self.name}: a needle of {length:g} m; it holds needles longer than"
                f" {least:g} m and shorter than {LONGEST_NEEDLE:g} m"
            )
        geometry = self.geometry.model_copy(update={"needle_length": length})
        return self.model_copy(update={"geometry": geometry})


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
