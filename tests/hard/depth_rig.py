"""A whole trainer in virtual time that knows of the depth only what two cameras can tell it.

The cameras of a rig profile are asked by their optics alone: the band's place in each picture with
noise, nothing where it is out of the picture or in the tube; the program's own solver makes a fix
of it, which comes late. Beside what the program believes stands what is true: the plant's own
angles and depth, and from them the force at the hand and the speed of the hub.
"""

from collections import deque
from dataclasses import dataclass, field
from itertools import pairwise

import numpy as np

from app.compose.trainer import TrainerSetup, build_loop, device_of
from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import VirtualClock
from app.exercises.scene import placed_plan_of
from app.mechanisms.lever import axis_kernel, felt_kernel, hub_velocity_kernel, tool_force_kernel
from app.mechanisms.pantograph.kernels import forward_kernel, jacobian_kernel
from app.mechanisms.profile import DeviceProfile
from app.planning.plan import Plan
from app.session.snapshot import Snapshot
from app.session.trainer import Trainer
from app.tracking.markers.extractor import Centre
from app.tracking.optics.rig import load_rig
from app.tracking.solver import FixSolver, SeenMarker
from tests.layered import layered

NOISE_PX = 0.1
LATENCY = 0.040
PLAN = Plan(np.array([0.0, -100.0, 0.0]), np.array([0.0, -40.0, 0.0]), "straight down")


@dataclass
class Truth:
    """Each tick as it was: shape (n,)."""

    force: FloatArray  # at the hand, of the torques sent, at the plant's own lever [N]
    speed: FloatArray  # of the hub across the needle [m/s]
    within: FloatArray  # whether the true depth lay in the interval
    shown: FloatArray  # force that the program says the hand feels [N]
    most: FloatArray  # force that it says the hand feels at most [N]


@dataclass
class DepthRig:
    """One trainer; `step` lets time pass.

    Attributes:
        rig: name of the camera rig.
        depth: where the needle begins [m].
        hidden: whether no camera sees the band at all.
        jump: how far along the needle the cameras see another thing than the band [m].
    """

    rig: str
    depth: float
    hidden: bool = False
    jump: float = 0.0
    force_cap: float = 5.0
    gravity: bool = False
    seed: int = 1
    x: float = 0.25
    _due: deque = field(default_factory=deque)
    _captured: float = -1.0
    truth: list[Truth] = field(default_factory=list)

    def __post_init__(self) -> None:
        chosen = layered("first-insertion")
        profile = device_of(chosen)
        if not self.gravity:  # the needle's own weight is no force of the program
            level = profile.mounting.model_copy(update={"gravity": (0.0, 0.0, 0.0)})
            profile = profile.model_copy(update={"mounting": level})
        self.profile: DeviceProfile = profile
        self.clock = VirtualClock(100.0)
        self.random = np.random.default_rng(self.seed)
        placed = placed_plan_of(chosen, profile, PLAN)
        self.loop = build_loop(TrainerSetup(chosen, placed, clock=self.clock), profile)
        self.loop._state[sv.PLANT_DEPTH] = self.depth
        self.loop.inbox.write(force_cap=self.force_cap)
        optics = load_rig(self.rig)
        self._models, self._needle = optics.models, optics.needle
        self._solver = FixSolver(optics, profile.fulcrum)
        self.trainer = Trainer(
            self.loop, None, placed, chosen, clock=self.clock, advance=self._look
        )
        self.loop.open()
        self.hold()
        self._before = self.loop.rows()[-1:]

    def hold(self, holds: bool = True) -> None:
        """Hold the needle at its tilt and the wanted depth, or let go of it."""
        self.trainer.hand(self.x, 0.0, self.depth, holds)

    def begin(self) -> None:
        """Arm, with a guidance far stronger than the hand may feel."""
        self.trainer.assistance(1.0)
        self.trainer.begin("tester")
        self.trainer.assistance(1.0)

    def step(self, seconds: float) -> Snapshot:
        """Let time pass; what was true is kept."""
        for _ in range(max(1, round(seconds / 0.02))):
            since = self.loop.latest().tick
            snapshot = self.trainer.step(20)
            rows = self.loop.rows(since)
            self.truth.append(self._true(np.concatenate([self._before, rows])))
            self._before = rows[-1:]
        return snapshot

    def of(self, name: str, ticks: int = 0) -> FloatArray:
        """Return one column of the truth, all of it or the last `ticks`."""
        return np.concatenate([getattr(part, name) for part in self.truth])[-ticks:]

    def close(self) -> None:
        """End."""
        self.trainer.close()

    # --- the cameras ------------------------------------------------------------------------------
    def _look(self, now: float) -> None:
        if now - self._captured >= 1.0 / 30.0 - 1e-9:
            self._captured = now
            self._due.append((now + LATENCY, self._fix(now)))
        while self._due and self._due[0][0] <= now:
            self.trainer.on_fix(self._due.popleft()[1])

    def _fix(self, now: float):
        state = self.loop.latest()
        depth = float(state.row[sv.PLANT_DEPTH]) + self.jump
        seen = depth - self._needle.marker_offset
        band = self.profile.fulcrum + seen * state.axis
        hidden = self._needle.hidden_mm
        tube = hidden is not None and hidden[0] <= 1e3 * seen <= hidden[1]
        sightings = []
        for model in self._models:
            there = not (self.hidden or tube) and bool(model.sees(band, 8.0)[0])
            noise = NOISE_PX * self.random.standard_normal(2)
            spread = NOISE_PX**2 * np.eye(2)
            sightings.append(
                SeenMarker(model.pixel(band) + noise, spread, Centre.BAND) if there else None
            )
        return self._solver.solve((sightings[0], sightings[1]), state.axis, now)

    # --- the truth --------------------------------------------------------------------------------
    def _true(self, rows: FloatArray) -> Truth:
        geometry = self.profile.pantograph
        a1, a2, base = geometry.links
        force, speed, within = [], [], []
        for before, row in pairwise(rows):
            q1, q2 = before[sv.PLANT_Q]
            depth = before[sv.PLANT_DEPTH]
            _, x, y = forward_kernel(q1, q2, a1, a2, base, 1.0)
            _, *jacobian = jacobian_kernel(q1, q2, x, y, a1, a2, base)
            dx, dy, dz, l_in = axis_kernel(x, y, *geometry.fulcrum)
            l_out = geometry.needle_length - depth
            _, gx, gy = tool_force_kernel(*row[sv.TORQUE], *jacobian)
            force.append(np.linalg.norm(felt_kernel(gx, gy, dx, dy, dz, l_in, l_out)))
            jxl, jxr, jyl, jyr = jacobian
            v1, v2 = before[sv.PLANT_QD]
            v = hub_velocity_kernel(
                jxl * v1 + jxr * v2, jyl * v1 + jyr * v2, dx, dy, dz, l_in, l_out
            )
            speed.append(np.linalg.norm(v))
            within.append(row[sv.DEPTH_LEAST] <= depth <= row[sv.DEPTH_MOST])
        shown = np.linalg.norm(rows[1:, sv.FELT], axis=1)
        return Truth(
            np.array(force), np.array(speed), np.array(within), shown, rows[1:, sv.FELT_MOST]
        )
