"""Listens to an OpenIGTLink server, such as PLUS or 3D Slicer, in a thread of its own.

Transforms are handed on as they come; whatever else is sent is read over. A peer that is gone is
looked for again, after 0.1 s at first and 5 s at most.
"""

from __future__ import annotations

import socket
import threading
import time
from collections.abc import Callable, Iterator
from dataclasses import dataclass
from typing import Final

from app.core.errors import AcusError
from app.core.messages import sentence
from app.exchange.errors import LinkAddressError, LinkMessageError
from app.exchange.live import igtl_messages as igtl
from app.exchange.live.journal import LinkJournal

LONGEST_TRANSFORM: Final = 1 << 16
LONGEST_OTHER: Final = 1 << 28
"""Bytes of a body: of one that is read, and of one that is read over."""

FIRST_WAIT, LONGEST_WAIT = 0.1, 5.0
SILENCE: Final = 10.0
"""A peer that says nothing for so long [s] is gone: PLUS sends a STATUS every few seconds."""

_LOOK: Final = 0.2
_CHUNK: Final = 1 << 16


@dataclass(frozen=True, slots=True)
class Address:
    """Where a server is."""

    host: str
    port: int = igtl.PORT

    @classmethod
    def of(cls, text: str) -> Address:
        """Read HOST, HOST:PORT, [IPV6] or [IPV6]:PORT.

        Raises:
            LinkAddressError: if it is none of these.
        """
        if text.startswith("["):
            host, _, rest = text[1:].partition("]")
        elif text.count(":") > 1:
            host, rest = text, ""
        else:
            host, colon, rest = text.partition(":")
            rest = colon + rest
        port = rest.removeprefix(":") or str(igtl.PORT)
        known = rest in ("", ":") or rest.startswith(":")
        if not (known and host and port.isdecimal() and 0 < int(port) < 65536):
            raise LinkAddressError(
                sentence(
                    "igtl:{address} is no address of an OpenIGTLink server; valid are igtl:HOST, "
                    "igtl:HOST:PORT and igtl:[::1]:PORT",
                    address=text,
                )
            )
        return cls(host, int(port))

    def __str__(self) -> str:
        host = f"[{self.host}]" if ":" in self.host else self.host
        return f"{host}:{self.port}"


class IgtlClient:
    """Hands on the transforms of one server.

    Args:
        address: of the server.
        take: gets every TRANSFORM message and the monotonic time [s] at which it had come.

    Attributes:
        journal: what happened to the connection.
        connected: whether there is one now.
    """

    def __init__(self, address: Address, take: Callable[[igtl.Message, float], None]) -> None:
        self.address, self.journal, self.connected = address, LinkJournal(), False
        self._hand_on = take
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None

    def open(self) -> None:
        """Start to look for the server; idempotent."""
        if self._thread is None:
            self._stop.clear()
            self._thread = threading.Thread(target=self._run, name="igtl-client", daemon=True)
            self._thread.start()

    def close(self) -> None:
        """Leave it; idempotent."""
        self._stop.set()
        thread, self._thread = self._thread, None
        if thread is not None and thread is not threading.current_thread():
            thread.join(timeout=2.0)

    def _run(self) -> None:
        wait = FIRST_WAIT
        while not self._stop.is_set():
            try:
                with socket.create_connection(
                    (self.address.host, self.address.port), timeout=1.0
                ) as peer:
                    self.connected, wait = True, FIRST_WAIT
                    self.journal.say(f"connected to {self.address}")
                    self._listen(peer)
            except (AcusError, OSError, UnicodeError) as error:
                why = getattr(error, "strerror", None) or str(error) or type(error).__name__
                self.journal.say(f"{self.address}: {why}", why)
            self.connected = False
            self._stop.wait(wait)
            wait = min(2.0 * wait, LONGEST_WAIT)

    def _listen(self, peer: socket.socket) -> None:
        """Read messages until the connection ends.

        Raises:
            LinkMessageError: if what comes is no OpenIGTLink.
            OSError: if the connection ends.
        """
        peer.settimeout(_LOOK)
        hello = igtl.packed("GET_STATUS", "Acus", time.time(), b"", 2)
        peer.sendall(hello)  # by it the server knows that version 2, with metadata, is understood
        while not self._stop.is_set():
            head = igtl.head_of(self._read(peer, igtl.HEADER.size), LONGEST_OTHER)
            if head.kind != "TRANSFORM":
                self._read_over(peer, head.size)
                continue
            if head.size > LONGEST_TRANSFORM:
                raise LinkMessageError(sentence("TRANSFORM announces {size} bytes", size=head.size))
            body = self._read(peer, head.size)
            try:
                self._hand_on(igtl.message_of(head, body), time.monotonic())
            except LinkMessageError as error:  # of this message alone
                self.journal.say(str(error), f"{head.device} refused")

    def _read(self, peer: socket.socket, size: int) -> bytes:
        found = bytearray()
        for chunk in self._chunks(peer, size):
            found += chunk
        return bytes(found)

    def _read_over(self, peer: socket.socket, size: int) -> None:
        for _ in self._chunks(peer, size):
            pass

    def _chunks(self, peer: socket.socket, size: int) -> Iterator[bytes]:
        since = time.monotonic()
        while size:
            if self._stop.is_set():
                raise OSError("it is left")
            try:
                chunk = peer.recv(min(size, _CHUNK))
            except TimeoutError:
                if time.monotonic() - since > SILENCE:
                    raise OSError(f"silent for {SILENCE:g} s") from None
                continue
            if not chunk:
                raise OSError("it has closed the connection")
            since = time.monotonic()
            size -= len(chunk)
            yield chunk


JUMP: Final = 1.0
"""From here on [s] a peer's clock was set."""

DRIFT: Final = 1e-3
"""How much slower than ours its clock may be."""


class PeerTime:
    """Brings a peer's time stamps to our monotonic clock.

    What arrives with the least delay stands for the offset of the clocks; what is later than that
    was longer on its way. No stamp, or a peer whose clock is set, starts anew at the arrival.
    """

    def __init__(self) -> None:
        self._offset: float | None = None
        self._last = 0.0

    def captured(self, stamp: float, arrived: float) -> float:
        """Return when something was captured [s, monotonic].

        Args:
            stamp: its time by the peer [s]; 0 for none.
            arrived: monotonic time of its arrival [s].
        """
        if not stamp > 0.0:
            return arrived
        offset = arrived - stamp
        if self._offset is None or abs(offset - self._offset) > JUMP:
            self._offset = offset
        else:
            crept = self._offset + DRIFT * max(0.0, arrived - self._last)
            self._offset = min(offset, crept)
        self._last = arrived
        return min(arrived, stamp + self._offset)
