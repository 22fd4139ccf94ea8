"""The whole simulated device at work: encoders, the loop's own stages, delay, and the plant.

The plant is integrated in steps of 1/8 tick: its own semi-implicit steps act half a step early, and
half a millisecond of that would flatter a loop of 1 kHz.
"""

from dataclasses import dataclass
from typing import Any, Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import STAGE_TYPE, stage
from app.core.parameters import Stage, numbered, packed
from app.device.control import kernel, machine_stages
from app.device.control.velocity import DEFAULT_VELOCITY, VelocityMethod
from app.device.links.simulated import simulated_link
from app.mechanisms.lever import felt_kernel
from app.mechanisms.pantograph.kernels import forward_kernel
from app.mechanisms.pantograph.profile import PantographProfile
from app.simulation.plant import initial_plant, plant_stage

from numba import types  # isort: skip  (after core.compiled)


from app.mechanisms.pantograph import inverse, jacobian
from app.mechanisms.pantograph.dynamics import dynamic_terms

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


class _SpringPlaces(NamedTuple):
    """A spring-damper at the tool: stiffness [N/m], damping [N·s/m], where it rests [m]."""

    stiffness: int
    damping: int
    x: int
    y: int


_SPRING: Final = numbered(_SpringPlaces)
_DELAY, _NEXT, _RING = range(3)
_MOST_DELAY: Final = 4


@stage
def spring_stage(state: FloatArray, p: FloatArray) -> None:
    """Add the hand force that is K and B at the tool point, and its potential."""
    ex, ey = state[sv.P3_X] - p[_SPRING.x], state[sv.P3_Y] - p[_SPRING.y]
    gx = -p[_SPRING.stiffness] * ex - p[_SPRING.damping] * state[sv.P3_VX]
    gy = -p[_SPRING.stiffness] * ey - p[_SPRING.damping] * state[sv.P3_VY]
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
    state[sv.POTENTIAL] += 0.5 * p[_SPRING.stiffness] * (ex * ex + ey * ey)


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

    profile: PantographProfile
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
        x, y = geometry.fulcrum[:2]
        spring = packed(_SPRING, stiffness=stiffness, damping=damping, x=x, y=y)
        law = Stage("spring", spring_stage, spring)
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

    def _stages(self, law: Stage) -> list[Stage]:
        link = simulated_link(self.profile, [])
        table = list(machine_stages(self.profile, [law], [], link, velocity=self.velocity))
        names = [item.name for item in table]
        first, last = names.index("transmission") + 1, names.index("safety")
        return table if self.protected else table[:first] + table[last:]

    @property
    def ticks(self) -> int:
        """Ticks of a whole run."""
        return round(DURATION * self.rate_hz)

    def stable(self, stiffness: float, damping: float) -> bool:
        """Return whether the swing dies away: see `QUIET_COUNTS`, `LASTING` and `WIDER`."""
        track = self.release(stiffness, damping)
        return len(track) == self.ticks and dies_away(track, self.quiet)

    @property
    def quiet(self) -> float:
        """Width that counts as rest [m]."""
        count = 2.0 * np.pi / self.profile.encoder.counts_per_turn
        return QUIET_COUNTS * count * self.profile.geometry.proximal


def dies_away(track: FloatArray, quiet: float) -> bool:
    """Return whether a tool path (n, 2) comes to rest, judged by its width in two thirds of its
    time.
    """
    third = len(track) // 3
    before = np.ptp(track[third : 2 * third], axis=0).max()
    after = np.ptp(track[2 * third :], axis=0).max()
    if max(before, after) > WIDER * 2.0 * OFFSET:
        return False
    return bool(after <= quiet or after < LASTING * before)


@dataclass(frozen=True, slots=True)
class Reduction:
    """What the tool point feels like along one direction: mass [kg] and viscous damping [N·s/m]."""

    mass: float
    damping: float


def reductions(profile: PantographProfile, depth: float) -> tuple[Reduction, Reduction]:
    """Mass and damping of P3 along x and y, needle vertical: Λ = (J M⁻¹ Jᵀ)⁻¹, J⁻ᵀ b J⁻¹.

    There the mechanism is symmetric, so that x and y do not couple.
    """
    geometry = profile.pantograph
    q = inverse(geometry, geometry.fulcrum[:2])
    j = jacobian(geometry, q)
    mass = dynamic_terms(profile.dynamic_model, q, (0.0, 0.0), depth).mass
    felt = np.linalg.inv(j @ np.linalg.inv(mass) @ j.T)
    back = np.linalg.inv(j)
    damping = profile.friction.viscous * back.T @ back
    along_x, along_y = (Reduction(float(felt[k, k]), float(damping[k, k])) for k in (0, 1))
    return along_x, along_y


def spectral_radius(
    model: Reduction, stiffness: FloatArray, damping: FloatArray, step: float, delay: int
) -> FloatArray:
    """Spectral radius over arrays of K [N/m] and B [N·s/m], both (n,), for a tick T = `step` [s]
    and a delay of whole ticks; (n,).
    """
    rate = model.damping / model.mass
    if rate * step > 1e-9:
        hold = -np.expm1(-rate * step) / rate
        speed, drift = hold / model.mass, (step - hold) / rate / model.mass
    else:
        hold, speed, drift = step, step / model.mass, 0.5 * step**2 / model.mass
    size = delay + 3  # x, v, then x of the ticks before
    a = np.zeros((len(stiffness), size, size))
    a[:, 0, 0], a[:, 0, 1], a[:, 1, 1] = 1.0, hold, 1.0 - rate * hold
    newest = 0 if delay == 0 else delay + 1
    for column, gain in (
        (newest, stiffness + damping / step),
        (delay + 2, -damping / step),
    ):
        a[:, 0, column] -= drift * gain
        a[:, 1, column] -= speed * gain
    a[:, 2, 0] = 1.0
    for row in range(3, size):
        a[:, row, row - 1] = 1.0
    return np.asarray(np.abs(np.linalg.eigvals(a)).max(axis=1))


def colgate(damping: float, virtual: FloatArray, step: float) -> FloatArray:
    """Largest K [N/m] by Colgate and Schenkel (1997): passive if b > K T/2 + |B|; (n,) of B."""
    return np.asarray(np.maximum(2.0 * (damping - np.abs(virtual)) / step, 0.0))


def delayed(damping: float, virtual: FloatArray, step: float, delay: int) -> FloatArray:
    """Largest K [N/m] of the free device with delay: K < (b + B)/(T/2 + t_d), small B and K."""
    return np.asarray((damping + virtual) / (0.5 * step + delay * step))
