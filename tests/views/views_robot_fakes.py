"""A robot on the bench that finds what it is told to find."""

from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path

from app.core.clock import VirtualClock
from app.device.commissioning.records import DeviceRecord
from app.device.commissioning.results import (
    AnyResult,
    ForceScale,
    Friction,
    Gauge,
    Homing,
    JointFriction,
    RobotLatency,
    RoutineName,
    RoutineReport,
    Signs,
)
from app.device.errors import CommissioningError
from app.device.links.link import BoardInfo
from app.mechanisms.profile import load_profile

BOARD = BoardInfo("icube", "A17-0042", "1.2.0", "1", 7)
JOINT = JointFriction(
    breakaway=0.005, breakaway_spread=0.0004, coulomb=0.004, viscous=0.002, residual=0.0003
)
RESULTS: dict[RoutineName, AnyResult] = {
    RoutineName.HOMING: Homing(offsets=(3.4, -0.19), change=(0.01, -0.02)),
    RoutineName.SIGNS: Signs(response=((0.02, 0.001), (0.001, 0.02)), by_hand=True),
    RoutineName.FORCE: ForceScale(
        commanded=(0.2, 0.5, 1.0), readings_g=(20.6, 51.0, 102.4), factor=1.005, residual=0.004,
        profile="icube",
    ),
    RoutineName.LATENCY: RobotLatency(
        round_trip=(0.0007, 0.0012, 0.004), lost=0.0, dead_time=0.0021, dead_time_spread=0.0003
    ),
    RoutineName.FRICTION: Friction(left=JOINT, right=JOINT),
    RoutineName.GAUGE: Gauge(zero=0.02, scale=1.01, residual=0.003, weights_g=(50.0, 100.0)),
}  # fmt: skip


class FakeRoutine:
    """Asks once (for grams, if it weighs), then ends; keeps what it was told."""

    def __init__(self, step: RoutineName, failure: str = "") -> None:
        self.name, self.failure = step, failure
        self.cancelled, self.answers, self.steps = 0, [], 0
        unit = "g" if step is RoutineName.FORCE else ""
        self.question = RoutineReport(
            0.4, "pushing with 0.5 N" if unit else "measuring; keep it there",
            needs="type the reading at 0.5 N" if unit else
            "bring both links to the stops and confirm", unit=unit,
        )  # fmt: skip

    def step(self, now: float) -> RoutineReport:
        self.steps += 1
        if not self.answers:
            return self.question
        if self.failure:
            return RoutineReport(0.4, "failed", done=True, failure=self.failure)
        return RoutineReport(1.0, "done", done=True, result=RESULTS[self.name])

    def answer(self, value: float | None = None) -> None:
        if self.question.unit and (value is None or value <= 0.0):
            raise CommissioningError(f"{value} is not a number of grams; type the reading in g")
        self.answers.append(value)

    def cancel(self) -> None:
        self.cancelled += 1


@dataclass
class FakeBench:
    info: BoardInfo = BOARD
    clock: VirtualClock = field(default_factory=lambda: VirtualClock(5.0))
    record: DeviceRecord = field(default_factory=lambda: DeviceRecord(device="A17-0042"))
    failure: str = ""
    routines: list[FakeRoutine] = field(default_factory=list)
    closed: int = 0

    def __post_init__(self) -> None:
        self.profile = load_profile("icube")

    def clearance(self):
        return self.record.readiness().clearance(self.info, self.profile)

    def done(self, *steps):
        entry = self.record.newest(*steps)
        return entry is not None and entry.boot == self.info.boot

    def routine(self, step):
        if step is RoutineName.FORCE and not self.done(RoutineName.SIGNS):
            raise CommissioningError("force needs the signs to be checked first")
        self.routines.append(FakeRoutine(step, self.failure))
        return self.routines[-1]

    def keep(self, result):
        when = datetime(2026, 11, 21, 10, 15, tzinfo=UTC)
        self.record = self.record.added(result, self.info.boot, when)
        return Path("a.yaml")

    def undo(self, *steps):
        self.record = self.record.undo(*steps)
        return Path("a.yaml")

    def close(self):
        self.closed += 1
