"""A simulated robot whose hand can let go, with the hub's true speed on record."""

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import VirtualClock
from app.core.compiled import stage
from app.device.control import Loop, laws, pantograph_stages
from app.device.links.memory_link import MemoryLink
from app.device.links.simulated import simulated_link
from app.mechanisms.pantograph.kernels import (
    axis_kernel,
    forward_kernel,
    hub_velocity_kernel,
    jacobian_kernel,
)
from app.mechanisms.profile import DeviceProfile
from app.simulation.compiler import compile
from app.simulation.consumers import DevicePort
from app.simulation.plant import initial_plant, plant_stage
from app.simulation.scene import EffectRequest, Scene

HISTORY = 4096


@stage
def record_true_speed(state: FloatArray, p: FloatArray) -> None:
    """Append the speed of the hub across the needle [m/s], by the plant's own state."""
    q1, q2 = state[sv.PLANT_Q_LEFT], state[sv.PLANT_Q_RIGHT]
    _, x, y = forward_kernel(q1, q2, p[0], p[1], p[2], 1.0)
    _, jxl, jxr, jyl, jyr = jacobian_kernel(q1, q2, x, y, p[0], p[1], p[2])
    dx, dy, dz, l_in = axis_kernel(x, y, p[3], p[4], p[5])
    v1, v2 = state[sv.PLANT_QD_LEFT], state[sv.PLANT_QD_RIGHT]
    wx, wy, wz = hub_velocity_kernel(
        jxl * v1 + jxr * v2,
        jyl * v1 + jyr * v2,
        dx,
        dy,
        dz,
        l_in,
        p[6] - state[sv.PLANT_DEPTH],
    )
    p[8 + int(p[7])] = (wx * wx + wy * wy + wz * wz) ** 0.5
    p[7] = min(p[7] + 1.0, len(p) - 9.0)


def direction(tilt: float, azimuth: float) -> tuple[float, float, float]:
    """Needle direction, hub to tip, at a tilt towards an azimuth [rad]."""
    sine = np.sin(tilt)
    return (sine * np.cos(azimuth), sine * np.sin(azimuth), -np.cos(tilt))


class LetGoRig:
    """Holds the needle at a pose under full force, then lets go.

    Args:
        profile: the robot.
        axis: where the hand holds the needle, hub to tip.
        path: where the force law pulls it, or pushes it away from.
        depth: of the tip [m].
        dial: assistance, -1...1: repels, guides.
        stiffness: of the guidance, as a factor on the profile's.
        tissue: with the side stiffness of the default layers.
        others: further force laws, with their defaults.
        wire: over the protocol's bytes and a board in memory: angles come a tick late.
    """

    def __init__(
        self,
        profile: DeviceProfile,
        axis: tuple[float, float, float],
        path: tuple[float, float, float],
        depth: float,
        dial: float = 1.0,
        stiffness: float = 1.0,
        tissue: bool = False,
        others: tuple[str, ...] = (),
        wire: bool = False,
    ) -> None:
        geometry, fixture = profile.pantograph, profile.fixture
        limit = profile.limits.hand_force
        self.depth = depth
        self.speeds = np.zeros(8 + HISTORY)
        self.speeds[:7] = (*geometry.links, *geometry.fulcrum, geometry.needle_length)
        self.clock = VirtualClock(10.0)
        requests = {
            "fixture": {
                "stiffness": stiffness * fixture.stiffness,
                "repulsion": limit,
                "limit": limit,
            }
        }
        requests |= {name: {} for name in others}
        stages = [plant_stage(profile, axis, depth), ("speed", record_true_speed, self.speeds)]
        initial = initial_plant(profile, axis, depth)
        start = initial["plant_q_left"], initial["plant_q_right"]
        self.board = MemoryLink(profile, stages, start) if wire else None
        link = self.board.stages() if self.board else simulated_link(profile, stages)
        effects, bound = [], laws.energy_bound(requests, profile)
        if tissue:
            port = DevicePort(profile.name, frozenset(a.value for a in profile.renders), True)
            scene = Scene(effects=(EffectRequest("lateral_tissue"),))
            plan = compile(scene, port)
            effects, bound = plan.stages(), bound + plan.energy_bound()
        forces = laws.stages_of(requests, profile)
        table = pantograph_stages(profile, forces, effects, link, energy_bound=bound)
        self.loop = Loop(table, profile.rate_hz, self.clock, initial=initial, link=self.board)
        self.loop.inbox.write(
            homed=1.0,
            force_cap=limit,
            assistance=dial,
            path_x=path[0],
            path_y=path[1],
            path_z=path[2],
        )
        self.hold(axis)

    def hold(self, axis: tuple[float, float, float], holds: float = 1.0) -> None:
        """Say where the hand wants the needle, and whether it holds it."""
        self.loop.inbox.write(
            hand_x=axis[0], hand_y=axis[1], hand_depth=self.depth, hand_holds=holds
        )

    def step(self, ticks: int) -> None:
        """Tick, with window and cameras alive."""
        for start in range(0, ticks, 50):
            now = self.clock.now()
            self.loop.inbox.write(heartbeat=now, tracked_depth=self.depth, tracked_time=now)
            self.loop.step(min(50, ticks - start))

    def arm(self) -> None:
        """Arm, and let the ramp pass."""
        self.loop.inbox.write(enabled=1.0)
        self.step(round(1.15 * self.loop.rate_hz))

    def let_go(self, ticks: int = 1000) -> tuple[FloatArray, FloatArray]:
        """Let go: (true speed of the hub after each tick, rows of the state)."""
        self.loop.inbox.write(hand_holds=0.0)
        before = int(self.speeds[7])
        self.step(ticks)
        return self.speeds[8 + before : 8 + before + ticks], self.loop.rows()[-ticks:]
