"""One request by HTTP, answered as a whole within its seconds, and to the address that was given.

Redirections are not followed: what is sent, and the password with it, goes nowhere else. Plain http
goes to this computer alone.
"""

from __future__ import annotations

import socket
import ssl
import time
from base64 import b64encode
from collections.abc import Callable, Iterator, Mapping
from contextlib import contextmanager, suppress
from dataclasses import dataclass
from http.client import HTTPConnection, HTTPResponse, HTTPSConnection, IncompleteRead
from ipaddress import ip_address
from threading import Event, Thread
from typing import BinaryIO, Final
from urllib.parse import urlsplit

from app.core.messages import sentence
from app.core.words import printable

_LARGEST: Final = 1 << 22
"""No answer is read farther than this [bytes]."""

_SAID: Final = 120
_PIECE: Final = 1 << 16
_LOOK_S: Final = 0.1


@dataclass(frozen=True, slots=True)
class WebAnswer:
    """What a server said.

    Attributes:
        status: of HTTP.
        headers: by name.
        body: whole.
    """

    status: int
    headers: Mapping[str, str]
    body: bytes

    @property
    def excerpt(self) -> str:
        """Return the beginning of the body, printable, in one line."""
        return printable(" ".join(self.body.decode(errors="replace").split()))[:_SAID]

    @property
    def elsewhere(self) -> str:
        """Return the host that a redirection names, printable."""
        try:
            return printable(urlsplit(self.headers.get("Location", "")).netloc)[:_SAID] or "?"
        except ValueError:
            return "?"


def fault_of_address(address: str) -> str:
    """Say what is wrong with an address that shall be written to; empty where nothing is."""
    try:
        parts = urlsplit(address)
        host, _ = parts.hostname or "", parts.port
    except ValueError:
        parts, host = urlsplit(""), ""
    if "@" in parts.netloc:
        return sentence(
            "the address holds a user: give name and password apart, where no list of addresses "
            "shows them"
        )
    plain = address.isascii() and address.isprintable() and " " not in address
    if parts.scheme not in ("https", "http") or not host or parts.query or not plain:
        return sentence(
            "{address!r} is no address: give one such as https://server.school.example/path",
            address=address,
        )
    if parts.scheme == "http" and not _is_this_computer(host):
        return sentence(
            "{host} would be told by plain http, which everybody on the way can read: give an "
            "address that begins with https",
            host=host,
        )
    return ""


def basic(user: str, password: str) -> dict[str, str]:
    """Return the header that says who asks (RFC 7617); none without a user."""
    if not user:
        return {}
    return {"Authorization": f"Basic {b64encode(f'{user}:{password}'.encode()).decode()}"}


def exchange(
    method: str,
    address: str,
    headers: Mapping[str, str],
    body: bytes | None,
    seconds: float,
    over: Callable[[], bool] | None = None,
    context: ssl.SSLContext | None = None,
) -> WebAnswer:
    """Send a request and read its answer whole.

    Args:
        method: of HTTP.
        address: with its query.
        headers: beside host and length.
        body: what is sent.
        seconds: that all of it may take, once connected.
        over: asked a few times a second; where it says so, the connection is cut.
        context: of the encryption; the system's where left out.

    Raises:
        ssl.SSLCertVerificationError: if the server's certificate is not trusted.
        OSError, http.client.HTTPException: if there is no answer in time, or not all of it.
    """
    end = time.monotonic() + seconds

    def late() -> bool:  # a server may also send a byte now and then
        return time.monotonic() > end or (over is not None and over())

    with _answer(method, address, headers, body, seconds, late, context) as answer:
        return _whole(answer)


def download(
    address: str,
    headers: Mapping[str, str],
    file: BinaryIO,
    seconds: float,
    over: Callable[[], bool],
    count: Callable[[int], None],
    context: ssl.SSLContext | None = None,
) -> WebAnswer:
    """Ask for what may be large; write what comes with status 200 to a file, piece by piece.

    The answer has no body then; with another status it has, and nothing is written.

    Args:
        address: with its query.
        headers: beside host.
        file: to which is written.
        seconds: longest silence.
        over: asked a few times a second; where it says so, the connection is cut.
        count: called with the size of each piece [bytes].
        context: of the encryption; the system's where left out.

    Raises:
        ssl.SSLCertVerificationError: if the server's certificate is not trusted.
        OSError, http.client.HTTPException: if there is no answer, or not all of it.
    """
    with _answer("GET", address, headers, None, seconds, over, context) as answer:
        if answer.status != 200:
            return _whole(answer)
        while piece := answer.read(_PIECE):
            file.write(piece)
            count(len(piece))
        if answer.length:
            raise IncompleteRead(b"")  # cut off
        return WebAnswer(answer.status, dict(answer.headers), b"")


@contextmanager
def _answer(
    method: str,
    address: str,
    headers: Mapping[str, str],
    body: bytes | None,
    seconds: float,
    over: Callable[[], bool],
    context: ssl.SSLContext | None,
) -> Iterator[HTTPResponse]:
    parts = urlsplit(address)
    host = parts.hostname or ""
    connection: HTTPConnection
    if parts.scheme == "https":
        context = context or ssl.create_default_context()
        connection = HTTPSConnection(host, parts.port, timeout=seconds, context=context)
    else:
        connection = HTTPConnection(host, parts.port, timeout=seconds)
    path = (parts.path or "/") + (f"?{parts.query}" if parts.query else "")
    done, cut, opened = Event(), Event(), list[socket.socket]()
    asked = (connection, opened, done, cut, over)
    guard = Thread(target=_guard, args=asked, name="acus web", daemon=True)
    try:
        guard.start()
        connection.connect()
        if connection.sock is not None:
            opened.append(connection.sock)
        connection.request(method, path, body, dict(headers))
        with connection.getresponse() as answer:
            yield answer
        if cut.is_set():  # what was read may look whole
            raise ConnectionAbortedError("cut")
    finally:
        done.set()
        guard.join()
        connection.close()


def _whole(answer: HTTPResponse) -> WebAnswer:
    raw = answer.read(_LARGEST + 1)
    if len(raw) > _LARGEST or answer.length:
        raise IncompleteRead(raw)  # too long, or cut off
    return WebAnswer(answer.status, dict(answer.headers), raw)


def _guard(
    connection: HTTPConnection,
    opened: list[socket.socket],
    done: Event,
    cut: Event,
    over: Callable[[], bool],
) -> None:
    """End a request whose time is over, whatever it waits for.

    The connection forgets its socket when the answer has none to follow, and the answer reads on.
    """
    while not done.wait(_LOOK_S):
        if over():
            cut.set()
            for sock in (*opened, connection.sock):
                if sock is not None:
                    with suppress(OSError):
                        sock.shutdown(socket.SHUT_RDWR)
            return


def _is_this_computer(host: str) -> bool:
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"
