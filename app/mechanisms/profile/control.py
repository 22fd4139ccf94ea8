"""Sections of a profile that describe sensing, motors, the wire and the loop."""

from enum import StrEnum
from typing import Annotated, Final

from pydantic import Field

from app.core.configuration import Strict
from app.mechanisms.profile.mechanics import Angle, Provenance, Section, Torque


class Axis(StrEnum):
    """A direction in which a device can push the needle."""

    LATERAL = "lateral"
    AXIAL = "axial"


class VelocityMethod(StrEnum):
    """How joint velocities come from encoder angles.

    `BACKWARD_DIFFERENCE`: of the last two readings (the thesis). `FILTERED`: the same through a
    low-pass of 50 Hz. `ALPHA_BETA`: tracker with fixed gains. `FOAW`: slope of the longest line
    within one count. `KALMAN`: tracker with gains from the encoder's resolution.
    """

    BACKWARD_DIFFERENCE = "backward_difference"
    FILTERED = "filtered"
    ALPHA_BETA = "alpha_beta"
    FOAW = "foaw"
    KALMAN = "kalman"


DEFAULT_VELOCITY: Final = VelocityMethod.FOAW
"""Chosen by measurement: `acus study velocity`, docs/studies.md."""


class EncoderSection(Section):
    """Joint encoders: counts per turn of the joint, joint angles at zero counts [rad]."""

    counts_per_turn: Annotated[int, Field(gt=0, le=100_000_000)]
    home_offsets: tuple[Angle, Angle]


class LetGoLimit(Strict):
    """What the program's forces may make of a needle that is let go, whoever holds it or not.

    Kinetic energy of the free mechanism [mJ], never above 10, and speed of the hub [m/s], never
    above 0.5, beyond what the same needle would do with the motors off.
    """

    energy_mj: Annotated[float, Field(gt=0.0, le=10.0)]
    speed: Annotated[float, Field(gt=0.0, le=0.5)]


LET_GO_UNSTATED: Final = LetGoLimit(energy_mj=10.0, speed=0.25)
"""Limit of a profile that states none: the speed that every robot was held to before."""


class LimitSection(Section):
    """Largest joint torque [N·m], largest force at the hand [N], never above 5 N, and the limit of
    a needle that is let go; a profile without that one is held to `LET_GO_UNSTATED`.
    """

    joint_torque: Torque
    hand_force: Annotated[float, Field(gt=0.0, le=5.0)]
    let_go: LetGoLimit | None = None


class FixtureSection(Section):
    """Defaults of the virtual fixture: stiffness [N/rad] and damping [N·s/m] at the hub."""

    stiffness: Annotated[float, Field(ge=0.0, le=10_000.0)]
    damping: Annotated[float, Field(ge=0.0, le=1000.0)]


class MotorSection(Section):
    """Motors and amplifiers, behind the board: what a torque is in amperes and volts.

    Torque constant of the motor shaft [N·m/A], amplifier [A/V], largest current [A].
    """

    torque_constant: Annotated[float, Field(gt=0.0, le=20.0)]
    amplifier_gain: Annotated[float, Field(gt=0.0, le=1000.0)]
    largest_current: Annotated[float, Field(gt=0.0, le=1000.0)]


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


class HandSection(Section):
    """The hand that holds the needle: fastest that it moves it along itself [m/s].

    A depth that was measured is uncertain by this speed times its age, and a fix that would need a
    faster hand is not believed.
    """

    depth_speed: Annotated[float, Field(ge=0.05, le=1.0)] = 0.12
    provenance: dict[str, Provenance] = Field(default={"depth_speed": Provenance.ESTIMATED})


class LoopSection(Section):
    """Rate of the control loop [Hz] and the directions in which the device can push."""

    rate_hz: Annotated[float, Field(ge=1.0, le=10_000.0)]
    renders: tuple[Axis, ...]
