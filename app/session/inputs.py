"""What the trainer tells the loop, by meaning instead of by slot; who may switch forces on."""

from __future__ import annotations

from collections.abc import Callable
from math import inf
from typing import TYPE_CHECKING

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen
from app.core.errors import AcusError
from app.core.messages import sentence
from app.device.readiness import ForceClearance
from app.planning.placement import PlacedPlan
from app.session.errors import NotReadyError

if TYPE_CHECKING:
    from app.device.control.shared import Inbox


class LoopInputs:
    """The loop's inputs; every value is checked before it crosses over.

    Attributes:
        assistance: dial as last set, -1...1.
        armed: whether forces are armed.
        rolled: roll of the needle as last set [rad].
    """

    def __init__(self, inbox: Inbox) -> None:
        self._inbox = inbox
        self.rolled = 0.0
        self.assistance = 0.0
        self.armed = False
        self._beat = -inf
        self._prepared = False

    def prepare(self, placed: PlacedPlan, assistance: float) -> None:
        """Set path, target and the exercise's assistance, the first time only."""
        if not self._prepared:
            self._prepared = True
            self.path(placed.axis, placed.p_target)
            self.assist(assistance)

    def path(self, axis: FloatArray, p_target: FloatArray) -> None:
        """Set the wanted direction (unit vector) and the target at rest [m]."""
        a, t = frozen(axis, (3,), "path").tolist(), frozen(p_target, (3,), "target").tolist()
        self._inbox.write(
            path_x=a[0], path_y=a[1], path_z=a[2], target_x=t[0], target_y=t[1], target_z=t[2]
        )

    def assist(self, value: float) -> None:
        """Set the assistance, clamped to -1...1.

        Raises:
            NumericalError: if it is not a number.
        """
        self.assistance = float(np.clip(frozen(value, (), "assistance"), -1.0, 1.0))
        self._inbox.write(assistance=self.assistance)

    def arm(self, armed: bool) -> None:
        """Arm or disarm the forces."""
        self.armed = armed
        self._inbox.write(enabled=float(armed))

    def clear(self, homed: float, force_cap: float) -> None:
        """Say whether the device is homed (1 or 0) and how much force it is cleared for [N].

        Raises:
            NumericalError: if a value is not finite.
        """
        checked = frozen((homed, force_cap), (2,), "clearance").tolist()
        self._inbox.write(homed=float(checked[0] > 0.5), force_cap=max(checked[1], 0.0))

    def hand(self, x: float, y: float, depth: float, holds: bool) -> None:
        """Move the simulated hand: direction (x, y), depth [m].

        Raises:
            NumericalError: if a value is not finite.
        """
        checked = frozen((x, y, depth), (3,), "hand").tolist()
        self._inbox.write(
            hand_x=checked[0], hand_y=checked[1], hand_depth=checked[2], hand_holds=float(holds)
        )

    def unsteady(self, level: int, seed: int) -> None:
        """Make the simulated hand unsteady by an exercise's level, 0 for not at all."""
        self._inbox.write(hand_level=float(level), hand_seed=float(seed))

    def hold_breath(self, held: bool) -> None:
        """Ask the simulated patient to hold the breath, or to breathe."""
        self._inbox.write(hold_breath=float(held))

    def roll(self, angle: float) -> None:
        """Set the roll of the needle [rad], clockwise seen from the hub.

        Raises:
            NumericalError: if it is not a number.
        """
        self.rolled = float(frozen(angle, (), "roll"))
        self._inbox.write(needle_roll=self.rolled)

    def tracked(self, depth: float, time: float, variance: float) -> None:
        """Hand over a depth that the cameras measured [m], its time [s] and variance [m²]."""
        values: ArrayLike = (depth, time, variance)
        checked = frozen(values, (3,), "tracked depth").tolist()
        self._inbox.write(
            tracked_depth=checked[0], tracked_time=checked[1], tracked_variance=checked[2]
        )

    def untracked(self) -> None:
        """Say that no depth is measured: from the next tick on it may be anywhere."""
        self._inbox.write(tracked_time=0.0)

    def heartbeat(self, now: float) -> None:
        """Tell the loop that the window lives [s]."""
        self._beat = now
        self._inbox.write(heartbeat=now)

    def silence(self, now: float) -> float:
        """Time since the window's last sign of life [s]; infinite before the first."""
        return now - self._beat


ClearanceOf = Callable[[], ForceClearance]
"""Asks the device what it is cleared for now; may change with a power cycle of its board."""


class Arming:
    """Arms and disarms the forces; the loop brings them up over a second and cuts them at once.

    With `held` they are on only while a key or pedal is held during an attempt, so an attempt
    begins without force; otherwise they are on for the whole attempt.

    Args:
        inputs: of the loop.
        held: whether a key or pedal must be held.
        clearance: of the device; None where whoever built the loop has written it.

    Attributes:
        held: see above.
        clearance: as last answered; None if nobody is asked.
    """

    def __init__(
        self, inputs: LoopInputs, held: bool = False, clearance: ClearanceOf | None = None
    ) -> None:
        self.held = held
        self.clearance: ForceClearance | None = None
        self._inputs = inputs
        self._asked = clearance
        self._written: tuple[float, float] | None = None

    def begin(self) -> None:
        """Begin an attempt: forces on, or off until the key is held."""
        self._inputs.arm(not self.held)

    def arm(self, running: Callable[[], bool]) -> None:
        """Switch the forces on; a held key does so only while an attempt runs.

        The attempt may end in another thread meanwhile, which is why it is looked at twice.
        """
        if self.held and not running():
            return
        self._inputs.arm(True)
        if self.held and not running():
            self._inputs.arm(False)

    def pause(self, before: bool, now: bool) -> None:
        """Switch the forces off as a pause begins, and as at the beginning when it ends."""
        if now and not before:
            self._inputs.arm(False)
        elif before and not now:
            self.begin()

    def off(self) -> None:
        """Switch the forces off."""
        self._inputs.arm(False)

    def require(self) -> None:
        """Ask, and refuse what must not begin on a device that is not homed.

        Raises:
            NotReadyError: with the device's own reason.
        """
        self.ask()
        if self.clearance is not None and not self.clearance.homed > 0.5:
            raise NotReadyError(self.clearance.reason or sentence("the robot is not homed"))

    def ask(self) -> None:
        """Ask what the device is cleared for, and tell the loop if it has changed."""
        if self._asked is None:
            return
        try:
            self.clearance = self._asked()
        except AcusError as error:
            self.clearance = ForceClearance(0.0, 0.0, str(error))
        now = (float(self.clearance.homed), float(self.clearance.force_cap))
        if now != self._written:
            self._inputs.clear(*now)
            self._written = now
