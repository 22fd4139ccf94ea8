"""What a robot is to the rest of the program: stages for the loop, life and health for people."""

from abc import ABC, abstractmethod
from collections.abc import Iterable
from dataclasses import dataclass
from enum import IntEnum
from typing import Final, NamedTuple

from app.core.events import EventQueue
from app.core.latest import Latest
from app.core.messages import sentence
from app.core.parameters import Stage

"""(name, compiled function, parameters): a stage of the tick."""


class LinkStatus(IntEnum):
    """Value of the slot `LINK_STATUS`: what the loop knows of its wire."""

    FINE = 0
    CONNECTING = 1
    SILENT = 2
    CLOSED = 3
    WRONG_VERSION = 4


@dataclass(frozen=True, slots=True)
class Link:
    """The two ends of a tick.

    Attributes:
        read: stages that write Q_LEFT, Q_RIGHT and Q_TIME, before everything else.
        write: stages that send TORQUE_LEFT and TORQUE_RIGHT, after safety.
    """

    read: tuple[Stage, ...]
    write: tuple[Stage, ...]

    @classmethod
    def of(cls, read: Iterable[Stage], write: Iterable[Stage]) -> "Link":
        """Build a link from any two collections of stages."""
        return cls(tuple(read), tuple(write))


@dataclass(frozen=True, slots=True)
class BoardInfo:
    """What a robot says about itself.

    Attributes:
        profile: name of the device profile that it was built for; empty if it does not say.
        serial: its serial number; empty if it has none. Calibrations are kept by it.
        firmware: version, for people.
        protocol: version of the wire protocol that it speaks.
        boot: number of its power cycle: homing and sign check count for one `boot` only.
        gauge: whether it measures the force.
        simulated: whether there is no hardware behind it: the plant is part of the loop.
        emulated: whether another program plays the board, by its own word or because the port is a
            pseudo-terminal, behind which no hardware can be.
        ready: whether it finds its zero by itself, and its signs are its maker's: there is nothing
            to commission; its forces were never weighed.
    """

    profile: str
    serial: str
    firmware: str
    protocol: str
    boot: int
    gauge: bool = False
    simulated: bool = False
    emulated: bool = False
    ready: bool = False

    @property
    def kind(self) -> str:
        """Return what is at the other end: `real`, `emulated` or `simulated`."""
        return "simulated" if self.simulated else "emulated" if self.emulated else "real"


class Hub(NamedTuple):
    """The needle by its hub.

    Attributes:
        axis: direction, hub to tip.
        l_out: hub to entry [m].
        inside: whether a needle can be there; if not, `axis` is the nearest that can.
    """

    axis: tuple[float, float, float]
    l_out: float
    inside: bool


class ToldHub(NamedTuple):
    """What a device tells of the needle by itself.

    Attributes:
        latest: the hub, with the time of the reading.
        events: what people must know of it.
    """

    latest: Latest[Hub]
    events: EventQueue


class DeviceLink(ABC):
    """A robot at the end of a wire, or in memory. `open` does I/O, `close` is idempotent.

    Attributes:
        hub: the needle as the device tells it; None where cameras have to look for it.
    """

    hub: ToldHub | None = None

    @abstractmethod
    def open(self) -> None:
        """Connect and learn who is there.

        Raises:
            LinkError: if nobody answers, or somebody else; says what to do.
        """

    @abstractmethod
    def close(self) -> None:
        """Let go of the wire; the loop has sent zero torque before."""

    @abstractmethod
    def stages(self) -> Link:
        """Return the stages of the tick; they live as long as the link, across reconnections."""

    @abstractmethod
    def info(self) -> BoardInfo:
        """Return who was found by the last successful `open` or reconnection."""


class BoardError(IntEnum):
    """What a board reports in the slot BOARD_ERROR."""

    NONE = 0
    TORQUE_NOT_FINITE = 1
    HOME_REFUSED = 2
    ENCODER = 3
    AMPLIFIER = 4
    SUPPLY_OFF = 5
    TOO_HOT = 6
    INTERNAL = 7

    @property
    def message(self) -> str:
        """Say what it means and what to do."""
        return _MESSAGES[self]


_MESSAGES: Final = {
    BoardError.NONE: "no error",
    BoardError.TORQUE_NOT_FINITE: "the board was sent a torque that is not a number",
    BoardError.HOME_REFUSED: "the board homes only while its motors are off and for the power"
    " cycle it is in; disarm and try again",
    BoardError.ENCODER: "an encoder is missing or skips; check its cable",
    BoardError.AMPLIFIER: "a motor amplifier reports a fault; switch its supply off and on",
    BoardError.SUPPLY_OFF: "the motor supply is off; release the emergency switch",
    BoardError.TOO_HOT: "a motor or amplifier is too hot; let it cool down",
    BoardError.INTERNAL: "the board's program reports an error of its own; reset it",
}


def describe_error(code: int) -> str:
    """Text for a board's error number, known or not."""
    if code in tuple(BoardError):
        return BoardError(code).message
    return sentence(
        "the board reports error {code}, which this program does not know; see its firmware",
        code=code,
    )
