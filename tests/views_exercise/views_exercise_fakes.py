"""A trainer that does what it is told, for tests of the widgets around it."""

from dataclasses import dataclass, field, replace
from pathlib import Path
from time import monotonic
from types import MappingProxyType, SimpleNamespace
from typing import Any

import numpy as np
from views_exercise_attempts import placed_plan

from app.core.arrays import FloatArray
from app.core.events import Event, EventQueue
from app.core.state_vector import INDEX, empty_state
from app.exercises.guidance import ScanChoice
from app.imaging.scan_order import ScanOrder
from app.mechanisms.profile import load_profile
from app.planning.placement import PlacedPlan
from app.session.curves import offset
from app.session.errors import IllegalTransitionError
from app.session.machine import State
from app.session.needle import DepthSource, NeedlePose
from app.session.recorder import RecordingStatus
from app.session.snapshot import Snapshot
from app.tracking.fix import FixStatus
from app.tracking.statistics import TrackerStatistics
from app.views.exercise.run import ExerciseRun


def pose(placed: PlacedPlan, tilt: float = 0.05, depth: float = 0.04, **changes: Any) -> NeedlePose:
    """A needle that leans by `tilt` [rad] off the path."""
    side = np.cross(placed.axis, [0.0, 1.0, 0.0])
    axis = np.cos(tilt) * placed.axis + np.sin(tilt) * side / np.linalg.norm(side)
    values: dict[str, Any] = {
        "p_tip": placed.p_entry + depth * axis, "axis": axis, "depth": depth, "time": 1.0,
        "orientation_age": 0.001, "depth_age": 0.03, "depth_source": DepthSource.TRACKED,
        "valid": True, "covariance": 1e-9 * np.eye(3), "reason": "",
    }  # fmt: skip
    return NeedlePose(**(values | changes))


def statistics(**changes: Any) -> TrackerStatistics:
    """A tracker that sees the marker."""
    values: dict[str, Any] = {
        "rate": 30.0, "valid_share": 0.98, "latency": 0.04, "age": 0.03,
        "status": FixStatus.VALID, "reason": "", "residual_px": 0.3, "missing": (),
    }  # fmt: skip
    return TrackerStatistics(**(values | changes))


def row(**slots: float) -> FloatArray:
    """A state vector of zeros but for these slots, by lower-case name."""
    values = empty_state()
    for name, value in slots.items():
        values[INDEX[name]] = value
    return values


def snapshot(placed: PlacedPlan | None = None, **changes: Any) -> Snapshot:
    """Everything is well."""
    placed = placed or placed_plan()
    where = changes.pop("pose", None) or pose(placed)
    device = SimpleNamespace(
        tick=5000, hub=where.p_tip - 0.2 * where.axis, felt=np.array([1.0, 2.0, 2.0]), fault=0,
        q=np.zeros(2), qd=np.zeros(2), torque=np.zeros(2), row=row(**changes.pop("slots", {})),
    )  # fmt: skip
    values: dict[str, Any] = {
        "time": 1.0, "state": State.READY, "reason": "", "elapsed": 0.0,
        "phases": MappingProxyType({}), "pose": where,
        "offset": offset(where, placed.p_target, placed), "p_target": placed.p_target,
        "device": device, "tracker": statistics(),
        "timing": SimpleNamespace(
            median=8e-5, p99=2e-4, missed=2, ticks=5000, cost=8e-5, rate_hz=1000.0
        ),
        "fix_status": "valid", "scans": 0, "assistance": 1.0, "armed": False,
        "recording": RecordingStatus(Path("a.mcap"), True, "", 10, 0, 0), "messages": (),
    }  # fmt: skip
    return Snapshot(**(values | changes))


@dataclass
class FakeTrainer:
    """Keeps what it was told in `calls`."""

    placed: PlacedPlan = field(default_factory=placed_plan)
    events: EventQueue = field(default_factory=EventQueue)
    result: Any = None
    calls: list[tuple[Any, ...]] = field(default_factory=list)
    now: Snapshot = field(default_factory=snapshot)

    def begin(self, student: str = "", hand: str = "") -> str:
        if self.now.state is not State.READY:
            raise IllegalTransitionError("'begin' is not possible while aligning")
        self.calls.append(("begin", student, hand))
        self.now = replace(self.now, state=State.ALIGNING)
        self.events.put(Event(1.0, "state", "aligning"))
        return "20261121-101500-ab12"

    def confirm_outside(self) -> None:
        self.calls.append(("confirm_outside",))

    def end(self) -> Any:
        self.calls.append(("end",))
        self.now = replace(self.now, state=State.ENDED)
        self.result = SimpleNamespace(state=State.ENDED)
        return self.result

    def abort(self, reason: str = "aborted by the user") -> Any:
        self.calls.append(("abort",))
        self.now = replace(self.now, state=State.ABORTED)
        self.result = SimpleNamespace(state=State.ABORTED)
        return self.result

    def scan(self, order: ScanOrder | None = None, choice: ScanChoice | None = None) -> int:
        chosen = () if choice in (None, ScanChoice()) else (choice,)
        self.calls.append(("scan",) if order is None else ("scan", order, *chosen))
        return 1

    def mark_entry(self, mark: object) -> None:
        self.calls.append(("mark_entry", mark))

    def arm(self) -> None:
        self.calls.append(("arm",))

    def disarm(self) -> None:
        self.calls.append(("disarm",))

    def hand(self, x: float, y: float, depth: float, holds: bool = True) -> None:
        self.calls.append(("hand", x, y, depth, holds))

    def assistance(self, value: float) -> None:
        self.calls.append(("assistance", value))

    def heartbeat(self) -> None:
        self.calls.append(("heartbeat",))

    paced: float | None = None
    """Its time where it waits for whoever leads; None where time goes on by itself."""

    @property
    def time(self) -> float:
        return monotonic() if self.paced is None else self.paced

    def lead(self, within: float) -> float | None:
        self.calls.append(("lead", within))
        return None if self.paced is None else 0.016

    def snapshot(self) -> Snapshot:
        return self.now

    def told(self, name: str) -> list[tuple[Any, ...]]:
        """Calls of one name."""
        return [call for call in self.calls if call[0] == name]


def run(trainer: FakeTrainer | None = None, **changes: Any) -> ExerciseRun:
    """A run of the fake trainer on the shipped device."""
    trainer = trainer or FakeTrainer()
    return ExerciseRun(trainer, trainer.placed, load_profile("icube"), **changes)
