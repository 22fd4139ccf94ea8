"""A small record on disk, and what a damaged one of it may give."""

from datetime import UTC, datetime
from pathlib import Path

import numpy as np

from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.core.events import Event
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan
from app.session.facts import PLAN, plan_record
from app.session.header import Attachment, SessionHeader
from app.session.machine import State
from app.session.needle import DOWN, DepthSource, NeedlePose
from app.session.recorder import Recorder
from app.session.recording import Recording, read_recording
from app.session.sample import Sample

WALL = datetime(2026, 1, 15, 9, 31, 22, tzinfo=UTC)
PLACED = PlacedPlan.of(Plan(np.zeros(3), np.array([0.0, 60.0, 0.0])), Placement(), np.zeros(3))


def pose(time: float, depth: float, valid: bool = True) -> NeedlePose:
    return NeedlePose(
        p_tip=np.array([0.0, 0.0, -depth]),
        axis=DOWN,
        depth=depth,
        time=time,
        orientation_age=0.0,
        depth_age=0.0,
        depth_source=DepthSource.TRACKED if valid else DepthSource.NONE,
        valid=valid,
        covariance=1e-8 * np.eye(3),
        reason="" if valid else "not a number",
    )


def write(folder: Path, seconds: float, name: str = "a", bad: float | None = None) -> Path:
    """A finished record of a needle that goes in at 10 mm/s."""
    clock = VirtualClock(50.0)
    rows: list[np.ndarray] = []
    header = SessionHeader(
        name,
        WALL,
        50.0,
        "s-1",
        "liver-01",
        metadata={PLAN: plan_record(PLACED)},
        attachments=(Attachment("exercise.json", "application/json", b'{"id": "liver-01"}'),),
    )

    def since(tick: int) -> np.ndarray:
        return np.array(rows[tick:]).reshape(-1, sv.SLOTS)

    recorder = Recorder(folder, header, since, clock=clock)
    recorder.open()
    for k in range(round(seconds * 50)):
        for _ in range(20):
            clock.sleep(0.001)
            state = sv.empty_state()
            state[sv.TIME], state[sv.TICK] = clock.now(), len(rows) + 1
            rows.append(state)
        depth = bad if bad is not None and k == 5 else 0.01 * (clock.now() - 50.0)
        seen = pose(clock.now(), depth)
        recorder.sample(Sample(clock.now(), State.INSERTING, seen, None, np.zeros(3)))
        if k % 25 == 0:
            recorder.event(Event(clock.now(), "scan", f"scan {k}", {"number": k}))
        recorder.drain()
    recorder.finish((Attachment("score.json", "application/json", b'{"total": 1.0}'),))
    return recorder.status().path


def read(folder: Path, data: bytes) -> Recording:
    path = folder / "cut.mcap"
    path.write_bytes(data)
    return read_recording(path)


def assert_prefix(part: Recording, full: Recording) -> None:
    """What a damaged record gives is exactly the beginning of what the whole one gives."""
    n, m = len(part.samples.time), len(part.inputs.values)
    for name in ("time", "depth", "tip", "axis", "state", "valid"):
        np.testing.assert_array_equal(getattr(part.samples, name), getattr(full.samples, name)[:n])
    np.testing.assert_array_equal(part.inputs.values, full.inputs.values[:m])
    assert part.events == full.events[: len(part.events)]
