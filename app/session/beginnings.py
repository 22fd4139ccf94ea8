"""Where an attempt of a simulated hand begins: off the path, each time elsewhere, by the seed.

A hand that mouse, keys, pen tablet or gamepad move is led to such a start before every attempt, the
first one and the next ones alike, and the attempt waits there until it moves. What leads the needle
by itself (scripts, the arm) begins at once, upright, as before.
"""

from dataclasses import dataclass, field
from math import cos, pi, radians, sin, sqrt
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.planning.placement import PlacedPlan

LEAST_OFF: Final = radians(8.0)
MOST_OFF: Final = radians(14.0)
"""Angle between needle and path at the start, as that of the novice in `simulation.skills`."""

CLEAR: Final = radians(4.0)
"""The start keeps so far from the robot's tilt limit."""

TRIES: Final = 32
"""Directions that are drawn until one is in reach; else the hand starts upright."""

_OWN: Final = 17  # distinguishes these numbers from others that are drawn from the same seed
_GOES_ON: Final = 18


@dataclass(frozen=True, slots=True)
class SeededStart:
    """Start of one attempt.

    Attributes:
        x, y: of the needle's direction there.
        level: by which the hand is unsteady from then on; 0: steady.
        seed: of its unsteadiness, a whole number below 2³².
    """

    x: float
    y: float
    level: int
    seed: int


@dataclass(slots=True)
class Beginnings:
    """Starts of the attempts of a run, one after the other; the same for one seed.

    Attributes:
        seed: of the run.
        level: of the hand, as the exercise has it.
        tilt_limit: of the robot [rad].
        aligned: whether they lie on the path; else off it.
        begun: attempts so far.
        gone_on: attempts so far that such a hand went on with, which somebody else had begun.
    """

    seed: int
    level: int
    tilt_limit: float
    aligned: bool = False
    begun: int = field(default=0)
    gone_on: int = field(default=0)

    def next(self, placed: PlacedPlan) -> SeededStart:
        """Return the start of the next attempt at a plan."""
        random = np.random.default_rng([self.seed, _OWN, self.begun])
        self.begun += 1
        hand = int(random.integers(1, 2**32))
        direction = placed.axis if self.aligned else self._direction(placed.axis, random)
        return SeededStart(float(direction[0]), float(direction[1]), self.level, hand)

    def goes_on(self) -> tuple[int, int]:
        """Return level and seed of a hand that goes on with an attempt that somebody else began."""
        random = np.random.default_rng([self.seed, _GOES_ON, self.gone_on])
        self.gone_on += 1
        return self.level, int(random.integers(1, 2**32))

    def _direction(self, axis: FloatArray, random: np.random.Generator) -> FloatArray:
        from app.simulation.trainee import directions, tangent_basis  # compiled: not at the start

        basis = tangent_basis(axis)
        for _ in range(TRIES):
            off, around = random.uniform(LEAST_OFF, MOST_OFF), random.uniform(0.0, 2.0 * pi)
            first, second = np.array([off * cos(around)]), np.array([off * sin(around)])
            direction: FloatArray = directions(first, second, axis, basis)[0]
            most = max(self.tilt_limit - CLEAR, 0.0)
            if direction[2] < 0.0 and sqrt(1.0 - min(1.0, direction[2] ** 2)) <= sin(most):
                return direction
        return np.array([0.0, 0.0, -1.0])
