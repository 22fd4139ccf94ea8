"""What a routine says after each step, and what it finds for the device's record. Strict, SI."""

from dataclasses import dataclass
from enum import StrEnum
from typing import Annotated, Literal

from pydantic import Field

from app.core.configuration import Strict
from app.core.messages import sentence
from app.device.readiness import SCALE_TOLERANCE


class RoutineName(StrEnum):
    """Routines of commissioning, in the order in which a new device takes them."""

    HOMING = "homing"
    OFFSETS = "offsets"
    SIGNS = "signs"
    FRICTION = "friction"
    LATENCY = "latency"
    FORCE = "force"
    GAUGE = "gauge"


class Side(StrEnum):
    """The two driven joints, seen from the hand that holds the needle (x to the right)."""

    LEFT = "left"
    RIGHT = "right"


class Homing(Strict):
    """Offsets [rad] added to the link's joint angles, (left, right).

    Attributes:
        reference: `stops` (links at the profile's home pose) or `jig` (needle held vertical).
        change: by how much the routine changed the offsets [rad].
    """

    step: Literal[RoutineName.HOMING, RoutineName.OFFSETS] = RoutineName.HOMING
    reference: Literal["stops", "jig"] = "stops"
    offsets: tuple[float, float]
    change: tuple[float, float]

    def summary(self) -> str:
        """One line for people."""
        left, right = self.offsets
        return sentence(
            "encoder offsets left {left:+.5f} rad, right {right:+.5f} rad (by {reference})",
            left=left,
            right=right,
            reference=self.reference,
        )


class Signs(Strict):
    """Motors and encoders are where they belong and turn the right way.

    Attributes:
        response: movement [rad] of (left, right) for a pulse on the left, then on the right motor.
        by_hand: whether the encoders' directions were checked by hand too.
    """

    step: Literal[RoutineName.SIGNS] = RoutineName.SIGNS
    response: tuple[tuple[float, float], tuple[float, float]]
    by_hand: bool

    def summary(self) -> str:
        """One line for people."""
        how = sentence("by hand and by pulses") if self.by_hand else sentence("by pulses only")
        return sentence("motors and encoders agree, checked {how}", how=how)


class JointFriction(Strict):
    """Friction of one joint.

    Attributes:
        breakaway: torque at which it starts to move, mean of both directions [N·m].
        breakaway_spread: standard deviation of the single ramps in one direction [N·m].
        coulomb: speed-independent part of the torque at constant speed [N·m].
        viscous: slope over speed [N·m·s/rad].
        residual: root mean square of the fit [N·m].
    """

    breakaway: float
    breakaway_spread: Annotated[float, Field(ge=0.0)]
    coulomb: float
    viscous: float
    residual: Annotated[float, Field(ge=0.0)]


class Friction(Strict):
    """Friction of both joints."""

    step: Literal[RoutineName.FRICTION] = RoutineName.FRICTION
    left: JointFriction
    right: JointFriction

    def summary(self) -> str:
        """One line for people."""
        return "; ".join(
            f"{side}: breakaway {1e3 * one.breakaway:.1f} ± {1e3 * one.breakaway_spread:.1f} mN·m,"
            f" Coulomb {1e3 * one.coulomb:.1f} mN·m, viscous {1e3 * one.viscous:.2f} mN·m·s/rad"
            for side, one in (("left", self.left), ("right", self.right))
        )


class RobotLatency(Strict):
    """Delays [s].

    Attributes:
        round_trip: command to answer: median, 99 %, largest; zeros without a wire.
        lost: share of commands that were never answered.
        dead_time: torque step to the onset of motion, median; what encoder resolution and
            inertia add is taken out by a fit.
        dead_time_spread: standard deviation of the single steps.
    """

    step: Literal[RoutineName.LATENCY] = RoutineName.LATENCY
    round_trip: tuple[float, float, float]
    lost: float
    dead_time: float
    dead_time_spread: float

    def summary(self) -> str:
        """One line for people."""
        median, high, largest = (1e3 * value for value in self.round_trip)
        return sentence(
            "round trip {median:.2f} ms (99 %: {high:.2f}, largest {largest:.2f}),"
            " lost {lost:.2f} %, torque to motion {dead_time:.1f}"
            " ± {dead_time_spread:.1f} ms",
            median=median,
            high=high,
            largest=largest,
            lost=100 * self.lost,
            dead_time=1e3 * self.dead_time,
            dead_time_spread=1e3 * self.dead_time_spread,
        )


class ForceScale(Strict):
    """Measured force over commanded force.

    Attributes:
        commanded: forces at the hub [N].
        readings_g: what the scale showed [g].
        factor: slope through zero by least squares.
        residual: root mean square of what the slope leaves [N].
        profile: name of the profile in use.
    """

    step: Literal[RoutineName.FORCE] = RoutineName.FORCE
    commanded: tuple[float, ...]
    readings_g: tuple[float, ...]
    factor: float
    residual: Annotated[float, Field(ge=0.0)]
    profile: str

    @property
    def verified(self) -> bool:
        """Return whether the factor is close enough to 1 to lift the cap."""
        return abs(self.factor - 1.0) <= SCALE_TOLERANCE

    def summary(self) -> str:
        """One line for people."""
        verdict = "verified" if self.verified else "not verified"
        return sentence(
            "force scale {factor:.3f}, residual {residual:.3f} N: {verdict}",
            factor=self.factor,
            residual=self.residual,
            verdict=verdict,
        )


class Gauge(Strict):
    """The board's force gauge, by weights: true force = (reading - zero) times scale.

    Attributes:
        zero: reading without a weight [N].
        scale: factor on what is above it.
        residual: root mean square of the fit [N], of true force.
        weights_g: the weights [g].
    """

    step: Literal[RoutineName.GAUGE] = RoutineName.GAUGE
    zero: float
    scale: float
    residual: Annotated[float, Field(ge=0.0)]
    weights_g: tuple[float, ...]

    def summary(self) -> str:
        """One line for people."""
        return sentence(
            "gauge zero {zero:+.3f} N, scale {scale:.4f}, ± {residual:.3f} N",
            zero=self.zero,
            scale=self.scale,
            residual=self.residual,
        )


AnyResult = Homing | Signs | Friction | RobotLatency | ForceScale | Gauge
"""Any of them; `step` says which in a file."""


@dataclass(frozen=True, slots=True)
class RoutineReport:
    """State of a routine, for the wizard and the command line.

    Attributes:
        progress: 0...1.
        message: what goes on, for people.
        needs: what the routine waits for, for people; empty while it works by itself. `answer`
            lets it go on.
        unit: of the number that it asks for; empty if a plain confirmation is enough.
        done: whether it has ended.
        result: what it found, once done.
        failure: why it ended without a result, and what to do; empty otherwise.
    """

    progress: float
    message: str
    needs: str = ""
    unit: str = ""
    done: bool = False
    result: AnyResult | None = None
    failure: str = ""
