"""A simulated hand that is not steady: weight, tremor, unrest, and push and tilt that are coupled.

Mouse, wheel, keys, pen tablet and gamepad say where the hand is wanted (HAND_*). A person's hand
comes there late and never stands still. What it is off goes into UNSTEADY_*, which
`mechanisms.hand_motion` adds before its own bounds on speed and acceleration:

- *weight*: direction and depth follow as a mass on a spring, damping ratio 0.7;
- *tremor*: noise through a resonance at 10 Hz, half-power band 8 to 12 Hz, across and along;
- *unrest*: the hub wanders, as a hand does that means to hold still;
- *push and tilt*: no push goes straight. Off the line a hand goes in proportion to its way (Gordon,
  Ghilardi and Ghez 1994, doi 10.1007/BF00241415), to another side in another movement; the needle
  turns about its entry by that and stays turned, however slow the push. A pause or a way back
  begins another push: who pushes a little, looks and mends has many small errors, who does not has
  one great one;
- *tilt and depth*: turning while pushing moves the depth, which stays moved.

Where tissue holds the needle it goes on holding: the plant's springs pull, nothing here moves it.
Sizes by level, and what each stands on: `simulation.unsteady`.

The stage rests while HAND_LEVEL is 0: for scripts, which bring their own hand, for the arm, between
attempts. Its numbers are uniform ones of a linear congruential generator (Numerical Recipes,
2³² · 1 664 525, 1 013 904 223) that begins at HAND_SEED, three to a nearly normal one. Both inputs
are recorded and a double holds the products exactly, so a replay has the same hand to the bit.
"""

from dataclasses import dataclass
from typing import Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.messages import sentence
from app.core.parameters import Stage, numbered, packed
from app.simulation.errors import SimulationError

NAME: Final = "unsteady_hand"

_TREMOR: Final = 2.0 * np.pi * 10.0  # [rad/s]
_NARROW: Final = 0.2  # damping ratio of the tremor's resonance: 4 Hz between half powers
_DAMPING: Final = 0.7  # ratio of the weight
_FASTEST_PUSH: Final = 0.03  # [m/s] while a faster push turns, the depth slips no further
_PAUSE: Final = 0.2  # [s] so long no way was wanted: the push is over
_BACK: Final = 5e-4  # [m] so far the other way it is another push
_MOST_ASIDE: Final = 0.35  # [rad]
_MOST_SLIP: Final = 0.005  # [m]
_LONGEST: Final = 5e-3  # [s] as the loop clamps a step
_MODULUS: Final = 4294967296.0
_SHORTEST: Final = 0.01  # [m] of needle outside the fulcrum


@dataclass(frozen=True, slots=True)
class Unsteadiness:
    """Sizes of a hand's unsteadiness.

    Attributes:
        lag: time by which it follows a steady movement late [s].
        tremor: standard deviation across the needle at the hub, in each of two directions [m].
        tremor_along: along the needle [m].
        unrest: standard deviation of the hub's wander across the needle, in each of two directions,
            in a hand that means to hold still [m].
        memory: time in which the wander forgets where it was [s].
        aside: standard deviation of the turn for a way that is pushed at one go, in each of two
            directions [rad/m].
        slip: depth for a turn while pushing as fast as bends most [m/rad].
    """

    lag: float
    tremor: float
    tremor_along: float
    unrest: float
    memory: float
    aside: float
    slip: float

    def __post_init__(self) -> None:
        values = [getattr(self, name) for name in self.__slots__]
        if not (np.isfinite(values).all() and min(values) >= 0.0 and self.lag * self.memory > 0.0):
            raise SimulationError(
                sentence(
                    "a hand's unsteadiness needs finite numbers of 0 or more, and a lag and a "
                    "memory above 0, got {this}",
                    this=self,
                )
            )


class _HandPlaces(NamedTuple):
    """The unsteadiness of the lowest level and of the highest, the needle's length, and memory."""

    highest: int
    length: int
    on: int = 0
    random: int = 0
    x: int = 0
    y: int = 0
    z: int = 0
    vx: int = 0
    vy: int = 0
    vz: int = 0
    shake_x: int = 0
    shake_y: int = 0
    shake_z: int = 0
    shake_vx: int = 0
    shake_vy: int = 0
    shake_vz: int = 0
    wander_x: int = 0
    wander_y: int = 0
    push: int = 0
    wanted: int = 0
    paused: int = 0
    back: int = 0
    leaves_x: int = 0
    leaves_y: int = 0
    aside_x: int = 0
    aside_y: int = 0
    slipped: int = 0


class _Of(NamedTuple):
    """The fields of `Unsteadiness`, in their order."""

    lag: int
    tremor: int
    tremor_along: int
    unrest: int
    memory: int
    aside: int
    slip: int


_AT: Final = numbered(_HandPlaces)
_LOW: Final = len(_AT)
_OF: Final = numbered(_Of)
_COUNT: Final = len(_OF)


def unsteady_stage(length: float, low: Unsteadiness, high: Unsteadiness, highest: int) -> Stage:
    """Build the stage that makes a simulated hand unsteady; it rests while HAND_LEVEL is 0.

    Args:
        length: of the needle, hub to tip [m].
        low: at level 1.
        high: at the level `highest` and above; between them it grows evenly.
        highest: that level, above 1.
    """
    numbers = [[getattr(one, name) for name in _Of._fields] for one in (low, high)]
    return Stage(NAME, step, packed(_AT, *numbers, highest=float(highest), length=length))


@njit
def _of_level(p: FloatArray, level: float, place: int) -> float:
    share = min(max((level - 1.0) / (p[_AT.highest] - 1.0), 0.0), 1.0)
    low, high = p[_LOW + place], p[_LOW + _COUNT + place]
    return low + share * (high - low)


@njit
def _uniform(p: FloatArray) -> float:
    """Draw the next number, 0 to 1."""
    raw = 1664525.0 * p[_AT.random] + 1013904223.0
    p[_AT.random] = raw - np.floor(raw / _MODULUS) * _MODULUS
    return p[_AT.random] / _MODULUS


@njit
def _normal(p: FloatArray) -> float:
    """Draw a number of mean 0 and variance 1."""
    return 2.0 * (_uniform(p) + _uniform(p) + _uniform(p) - 1.5)


@njit
def _begin(state: FloatArray, p: FloatArray) -> None:
    for place in range(_AT.on, _LOW):
        p[place] = 0.0
    p[_AT.on] = 1.0
    seed = np.floor(abs(state[sv.HAND_SEED]))
    p[_AT.random] = seed - np.floor(seed / _MODULUS) * _MODULUS
    for _ in range(8):  # neighbouring seeds begin alike
        _uniform(p)
    p[_AT.x], p[_AT.y], p[_AT.z] = state[sv.HAND_X], state[sv.HAND_Y], state[sv.HAND_DEPTH]
    p[_AT.wanted] = p[_AT.z]


@njit
def _follow(p: FloatArray, i: int, wanted: float, pull: float, h: float) -> None:
    """Let a part of the hand follow what is wanted, by `pull` [rad/s], for a step h [s]."""
    x, v = p[_AT.x + i], p[_AT.vx + i]
    v += (pull * pull * (wanted - x) - 2.0 * _DAMPING * pull * v) * h
    p[_AT.vx + i] = v
    p[_AT.x + i] = x + v * h


@njit
def _shake(p: FloatArray, i: int, size: float, h: float) -> float:
    """Go on with the tremor of a standard deviation `size`."""
    x, v = p[_AT.shake_x + i], p[_AT.shake_vx + i]
    drive = np.sqrt(4.0 * _NARROW * _TREMOR * _TREMOR * _TREMOR * h) * _normal(p)
    v += drive - (_TREMOR * _TREMOR * x + 2.0 * _NARROW * _TREMOR * v) * h
    p[_AT.shake_vx + i] = v
    p[_AT.shake_x + i] = x + v * h
    return size * p[_AT.shake_x + i]


@njit
def _push(p: FloatArray, wanted: float, aside: float, h: float) -> None:
    """Let the direction go aside while the hand pushes or pulls; another push, another side."""
    way = wanted - p[_AT.wanted]
    p[_AT.wanted] = wanted
    p[_AT.paused] = p[_AT.paused] + h if way == 0.0 else 0.0
    p[_AT.back] = 0.0 if way * p[_AT.push] > 0.0 else p[_AT.back] + abs(way)
    if p[_AT.paused] > _PAUSE:
        p[_AT.push] = 0.0
    if way != 0.0 and (p[_AT.push] == 0.0 or p[_AT.back] > _BACK):
        p[_AT.push], p[_AT.back] = np.sign(way), 0.0
        for i in range(2):
            p[_AT.leaves_x + i] = aside * _normal(p)
    for i in range(2):
        gone = p[_AT.aside_x + i] + p[_AT.leaves_x + i] * abs(p[_AT.vz]) * h
        p[_AT.aside_x + i] = min(max(gone, -_MOST_ASIDE), _MOST_ASIDE)


@stage
def step(state: FloatArray, p: FloatArray) -> None:
    """Write UNSTEADY_* for this tick."""
    level, asked = state[sv.HAND_LEVEL], state[sv.HAND_X] + state[sv.HAND_Y] + state[sv.HAND_DEPTH]
    if not (level > 0.0 and state[sv.HAND_HOLDS] > 0.5 and np.isfinite(asked)):
        p[_AT.on] = 0.0
        state[sv.UNSTEADY_X] = state[sv.UNSTEADY_Y] = state[sv.UNSTEADY_DEPTH] = 0.0
        return
    if p[_AT.on] < 0.5:
        _begin(state, p)
    if state[sv.DT] > 0.0:
        h = min(state[sv.DT], _LONGEST)
        pull = 2.0 * _DAMPING / _of_level(p, level, _OF.lag)
        forgets = h / _of_level(p, level, _OF.memory)
        lever = max(p[_AT.length] - state[sv.PLANT_DEPTH], _SHORTEST)
        wander = _of_level(p, level, _OF.unrest) * np.sqrt(2.0 * forgets)
        _push(p, state[sv.HAND_DEPTH], _of_level(p, level, _OF.aside), h)
        for i in range(2):
            p[_AT.wander_x + i] += wander * _normal(p) - forgets * p[_AT.wander_x + i]
            off = p[_AT.wander_x + i] / lever + p[_AT.aside_x + i]
            _follow(p, i, state[sv.HAND_X + i] + off, pull, h)
        _follow(p, 2, state[sv.HAND_DEPTH], pull, h)
        turn = np.sqrt(p[_AT.vx] ** 2 + p[_AT.vy] ** 2)
        push = min(max(p[_AT.vz], -_FASTEST_PUSH), _FASTEST_PUSH)
        slip = _of_level(p, level, _OF.slip) * turn * (push / _FASTEST_PUSH) * h
        p[_AT.slipped] = min(max(p[_AT.slipped] + slip, -_MOST_SLIP), _MOST_SLIP)
        across = _of_level(p, level, _OF.tremor) / lever
        along = _of_level(p, level, _OF.tremor_along)
        state[sv.UNSTEADY_X] = p[_AT.x] + _shake(p, 0, across, h) - state[sv.HAND_X]
        state[sv.UNSTEADY_Y] = p[_AT.y] + _shake(p, 1, across, h) - state[sv.HAND_Y]
        depth = p[_AT.z] + p[_AT.slipped] + _shake(p, 2, along, h)
        state[sv.UNSTEADY_DEPTH] = depth - state[sv.HAND_DEPTH]
