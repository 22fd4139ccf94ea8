"""Leaving the room for a control scan: a wait in the attempt's own time, which counts.

Half of the time is for leaving, then the scan is taken, and the other half is for coming back.
Nobody holds the needle meanwhile: a simulated hand stays where it is. The patient breathes on.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from app.core.messages import sentence
from app.session.control_scan import Taking
from app.session.errors import IllegalTransitionError

KIND: Final = "room"
"""Kind of the event that says that somebody leaves, is back, or could not be scanned."""


@dataclass(frozen=True, slots=True)
class Leave:
    """One way out of the room and back.

    Attributes:
        taking: the scan that is taken outside.
        began: when the student left [s].
        lasts: until he is back [s].
        taken: whether the scan has been taken.
    """

    taking: Taking
    began: float
    lasts: float
    taken: bool = False

    @property
    def due(self) -> float:
        """When the scan is taken [s]."""
        return self.began + 0.5 * self.lasts

    @property
    def back(self) -> float:
        """When the student is at the patient again [s]."""
        return self.began + self.lasts

    def left(self, now: float) -> float:
        """Time until he is back [s]."""
        return max(0.0, self.back - now)


def require_inside(leave: Leave | None, now: float) -> None:
    """Refuse what needs a student in the room.

    Raises:
        IllegalTransitionError: saying how long it takes until he is back.
    """
    if leave is not None:
        raise IllegalTransitionError(
            sentence(
                "you are out of the room for a control scan: back in {left:.0f} s",
                left=leave.left(now),
            )
        )
