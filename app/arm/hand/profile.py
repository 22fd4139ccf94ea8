"""A hand by its profile: lengths, limits and drive from YAML, each value with its provenance."""

from math import radians
from pathlib import Path
from typing import Annotated

from pydantic import Field

from app.arm.hand.finger import HandGeometry
from app.core.configuration import Strict, load
from app.core.errors import ConfigurationError
from app.core.messages import sentence
from app.mechanisms.profile.mechanics import Distance, Length, Section, Torque

HalfTurn = Annotated[float, Field(gt=0.0, le=180.0)]
"""[°]"""
Gear = Annotated[float, Field(gt=0.0, le=1000.0)]
"""Turns of the motor per turn of the joint."""


class HandLengths(Section):
    """Lengths [m] and φ30 [°]; see `finger.HandGeometry`."""

    knuckle: Length
    proximal: Length
    distal: Length
    bend_deg: Annotated[float, Field(ge=0.0, lt=180.0)]
    pad: Distance
    half_base: Length
    joint_height: Length
    palm_radius: Length


class FingerLimits(Section):
    """Upper limits of φ2, φ3 and the spread [°]; the lower ones are 0."""

    proximal_deg: HalfTurn
    distal_deg: HalfTurn
    spread_deg: HalfTurn


class HandDrive(Section):
    """Gears, breakaway torque [N·m]; of the motor lag [s], top speed [rad/s], period [s]."""

    proximal_gear: Gear
    distal_gear: Gear
    breakaway: Torque
    lag: Annotated[float, Field(gt=0.0, le=1.0)]
    top_speed: Annotated[float, Field(gt=0.0, le=1e4)]
    period: Annotated[float, Field(gt=0.0, le=0.1)]


class HandProfile(Strict):
    """One hand. Values are SI but for fields in `_deg`."""

    name: str
    description: str
    geometry: HandLengths
    limits: FingerLimits
    drive: HandDrive

    @property
    def hand(self) -> HandGeometry:
        """Geometry for the functions of `arm.hand`.

        Raises:
            MechanismError: if the values do not make a hand.
        """
        lengths, limits, drive = self.geometry, self.limits, self.drive
        return HandGeometry(
            knuckle=lengths.knuckle,
            proximal=lengths.proximal,
            distal=lengths.distal,
            bend=radians(lengths.bend_deg),
            pad=lengths.pad,
            half_base=lengths.half_base,
            joint_height=lengths.joint_height,
            palm_radius=lengths.palm_radius,
            most_proximal=radians(limits.proximal_deg),
            most_distal=radians(limits.distal_deg),
            most_spread=radians(limits.spread_deg),
            proximal_gear=drive.proximal_gear,
            distal_gear=drive.distal_gear,
            breakaway=drive.breakaway,
        )


def hand_names() -> list[str]:
    """Names of the shipped hands."""
    return sorted(path.stem for path in _folder().glob("*.yaml"))


def load_hand(name_or_path: str | Path = "bh8-282") -> HandProfile:
    """Load a shipped hand by name, or any by the path of its YAML file.

    Raises:
        ConfigurationError: if there is none (names the valid names), or the file is wrong.
    """
    text = str(name_or_path)
    if text in hand_names():
        return load(_folder() / f"{text}.yaml", HandProfile)
    path = Path(name_or_path)
    if path.suffix not in (".yaml", ".yml"):
        raise ConfigurationError(
            sentence(
                "no hand {wanted!r}; valid names: {hand_names}, or the path of a .yaml file",
                wanted=text,
                hand_names=", ".join(hand_names()),
            )
        )
    return load(path, HandProfile)


def _folder() -> Path:
    return Path(__file__).resolve().parents[1] / "profiles" / "hands"
