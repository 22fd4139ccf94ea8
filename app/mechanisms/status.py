"""What a kinematic kernel says about its answer: integers for compiled code, names for people."""

from enum import IntEnum
from typing import Final

from app.core.messages import sentence
from app.mechanisms.errors import (
    DegenerateError,
    MechanismError,
    NoGripError,
    NotFiniteError,
    SingularError,
    UnreachableError,
)


class Status(IntEnum):
    """Status of a kinematic answer; anything but `OK` comes with finite but meaningless numbers."""

    OK = 0
    UNREACHABLE = 1
    SINGULAR = 2
    NO_GRIP = 3
    DEGENERATE = 4
    NOT_FINITE = 5


# Compiled code takes module-level integers as constants; an enumeration member would be an object.
OK: Final = int(Status.OK)
UNREACHABLE: Final = int(Status.UNREACHABLE)
SINGULAR: Final = int(Status.SINGULAR)
NO_GRIP: Final = int(Status.NO_GRIP)
DEGENERATE: Final = int(Status.DEGENERATE)
NOT_FINITE: Final = int(Status.NOT_FINITE)

_ERRORS: dict[Status, type[MechanismError]] = {
    Status.UNREACHABLE: UnreachableError,
    Status.SINGULAR: SingularError,
    Status.NO_GRIP: NoGripError,
    Status.DEGENERATE: DegenerateError,
    Status.NOT_FINITE: NotFiniteError,
}


def check(status: int, what: str) -> None:
    """Raise the error that belongs to `status`; `what` says which input led there.

    Raises:
        MechanismError: of the family member named by the status.
    """
    if status != OK:
        name = Status(status)
        raise _ERRORS[name](
            sentence("{status}: {cause}", status=name.name.lower().replace("_", " "), cause=what)
        )
