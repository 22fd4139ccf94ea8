"""What a link to a robot is to the loop: stages that bring angles in and carry torques out."""

from collections.abc import Iterable
from dataclasses import dataclass
from typing import Any

from app.core.arrays import FloatArray

Triple = tuple[str, Any, FloatArray]
"""(name, compiled function, parameters): a stage of the tick."""


@dataclass(frozen=True, slots=True)
class Link:
    """The two ends of a tick.

    Attributes:
        read: stages that write Q_LEFT, Q_RIGHT and Q_TIME, before everything else.
        write: stages that send TORQUE_LEFT and TORQUE_RIGHT, after safety.
    """

    read: tuple[Triple, ...]
    write: tuple[Triple, ...]

    @classmethod
    def of(cls, read: Iterable[Triple], write: Iterable[Triple]) -> "Link":
        """Build a link from any two collections of stages."""
        return cls(tuple(read), tuple(write))
