"""A student at a simulated robot in virtual time: a pad for the hand, cameras late and noisy."""

from contextlib import suppress
from pathlib import Path
from unittest.mock import patch

import numpy as np

from app.compose.cameras import AttachedCameras, simulated_on
from app.compose.trainer import TrainerSetup, build_rig, device_of
from app.core import state_vector as sv
from app.core.clock import VirtualClock
from app.exercises.scene import placed_plan_of
from app.imaging.field.tissue_field import TissueField
from app.planning.plan import Plan
from app.session.errors import ControlLockedError
from app.session.machine import State
from app.session.pad.geometry import PadScale, downward, path_frame
from app.session.pad.hand import Handle, HandLimits, HandPose, PadHand
from app.session.trainer import Trainer
from app.session.withdrawal import Start
from app.tracking.fix import FixStatus, NeedleFix
from tests.layered import layered

PLAN = Plan(np.array([0.0, -100.0, 0.0]), np.array([15.0, -35.0, 10.0]), "test")
FRAME = 1.0 / 30.0
LATENCY = 0.04
PAD_RADIUS = 150.0
"""Of the pad on the screen [px]."""
INTENT = 10
"""Ticks between two wishes of the window: 100 Hz."""
LOOK = 20
"""Ticks between two looks of the trainer: 50 Hz, as in the program."""

_CAMERAS: dict[str, AttachedCameras] = {}


def _never_opened(rig, *rest):
    """Cameras of a rig, painted once: a student has eyes of its own, and nobody opens these."""
    if rig.name not in _CAMERAS:
        _CAMERAS[rig.name] = simulated_on(rig, *rest)
    return _CAMERAS[rig.name]


class Student:
    """A trainer in virtual time, cameras that see the marker late and with noise, and a pad."""

    def __init__(
        self,
        folder: Path,
        exercise: str = "first-insertion",
        skill: str | None = None,
        tissues: TissueField | None = None,
    ) -> None:
        chosen = layered(exercise)
        profile = device_of(chosen)
        placed = placed_plan_of(chosen, profile, PLAN if chosen.touch is None else None)
        self.clock = VirtualClock(10.0)
        setup = TrainerSetup(
            chosen, placed, skill=skill, sessions=folder, clock=self.clock, tissues=tissues
        )
        with patch("app.compose.trainer.simulated_on", _never_opened):
            self.rig = build_rig(setup)
        self._random = np.random.default_rng(5)
        self._seen = self._looked = 0.0
        self.blind = False
        context = self.rig.trainer._context
        self.trainer = Trainer(
            self.rig.loop, None, placed, chosen, context, self.clock, self._cameras,
            start=Start.SIMULATED,
        )  # fmt: skip
        scale = PadScale(placed.length, 5e-3)
        frame = path_frame(placed.axis, placed.T_world_patient.rotation)
        limits = HandLimits(profile.tilt_limit, *profile.depth_range)
        start = HandPose(np.array([0.0, 0.0, -1.0]), -0.015, True)
        handle = None if chosen.touch is None else Handle(profile.needle_length)
        self.hand = PadHand(frame, scale, limits, start, handle)
        self.rig.loop.open()
        self.trainer.step()

    def close(self) -> None:
        self.trainer.close()
        self.rig.loop.close()

    def _cameras(self, now: float) -> None:
        if self.blind or now - self._seen < FRAME:
            return
        self._seen = now
        rows = self.rig.loop.rows(self.rig.loop.latest().tick - 60)
        row = rows[int(np.argmin(np.abs(rows[:, sv.TIME] - (now - LATENCY))))]
        depth = row[sv.PLANT_DEPTH] + self._random.normal(0.0, 1e-4)
        axis = row[sv.AXIS].copy()
        tip = self.rig.profile.fulcrum + depth * axis
        pixels = (np.zeros(2), np.zeros(2))
        fix = NeedleFix(tip, 1e-8 * np.eye(3), row[sv.TIME], FixStatus.VALID, pixels, 0.1)
        self.trainer.on_fix(fix)

    def wish(self, milliseconds: int = INTENT) -> None:
        """Pass on where the hand is wanted; let time pass. A needle that is being brought out
        takes the hand with it, as it takes the window's; in a pause both stand."""
        if self.trainer.snapshot().state in (State.WITHDRAWING, State.PAUSED):
            row = self.rig.loop.latest().row
            direction = downward(row[sv.HAND_X], row[sv.HAND_Y])
            self.hand.follow(direction, float(row[sv.HAND_DEPTH]))
        x, y, _ = self.hand.pose.direction
        self.trainer.hand(float(x), float(y), self.hand.pose.depth, self.hand.pose.holds)
        self.trainer.heartbeat()
        self._pass(milliseconds)

    def _pass(self, milliseconds: int) -> None:
        """Let the loop and the cameras go on, and the trainer look when it is time."""
        self.rig.loop.step(milliseconds)
        now = self.clock.now()
        self._cameras(now)
        if now - self._looked >= 1e-3 * LOOK - 1e-9:
            self._looked = now
            self.trainer.tick(now)

    def busy(self, milliseconds: int) -> None:
        """Let time pass in which the window gives no sign of life."""
        for _ in range(max(1, milliseconds // INTENT)):
            self._pass(INTENT)

    def pause(self, milliseconds: int) -> None:
        """Wish nothing else for a while."""
        for _ in range(max(1, milliseconds // INTENT)):
            self.wish()

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
                with suppress(ControlLockedError):  # the exercise keeps it
                    self.trainer.assistance(float(np.sin(amount[0])))
            self.wish()

    @property
    def fault(self) -> int:
        return int(self.rig.loop.latest().row[sv.FAULT])
