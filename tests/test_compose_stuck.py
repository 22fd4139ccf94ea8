"""A force law that does not return, in a whole running trainer: named, ended, saved."""

import time

import numpy as np
import pytest

from app.compose import trainer as composed
from app.compose.trainer import TrainerSetup, build_loop, device_of
from app.core import state_vector as sv
from app.core.compiled import stage
from app.device.control.kernel import fence
from app.exercises.scene import placed_plan_of
from app.planning.plan import Plan
from app.session.context import RunContext
from app.session.machine import State
from app.session.recording import read_recording
from app.session.trainer import Trainer
from tests.layered import layered

PLAN = Plan(np.array([0.0, -100.0, 0.0]), np.array([15.0, -35.0, 10.0]), "test")


@stage
def sticks(state, p):
    """Never return once p[0] is set, until p[1] is."""
    while p[0] != 0.0 and p[1] == 0.0:
        fence()


def _until(done, patience=60.0):
    end = time.monotonic() + patience
    while not done():
        assert time.monotonic() < end
        time.sleep(0.01)


@pytest.fixture
def sticky(monkeypatch):
    """Parameters of a law that is among the exercise's."""
    p, own = np.zeros(2), composed.laws.stages_of
    monkeypatch.setattr(
        composed.laws, "stages_of", lambda *given: [*own(*given), ("sticky", sticks, p)]
    )
    yield p
    p[1] = 1.0


def test_the_window_is_told_which_law_and_the_attempt_is_saved(sticky, tmp_path):
    exercise = layered("first-insertion")
    profile = device_of(exercise)
    placed = placed_plan_of(exercise, profile, PLAN)
    loop = build_loop(TrainerSetup(exercise, placed), profile)
    trainer = Trainer(loop, None, placed, exercise, RunContext(folder=tmp_path))
    trainer.open()
    try:
        _until(lambda: loop.latest().tick > 50)
        trainer.begin("tester")
        _until(lambda: loop.latest().row[sv.ENABLED] > 0.5)
        sticky[0] = 1.0
        _until(lambda: trainer.snapshot().state is State.ABORTED)
        said = trainer.snapshot().messages
        assert any("force law or effect 'sticky' does not return" in line for line in said)
        _until(lambda: trainer.result is not None)
        assert trainer.result.record is not None
        recording = read_recording(trainer.result.record)
        assert recording.complete
        assert any("'sticky'" in event.message for event in recording.events)

    finally:
        began = time.monotonic()
        trainer.close()
    assert time.monotonic() - began < 4.5  # five seconds would be a thread that is waited for
