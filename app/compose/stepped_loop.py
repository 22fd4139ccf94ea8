"""A loop in virtual time that is stepped from outside: rows, clock and hand, and no trainer."""

from __future__ import annotations

from math import isfinite, sqrt
from typing import TYPE_CHECKING, Final, NamedTuple

import numpy as np
from numpy.typing import ArrayLike

from app.compose.trial_parts import BEGIN, SETTLED, STEP_TICKS
from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.bend import tip_beside
from app.core.clock import VirtualClock
from app.core.errors import NumericalError
from app.core.messages import sentence
from app.core.parameters import Stage
from app.core.staleness import TRACKER_HOLD
from app.device.control import Loop, Table
from app.session.inputs import LoopInputs
from app.simulation.plant import SimulatedHand, initial_plant
from app.tracking.simulated.sampled import cover

if TYPE_CHECKING:
    from app.mechanisms.profile import DeviceProfile
    from app.planning.placement import PlacedPlan

WAITS: Final = -0.015
"""Where the needle waits: tip 15 mm above the skin [m]."""

HEARTBEATS: Final = 10
"""Looks from one sign of life of the window to the next: 0.2 s, of 1 s that the loop allows."""


_HAND: Final = SimulatedHand()
_REACH: Final = 0.02
"""A wish runs no farther ahead of the needle than this, across at the hub and along [m]."""


class NeedleSeen(NamedTuple):
    """What is known of the needle at a moment, by the rules of `session.fusion`.

    Attributes:
        measured: whether the cameras have measured the depth; else it is the model's.
        depth: of the tip [m].
        axis: hub to tip, unit, shape (3,).
        tip: as the tissue bends it [m], shape (3,).
        true_tip: the same, whatever the cameras say.
    """

    measured: bool
    depth: float
    axis: FloatArray
    tip: FloatArray
    true_tip: FloatArray


def bends_of(rows: FloatArray) -> FloatArray:
    """Return `Bend.numbers` of states of the loop, shape (n, 10); NaN where there is no bend."""
    bend = np.column_stack(
        [
            rows[:, sv.TIP_OFFSET],
            rows[:, sv.TIP_SLOPE],
            rows[:, sv.ROOT_CURVATURE],
            rows[:, sv.BENT_LENGTH],
        ]
    )
    bend[~(bend[:, 9] > 0.0)] = np.nan
    return bend


class SteppedLoop:
    """An attempt that has begun: the forces are armed, and its time stands until it is stepped.

    Args:
        table: what is computed in a tick.
        cameras: its stage that measures the depth.
        profile: of the device.
        placed: plan as robot and hand have it.
        dial: of the robot's help.
        axis: direction that the needle has at the beginning, hub to tip, shape (3,).

    Attributes:
        dial: of the robot's help.
        begin: when the attempt began [s].
        rows: the loop's state at each look since then, each of shape (slots,).
    """

    def __init__(
        self,
        table: Table,
        cameras: Stage,
        profile: DeviceProfile,
        placed: PlacedPlan,
        dial: float,
        axis: ArrayLike,
    ) -> None:
        x, y, _ = np.asarray(axis, np.float64).tolist()
        self.dial, self.rows = dial, list[FloatArray]()
        self._clock, self._cameras = VirtualClock(BEGIN), cameras
        self._length, self._fulcrum = profile.needle_length, profile.fulcrum
        initial = initial_plant(profile, axis, WAITS)
        self._loop = Loop(table, profile.rate_hz, self._clock, initial=initial)
        self._loop.inbox.write(
            hand_x=x,
            hand_y=y,
            hand_depth=WAITS,
            hand_holds=1.0,
            homed=1.0,
            force_cap=profile.limits.hand_force,
        )
        self._inputs = LoopInputs(self._loop.inbox)
        self._inputs.prepare(placed, dial)
        self._loop.open()
        self._inputs.heartbeat(BEGIN)
        self._tick = round(SETTLED * profile.rate_hz)
        self._loop.step(self._tick)
        self.begin = self._clock.now()
        self._inputs.arm(True)

    @property
    def now(self) -> float:
        """Return the virtual time [s]."""
        return self._clock.now()

    @property
    def row(self) -> FloatArray:
        """Return the newest state of the loop, shape (slots,)."""
        return self.rows[-1] if self.rows else self._loop.rows(self._tick - 1)[0]

    def seen(self) -> NeedleSeen:
        """Return what is known of the needle now."""
        row = self.row
        since = float(row[sv.TRACKED_TIME])
        measured = since > 0.0 and row[sv.TIME] - since <= TRACKER_HOLD
        depth = float(row[sv.TRACKED_DEPTH] if measured else row[sv.DEPTH])
        axis = row[sv.AXIS]
        axis = axis / sqrt(float(axis @ axis))
        tip = self._fulcrum + depth * axis
        if row[sv.BENT_LENGTH] > 0.0:
            tip += tip_beside(
                row[sv.TIP_OFFSET],
                row[sv.TIP_SLOPE],
                row[sv.ROOT_CURVATURE],
                float(row[sv.BENT_LENGTH]),
                depth,
            )
        return NeedleSeen(measured, depth, axis, tip, tip + (row[sv.PLANT_DEPTH] - depth) * axis)

    @property
    def felt(self) -> FloatArray:
        """Return the force at the hub that the robot lets the hand feel [N], shape (3,)."""
        felt: FloatArray = self.row[sv.FELT]
        return felt

    @property
    def lever(self) -> float:
        """Return how far the hub is from the fulcrum [m]."""
        return max(self._length - float(self.row[sv.PLANT_DEPTH]), 1e-3)

    def within_reach(self, x: float, y: float, depth: float) -> tuple[float, float, float]:
        """Return a wish no farther from the needle than a hand would have it."""
        row, across = self.row, _REACH / self.lever
        return (
            _near(x, float(row[sv.AXIS_X]), across),
            _near(y, float(row[sv.AXIS_Y]), across),
            _near(depth, float(row[sv.PLANT_DEPTH]), _REACH),
        )

    def pressing(
        self, across_x: float, across_y: float, along: float
    ) -> tuple[float, float, float]:
        """Return the wish (x, y, depth) by which the hand's springs press with a force [N] at most.

        What resists with more stands, what resists with less yields at the hand's own speed.
        """
        row, k = self.row, _HAND.stiffness * self.lever
        return (
            float(row[sv.AXIS_X]) + across_x / k,
            float(row[sv.AXIS_Y]) + across_y / k,
            float(row[sv.PLANT_DEPTH]) + along / _HAND.axial_stiffness,
        )

    def cover(self, until: float) -> None:
        """Cover both cameras until a time [s]."""
        cover(self._cameras, until)

    def hand(self, x: float, y: float, depth: float) -> None:
        """Say where the simulated hand is wanted: direction (x, y) and depth [m].

        Raises:
            NumericalError: if one is not finite.
        """
        if not isfinite(x + y + depth):
            raise NumericalError(
                sentence("the hand is wanted at {place}: give finite values", place=(x, y, depth))
            )
        self._loop.inbox.write(hand_x=x, hand_y=y, hand_depth=depth)

    def step(self) -> FloatArray:
        """Let time pass until the next look, 20 ms, and return the loop's state then."""
        if len(self.rows) % HEARTBEATS == 0:
            self._inputs.heartbeat(self._clock.now())
        self._loop.step(STEP_TICKS)
        self._tick += STEP_TICKS
        self.rows.append(self._loop.rows(self._tick - 1)[0])
        return self.rows[-1]

    def close(self) -> None:
        """End it; idempotent."""
        self._loop.close()


def _near(value: float, middle: float, most: float) -> float:
    return min(max(value, middle - most), middle + most)
