"""A simulated robot whose hand can let go, with the truth on record, and a twin without motors."""

from dataclasses import dataclass

import numpy as np
from memory_link import MemoryLink

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import VirtualClock
from app.core.compiled import stage
from app.device.control import Loop, laws, machine_stages
from app.device.links.simulated import simulated_link
from app.mechanisms.dynamic_model import A1, A2, BASE, FX, FY, FZ, MODEL_SIZE
from app.mechanisms.lever import axis_kernel, hub_velocity_kernel
from app.mechanisms.pantograph.dynamics import dynamics_kernel
from app.mechanisms.pantograph.kernels import forward_kernel, jacobian_kernel
from app.mechanisms.profile import DeviceProfile
from app.simulation.consumers import DevicePort
from app.simulation.plan import compile
from app.simulation.plant import initial_plant, plant_stage
from app.simulation.scene import EffectRequest, Scene

HISTORY = 8192
_LENGTH, _WRITTEN, _RECORD = MODEL_SIZE, MODEL_SIZE + 1, MODEL_SIZE + 2
SOON = 50  # ticks, ms: for which a run is watched after letting go was noticed


@stage
def record_true_motion(state: FloatArray, p: FloatArray) -> None:
    """Append the hub's speed across the needle [m/s] and the mechanism's kinetic energy [J].

    By the plant's own state and inertias; the needle's turning counts, its sliding does not: the
    motors do not drive it.
    """
    q1, q2 = state[sv.PLANT_Q_LEFT], state[sv.PLANT_Q_RIGHT]
    v1, v2 = state[sv.PLANT_QD_LEFT], state[sv.PLANT_QD_RIGHT]
    depth = state[sv.PLANT_DEPTH]
    _, x, y = forward_kernel(q1, q2, p[A1], p[A2], p[BASE], 1.0)
    _, jxl, jxr, jyl, jyr = jacobian_kernel(q1, q2, x, y, p[A1], p[A2], p[BASE])
    dx, dy, dz, l_in = axis_kernel(x, y, p[FX], p[FY], p[FZ])
    wx, wy, wz = hub_velocity_kernel(
        jxl * v1 + jxr * v2, jyl * v1 + jyr * v2, dx, dy, dz, l_in, p[_LENGTH] - depth
    )
    m11, m12, m22, _, _, _, _ = dynamics_kernel(q1, q2, v1, v2, x, y, depth, 0.0, p, 0)
    row = _RECORD + 2 * int(p[_WRITTEN])
    p[row] = (wx * wx + wy * wy + wz * wz) ** 0.5
    p[row + 1] = 0.5 * (m11 * v1 * v1 + 2.0 * m12 * v1 * v2 + m22 * v2 * v2)
    p[_WRITTEN] = min(p[_WRITTEN] + 1.0, HISTORY - 1.0)


@dataclass(frozen=True, slots=True, eq=False)
class Run:
    """What became of a needle that was let go, tick by tick.

    Attributes:
        speed: of the hub [m/s]; `twin_speed` with the motors off.
        energy: kinetic [J]; `twin_energy` likewise.
        rows: of the state.
    """

    speed: FloatArray
    energy: FloatArray
    twin_speed: FloatArray
    twin_energy: FloatArray
    rows: FloatArray

    @property
    def noticed(self) -> int | None:
        """Tick in which letting go was noticed."""
        found = np.flatnonzero(self.rows[:, sv.LET_GO] > 0.0)
        return int(found[0]) if len(found) else None

    @property
    def watched(self) -> slice:
        """Ticks in which the program's forces answer for the motion: until `SOON` after it was
        noticed. Later a needle that topples has its speed from its weight.
        """
        return slice(0, len(self.speed) if self.noticed is None else self.noticed + SOON)

    @property
    def excess_speed(self) -> float:
        """Largest speed of the hub beyond the twin's [m/s]."""
        return float((self.speed - self.twin_speed)[self.watched].max())

    @property
    def excess_energy(self) -> float:
        """Largest kinetic energy beyond the twin's [J]."""
        return float((self.energy - self.twin_energy)[self.watched].max())


def scaled(profile: DeviceProfile, *factors: float) -> DeviceProfile:
    """Return the profile with its inertias times a factor each: proximal and rotor, distal, tool,
    needle; a single factor for all.
    """
    proximal, distal, tool, needle = factors if len(factors) > 1 else factors * 4
    part = profile.inertia
    changed = {
        "proximal_mass": proximal * part.proximal_mass,
        "proximal_inertia": proximal * part.proximal_inertia,
        "rotor_inertia": proximal * part.rotor_inertia,
        "distal_mass": distal * part.distal_mass,
        "distal_inertia": distal * part.distal_inertia,
        "tool_mass": tool * part.tool_mass,
        "needle_mass": needle * part.needle_mass,
        "needle_inertia": needle * part.needle_inertia,
    }
    return profile.model_copy(update={"inertia": part.model_copy(update=changed)})


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
        body: the robot as it is, where its inertias are not those of the profile.
        cameras: whether they measure the depth; else the loop knows the profile's range only.
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
        body: DeviceProfile | None = None,
        cameras: bool = True,
    ) -> None:
        geometry, fixture = profile.pantograph, profile.fixture
        limit = profile.limits.hand_force
        self.depth, self._cameras = depth, cameras
        body = body or profile
        self._record = np.zeros(_RECORD + 2 * HISTORY)
        self._record[:_LENGTH] = body.dynamic_model.values
        self._record[_LENGTH] = geometry.needle_length
        self.clock = VirtualClock(10.0)
        requests = {
            "fixture": {
                "stiffness": stiffness * fixture.stiffness,
                "repulsion": limit,
                "limit": limit,
            }
        }
        requests |= {name: {} for name in others}
        self._plant = plant_stage(body, axis, depth)
        stages = [self._plant, ("motion", record_true_motion, self._record)]
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
        table = machine_stages(profile, forces, effects, link, energy_bound=bound)
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
        """Tick, with the window alive, and the cameras if there are any."""
        for start in range(0, ticks, 50):
            now = self.clock.now()
            self.loop.inbox.write(heartbeat=now)
            if self._cameras:
                self.loop.inbox.write(tracked_depth=self.depth, tracked_time=now)
            self.loop.step(min(50, ticks - start))

    def arm(self) -> None:
        """Arm, and let the ramp pass."""
        self.loop.inbox.write(enabled=1.0)
        self.step(round(1.15 * self.loop.rate_hz))

    @property
    def pull(self) -> float:
        """Force with which the hand holds against the robot and the needle's weight [N]."""
        return float(np.linalg.norm(self.loop.latest().row[[sv.PULL_X, sv.PULL_Y, sv.PULL_Z]]))

    def run_away(self, ticks: int = 400) -> Run:
        """Let go, and let a twin go from the same state with its motors off."""
        twin = self._twin(ticks)
        first = int(self._record[_WRITTEN])
        self.loop.inbox.write(hand_holds=0.0)
        self.step(ticks)
        run = self._record[_RECORD:].reshape(-1, 2)[first : first + ticks].copy()
        return Run(run[:, 0], run[:, 1], twin[:, 0], twin[:, 1], self.loop.rows()[-ticks:])

    def _twin(self, ticks: int) -> FloatArray:
        """Speed [m/s] and energy [J] of the needle without motors, (ticks, 2)."""
        state, record = self.loop._state.copy(), self._record.copy()
        record[_WRITTEN] = 0.0
        state[[sv.TORQUE_LEFT, sv.TORQUE_RIGHT, sv.HAND_HOLDS]] = 0.0
        state[sv.DT] = 1.0 / self.loop.rate_hz
        for _ in range(ticks):
            self._plant[1](state, self._plant[2])
            record_true_motion(state, record)
        return record[_RECORD:].reshape(-1, 2)[:ticks]
