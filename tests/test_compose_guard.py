"""The passivity guard in a shipped exercise: it is there, and nobody feels it."""

import numpy as np
import pytest

from app.compose.trainer import TrainerSetup, build_loop, device_of
from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import VirtualClock
from app.exercises.scene import placed_plan_of
from app.planning.plan import Plan
from tests.layered import layered

PLAN = Plan(np.array([0.0, -100.0, 0.0]), np.array([15.0, -35.0, 10.0]), "test")
FRAME = 33


def rows_of(exercise: str, dial: float, seconds: float = 12.0) -> FloatArray:
    chosen = layered(exercise)
    profile = device_of(chosen)
    placed = placed_plan_of(chosen, profile, PLAN)
    clock = VirtualClock(10.0)
    loop = build_loop(TrainerSetup(chosen, placed, skill="expert", seed=1, clock=clock), profile)
    path = placed.axis
    loop.inbox.write(assistance=dial, path_x=path[0], path_y=path[1], path_z=path[2])
    with loop:
        loop.inbox.write(enabled=1.0)
        for _ in range(round(seconds * profile.rate_hz / FRAME)):
            depth, now = loop.latest().row[sv.PLANT_DEPTH], clock.now()
            loop.inbox.write(heartbeat=now, tracked_depth=depth, tracked_time=now)
            loop.step(FRAME)
        return loop.rows()


@pytest.mark.parametrize(
    ("exercise", "dial"),
    [
        ("first-insertion", 1.0),
        ("thick-tissue", 1.0),
        ("thick-tissue", 0.0),
        ("thick-tissue", -1.0),
    ],
)
def test_nobody_feels_the_guard_in_a_shipped_exercise(exercise, dial):
    rows = rows_of(exercise, dial)
    assert not rows[:, sv.FAULT].any()
    assert rows[-1, sv.TRAINEE_PHASE] == 9.0
    assert rows[-1, sv.ENERGY_BOUND] > 0.5
    assert rows[:, sv.GUARD_SCALE].min() == 1.0
    assert rows[-1, sv.GUARD_LOSS] < 1e-3  # J, in 12 s
    speed = np.linalg.norm(rows[:, sv.QD], axis=1)
    assert (rows[:, sv.GUARD_DAMPING] * speed).max() < 0.02  # N·m, about 0.1 N at the hand


def test_the_energy_of_a_run_is_between_what_is_declared_and_what_the_hand_put_in():
    rows = rows_of("thick-tissue", 1.0)
    work = np.sum(
        rows[:-1, [sv.TORQUE_LEFT, sv.TORQUE_RIGHT]]
        * np.diff(rows[:, [sv.Q_LEFT, sv.Q_RIGHT]], axis=0),
    )
    assert rows[-1, sv.ENERGY_OUT] == pytest.approx(work, abs=1e-9)
    assert rows[:, sv.ENERGY_TANK].min() > 0.0
    assert (rows[:, sv.ENERGY_TANK] <= rows[:, sv.ENERGY_BOUND]).all()
