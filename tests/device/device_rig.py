"""A whole tick on a virtual clock, with encoders that can fail and motors that remember."""

from typing import Any

import numpy as np
from virtual_fixture import VirtualFixture

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import VirtualClock
from app.core.compiled import stage
from app.device.control import Loop, Table, machine_stages
from app.device.links import Link
from app.mechanisms.pantograph import ForceLaw, inverse
from app.mechanisms.profile import load_profile

PROFILE = load_profile("icube")
GEOMETRY = PROFILE.pantograph
HAND_LIMIT = PROFILE.limits.hand_force
TORQUE_LIMIT = PROFILE.limits.joint_torque


@stage
def plant_to_encoders(state: FloatArray, p: FloatArray) -> None:
    """Encoders without quantisation that stop being read while p[0] is not zero."""
    if p[0] == 0.0:
        state[sv.Q_LEFT] = state[sv.PLANT_Q_LEFT]
        state[sv.Q_RIGHT] = state[sv.PLANT_Q_RIGHT]
        state[sv.Q_TIME] = state[sv.TIME]


@stage
def keep_what_was_sent(state: FloatArray, p: FloatArray) -> None:
    """Store the torques that reach the link, count the calls, remember the largest."""
    p[0] = state[sv.TORQUE_LEFT]
    p[1] = state[sv.TORQUE_RIGHT]
    p[2] += 1.0
    p[3] = max(p[3], abs(p[0]), abs(p[1]))


@stage
def add_force(state: FloatArray, p: FloatArray) -> None:
    """An effect that wants a constant force."""
    state[sv.FORCE_X] += p[0]
    state[sv.FORCE_Y] += p[1]
    state[sv.FORCE_Z] += p[2]


def pose(tilt: float, azimuth: float) -> dict[str, float]:
    """PLANT_Q_* of a needle whose tool point lies at a tilt [rad] towards an azimuth [rad]."""
    reach = GEOMETRY.fulcrum[2] * np.tan(tilt)
    p3 = GEOMETRY.fulcrum[:2] + reach * np.array([np.cos(azimuth), np.sin(azimuth)])
    left, right = inverse(GEOMETRY, p3)
    return {"plant_q_left": left, "plant_q_right": right}


class Rig:
    """Loop on a virtual clock with encoders that can fail and a link that remembers."""

    def __init__(
        self,
        tilt: float = 0.3,
        azimuth: float = 0.5,
        force_law: ForceLaw = ForceLaw.VIRTUAL_WORK,
        force: tuple[float, float, float] | None = None,
        laws: list[Any] | None = None,
    ) -> None:
        self.freeze = np.zeros(1)
        self.sent = np.zeros(4)
        self.force = np.array(force if force is not None else (0.0, 0.0, 0.0))
        link = Link.of(
            [("encoders", plant_to_encoders, self.freeze)],
            [("motors", keep_what_was_sent, self.sent)],
        )
        laws = [VirtualFixture.of(PROFILE).stage()] if laws is None else laws
        effects = [("push", add_force, self.force)]
        self.table: Table = machine_stages(PROFILE, laws, effects, link, force_law)
        self.clock = VirtualClock(10.0)
        self.loop = Loop(self.table, 1000.0, self.clock, initial=pose(tilt, azimuth))
        self.write(homed=1.0, force_cap=HAND_LIMIT)
        self.beating = True

    def arm(self, **inputs: float) -> None:
        """Arm with full assistance towards the vertical, and let the ramp pass."""
        self.write(enabled=1.0, assistance=1.0, path_z=-1.0, **inputs)
        self.step(1100)

    def write(self, **inputs: float) -> None:
        """Write inputs."""
        self.loop.inbox.write(**inputs)

    def step(self, ticks: int = 1) -> None:
        """Tick, with the window alive unless `beating` is off."""
        for start in range(0, ticks, 100):
            if self.beating:
                self.loop.inbox.write(heartbeat=self.clock.now())
            self.loop.step(min(100, ticks - start))

    @property
    def felt(self) -> float:
        """Largest force that the hand can feel, at any depth [N]: what the limits are for."""
        return self.loop.latest().felt_most
