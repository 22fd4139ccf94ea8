"""A drill with the whole trainer in virtual time: begun on the path, played, replayed, verified."""

from pathlib import Path

import numpy as np
import pytest

from app.compose.cameras import AttachedCameras
from app.compose.recomputed import replay_recording
from app.compose.trainer import (
    TrainerSetup,
    _context,
    beginnings_of,
    build_loop,
    device_of,
)
from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.exercises.drill import DrillKind
from app.exercises.drilled import drilled
from app.exercises.scene import placed_plan_of
from app.planning.plan import Plan
from app.session.ct_facts import CtFacts
from app.session.machine import State
from app.session.recording import read_recording
from app.session.review import review
from app.session.trainer import Trainer
from app.session.verify import verify
from app.session.withdrawal import Start
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.optics.rig import load_rig
from tests.layered import layered

PLAN = Plan(np.array([0.0, -100.0, 0.0]), np.array([15.0, -35.0, 10.0]), "test")
SPEED = 20e-3
"""At which the script pushes [m/s]."""


def played(folder: Path):
    """Play "depth only": wait for the start, push along the path, stop at the target, end."""
    whole, clock = layered("first-insertion"), VirtualClock(50.0)
    profile = device_of(whole)
    drill = drilled(whole, DrillKind.DEPTH, placed_plan_of(whole, profile, PLAN))
    placed = placed_plan_of(drill, profile, PLAN)
    setup = TrainerSetup(drill, placed, CtFacts("ct-1"), None, 3, folder, clock)
    loop = build_loop(setup, profile)

    def measure(now: float) -> None:
        state = loop.latest()
        tip = profile.fulcrum + state.row[sv.PLANT_DEPTH] * state.axis
        pixels = (np.zeros(2), np.zeros(2))
        trainer.on_fix(NeedleFix(tip, 1e-9 * np.eye(3), now, FixStatus.VALID, pixels, 0.0))

    context = _context(setup, profile, AttachedCameras((), load_rig(drill.rig), {}), None)
    trainer = Trainer(
        loop, None, placed, drill, context, clock, measure,
        start=Start.SIMULATED, beginnings=beginnings_of(setup, profile),
    )  # fmt: skip
    loop.open()
    trainer.heartbeat()
    trainer.step(300)
    trainer.begin("tester", "mouse")
    for _ in range(1000):
        trainer.heartbeat()
        if trainer.step().ready:
            break
    row = loop.latest().row
    x, y, depth = (float(row[slot]) for slot in (sv.HAND_X, sv.HAND_Y, sv.HAND_DEPTH))
    for _ in range(500):
        depth = min(depth + 0.02 * SPEED, placed.length)
        trainer.hand(x, y, depth, True)
        trainer.heartbeat()
        snapshot = trainer.step()
        if snapshot.state is State.HOLDING and snapshot.phases[State.HOLDING] > 1.0:
            break
    result = trainer.end()
    trainer.close()
    loop.close()
    return result, placed


@pytest.mark.long("journey")
def test_a_depth_drill_begins_on_the_path_is_replayed_to_the_bit_and_its_score_verified(tmp_path):
    result, placed = played(tmp_path)
    recording = read_recording(result.record)
    assert recording.metadata["conditions"]["drill"] == "depth"
    report = replay_recording(recording)
    assert report.identical
    assert report.every_slot
    checked = verify(recording)
    assert checked.changes == ()
    score = checked.standing
    assert [row.name for row in score.rows if row.weight > 0.0] == ["depth_error"]
    assert score.total == pytest.approx(result.score.total)
    assert score.passed
    inside = np.flatnonzero(recording.samples.state == "inserting")[0]
    assert recording.samples.axis[inside] @ placed.axis > np.cos(np.radians(3.0))
    shown = review(recording)
    assert (shown.drill.kind, shown.drill.of) == (DrillKind.DEPTH, "first-insertion")
    assert result.trajectory.seen_from == recording.trajectory().seen_from < np.inf
