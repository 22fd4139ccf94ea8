"""Small fakes of the parts that a trainer is composed of, all on one virtual clock."""

from dataclasses import dataclass, field
from datetime import UTC, datetime
from pathlib import Path
from types import SimpleNamespace
from typing import Any

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import VirtualClock
from app.core.events import EventQueue
from app.core.latest import Latest
from app.device.checkpoint import Checkpoint
from app.device.state import DeviceState
from app.exercises.guidance import GuidancePart
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan
from app.scoring.defaults import DEFAULT_TOLERANCES
from app.scoring.rows import ScoreRules
from app.session.context import RunContext
from app.session.header import Attachment
from app.session.trainer import Trainer
from app.tracking.discrepancy import Discrepancy

FULCRUM = np.array([0.0, 0.16056, 0.090])
WALL = datetime(2026, 1, 15, 9, 31, 22, 418000, tzinfo=UTC)
EXERCISE = SimpleNamespace(
    effects={},
    drill=None,
    is_own_plan=False,
    asks_lung_path=False,
    bands={},
    bands_for=lambda hand: None,
    tolerances_for=lambda hand: DEFAULT_TOLERANCES,
    id="liver-01",
    title="Liver, first insertion",
    version=1,
    assistance=0.5,
    locked=frozenset(),
    tolerances=DEFAULT_TOLERANCES,
    rules=ScoreRules(),
    guidance=GuidancePart(),
    longest_hold=None,
    procedure=None,
    touch_task=lambda placed: None,
)


def placed_plan(length_mm: float = 60.0) -> PlacedPlan:
    """A path straight down."""
    plan = Plan(
        np.array([-12.5, -98.0, 310.2]), np.array([-12.5, -98.0 + length_mm, 310.2]), "Plan"
    )
    return PlacedPlan.of(plan, Placement(), FULCRUM)


def row(
    time: float,
    tick: int,
    axis: Any = (0.0, 0.0, -1.0),
    depth: float = 0.0,
    **slots: float,
) -> FloatArray:
    """A state vector whose needle passes through the fulcrum."""
    state = sv.empty_state()
    axis = np.asarray(axis, dtype=np.float64)
    state[sv.TIME] = state[sv.Q_TIME] = time
    state[sv.TICK] = tick
    state[sv.DT] = 0.001
    state[sv.AXIS] = axis
    state[sv.DEPTH] = depth
    state[sv.DEPTH_LEAST], state[sv.DEPTH_MOST] = -0.03, 0.12
    state[sv.TIP] = FULCRUM + depth * axis
    state[sv.HUB] = FULCRUM - (0.2 - depth) * axis
    state[sv.LIMIT_SCALE] = state[sv.SAFETY_SCALE] = 1.0
    for name, value in slots.items():
        state[sv.INDEX[name]] = value
    return state


class FakeInbox:
    def __init__(self) -> None:
        self.values: dict[str, float] = {}
        self.writes: list[dict[str, float]] = []

    def write(self, **inputs: float) -> None:
        self.writes.append(inputs)
        self.values.update(inputs)


@dataclass
class FakeLoop:
    """The needle is wherever the hand wants it; `ring` rows are kept."""

    clock: VirtualClock
    ring: int = 4096
    inbox: FakeInbox = field(default_factory=FakeInbox)
    extra: dict[str, float] = field(default_factory=dict)
    opened: int = 0
    history: list[FloatArray] = field(default_factory=list)
    frozen: bool = False
    tick: int = 0

    def open(self) -> None:
        self.opened += 1

    def close(self) -> None:
        self.opened = 0

    def step(self, n: int = 1) -> None:
        state = self._state()
        for _ in range(n):
            self.clock.sleep(0.001)
            if not self.frozen:
                self.tick += 1
                state = state.copy()
                state[sv.TIME], state[sv.TICK] = self.clock.now(), self.tick
                if "q_time" not in self.extra:
                    state[sv.Q_TIME] = state[sv.TIME]
                self.history.append(state)
        del self.history[: -self.ring]

    def _state(self) -> FloatArray:
        """Where the hand wants the needle now, as the next ticks have it."""
        values = self.inbox.values
        x, y = values.get("hand_x", 0.0), values.get("hand_y", 0.0)
        axis = np.array([x, y, -np.sqrt(1.0 - x * x - y * y)])
        state = row(0.0, 0, axis, values.get("hand_depth", -0.02))
        for name, value in (values | self.extra).items():
            state[sv.INDEX[name]] = value
        return state

    def latest(self) -> DeviceState:
        return DeviceState.from_row(self.history[-1] if self.history else sv.empty_state())

    def rows(self, since_tick: int) -> FloatArray:
        newer = self.tick - since_tick  # no tick is left out
        kept = self.history[-newer:] if newer > 0 else []
        return np.array(kept).reshape(len(kept), sv.SLOTS)

    def checkpoint(self) -> Checkpoint:
        return Checkpoint.of(self.history[-1] if self.history else sv.empty_state(), [])

    def timing(self) -> str:
        return "on time"


@dataclass(frozen=True)
class FakeFix:
    p_tip_world: FloatArray
    time: float
    status: str = "valid"
    covariance: FloatArray = field(default_factory=lambda: np.eye(3) * 1e-8)
    residual_px: float = 0.2
    has_point: bool = False
    line_variance: float | None = None
    axis: FloatArray | None = None
    discrepancy: Discrepancy = field(default_factory=Discrepancy)

    @property
    def usable(self) -> bool:
        return self.status == "valid" or (self.status == "one_camera" and self.has_point)


@dataclass
class FakeTracker:
    """Sees the true tip at 30 Hz unless `status` says otherwise."""

    loop: FakeLoop
    status: str = "valid"
    latest: Latest[FakeFix] = field(default_factory=Latest)
    events: EventQueue = field(default_factory=EventQueue)
    opened: int = 0
    seen: float = -1.0
    every: float = 1.0 / 30.0
    late: float = 0.0

    def open(self) -> None:
        self.opened += 1

    def close(self) -> None:
        self.opened = 0

    def statistics(self) -> dict[str, float]:
        return {"rate_hz": 30.0}

    def advance(self, now: float) -> None:
        if now - self.seen >= self.every - 1e-9:
            self.seen = now
            fix = FakeFix(self.loop.latest().tip, now - self.late, self.status)
            self.latest.publish(fix, now)


@dataclass
class Bench:
    """A whole trainer on fakes."""

    folder: Path
    clock: VirtualClock = field(default_factory=lambda: VirtualClock(100.0))
    placed: PlacedPlan = field(default_factory=placed_plan)
    drill: Any = None
    simulated: bool = False

    def __post_init__(self) -> None:
        self.loop = FakeLoop(self.clock)
        self.tracker = FakeTracker(self.loop)
        counter = iter(range(1, 1000))
        self.context = RunContext(
            folder=self.folder,
            seed=7,
            metadata={"device": {"profile": "icube"}},
            attachments=(Attachment("plan.mrk.json", "application/json", b"{}"),),
            wall=lambda: WALL,
            identify=lambda wall: f"{wall:%Y%m%d-%H%M%S}-{next(counter):04d}",
        )
        self.trainer = Trainer(
            self.loop,
            self.tracker,
            self.placed,
            SimpleNamespace(**vars(EXERCISE) | {"drill": self.drill}),
            self.context,
            clock=self.clock,
            advance=self.tracker.advance,
            simulated=self.simulated,
        )

    def run(
        self, seconds: float, depth: float | None = None, x: float = 0.0, y: float = 0.0
    ) -> Any:
        """Let time pass; the hand moves to `depth` [m] at a steady speed meanwhile."""
        steps = max(1, round(seconds / 0.02))
        start = self.loop.inbox.values.get("hand_depth", -0.02)
        end = start if depth is None else depth
        snapshot = None
        for k in range(1, steps + 1):
            self.trainer.hand(x, y, start + (end - start) * k / steps, True)
            snapshot = self.trainer.step(20)
        return snapshot

    def insertion(self, depth: float = 0.06, x: float = 0.0, y: float = 0.0) -> None:
        """Align, insert to `depth` [m], hold for two seconds."""
        self.run(0.5, -0.02, x, y)
        self.run(3.0, depth, x, y)
        self.run(2.0, depth, x, y)
