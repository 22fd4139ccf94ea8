"""Who may come in, and the sockets at which a link listens: loopback unless asked for more.

Off loopback a link needs something that a stranger has not: a token where the protocol can carry
one, else a list of the addresses that may come in.
"""

from __future__ import annotations

import errno
import hmac
import socket
from collections.abc import Sequence
from contextlib import suppress
from dataclasses import dataclass
from ipaddress import IPv4Network, IPv6Address, IPv6Network, ip_address, ip_network
from typing import Final
from urllib.parse import parse_qs, urlsplit

from app.core.messages import sentence
from app.exchange.errors import LinkAddressError

LOOPBACK: Final = "localhost"

Network = IPv4Network | IPv6Network


@dataclass(frozen=True, slots=True)
class Doors:
    """Where links listen and whom they let in.

    Attributes:
        host: name or address to listen at; `localhost` is both 127.0.0.1 and ::1, `*` everything.
        token: what a peer must know; empty for none.
        allowed: networks from which a peer may come, besides this computer; empty for any.
    """

    host: str = LOOPBACK
    token: str = ""
    allowed: tuple[Network, ...] = ()

    @classmethod
    def of(cls, host: str, token: str = "", allowed: str = "") -> Doors:
        """Read them from texts.

        Args:
            host: where to listen.
            token: at least 16 characters, or none.
            allowed: addresses or networks with commas between, such as 10.0.0.7,fd00::/64.

        Raises:
            LinkAddressError: naming the value and what would be valid.
        """
        if token and len(token) < SHORTEST:
            raise LinkAddressError(
                sentence(
                    "the token of the links has {length} characters; at least {least} are needed",
                    length=len(token),
                    least=SHORTEST,
                )
            )
        networks = []
        for text in filter(None, (part.strip() for part in allowed.split(","))):
            try:
                networks.append(ip_network(text, strict=False))
            except ValueError as error:
                raise LinkAddressError(
                    sentence(
                        "--links-allow {address!r} is no address and no network; valid are "
                        "10.0.0.7, 10.0.0.0/24, fd00::/64, with commas between",
                        address=text,
                    )
                ) from error
        return cls(host.strip() or LOOPBACK, token, tuple(networks))

    @property
    def only_here(self) -> bool:
        """Return whether only this computer can reach them."""
        return self.host == LOOPBACK or _is_loopback(self.host)

    def lets_in(self, address: str) -> bool:
        """Return whether a peer of this address may come in."""
        try:
            peer = ip_address(address.partition("%")[0])
        except ValueError:
            return False
        if isinstance(peer, IPv6Address) and peer.ipv4_mapped is not None:
            peer = peer.ipv4_mapped
        return peer.is_loopback or not self.allowed or any(peer in net for net in self.allowed)

    def knows(self, path: str, headers: Sequence[tuple[str, str]]) -> str:
        """Return why a request for a web socket is refused; empty where it is not.

        A browser lets every page that it shows connect to this computer, and names the page: one
        of another computer has to know the token, as everybody has who comes from elsewhere.

        Args:
            path: of the request; `?token=…` may stand in it.
            headers: of the request, names in small letters.
        """
        given = parse_qs(urlsplit(path).query).get("token", [""])[0]
        named = dict(headers)
        bearer = named.get("authorization", "")
        given = given or bearer.removeprefix("Bearer ").strip()
        if self.token and hmac.compare_digest(given.encode(), self.token.encode()):
            return ""
        if self.token:
            return "the token is missing or wrong"
        origin = urlsplit(named.get("origin", ""))
        if origin.scheme in ("http", "https") and not _is_loopback(origin.hostname or ""):
            return f"a page of {origin.hostname} has to know a token"
        return ""

    def listen(self, port: int, title: str) -> list[socket.socket]:
        """Return listening sockets, IPv4 and IPv6 as the host has them.

        Args:
            port: 0 for one that is free; the same for all.
            title: of the link, for errors.

        Raises:
            LinkAddressError: if the host is unknown, or the port cannot be had.
        """
        if not 0 <= port < 65536:
            raise LinkAddressError(
                sentence("{title}: port {port} is not 0 to 65535", title=title, port=port)
            )
        opened: list[socket.socket] = []
        try:
            for family, place in self._places(port, title):
                with suppress(_NoSuchFamilyError):
                    one = _listening(family, place, opened)
                    opened.append(one)
        except OSError as error:
            for one in opened:
                one.close()
            raise LinkAddressError(
                sentence(
                    "{title} cannot listen at {host} port {port}: {reason}; close the other "
                    "program, or choose another port",
                    title=title,
                    host=self.host,
                    port=port,
                    reason=error.strerror or str(error),
                )
            ) from error
        if not opened:
            raise LinkAddressError(
                sentence("{title}: {host} is no address here", title=title, host=self.host)
            )
        return opened

    def _places(self, port: int, title: str) -> list[tuple[int, tuple[str, int]]]:
        if self.host == LOOPBACK:
            return [(socket.AF_INET, ("127.0.0.1", port)), (socket.AF_INET6, ("::1", port))]
        if self.host == "*":
            return [(socket.AF_INET, ("0.0.0.0", port)), (socket.AF_INET6, ("::", port))]
        try:
            found = socket.getaddrinfo(self.host, port, type=socket.SOCK_STREAM)
        except (OSError, UnicodeError) as error:
            raise LinkAddressError(
                sentence(
                    "{title}: the host {host!r} is not known; give a name or an address of this "
                    "computer",
                    title=title,
                    host=self.host,
                )
            ) from error
        return [(family, (str(place[0]), port)) for family, *_, place in found]


SHORTEST: Final = 16
"""Characters that a token has at least."""


class _NoSuchFamilyError(Exception):
    """There is no IPv4, or no IPv6, on this computer."""


def _listening(family: int, place: tuple[str, int], before: list[socket.socket]) -> socket.socket:
    """Open one socket; a port that was chosen for the first is that of all."""
    host, port = place
    if port == 0 and before:
        port = before[0].getsockname()[1]
    try:
        one = socket.socket(family, socket.SOCK_STREAM)
    except OSError as error:
        raise _NoSuchFamilyError from error
    try:
        one.setsockopt(socket.SOL_SOCKET, socket.SO_REUSEADDR, 1)
        if family == socket.AF_INET6:
            one.setsockopt(socket.IPPROTO_IPV6, socket.IPV6_V6ONLY, 1)
        one.bind((host, port))
        one.listen(16)
        one.setblocking(False)
    except OSError as error:
        one.close()
        if error.errno in _ABSENT:
            raise _NoSuchFamilyError from error
        raise
    return one


_ABSENT: Final = frozenset({errno.EAFNOSUPPORT, errno.EADDRNOTAVAIL})
"""No IPv4, or no IPv6, here: either alone is enough."""


def _is_loopback(host: str) -> bool:
    if host == LOOPBACK:
        return True
    try:
        return ip_address(host.strip("[]").partition("%")[0]).is_loopback
    except ValueError:
        return False


def address_of(sockets: Sequence[socket.socket]) -> str:
    """Return where sockets listen, for people: 127.0.0.1:18944, [::1]:18944."""
    found = []
    for one in sockets:
        host, port = one.getsockname()[:2]
        found.append(f"[{host}]:{port}" if ":" in host else f"{host}:{port}")
    return ", ".join(found)
