"""No movement of mouse, wheel, keys, pen or gamepad voids an attempt on a simulated robot."""

from pathlib import Path

import numpy as np
import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from app.compose.trainer import TrainerSetup, build_rig, device_of
from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.device.faults import Fault
from app.exercises.library import load_exercise
from app.exercises.scene import placed_plan_of
from app.planning.plan import Plan
from app.session.machine import State
from app.session.trainer import Trainer
from app.tracking.fix import FixStatus, NeedleFix
from app.views.exercise.hand import Hand, HandLimits, HandPose
from app.views.exercise.pad_geometry import PadScale, path_frame

PLAN = Plan(np.array([0.0, -100.0, 0.0]), np.array([15.0, -35.0, 10.0]), "test")
FRAME = 1.0 / 30.0
LATENCY = 0.04
PAD_RADIUS = 150.0
"""Of the pad on the screen [px]."""
INTENT = 10
"""Ticks between two wishes of the window: 100 Hz."""


class Student:
    """A trainer in virtual time, cameras that see the marker late and with noise, and a pad."""

    def __init__(
        self, folder: Path, exercise: str = "first-insertion", skill: str | None = None
    ) -> None:
        chosen = load_exercise(exercise)
        profile = device_of(chosen)
        placed = placed_plan_of(chosen, profile, PLAN)
        self.clock = VirtualClock(10.0)
        setup = TrainerSetup(chosen, placed, skill=skill, sessions=folder, clock=self.clock)
        self.rig = build_rig(setup)
        self._random = np.random.default_rng(5)
        self._seen = 0.0
        context = self.rig.trainer._context
        self.trainer = Trainer(
            self.rig.loop, None, placed, chosen, context, self.clock, self._cameras
        )
        scale = PadScale(placed.length, 5e-3)
        frame = path_frame(placed.axis, placed.T_world_patient.rotation)
        limits = HandLimits(profile.tilt_limit, *profile.depth_range)
        start = HandPose(np.array([0.0, 0.0, -1.0]), -0.015, True)
        self.hand = Hand(frame, scale, limits, start)
        self.rig.loop.open()
        self.trainer.step()

    def close(self) -> None:
        self.trainer.close()
        self.rig.loop.close()

    def _cameras(self, now: float) -> None:
        if now - self._seen < FRAME:
            return
        self._seen = now
        rows = self.rig.loop.rows(self.rig.loop.latest().tick - 60)
        row = rows[int(np.argmin(np.abs(rows[:, sv.TIME] - (now - LATENCY))))]
        depth = row[sv.PLANT_DEPTH] + self._random.normal(0.0, 1e-4)
        axis = row[sv.AXIS].copy()
        tip = self.rig.profile.pantograph.fulcrum + depth * axis
        pixels = (np.zeros(2), np.zeros(2))
        fix = NeedleFix(tip, 1e-8 * np.eye(3), row[sv.TIME], FixStatus.VALID, pixels, 0.1)
        self.trainer.on_fix(fix)

    def wish(self, milliseconds: int = INTENT) -> None:
        """Pass on where the hand is wanted; let time pass."""
        x, y, _ = self.hand.pose.direction
        self.trainer.hand(float(x), float(y), self.hand.pose.depth, self.hand.pose.holds)
        self.trainer.step(milliseconds)

    def do(self, kind: str, amount: tuple[float, float], milliseconds: int) -> None:
        """Drag by pixels, roll the wheel by notches of 1 mm, press keys, lean a pen, push sticks:
        `amount` over a time."""
        steps = max(1, milliseconds // INTENT)
        a, b = amount[0] / steps, amount[1] / steps
        for _ in range(steps):
            if kind == "drag":
                self.hand.drag((a / PAD_RADIUS, b / PAD_RADIUS))
            elif kind == "wheel":
                self.hand.advance(1e-3 * a)
            elif kind == "tilt":
                self.hand.tilt(np.deg2rad(a), np.deg2rad(b))
            elif kind == "dial":
                self.trainer.assistance(float(np.sin(amount[0])))
            self.wish()

    @property
    def fault(self) -> int:
        return int(self.rig.loop.latest().row[sv.FAULT])


MOVE = st.one_of(
    st.tuples(
        st.just("drag"),
        st.tuples(st.floats(-2000.0, 2000.0), st.floats(-2000.0, 2000.0)),
        st.sampled_from([10, 50, 200, 700, 1500]),
    ),
    st.tuples(
        st.just("wheel"),
        st.tuples(st.floats(-150.0, 150.0), st.just(0.0)),
        st.sampled_from([10, 50, 300, 1000]),
    ),
    st.tuples(
        st.just("tilt"),
        st.tuples(st.floats(-60.0, 60.0), st.floats(-60.0, 60.0)),
        st.sampled_from([10, 50, 300, 1000]),
    ),
    st.tuples(
        st.just("dial"), st.tuples(st.floats(-2.0, 2.0), st.just(0.0)), st.sampled_from([10, 500])
    ),
)


@pytest.mark.parametrize("exercise", ["first-insertion", "against-repulsion", "thick-tissue"])
@settings(
    max_examples=12, deadline=None, suppress_health_check=[HealthCheck.function_scoped_fixture]
)
@given(moves=st.lists(MOVE, min_size=1, max_size=12))
def test_no_movement_voids_an_attempt(
    tmp_path: Path, exercise: str, moves: list[tuple[str, tuple[float, float], int]]
) -> None:
    student = Student(tmp_path, exercise)
    try:
        student.do("wheel", (0.0, 0.0), 200)
        student.trainer.begin()
        student.do("wheel", (0.0, 0.0), 1200)  # the force has come up
        for kind, amount, milliseconds in moves:
            student.do(kind, amount, milliseconds)
        student.do("wheel", (0.0, 0.0), 800)
        snapshot = student.trainer.snapshot()
        assert snapshot.state is not State.ABORTED, snapshot.reason
        assert student.fault == Fault.NONE
    finally:
        student.close()


@pytest.mark.parametrize("dial", [1.0, 0.5, 0.0, -1.0])
@pytest.mark.parametrize(
    "moves",
    [
        [("drag", (100.0, 0.0), 700)],
        [("drag", (2000.0, 0.0), 50)],
        [("drag", (2000.0 * (-1) ** k, 700.0 * (-1) ** (k // 2)), 50) for k in range(30)],
        [("drag", (300.0 * (-1) ** k, 0.0), 200) for k in range(20)],
        [("tilt", (40.0, 0.0), 500), ("tilt", (-60.0, 0.0), 100), ("tilt", (0.0, 60.0), 100)],
        [("wheel", (100.0, 0.0), 50), ("drag", (400.0, 0.0), 50), ("wheel", (-130.0, 0.0), 50)] * 3,
    ],
    ids=["slow", "wild", "alternating", "shaking", "keys", "in and out"],
)
def test_a_wild_mouse_voids_nothing(
    tmp_path: Path, dial: float, moves: list[tuple[str, tuple[float, float], int]]
) -> None:
    student = Student(tmp_path)
    try:
        student.trainer.begin()
        student.trainer.assistance(dial)
        student.do("wheel", (0.0, 0.0), 1200)
        for kind, amount, milliseconds in moves:
            student.do(kind, amount, milliseconds)
        student.do("wheel", (0.0, 0.0), 500)
        snapshot = student.trainer.snapshot()
        assert snapshot.state is not State.ABORTED, snapshot.reason
    finally:
        student.close()
