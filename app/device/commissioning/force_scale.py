"""Forces by weights: is a commanded newton one on a kitchen scale; what does the gauge read?"""

from typing import TYPE_CHECKING, ClassVar, Final

import numpy as np
from numpy.typing import ArrayLike

from app.core import state_vector as sv
from app.core.arrays import FloatArray, unit
from app.core.messages import sentence
from app.device.commissioning.results import ForceScale, Gauge, RoutineName, RoutineReport
from app.device.commissioning.routine import Routine, Script
from app.device.control.loop import Loop
from app.device.errors import CommissioningError
from app.device.readiness import SCALE_TOLERANCE, UNVERIFIED_FORCE
from app.mechanisms.profile import DeviceProfile

if TYPE_CHECKING:
    from app.device.control.corrections import Corrections


FORCES: Final = (0.2, 0.5, 0.9)
"""Commanded forces at the hub [N], the smallest first: a missing gear makes it ten times more,
and the largest has to stay below 1 N at any depth that the ruler allows."""

RULER: Final = 0.0005
"""Standard deviation of a depth that is held by a ruler [m]."""

GRAVITY: Final = 9.80665
"""Standard gravity [m/s²]: what turns a scale's grams into newtons."""

_SETTLE: Final = 1.0
_RUNAWAY: Final = 2.0  # reading over command at which the next, larger force is not commanded
_RESIDUAL: Final = 0.06  # [N] root mean square from the line
_NOTHING: Final = 0.05  # factor below which the scale did not feel the robot


class ForceScaleRoutine(Routine):
    """Push the hub with 0.2, 0.5 and 0.9 N and ask what the scale shows after each.

    No camera measures the depth here, so the person holds it by a ruler, and the loop is told so.

    Args:
        loop, profile: as in `Routine`.
        direction: of the force at the hub, in world, shape (3,); only what lies across the needle
            can be rendered.
    """

    NAME: ClassVar[RoutineName] = RoutineName.FORCE
    TITLE: ClassVar[str] = "Force scale"

    def __init__(
        self,
        loop: Loop,
        profile: DeviceProfile,
        direction: ArrayLike = (1.0, 0.0, 0.0),
    ) -> None:
        super().__init__(loop, profile)
        self._direction = unit(direction, "direction")
        self._lever = profile.needle_length - profile.fulcrum[2]

    def step(self, now: float) -> RoutineReport:
        """Go on; the depth is the one that the person was asked to hold."""
        depth = self._profile.needle_length - self._lever
        self._loop.inbox.write(tracked_depth=depth, tracked_time=now, tracked_variance=RULER**2)
        return super().step(now)

    def _quiet(self) -> None:
        super()._quiet()
        self._loop.inbox.write(tracked_time=0.0)

    def _script(self) -> Script:
        self._disarm()
        x, y, z = self._direction
        yield from self._ask(
            "hold the needle upright against the scale (or tie the hub to the weight on it, see"
            f" docs/hardware.md), so that a force towards ({x:g}, {y:g}, {z:g}) is weighed"
            " (x to the right, z up), with the hub, where the force is weighed,"
            f" {1e3 * self._lever:.0f} mm by a ruler above the fulcrum: the force that is felt"
            " depends on it; tare the scale and confirm"
        )
        direction = self._across()
        yield from self._arm(1.0, UNVERIFIED_FORCE)
        readings: list[float] = []
        for force in FORCES:
            self._force(force * direction)
            yield from self._wait(_SETTLE, f"pushing with {force:g} N")
            readings.append((yield from self._ask(f"type the reading at {force:g} N", "g")))
            self._progress += 0.3
            if abs(newtons(readings[-1])) > _RUNAWAY * force:
                break  # never command more of what is already far too strong
        factor, residual = fit(FORCES[: len(readings)], readings)
        if reason := refusal(factor, residual, self._profile.gear):
            raise CommissioningError(sentence("{title}: {reason}", title=self.TITLE, reason=reason))
        return ForceScale(
            commanded=FORCES,
            readings_g=tuple(readings),
            factor=factor,
            residual=residual,
            profile=self._profile.name,
        )

    def _across(self) -> FloatArray:
        """Direction of the force, across the needle as it stands now."""
        axis = self._loop.latest().axis
        across = self._direction - (self._direction @ axis) * axis
        if np.linalg.norm(across) < 0.5:
            raise CommissioningError(
                sentence(
                    "{title}: the force would point along the needle, where the robot cannot"
                    " push; hold the needle upright",
                    title=self.TITLE,
                )
            )
        return unit(across, "direction")


def newtons(grams: float) -> float:
    """Force [N] that a scale shows as grams."""
    return grams * 1e-3 * GRAVITY


def fit(commanded: ArrayLike, readings_g: ArrayLike) -> tuple[float, float]:
    """Slope through zero of measured over commanded force, and the residual [N].

    Raises:
        CommissioningError: if there is no reading, their numbers differ, or one is not finite.
    """
    wanted = np.atleast_1d(np.asarray(commanded, dtype=np.float64))
    grams = np.atleast_1d(np.asarray(readings_g, dtype=np.float64))
    if len(grams) == 0 or len(grams) != len(wanted):
        raise CommissioningError(
            sentence(
                "Force scale: {readings} readings for {forces} forces; give one reading "
                "in grams for each",
                readings=len(grams),
                forces=len(wanted),
            )
        )
    if not np.isfinite(grams).all():
        raise CommissioningError(
            sentence(
                "Force scale: the readings {grams} g are not all numbers; weigh again",
                grams=grams.tolist(),
            )
        )
    measured = grams * 1e-3 * GRAVITY
    factor = float(wanted @ measured / (wanted @ wanted))
    return factor, float(np.sqrt(np.mean((measured - factor * wanted) ** 2)))


def refusal(factor: float, residual: float, gear: float) -> str:
    """Say why a factor is not accepted, with the likely reason; empty if it is.

    Args:
        factor: measured over commanded force.
        residual: root mean square from the line [N].
        gear: motor turns per joint turn.
    """
    text = sentence("measured over commanded force is {factor:.3f}", factor=factor)
    if abs(factor - 1.0) <= SCALE_TOLERANCE:
        if residual <= _RESIDUAL:
            return ""
        return sentence(
            "the readings scatter by {residual:.3f} N about a line (at most {largest_residual:g} "
            "N): tare the scale, keep the needle still, and weigh again",
            residual=residual,
            largest_residual=_RESIDUAL,
        )
    allowed = f"{text}, outside 1 ± {SCALE_TOLERANCE:g}: "
    if abs(factor) < _NOTHING:
        return allowed + sentence(
            "the scale does not feel the robot; check thread, tare and motor supply"
        )
    if factor < 0.0:
        return allowed + sentence(
            "the sign is wrong; check the direction of the set-up, then the signs"
        )
    if gear > 1.0 and _near(factor, gear):
        return allowed + sentence(
            "the gear ratio {gear:g}:1 seems to be missing in the torque factor: the board "
            "takes the joint torque for the motor shaft's; divide its torque factor by the "
            "gear ratio",
            gear=gear,
        )
    if gear > 1.0 and _near(factor, 1.0 / gear):
        return allowed + sentence(
            "the gear ratio {gear:g}:1 seems to be applied twice; multiply the board's torque"
            " factor by the gear ratio",
            gear=gear,
        )
    return allowed + sentence(
        "check torque constant, amplifier gain and lengths in the profile against the device"
    )


def _near(factor: float, wanted: float) -> bool:
    return abs(factor / wanted - 1.0) <= 0.3


WEIGHTS_G: Final = (0.0, 50.0, 100.0, 200.0)
"""Weights that are hung on the hub [g]."""

_LISTEN: Final = 0.5
_GAUGE_RESIDUAL: Final = 0.1  # [N]
_SCALES: Final = (0.1, 10.0)


class GaugeRoutine(Routine):
    """Hang known weights on the hub, motors off, and fit_gauge zero and scale.

    Args:
        loop, profile: as in `Routine`.
        corrections: in use; its gauge values are taken out of the readings.
        weights_g: at least two different weights [g].
    """

    NAME: ClassVar[RoutineName] = RoutineName.GAUGE
    TITLE: ClassVar[str] = "Gauge calibration"

    def __init__(
        self,
        loop: Loop,
        profile: DeviceProfile,
        corrections: "Corrections",
        weights_g: tuple[float, ...] = WEIGHTS_G,
    ) -> None:
        super().__init__(loop, profile)
        self._corrections, self._weights_g = corrections, weights_g

    def _script(self) -> Script:
        self._disarm()
        state = yield from self._say("looking for the gauge")
        if state.row[sv.GAUGE] != 1.0:
            raise CommissioningError(
                sentence(
                    "{title}: the board measures no force; connect the gauge's amplifier, or"
                    " leave this step out: forces are then shown as estimated",
                    title=self.TITLE,
                )
            )
        readings = []
        for weight in self._weights_g:
            yield from self._ask(f"hang {weight:g} g on the hub, across the needle, and confirm")
            since = self._loop.latest().tick
            yield from self._wait(_LISTEN, f"reading the gauge under {weight:g} g")
            shown = float(np.mean(self._loop.rows(since)[:, sv.GAUGE_FORCE]))
            zero, scale = self._corrections.gauge
            readings.append(shown / scale + zero)
            self._progress += 1.0 / (len(self._weights_g) + 1)
        return fit_gauge(self._weights_g, readings)


def fit_gauge(weights_g: ArrayLike, readings: ArrayLike) -> Gauge:
    """Fit reading = zero + force / scale by least squares.

    Args:
        weights_g: shape (n,) [g], at least two different ones.
        readings: shape (n,), uncorrected [N].

    Raises:
        CommissioningError: if the readings do not determine a scale or are no line.
    """
    weights = np.atleast_1d(np.asarray(weights_g, dtype=np.float64))
    shown = np.atleast_1d(np.asarray(readings, dtype=np.float64))
    if len(weights) != len(shown) or not len(weights) or np.ptp(weights) <= 0.0:
        raise CommissioningError(
            sentence(
                "Gauge calibration: give one reading for each of at least two different weights"
            )
        )
    if not (np.isfinite(weights).all() and np.isfinite(shown).all()):
        raise CommissioningError(
            sentence("Gauge calibration: a reading is not a number; read again")
        )
    force = weights * 1e-3 * GRAVITY
    slope, zero = (float(value) for value in np.polyfit(force, shown, 1))
    if not _SCALES[0] <= slope <= _SCALES[1]:
        raise CommissioningError(
            sentence(
                "Gauge calibration: the reading changes by {slope:.3f} N per newton (valid "
                "{least_scale:g} to {largest_scale:g}): check the amplifier's gain and "
                "polarity, and which way the weights pull",
                slope=slope,
                least_scale=_SCALES[0],
                largest_scale=_SCALES[1],
            )
        )
    residual = float(np.sqrt(np.mean(((shown - zero) / slope - force) ** 2)))
    if residual > _GAUGE_RESIDUAL:
        raise CommissioningError(
            sentence(
                "Gauge calibration: the readings lie {residual:.2f} N off a line (at most"
                " {gauge_residual:g} N): let the weights hang still and free",
                residual=residual,
                gauge_residual=_GAUGE_RESIDUAL,
            )
        )
    return Gauge(zero=zero, scale=1.0 / slope, residual=residual, weights_g=tuple(weights.tolist()))
