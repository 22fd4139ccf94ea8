"""One request by HTTP, answered as a whole within its seconds, and to the address that was given.

Redirections are not followed: what is sent, and the password with it, goes nowhere else. Plain http
goes to this computer alone.
"""

from __future__ import annotations

import socket
import ssl
from base64 import b64encode
from collections.abc import Mapping
from contextlib import suppress
from dataclasses import dataclass
from http.client import HTTPConnection, HTTPSConnection, IncompleteRead
from ipaddress import ip_address
from threading import Timer
from typing import Final
from urllib.parse import urlsplit

from app.core.messages import sentence
from app.core.words import printable

_LARGEST: Final = 1 << 22
"""No answer is read farther than this [bytes]."""

_SAID: Final = 120


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
    method: str, address: str, headers: Mapping[str, str], body: bytes | None, seconds: float
) -> WebAnswer:
    """Send a request and read its answer whole.

    Args:
        method: of HTTP.
        address: with its query.
        headers: beside host and length.
        body: what is sent.
        seconds: that all of it may take, once connected.

    Raises:
        ssl.SSLCertVerificationError: if the server's certificate is not trusted.
        OSError, http.client.HTTPException: if there is no answer in time, or not all of it.
    """
    parts = urlsplit(address)
    host = parts.hostname or ""
    connection: HTTPConnection
    if parts.scheme == "https":
        context = ssl.create_default_context()
        connection = HTTPSConnection(host, parts.port, timeout=seconds, context=context)
    else:
        connection = HTTPConnection(host, parts.port, timeout=seconds)
    path = (parts.path or "/") + (f"?{parts.query}" if parts.query else "")
    guard = Timer(seconds, _cut, (connection,))  # a server may also send a byte now and then
    guard.daemon = True
    try:
        guard.start()
        connection.request(method, path, body, dict(headers))
        answer = connection.getresponse()
        raw = answer.read(_LARGEST + 1)
        if len(raw) > _LARGEST or answer.length:
            raise IncompleteRead(raw)  # too long, or cut off
        return WebAnswer(answer.status, dict(answer.headers), raw)
    finally:
        guard.cancel()
        connection.close()


def _cut(connection: HTTPConnection) -> None:
    """End a request whose time is over."""
    if connection.sock is not None:
        with suppress(OSError):
            connection.sock.shutdown(socket.SHUT_RDWR)


def _is_this_computer(host: str) -> bool:
    try:
        return ip_address(host).is_loopback
    except ValueError:
        return host == "localhost"
