"""The whole simulated device at work: encoders, the loop's own stages, delay, and the plant.

The plant is integrated in steps of 1/8 tick: its own semi-implicit steps act half a step early, and
half a millisecond of that would flatter a loop of 1 kHz.
"""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import STAGE_TYPE, stage
from app.device.control import Stage, kernel, pantograph_stages
from app.device.control.velocity import DEFAULT_VELOCITY, VelocityMethod
from app.device.links.simulated import simulated_link
from app.mechanisms.pantograph.kernels import felt_kernel, forward_kernel
from app.mechanisms.profile import DeviceProfile
from app.simulation.plant import initial_plant, plant_stage

from numba import types  # isort: skip  (after core.compiled)

DEPTH: Final = 0.060  # [m] of the needle
DURATION: Final = 1.5  # [s]
OFFSET: Final = 0.25e-3  # [m] of the tool along x and y when it is let go
QUIET_COUNTS: Final = 4.0
"""Swinging over no more than this many encoder counts is rest: quantisation alone does it."""
LASTING: Final = 0.95
"""Swinging in the last third at least this share of the second third does not die away."""
WIDER: Final = 1.1
"""Nor does what ever swings wider than this times the first swing, 2 `OFFSET`."""

_FINE: Final = 8
_AWAY: Final = 0.020  # [m] no stable device goes there
_K, _B, _X, _Y = range(4)
_DELAY, _NEXT, _RING = range(3)
_MOST_DELAY: Final = 4


@stage
def spring_stage(state: FloatArray, p: FloatArray) -> None:
    """Add the hand force that is K and B at the tool point, and its potential."""
    ex, ey = state[sv.P3_X] - p[_X], state[sv.P3_Y] - p[_Y]
    gx = -p[_K] * ex - p[_B] * state[sv.P3_VX]
    gy = -p[_K] * ey - p[_B] * state[sv.P3_VY]
    fx, fy, fz = felt_kernel(
        gx,
        gy,
        state[sv.AXIS_X],
        state[sv.AXIS_Y],
        state[sv.AXIS_Z],
        state[sv.L_IN],
        state[sv.L_OUT],
    )
    state[sv.FORCE_X] += fx
    state[sv.FORCE_Y] += fy
    state[sv.FORCE_Z] += fz
    state[sv.POTENTIAL] += 0.5 * p[_K] * (ex * ex + ey * ey)


@stage
def delay_stage(state: FloatArray, p: FloatArray) -> None:
    """Hold TORQUE_* back by whole ticks."""
    if not p[_DELAY] > 0.0:
        return
    k = int(p[_NEXT])
    left, right = p[_RING + 2 * k], p[_RING + 2 * k + 1]
    p[_RING + 2 * k], p[_RING + 2 * k + 1] = state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT]
    state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = left, right
    p[_NEXT] = (k + 1) % int(p[_DELAY])


@kernel.compiled(
    types.int64(
        types.float64[::1],
        kernel.STAGES,
        kernel.PARAMETERS,
        STAGE_TYPE,
        types.float64[::1],
        types.float64[::1],
        types.float64,
        types.float64[:, ::1],
    )
)
def swing(
    state: Any,
    stages: Any,
    parameters: Any,
    plant: Any,
    plant_parameters: Any,
    links: Any,
    step: float,
    track: Any,
) -> int:
    """Run len(track) ticks; the true tool point of each goes into `track` (n, 2).

    Returns how many were run: fewer if the tool went further away than a stable device goes.
    """
    for k in range(len(track)):
        state[sv.TIME] += step
        state[sv.DT] = step
        state[sv.HEARTBEAT] = state[sv.TIME]
        kernel.run_stages(state, stages, parameters)
        state[sv.DT] = step / _FINE
        for _ in range(_FINE):
            plant(state, plant_parameters)
        _, x, y = forward_kernel(
            state[sv.PLANT_Q_LEFT], state[sv.PLANT_Q_RIGHT], links[0], links[1], links[2], 1.0
        )
        track[k, 0], track[k, 1] = x, y
        if abs(x - track[0, 0]) + abs(y - track[0, 1]) > _AWAY:
            return k + 1
    return len(track)


@dataclass(frozen=True, slots=True)
class Device:
    """A simulated device without a hand.

    Attributes:
        profile: its numbers.
        rate_hz: of the loop.
        delay: whole ticks between command and torque.
        velocity: estimator.
        protected: with what stands between transmission and safety (the speed governor, and what
            else guards against an unstable law); without it the law alone is judged.
    """

    profile: DeviceProfile
    rate_hz: float
    delay: int = 0
    velocity: VelocityMethod = DEFAULT_VELOCITY
    protected: bool = False

    def release(self, stiffness: float, damping: float) -> FloatArray:
        """Let go beside the rest point of a spring-damper at the tool; true P3 per tick (n, 2).

        It ends early where the tool leaves for good.
        """
        geometry = self.profile.pantograph
        axis = np.array([*np.full(2, OFFSET), -geometry.fulcrum[2]])
        plant = plant_stage(self.profile, axis, DEPTH)
        state = sv.empty_state()
        for name, value in initial_plant(self.profile, axis, DEPTH).items():
            state[sv.INDEX[name]] = value
        for slot in (sv.ENABLED, sv.HOMED, sv.ARMING):
            state[slot] = 1.0
        state[sv.FORCE_CAP], state[sv.TIME] = self.profile.limits.hand_force, 1.0
        law = ("spring", spring_stage, np.array([stiffness, damping, *geometry.fulcrum[:2]]))
        functions, values = kernel.no_stages(), kernel.no_parameters()
        for _, function, parameters in self._stages(law):
            kernel.append(functions, values, function, parameters)
        held = np.zeros(_RING + 2 * _MOST_DELAY)
        held[_DELAY] = self.delay
        kernel.append(functions, values, delay_stage, held)
        track = np.zeros((self.ticks, 2))
        links = np.array(geometry.links)
        step = 1.0 / self.rate_hz
        return track[: swing(state, functions, values, plant[1], plant[2], links, step, track)]

    def _stages(self, law: tuple[str, Any, FloatArray]) -> list[Stage]:
        link = simulated_link(self.profile, [])
        table = list(pantograph_stages(self.profile, [law], [], link, velocity=self.velocity))
        names = [item.name for item in table]
        first, last = names.index("transmission") + 1, names.index("safety")
        return table if self.protected else table[:first] + table[last:]

    @property
    def ticks(self) -> int:
        """Ticks of a whole run."""
        return round(DURATION * self.rate_hz)

    def stable(self, stiffness: float, damping: float) -> bool:
        """Whether the swing dies away: see `QUIET_COUNTS`, `LASTING` and `WIDER`."""
        track = self.release(stiffness, damping)
        return len(track) == self.ticks and dies_away(track, self.quiet)

    @property
    def quiet(self) -> float:
        """Width that counts as rest [m]."""
        count = 2.0 * np.pi / self.profile.encoder.counts_per_turn
        return QUIET_COUNTS * count * self.profile.geometry.proximal


def dies_away(track: FloatArray, quiet: float) -> bool:
    """Whether a tool path (n, 2) comes to rest, judged by its width in two thirds of its time."""
    third = len(track) // 3
    before = np.ptp(track[third : 2 * third], axis=0).max()
    after = np.ptp(track[2 * third :], axis=0).max()
    if max(before, after) > WIDER * 2.0 * OFFSET:
        return False
    return bool(after <= quiet or after < LASTING * before)
