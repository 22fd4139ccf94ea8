"""A conversation with a board by hand: bytes out, frames in, each with its time.

Not for the loop: every answer is kept, those that come twice, late or unasked too.
"""

import os
import select
import struct
import time
from dataclasses import dataclass
from typing import Final

from app.device.links import acus_protocol as acus
from app.device.links import cable_protocol as cables
from app.device.links import framing
from app.device.links.port import Port, reason

ANSWER: Final = 0.3
"""How long an answer is waited for [s]: some serial adapters collect bytes for 16 ms."""

SETTLE: Final = 0.004
"""How long is waited for a second answer after the first [s]."""

SILENT: Final = 0.03
"""How long is waited where none may come [s]."""


class DepartureError(Exception):
    """The board departs from the protocol; says how."""


class UnseenError(Exception):
    """A rule cannot be seen here; says why, and what would show it."""


@dataclass(frozen=True, slots=True)
class HeardState:
    """One STATE of a board.

    Attributes:
        heard: when it came [s].
        flags, sequence, error: as in docs/protocol.md.
        time: since the board's power-up [µs], modulo 2³².
        counts: of the left and right joint.
        tensions, reeled: of the cables [N], [m]; empty of a robot without.
    """

    heard: float
    flags: int
    sequence: int
    time: int
    counts: tuple[int, int]
    error: int
    tensions: tuple[float, ...] = ()
    reeled: tuple[float, ...] = ()

    def has(self, flag: int) -> bool:
        """Return whether a flag is set."""
        return bool(self.flags & flag)


class Talk:
    """What is said to a board and what it answers.

    Args:
        port: an open port.
        version: of the protocol: 1 with two joint torques, 2 with four cables.
    """

    def __init__(self, port: Port, version: int) -> None:
        self.version = version
        self.channels = 2 if version == acus.VERSION else cables.CHANNELS
        self.states: list[HeardState] = []
        """Every STATE that was heard, in its order."""
        self.sequence = 64990
        self._port = port
        self._deframer = framing.Deframer()

    @property
    def damaged(self) -> int:
        """Frames that came damaged so far."""
        return self._deframer.errors

    def send(self, data: bytes) -> float:
        """Send bytes; return when they went out [s].

        Raises:
            DepartureError: if the port takes them no more.
        """
        try:
            while data:
                data = data[os.write(self._port.fd, data) :]
        except BlockingIOError:
            raise DepartureError("the port takes no more bytes: nobody reads them") from None
        except OSError as error:
            raise DepartureError(str(reason(self._port.path, self._port.baud, error))) from error
        return time.monotonic()

    def hear(self, seconds: float, enough: int | None = None) -> list[bytes]:
        """Return the messages that come in a time; no later than `SETTLE` after `enough` of them.

        Raises:
            DepartureError: if the port has gone.
        """
        heard: list[bytes] = []
        end = time.monotonic() + seconds
        while (left := end - time.monotonic()) > 0.0:
            if not select.select([self._port.fd], [], [], left)[0]:
                break
            try:
                data = os.read(self._port.fd, 4096)
            except OSError as error:
                raise DepartureError(
                    str(reason(self._port.path, self._port.baud, error))
                ) from error
            for message in self._deframer.feed(data):
                heard.append(message)
                self._keep(message)
            if enough is not None and len(heard) >= enough:
                end, enough = min(end, time.monotonic() + SETTLE), None
        return heard

    def _keep(self, message: bytes) -> None:
        kind, length = (
            (acus.STATE, (acus.STATE_BYTES, acus.STATE_WITH_FORCE_BYTES))
            if self.version == acus.VERSION
            else (cables.STATE, (cables.STATE_BYTES,))
        )
        if message[0] == kind and len(message) in length:
            _, flags, sequence, at, left, right, error = struct.unpack("<BBHIiiB", message[:17])
            rest = struct.unpack("<8f", message[17:]) if self.version != acus.VERSION else ()
            self.states.append(
                HeardState(
                    *(time.monotonic(), flags, sequence, at, (left, right), error),
                    *(rest[:4], rest[4:]),
                )
            )

    def command(
        self, enable: bool = True, channels: tuple[float, ...] | None = None, flags: int = 0
    ) -> bytes:
        """Return the next COMMAND's frame: zero torque, or the least that four channels can have.

        Further `flags` are set beside enable.
        """
        self.sequence = (self.sequence + 1) & 0xFFFF
        kind = acus.COMMAND if self.version == acus.VERSION else cables.COMMAND
        flags |= acus.ENABLE if enable else 0
        asked = channels or (0.0,) * self.channels
        return framing.frame(
            struct.pack(f"<BBH{self.channels}f", kind, flags, self.sequence, *asked)
        )

    def ask(
        self, enable: bool = True, channels: tuple[float, ...] | None = None, flags: int = 0
    ) -> HeardState:
        """Send a command and return its STATE.

        Raises:
            DepartureError: if it is not answered by one STATE with its number, at once.
        """
        self.quiet()
        before = len(self.states)
        self.send(self.command(enable, channels, flags))
        heard = self.hear(ANSWER, 1)
        new = self.states[before:]
        if len(heard) != 1 or len(new) != 1:
            raise DepartureError(f"a COMMAND got {_named(heard)} instead of one STATE")
        if new[0].sequence != self.sequence:
            raise DepartureError(
                f"COMMAND {self.sequence} was answered by a STATE with number {new[0].sequence}"
            )
        return new[0]

    def quiet(self) -> None:
        """Look that nothing is left over.

        Raises:
            DepartureError: if something has come that was not waited for.
        """
        heard = self.hear(0.0005)
        if heard:
            raise DepartureError(f"{_named(heard)} came late, twice or unasked")

    def hello(self, version: int | None = None) -> bytes:
        """Greet the board; return its INFO.

        Raises:
            DepartureError: if no INFO comes, or more than that.
        """
        self.quiet()
        self.send(acus.hello(self.version if version is None else version))
        heard = self.hear(ANSWER, 1)
        if len(heard) != 1 or heard[0][0] != acus.INFO:
            raise DepartureError(f"HELLO got {_named(heard)} instead of one INFO")
        return heard[0]

    def unanswered(self, data: bytes, what: str) -> None:
        """Send what no board may answer.

        Raises:
            DepartureError: if something comes.
        """
        self.send(data)
        heard = self.hear(SILENT, 1)
        if heard:
            raise DepartureError(f"{what} got {_named(heard)}: it is to be ignored")

    def pause(self, seconds: float) -> None:
        """Say nothing for a while, counted from now."""
        end = time.monotonic() + seconds
        time.sleep(max(seconds - 0.001, 0.0))
        while time.monotonic() < end:
            pass


def _named(messages: list[bytes]) -> str:
    names = {acus.INFO: "INFO", acus.STATE: "STATE", cables.STATE: "STATE of version 2"}
    kinds = [names.get(message[0], f"0x{message[0]:02x}") for message in messages]
    return " and ".join(kinds[:4]) + (f" and {len(kinds) - 4} more" * (len(kinds) > 4)) or "nothing"
