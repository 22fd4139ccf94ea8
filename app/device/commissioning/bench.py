"""A device on the bench: its link, a loop with the service stage, its record, its routines.

The tick of a robot that is being commissioned has no force law: the service stage alone adds the
small test forces and torques of the routines.
"""

from __future__ import annotations

from collections.abc import Callable, Mapping
from dataclasses import dataclass
from datetime import datetime
from math import isfinite
from pathlib import Path
from typing import Final, NamedTuple

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import Clock, SystemClock, VirtualClock
from app.core.compiled import njit, stage
from app.core.messages import sentence
from app.core.parameters import Stage, numbered, packed
from app.device.commissioning.force_scale import ForceScaleRoutine, GaugeRoutine
from app.device.commissioning.friction import FrictionRoutine
from app.device.commissioning.homing import HomingRoutine, JigHomingRoutine
from app.device.commissioning.pulses import LatencyRoutine, SignRoutine
from app.device.commissioning.records import DeviceRecord, load_record, save_record
from app.device.commissioning.results import AnyResult, RoutineName, RoutineReport
from app.device.commissioning.routine import Routine
from app.device.control.corrections import Corrections
from app.device.control.depth_interval import DepthInterval
from app.device.control.governor import SpeedGovernor
from app.device.control.kinematics import Kinematics
from app.device.control.loop import Loop
from app.device.control.safety import Safety
from app.device.control.table import Table, judged
from app.device.control.transmission import Transmission
from app.device.control.vectors import shrink_kernel
from app.device.control.velocity import VelocityFilter
from app.device.errors import CommissioningError
from app.device.lifetime import Lifetime
from app.device.links.link import BoardInfo, DeviceLink, Link
from app.device.readiness import ForceClearance
from app.mechanisms.profile import DeviceProfile

LARGEST_FORCE: Final = 1.0
"""Largest test force at the hub [N]: what an unverified robot may give."""

LARGEST_TORQUE: Final = 0.03
"""Largest test torque of a joint [N·m]: about 0.3 N at the hand."""


class _ServicePlaces(NamedTuple):
    """Bounds of `Service`, and the force now."""

    force: int
    torque: int
    rate: int
    x: int = 0
    y: int = 0
    z: int = 0


_AT: Final = numbered(_ServicePlaces)


@njit
def _bounded(value: float, limit: float) -> float:
    return min(max(value, -limit), limit) if isfinite(value) else 0.0


@njit
def _follow(state: FloatArray, p: FloatArray, x: float, y: float, z: float) -> None:
    """Move the force towards (x, y, z) at a limited rate; towards zero at once."""
    if x == 0.0 and y == 0.0 and z == 0.0:
        p[_AT.x], p[_AT.y], p[_AT.z] = 0.0, 0.0, 0.0
        return
    step = p[_AT.rate] * max(state[sv.DT], 0.0)
    dx, dy, dz = x - p[_AT.x], y - p[_AT.y], z - p[_AT.z]
    scale = shrink_kernel(dx, dy, dz, step)
    p[_AT.x] += scale * dx
    p[_AT.y] += scale * dy
    p[_AT.z] += scale * dz


@stage
def service_stage(state: FloatArray, p: FloatArray) -> None:
    """Add TEST_X, TEST_Y, TEST_Z to FORCE_* and TEST_LEFT, TEST_RIGHT to JOINT_*, all bounded."""
    if not state[sv.ENABLED] > 0.5:
        p[_AT.x], p[_AT.y], p[_AT.z] = 0.0, 0.0, 0.0
        return
    x, y, z = state[sv.TEST_X], state[sv.TEST_Y], state[sv.TEST_Z]
    if not (isfinite(x) and isfinite(y) and isfinite(z)):
        x, y, z = 0.0, 0.0, 0.0
    scale = shrink_kernel(x, y, z, p[_AT.force])
    _follow(state, p, scale * x, scale * y, scale * z)
    state[sv.FORCE_X] += p[_AT.x]
    state[sv.FORCE_Y] += p[_AT.y]
    state[sv.FORCE_Z] += p[_AT.z]
    state[sv.JOINT_LEFT] += _bounded(state[sv.TEST_LEFT], p[_AT.torque])
    state[sv.JOINT_RIGHT] += _bounded(state[sv.TEST_RIGHT], p[_AT.torque])


@dataclass(frozen=True, slots=True)
class Service:
    """Bounds of the commissioning routines.

    Attributes:
        force: largest test force [N].
        torque: largest test torque of a joint [N·m].
        rate: how fast the force comes up [N/s]; it goes to zero at once.
    """

    force: float = LARGEST_FORCE
    torque: float = LARGEST_TORQUE
    rate: float = 2.0

    def stage(self) -> Stage:
        """Return the stage for a loop's table, with memory of its own."""
        parameters = packed(_AT, force=self.force, torque=self.torque, rate=self.rate)
        return Stage("service", service_stage, parameters)


def commissioning_table(
    profile: DeviceProfile, link: Link, corrections: Corrections | None = None
) -> Table:
    """Table of a tick: link read, plausibility, corrections, velocity, kinematics, service,
    transmission, speed governor, safety, link write.

    Args:
        profile: the robot's numbers.
        link: the robot's two ends.
        corrections: of its encoders and gauge; nothing is corrected by default.
    """
    machine = profile.machine.stages()
    return Table.of(
        [
            *judged(link, profile, [(corrections or Corrections()).stage()]),
            VelocityFilter().stage(),
            DepthInterval.of(profile).stage(),
            machine.pose,
            *machine.watch,
            Kinematics.of(profile).stage(),
            Service().stage(),
            Transmission.of(profile).stage(),
            SpeedGovernor.of(profile).stage(),
            Safety.of(profile).stage(),
            *machine.efforts,
        ],
        link.write,
    )


PERIOD: Final = 0.01
"""A routine is stepped this often [s]."""

NEEDS_HOMING: Final = frozenset(
    {RoutineName.SIGNS, RoutineName.FRICTION, RoutineName.LATENCY, RoutineName.FORCE}
)
NEEDS_SIGNS: Final = frozenset({RoutineName.FRICTION, RoutineName.LATENCY, RoutineName.FORCE})
"""What must be done in this power cycle before a routine may push."""


class Bench(Lifetime):
    """One device while it is commissioned.

    Args:
        link: to the device; opened and closed with the bench.
        profile: of the device.
        clock: the machine's, or a virtual one.
        folder: of the records; the user's by default.
        today: date and time for the record.
        initial: starting values of the loop's state, for a simulated plant.
    """

    def __init__(
        self,
        link: DeviceLink,
        profile: DeviceProfile,
        clock: Clock | None = None,
        folder: Path | None = None,
        today: Callable[[], datetime] | None = None,
        initial: Mapping[str, float] | None = None,
    ) -> None:
        self.profile = profile
        self.clock: Clock = clock or SystemClock()
        self.corrections = Corrections()
        self._link, self._folder, self._initial = link, folder, initial
        self._today = today or (lambda: datetime.now().astimezone())
        self._loop: Loop | None = None
        self._record: DeviceRecord | None = None

    # --- life -------------------------------------------------------------------------------------
    def open(self) -> None:
        """Connect, read the device's record, start the loop without force.

        Raises:
            LinkError: if the device does not answer.
            RecordError: if its record is damaged.
        """
        if self._loop is not None:
            return
        self._link.open()
        try:
            self._record = load_record(self.info, self._folder)
            self.corrections.set_offsets(*self._record.offsets(self.info.boot))
            self.corrections.set_gauge(*self._record.gauge())
            table = commissioning_table(self.profile, self._link.stages(), self.corrections)
            loop = Loop(table, self.profile.rate_hz, self.clock, initial=self._initial)
            loop.open()
            self._loop = loop
        except BaseException:
            self._link.close()
            raise

    def close(self) -> None:
        """End at zero torque and let go of the device; idempotent."""
        loop, self._loop = self._loop, None
        if loop is not None:
            loop.close()
        self._link.close()

    # --- the device -------------------------------------------------------------------------------
    @property
    def info(self) -> BoardInfo:
        """Return who is at the other end."""
        return self._link.info()

    @property
    def loop(self) -> Loop:
        """The running loop.

        Raises:
            CommissioningError: if the bench is closed.
        """
        if self._loop is None:
            raise CommissioningError(sentence("the bench is closed; open it first"))
        return self._loop

    @property
    def record(self) -> DeviceRecord:
        """Return what is known of the device.

        Raises:
            CommissioningError: if the bench was never opened.
        """
        if self._record is None:
            raise CommissioningError(sentence("the bench was not opened; open it first"))
        return self._record

    def clearance(self) -> ForceClearance:
        """Return how much force the device is cleared for now."""
        return self.record.readiness().clearance(self.info, self.profile)

    def done(self, *steps: RoutineName) -> bool:
        """Return whether any of some routines has succeeded in this power cycle."""
        entry = self.record.newest(*steps)
        return entry is not None and entry.boot == self.info.boot

    # --- routines ---------------------------------------------------------------------------------
    def routine(self, step: RoutineName, by_hand: bool = True) -> Routine:
        """Make a routine on the running loop.

        Args:
            step: which.
            by_hand: whether the sign check has the links turned by hand.

        Raises:
            CommissioningError: if the routines that it builds on were not done in this power cycle.
        """
        if step in NEEDS_HOMING and not self.done(RoutineName.HOMING, RoutineName.OFFSETS):
            raise CommissioningError(
                sentence(
                    "{step} needs the device to be homed since it was switched on; run"
                    " `--step homing` first",
                    step=step.value,
                )
            )
        if step in NEEDS_SIGNS and not self.done(RoutineName.SIGNS):
            raise CommissioningError(
                sentence(
                    "{step} pushes, so the signs must be checked since the device was switched"
                    " on; run `--step signs` first",
                    step=step.value,
                )
            )
        return self._make(step, by_hand)

    def _make(self, step: RoutineName, by_hand: bool) -> Routine:
        loop, profile = self.loop, self.profile
        match step:
            case RoutineName.HOMING:
                return HomingRoutine(loop, profile, self.corrections, self._zero)
            case RoutineName.OFFSETS:
                return JigHomingRoutine(loop, profile, self.corrections, self._zero)
            case RoutineName.SIGNS:
                return SignRoutine(loop, profile, by_hand)
            case RoutineName.FRICTION:
                return FrictionRoutine(loop, profile)
            case RoutineName.LATENCY:
                return LatencyRoutine(loop, profile)
            case RoutineName.FORCE:
                return ForceScaleRoutine(loop, profile)
            case RoutineName.GAUGE:
                return GaugeRoutine(loop, profile, self.corrections)

    def keep(self, result: AnyResult) -> Path:
        """Put a result into the device's record and use it; returns the file.

        Raises:
            RecordError: if the file cannot be written; the record stays as it was.
        """
        return self._store(self.record.added(result, self.info.boot, self._today()))

    def undo(self, *steps: RoutineName) -> Path:
        """Take the newest result (of some routines, or of any) back; returns the file.

        Raises:
            RecordError: if there is none, or the file cannot be written.
        """
        return self._store(self.record.undo(*steps))

    def run(
        self,
        routine: Routine,
        answer: Callable[[RoutineReport], float | None],
        tell: Callable[[RoutineReport], None] = lambda _: None,
    ) -> RoutineReport:
        """Step a routine to its end; cancelled if `answer` or anything else raises.

        Args:
            routine: from `routine`.
            answer: called in each step while something is needed; returns the number (any for a
                confirmation), or None for not yet. It must not block: after a second without a
                step the loop drops the force.
            tell: called after each step.
        """
        try:
            while not (report := routine.step(self.clock.now())).done:
                tell(report)
                if report.needs and (value := answer(report)) is not None:
                    routine.answer(value)
                self.advance(PERIOD)
        except BaseException:
            routine.cancel()
            raise
        tell(report)
        return report

    def advance(self, duration: float) -> None:
        """Let time [s] pass."""
        if isinstance(self.clock, VirtualClock):
            self.loop.step(max(round(duration * self.loop.rate_hz), 1))
        else:
            self.clock.sleep(duration)

    # --- inside -----------------------------------------------------------------------------------
    def _store(self, record: DeviceRecord) -> Path:
        path = save_record(record, self._folder)
        self._record = record
        self.corrections.set_offsets(*record.offsets(self.info.boot))
        self.corrections.set_gauge(*record.gauge())
        return path

    def _zero(self) -> None:
        """Make the present pose the zero of the board's counters, where it can.

        An earlier homing of this power cycle measured from another zero: it is taken back first,
        so that its offsets and its clearance never meet the new one, however the routine ends.
        """
        zero = getattr(self._link, "home", None)
        if zero is None:
            return
        while self.done(RoutineName.HOMING, RoutineName.OFFSETS):
            self.undo(RoutineName.HOMING, RoutineName.OFFSETS)
        zero()
