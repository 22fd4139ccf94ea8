"""The simulated robot's link: encoder readings of the plant, torques to the plant."""

from collections.abc import Iterable
from dataclasses import dataclass
from math import pi
from typing import Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import stage
from app.core.parameters import Stage, numbered, packed
from app.device.links.link import Link
from app.mechanisms.profile import DeviceProfile


class _SimulatedPlaces(NamedTuple):
    """One count of the encoders, and the joint angles at zero counts [rad]."""

    one_count: int
    home_left: int
    home_right: int


_AT: Final = numbered(_SimulatedPlaces)


@stage
def encoder_stage(state: FloatArray, p: FloatArray) -> None:
    """Copy PLANT_Q_* into Q_*, as whole counts from the home offsets, and stamp Q_TIME."""
    count = p[_AT.one_count]
    # numpy's floor stays a float: a NaN stays NaN and is seen by safety, not turned into a count.
    left = np.floor((state[sv.PLANT_Q_LEFT] - p[_AT.home_left]) / count + 0.5)
    right = np.floor((state[sv.PLANT_Q_RIGHT] - p[_AT.home_right]) / count + 0.5)
    state[sv.Q_LEFT] = p[_AT.home_left] + left * count
    state[sv.Q_RIGHT] = p[_AT.home_right] + right * count
    state[sv.Q_TIME] = state[sv.TIME]


@stage
def gauge_stage(state: FloatArray, p: FloatArray) -> None:
    """Copy what the simulated cables' gauges and reels measure into CABLE_* and REEL_*."""
    for k in range(4):
        state[sv.CABLE_1 + k] = state[sv.PLANT_CABLE_1 + k]
        state[sv.REEL_1 + k] = state[sv.PLANT_REEL_1 + k]


@dataclass(frozen=True, slots=True)
class SimulatedEncoders:
    """Encoders of the simulated robot.

    Attributes:
        counts_per_turn: counts per turn of the joint.
        home_offsets: joint angles at zero counts [rad], (left, right).
    """

    counts_per_turn: int
    home_offsets: tuple[float, float]

    def stage(self) -> Stage:
        """Return the stage for a loop's table."""
        left, right = self.home_offsets
        count = 2.0 * pi / self.counts_per_turn
        parameters = packed(_AT, one_count=count, home_left=left, home_right=right)
        return Stage("encoders", encoder_stage, parameters)


def simulated_link(profile: DeviceProfile, plant: Iterable[Stage]) -> Link:
    """Link to a simulated plant.

    Args:
        profile: gives the encoders' resolution; cables have gauges beside them.
        plant: stages that read TORQUE_* and write PLANT_*, run after safety.
    """
    encoders = SimulatedEncoders(profile.encoder.counts_per_turn, profile.encoder.home_offsets)
    read = [encoders.stage()]
    if profile.tension_range is not None:
        read.append(Stage("gauges", gauge_stage, np.zeros(1)))
    return Link.of(read, plant)
