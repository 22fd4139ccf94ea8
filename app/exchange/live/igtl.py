"""Serves OpenIGTLink: many peers, one thread, nothing that anybody waits for.

A peer has what it has not taken yet in a buffer of its own. While there is anything in it, newer
poses are left out for it; one that takes nothing for `PATIENCE` is dropped. It is spoken to with
headers of version 1 until it sends one of version 2, as Slicer expects.
"""

from __future__ import annotations

import selectors
import socket
import threading
import time
from dataclasses import dataclass, field
from typing import Final

from app.core.errors import AcusError
from app.core.messages import sentence
from app.core.rate_meter import RateMeter
from app.exchange.errors import LinkAddressError, LinkMessageError
from app.exchange.live import igtl_messages as igtl
from app.exchange.live import igtl_told as told
from app.exchange.live.doors import Doors, address_of
from app.exchange.live.journal import LinkHealth, LinkJournal, LinkReport
from app.exchange.moment import LiveMoment, LivePlan, LiveScan, LiveSource

TITLE: Final = "OpenIGTLink"

RATE_HZ: Final = 50.0
PATIENCE: Final = 1.0
"""A peer that takes nothing for so long [s] is dropped."""

KEEP_ALIVE: Final = 1.0
MOST_PEERS: Final = 16
LARGEST_BODY: Final = 1 << 20
"""Bytes of a body that a peer may send."""

MOST_MESSAGES: Final = 500
"""Messages a second that a peer may send."""

MOST_BYTES: Final = 8 << 20
"""Bytes a second that it may send."""

_SEND_BUFFER: Final = 1 << 16
_TAKE: Final = 1 << 16


@dataclass(slots=True, eq=False)
class _Peer:
    socket: socket.socket
    name: str
    version: int = 1
    coming: bytearray = field(default_factory=bytearray)
    head: igtl.Head | None = None
    going: bytearray = field(default_factory=bytearray)
    moved: float = 0.0
    event: int = 0
    plan: LivePlan | None = None
    scan: LiveScan | None = None
    wall: float = 0.0
    alive: float = 0.0
    second: float = 0.0
    messages: int = 0
    bytes: int = 0
    wanted: set[str] = field(default_factory=set)


class IgtlServer:
    """Tells peers what is live.

    Args:
        source: what is live.
        doors: where to listen, and whom to let in.
        port: to listen at; 0 for one that is free.
        rate_hz: poses a second at most.
    """

    def __init__(
        self, source: LiveSource, doors: Doors, port: int = igtl.PORT, rate_hz: float = RATE_HZ
    ) -> None:
        self.journal = LinkJournal()
        self.address, self.port = "", port
        self._source, self._doors, self._period = source, doors, 1.0 / rate_hz
        self._peers: dict[socket.socket, _Peer] = {}
        self._listening: list[socket.socket] = []
        self._selector = selectors.DefaultSelector()
        self._thread: threading.Thread | None = None
        self._stop = threading.Event()
        self._count, self._meter = 0, RateMeter()

    def open(self) -> None:
        """Listen, and start the thread; idempotent.

        Raises:
            LinkAddressError: if the port cannot be had, or nothing says who may come from outside.
        """
        if self._thread is not None:
            return
        if not (self._doors.only_here or self._doors.allowed):
            raise LinkAddressError(
                sentence(
                    "OpenIGTLink has no token: to listen at {host}, name who may come in, "
                    "--links-allow 10.0.0.7 or a network, 10.0.0.0/24",
                    host=self._doors.host,
                )
            )
        self._listening = self._doors.listen(self.port, TITLE)
        self.port, self.address = self._listening[0].getsockname()[1], address_of(self._listening)
        for one in self._listening:
            self._selector.register(one, selectors.EVENT_READ)
        self._thread = threading.Thread(target=self._run, name="igtl-server", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Say that it ends, and end; idempotent."""
        self._stop.set()
        thread, self._thread = self._thread, None
        if thread is not None:
            thread.join(timeout=2.0)

    def status(self) -> LinkReport:
        """Return how it is."""
        peers = len(self._peers)
        health = LinkHealth.CONNECTED if peers else LinkHealth.WAITING
        rate = self._meter.read(time.monotonic(), self._count)
        return LinkReport(TITLE, self.address, peers, rate, health, self.journal.last)

    # --- the thread -----------------------------------------------------------------------------
    def _run(self) -> None:
        due = time.monotonic()
        try:
            while not self._stop.is_set():
                try:
                    self._serve(max(0.0, due - time.monotonic()))
                    if (now := time.monotonic()) >= due:
                        due = max(due + self._period, now)
                        self._tell(now)
                except Exception as error:  # of this link alone: it goes on
                    self.journal.say(f"a fault of the link: {type(error).__name__}: {error}")
                    self._stop.wait(self._period)
        finally:
            self._end()

    def _serve(self, wait: float) -> None:
        for key, events in self._selector.select(wait):
            one = key.fileobj
            if not isinstance(one, socket.socket):
                continue
            if one in self._listening:
                self._let_in(one)
            elif (peer := self._peers.get(one)) is not None:
                if events & selectors.EVENT_WRITE:
                    self._send(peer)
                if events & selectors.EVENT_READ and one in self._peers:
                    self._receive(peer)

    def _let_in(self, listening: socket.socket) -> None:
        try:
            one, place = listening.accept()
        except OSError:
            return  # who knocked has gone again
        host, port = place[:2]
        name = f"{host}:{port}"
        refused = "" if self._doors.lets_in(host) else "its address may not come in"
        if not refused and len(self._peers) >= MOST_PEERS:
            refused = f"there are {MOST_PEERS} peers already"
        if refused:
            self.journal.say(f"{name} is refused: {refused}", f"{host}{refused}")
            one.close()
            return
        one.setblocking(False)
        one.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
        one.setsockopt(socket.SOL_SOCKET, socket.SO_SNDBUF, _SEND_BUFFER)
        one.setsockopt(socket.SOL_SOCKET, socket.SO_KEEPALIVE, 1)
        if hasattr(socket, "TCP_USER_TIMEOUT"):  # a peer whose computer is gone
            one.setsockopt(socket.IPPROTO_TCP, socket.TCP_USER_TIMEOUT, int(1e3 * PATIENCE))
        recent = self._source.events_after(0)
        self._peers[one] = _Peer(one, name, event=recent[-1].number if recent else 0)
        self._selector.register(one, selectors.EVENT_READ)
        self.journal.say(f"{name} is connected", f"{host} connected")

    # --- to a peer ------------------------------------------------------------------------------
    def _tell(self, now: float) -> None:
        if not self._peers:
            return
        moment = self._source.now()
        ready: dict[int, bytes] = {}
        for peer in list(self._peers.values()):
            if peer.going:
                if now - peer.moved > PATIENCE:
                    self._drop(peer, f"it took nothing for {PATIENCE:g} s")
                continue
            version = peer.version
            if version not in ready:
                ready[version] = b"".join(told.poses(moment, version))
            peer.going += self._news(peer, moment, now)
            wall = 0.0 if moment.needle is None else moment.needle.wall
            if wall != peer.wall:  # the same pose is told once
                peer.wall = wall
                peer.going += ready[version]
            if peer.going:
                peer.moved = now
                self._send(peer)

    def _news(self, peer: _Peer, moment: LiveMoment, now: float) -> bytes:
        """Return what a peer has not been told yet: state, plan, events, scan."""
        found, version = [], peer.version
        if now - peer.alive >= KEEP_ALIVE or "STATUS" in peer.wanted:
            peer.alive = now
            found.append(told.state(moment, version))
        if moment.plan is not None and (
            moment.plan is not peer.plan or peer.wanted & {"POINT", "TRANSFORM"}
        ):
            found += told.planned(moment.plan, moment.wall, version)
        peer.plan = moment.plan
        for event in self._source.events_after(peer.event):
            peer.event = event.number
            found.append(told.happened(event, version))
        if moment.scan is not None and (moment.scan is not peer.scan or "IMAGE" in peer.wanted):
            found.append(told.scanned(moment.scan, version))
        peer.scan = moment.scan
        if "TRANSFORM" in peer.wanted:
            peer.wall = 0.0
        peer.wanted.clear()
        self._count += len(found)
        return b"".join(found)

    def _send(self, peer: _Peer) -> None:
        try:
            sent = peer.socket.send(memoryview(peer.going)[: 1 << 18]) if peer.going else 0
        except (BlockingIOError, InterruptedError):
            sent = 0
        except OSError as error:
            self._drop(peer, error.strerror or str(error))
            return
        if sent:
            peer.moved = time.monotonic()
            self._count += 1
            del peer.going[:sent]
        wanted = selectors.EVENT_READ | (selectors.EVENT_WRITE if peer.going else 0)
        if self._selector.get_key(peer.socket).events != wanted:
            self._selector.modify(peer.socket, wanted)

    # --- from a peer ----------------------------------------------------------------------------
    def _receive(self, peer: _Peer) -> None:
        try:
            data = peer.socket.recv(_TAKE)
        except (BlockingIOError, InterruptedError):
            return
        except OSError as error:
            self._drop(peer, error.strerror or str(error))
            return
        if not data:
            self._drop(peer, "it has closed the connection")
            return
        now = time.monotonic()
        if now - peer.second >= 1.0:
            peer.second, peer.messages, peer.bytes = now, 0, 0
        peer.bytes += len(data)
        if peer.bytes > MOST_BYTES:
            self._drop(peer, f"it sends more than {MOST_BYTES >> 20} MB a second")
            return
        peer.coming += data
        try:
            while self._take(peer):
                pass
        except AcusError as error:
            self._drop(peer, str(error))

    def _take(self, peer: _Peer) -> bool:
        """Read one whole message; return whether there was one.

        Raises:
            LinkMessageError: for one that is not as the protocol says, or too many of them.
        """
        if peer.head is None:
            if len(peer.coming) < igtl.HEADER.size:
                return False
            peer.head = igtl.head_of(bytes(peer.coming[: igtl.HEADER.size]), LARGEST_BODY)
            del peer.coming[: igtl.HEADER.size]
        if len(peer.coming) < peer.head.size:
            return False
        head, peer.head = peer.head, None
        body = bytes(peer.coming[: head.size])
        del peer.coming[: head.size]
        peer.messages += 1
        if peer.messages > MOST_MESSAGES:
            raise LinkMessageError(
                sentence("it sends more than {most} messages a second", most=MOST_MESSAGES)
            )
        message = igtl.message_of(head, body)
        self._count += 1
        if message.version >= 2:
            peer.version = 2
        if message.kind.startswith("GET_"):
            peer.wanted.add(message.kind.removeprefix("GET_"))
        elif message.kind.startswith("STT_"):
            peer.wanted.add(message.kind.removeprefix("STT_"))  # it is told all the time anyhow
        else:
            self.journal.say(
                f"{peer.name} sends {message.kind}, which is not taken", f"kind {message.kind}"
            )
        return True

    # --- the end --------------------------------------------------------------------------------
    def _drop(self, peer: _Peer, reason: str) -> None:
        if self._peers.pop(peer.socket, None) is None:
            return
        host = peer.name.rpartition(":")[0]
        self.journal.say(f"{peer.name} is dropped: {reason}", f"{host} {reason}")
        self._selector.unregister(peer.socket)
        peer.socket.close()

    def _end(self) -> None:
        for peer in list(self._peers.values()):
            goodbye = igtl.packed(
                "STATUS",
                "Acus",
                time.time(),
                igtl.status(19, "SHUTDOWN", "Acus ends"),
                peer.version,
            )
            if not peer.going:
                peer.going += goodbye
                self._send(peer)
            self._drop(peer, "Acus ends")
        for one in self._listening:
            one.close()
        self._selector.close()


def server(source: LiveSource, doors: Doors, port: int) -> IgtlServer:
    """Return the server of this protocol, not open yet."""
    return IgtlServer(source, doors, port)
