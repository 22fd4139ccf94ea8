"""Who may switch the forces on, and how much force the device is cleared for."""

from collections.abc import Callable
from dataclasses import dataclass

from app.core.errors import AcusError
from app.session.errors import NotReadyError
from app.session.inputs import LoopInputs
from app.session.ports import ClearancePort

ClearanceOf = Callable[[], ClearancePort]
"""Asks the device what it is cleared for now; may change with a power cycle of its board."""


@dataclass(frozen=True, slots=True)
class NoClearance:
    """The answer of a device that cannot be asked: no force, and why.

    Attributes:
        reason: why, one line.
        homed: 0.
        force_cap: 0 [N].
    """

    reason: str
    homed: float = 0.0
    force_cap: float = 0.0


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
        self.clearance: ClearancePort | None = None
        self._inputs = inputs
        self._ask = clearance
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
        self.look()
        if self.clearance is not None and not self.clearance.homed > 0.5:
            raise NotReadyError(self.clearance.reason or "the robot is not homed")

    def look(self) -> None:
        """Ask what the device is cleared for, and tell the loop if it has changed."""
        if self._ask is None:
            return
        try:
            self.clearance = self._ask()
        except AcusError as error:
            self.clearance = NoClearance(str(error))
        now = (float(self.clearance.homed), float(self.clearance.force_cap))
        if now != self._written:
            self._inputs.clear(*now)
            self._written = now
