"""What one request to a PACS may take: of time, of memory and of what it sends.

The network library reads whatever length a peer announces, for as long as it drips, and queues what
nobody has taken yet. So each connection of a request reads through `RequestLimits` instead: one
clock for all of it, no PDU over a megabyte, pictures to the disk and nothing else over a megabyte,
and a few messages ahead of whoever takes them.
"""

import ipaddress
import shutil
import socket
import threading
import time
from collections.abc import Callable
from functools import partial
from pathlib import Path
from tempfile import NamedTemporaryFile
from typing import Any, Final

from app.core.progress import Cancelled, Progress
from app.imaging.pacs.settings import PacsSettings

MOST_PDU: Final = 1 << 20
"""Longest PDU that is read [bytes]; we announce 16 kB."""

_MOST_GREETING: Final = 1 << 17
"""The same before there is an association."""

MOST_MESSAGE: Final = 1 << 20
"""Longest message that is no picture [bytes]."""

_MOST_WORDS: Final = 1 << 26
"""All messages together that are no pictures [bytes]."""

LARGEST_PICTURE: Final = 2 * 1024**3
SPARE_BYTES: Final = 256 * 1024**2
"""What stays free of a disk to which pictures are written."""

_AHEAD: Final = 4
"""Messages that may wait for whoever takes them."""

SILENCES: Final = 4.0
"""A request as a whole may take so many of the silences that are borne, and more for what comes."""

LEAST_RATE: Final = 20_000.0
"""Pictures come at least as fast [bytes/s]; slower ones use up the clock."""

_LOOK_S: Final = 0.2
_LOOK_AT_DISK: Final = 1 << 24
_PIECE: Final = 1 << 16


class RequestLimits:
    """What is left of what one request may take; shared by all its connections.

    Args:
        settings: of the PACS.
        progress: of whoever asked; looked at for a cancel.
        folder: to which pictures are written while they come; none come where it is None.

    Attributes:
        problem: what was too much; empty while nothing was.
        strangers: addresses that tried to send pictures and may not.
    """

    def __init__(
        self, settings: PacsSettings, progress: Progress, folder: Path | None = None
    ) -> None:
        self._settings, self._progress, self._folder = settings, progress, folder
        self._started = time.monotonic()
        self._received = self._words = 0
        self._ended = False
        self._sockets: list[socket.socket] = []
        self._linked: list[Any] = []
        self.problem = ""
        self.strangers: dict[str, None] = {}

    def fail(self, problem: str) -> None:
        """End the request; the first problem counts."""
        self.problem = self.problem or problem

    def end(self) -> None:
        """Let every connection go; nothing more is read. Idempotent."""
        self._ended = True

    def close(self) -> None:
        """Close connections that others opened, and delete pictures that came in part. Idempotent.

        The library forgets both where a connection is cut.
        """
        self.end()
        for connection in self._sockets:
            connection.close()
        for linked in self._linked:
            file = getattr(linked.dimse.message, "_data_set_file", None)
            if file is not None:
                file.close()
        for path in self._folder.glob(f"*{SPOOLED}") if self._folder is not None else ():
            path.unlink(missing_ok=True)

    def over(self) -> bool:
        """Return whether nothing more may be read: it is too much, too late, cancelled or done."""
        allowed = SILENCES * self._settings.timeout_s + self._received / LEAST_RATE
        if time.monotonic() - self._started > allowed:
            self.fail(f"it took longer than {allowed:.0f} s for {self._received / 1e6:.1f} MB")
        try:
            self._progress.check()
        except Cancelled:
            return True
        return self._ended or bool(self.problem)

    def check(self) -> None:
        """Raise where whoever asked has cancelled.

        Raises:
            Cancelled: then.
        """
        self._progress.check()

    def bind(self, event: Any) -> None:
        """Read a connection that was just opened within these limits (a handler of pynetdicom)."""
        linked = event.assoc
        self._linked.append(linked)
        reader = _BoundedReader(self, linked)
        linked.dul.socket.recv = reader.recv
        linked.acus_folder = self._folder
        linked.bind(_events().EVT_DIMSE_RECV, reader.complete)

    def accept(self, event: Any) -> None:
        """Do as `bind` for a connection that somebody opened to us, if it may."""
        self._sockets.append(event.assoc.dul.socket.socket)
        address = str(event.address[0])
        if not may_send(self._settings, address):
            self.strangers[address] = None
            event.assoc.dul.socket.recv = _refuse
            return
        self.bind(event)

    def count(self, size: int, is_picture: bool) -> None:
        """Count what was read [bytes]."""
        self._received += size
        if not is_picture:
            self._words += size
            if self._words > _MOST_WORDS:
                self.fail(f"it sent more than {_MOST_WORDS >> 20} MB beside pictures")

    def require_room(self) -> None:
        """End the request where the disk is nearly full."""
        folder = self._folder
        if folder is not None and shutil.disk_usage(folder).free < SPARE_BYTES:
            self.fail("the disk is full")


class _BoundedReader:
    """Reads one connection in place of the network library's own socket.

    Args:
        limits: of the request.
        linked: the association.
    """

    def __init__(self, limits: RequestLimits, linked: Any) -> None:
        self._limits, self._linked = limits, linked
        self._message = self._looked = 0

    def complete(self, event: Any) -> None:
        """Begin to count the next message."""
        self._message = self._looked = 0

    def recv(self, count: int) -> bytearray:
        """Read so many bytes; fewer if the other end is gone.

        Raises:
            OSError: if it is too much, or the request is over.
        """
        limits = self._limits
        is_picture = type(self._linked.dimse.message).__name__ == "C_STORE_RQ"
        self._judge(count, is_picture)
        self._wait_for_takers()
        data = bytearray()
        connection = self._linked.dul.socket.socket
        while len(data) < count:
            if limits.over() or connection is None:
                raise OSError("the request is over")
            piece = _received(connection, min(_PIECE, count - len(data)))
            if piece is None:
                continue
            if not piece:
                break
            data += piece
            limits.count(len(piece), is_picture)
        return data

    def _judge(self, count: int, is_picture: bool) -> None:
        most = MOST_PDU if self._linked.is_established else _MOST_GREETING
        if count > most:
            self._fail(f"it announced a PDU of {count / 1e6:.1f} MB; {most / 1e6:.1f} is the most")
        self._message += count
        if self._message > (LARGEST_PICTURE if is_picture else MOST_MESSAGE):
            what = "a picture" if is_picture else "a message"
            self._fail(f"it sent {what} of more than {self._message / 1e6:.0f} MB")
        if is_picture and self._message > self._looked + _LOOK_AT_DISK:
            self._looked = self._message
            self._limits.require_room()

    def _wait_for_takers(self) -> None:
        """Read on only when what has come is being taken."""
        while self._linked.dimse.msg_queue.qsize() >= _AHEAD and not self._limits.over():
            time.sleep(0.005)

    def _fail(self, problem: str) -> None:
        self._limits.fail(problem)
        raise OSError(problem)


def _received(connection: socket.socket, most: int) -> bytes | None:
    """Read what there is; None where nothing came for a moment."""
    before = connection.gettimeout()
    connection.settimeout(_LOOK_S)
    try:
        return connection.recv(most)
    except TimeoutError:
        return None
    finally:
        connection.settimeout(before)


def _refuse(count: int) -> bytearray:
    raise OSError("nobody whom we know")


def may_send(settings: PacsSettings, address: str) -> bool:
    """Return whether pictures may come from an address: the PACS' own, or one that is listed for
    it.
    """
    known: set[str] = set()
    for name in (settings.host, *settings.senders):
        try:
            known |= {_plain(str(found[4][0])) for found in socket.getaddrinfo(name, None)}
        except (OSError, UnicodeError):
            continue  # a name that is not known now opens no door
    return _plain(address) in known


def _plain(address: str) -> str:
    """Write an address in one way only."""
    found = ipaddress.ip_address(address.split("%")[0])
    mapped = getattr(found, "ipv4_mapped", None)
    return str(mapped or found)


def _events() -> Any:
    from pynetdicom import evt

    return evt


def spool_to_own_folder(messages: Any) -> None:
    """Have the network library write pictures that come to the folder of their request.

    It would write them, with the patient's name, to the folder for temporary files and leave those
    there whose connection was cut.

    Args:
        messages: the library's module `dimse_messages`.
    """
    if getattr(messages.NamedTemporaryFile, "func", None) is not _spooled:
        messages.NamedTemporaryFile = partial(_spooled, NamedTemporaryFile)


def _spooled(make: Callable[..., Any], **given: Any) -> Any:
    linked = getattr(threading.current_thread(), "assoc", None)  # the thread that reads
    folder = getattr(linked, "acus_folder", None)
    if folder is not None:
        given |= {"dir": folder, "suffix": SPOOLED}
    return make(**given)


SPOOLED: Final = ".spooled"
"""How the names of pictures end that are still coming."""
