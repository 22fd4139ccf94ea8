"""Serves web sockets in a thread of its own, for every link that speaks by them.

Each peer has a task; nobody waits for another. One that takes nothing for `PATIENCE`, or does not
answer a ping in that time, is dropped. What a peer may ask is bounded: size, messages a second.
"""

from __future__ import annotations

import asyncio
import threading
import time
from collections.abc import Awaitable, Callable, Coroutine, Sequence
from importlib import import_module
from typing import TYPE_CHECKING, Any, Final

from app.core.extras import not_installed
from app.core.rate_meter import RateMeter
from app.exchange.errors import ExportError
from app.exchange.live.doors import Doors, address_of
from app.exchange.live.journal import LinkHealth, LinkJournal, LinkReport

if TYPE_CHECKING:
    from websockets.asyncio.server import ServerConnection

PATIENCE: Final = 1.0
"""A peer that takes nothing, or answers nothing, for so long [s] is dropped."""

LARGEST: Final = 1 << 20
"""Bytes of a message of a peer."""

MOST_MESSAGES: Final = 500
"""Messages a second that a peer may send."""

MOST_PEERS: Final = 16

_PING, _PONG, _GOODBYE = 0.25, 0.6, 0.1
_HIGH_WATER: Final = 1 << 15


class FloodError(Exception):
    """A peer sends more than it may."""


class SocketPeer:
    """One connection.

    Args:
        connection: of the library.
        server: that it belongs to.
    """

    def __init__(self, connection: ServerConnection, server: WebSocketServer) -> None:
        host, port = connection.remote_address[:2]
        self.host, self.name = str(host), f"{host}:{port}"
        self._connection, self._server = connection, server
        self._second, self._messages = 0.0, 0

    async def send(self, data: str | bytes) -> None:
        """Send a message.

        Raises:
            TimeoutError: if the peer takes nothing for `PATIENCE`.
        """
        async with asyncio.timeout(PATIENCE):
            await self._connection.send(data)
        self._server.count += 1

    async def receive(self) -> str | bytes:
        """Return the next message.

        Raises:
            FloodError: for too many of them.
        """
        data = await self._connection.recv()
        now = time.monotonic()
        if now - self._second >= 1.0:
            self._second, self._messages = now, 0
        self._messages += 1
        self._server.count += 1
        if self._messages > MOST_MESSAGES:
            raise FloodError
        return data


class WebSocketServer:
    """Listens, lets peers in, and has each one talked to.

    Args:
        title: of the link.
        doors: where to listen, and whom to let in.
        port: to listen at; 0 for one that is free.
        talk: talks to a peer until it is gone; gets the journal too, raises whatever ends it.
        subprotocols: of which a peer must speak one; none are asked for without.
        needs: packages of the extra `links`.
        at_end: called when it closes.
    """

    def __init__(
        self,
        title: str,
        doors: Doors,
        port: int,
        talk: Callable[[SocketPeer, LinkJournal], Awaitable[None]],
        subprotocols: Sequence[str] = (),
        needs: Sequence[str] = ("websockets",),
        at_end: Callable[[], object] = lambda: None,
    ) -> None:
        self.journal = LinkJournal()
        self.port, self.address, self.count = port, "", 0
        self._title, self._doors, self._talk = title, doors, talk
        self._subprotocols: Any = list(subprotocols) or None
        self._needs, self._at_end = tuple(needs), at_end
        self._peers: set[SocketPeer] = set()
        self._meter = RateMeter()
        self._thread: threading.Thread | None = None
        self._loop: asyncio.AbstractEventLoop | None = None
        self._end: asyncio.Event | None = None

    def open(self) -> None:
        """Listen, and start the thread; idempotent.

        Raises:
            LinkAddressError: if the port cannot be had.
            ExportError: if the library is not installed.
        """
        if self._thread is not None:
            return
        for package in self._needs:
            try:
                import_module(package)
            except ImportError as error:
                raise not_installed(ExportError, package, "links") from error
        sockets = self._doors.listen(self.port, self._title)
        self.port, self.address = sockets[0].getsockname()[1], address_of(sockets)
        started = threading.Event()
        name = self._title.lower().replace(" ", "-")
        self._thread = threading.Thread(
            target=lambda: asyncio.run(self._serve(sockets, started)), name=name, daemon=True
        )
        self._thread.start()
        started.wait(5.0)

    def close(self) -> None:
        """End all connections and the thread; idempotent."""
        thread, self._thread = self._thread, None
        if thread is not None and self._loop is not None and self._end is not None:
            self._loop.call_soon_threadsafe(self._end.set)
            thread.join(timeout=3.0)
        self._at_end()

    def status(self) -> LinkReport:
        """Return how it is."""
        peers = len(self._peers)
        health = LinkHealth.CONNECTED if peers else LinkHealth.WAITING
        rate = self._meter.read(time.monotonic(), self.count)
        return LinkReport(self._title, self.address, peers, rate, health, self.journal.last)

    # --- the thread -----------------------------------------------------------------------------
    async def _serve(self, sockets: Sequence[Any], started: threading.Event) -> None:
        from contextlib import AsyncExitStack

        from websockets.asyncio.server import serve

        self._loop, self._end = asyncio.get_running_loop(), asyncio.Event()
        async with AsyncExitStack() as servers:
            for one in sockets:
                await servers.enter_async_context(
                    serve(
                        self._meet,
                        sock=one,
                        process_request=self._admit,
                        subprotocols=self._subprotocols,
                        compression=None,
                        open_timeout=2.0,
                        ping_interval=_PING,
                        ping_timeout=_PONG,
                        close_timeout=_GOODBYE,
                        max_size=LARGEST,
                        max_queue=16,
                        write_limit=_HIGH_WATER,
                        logger=_quiet(),
                    )
                )
            started.set()
            await self._end.wait()

    def _admit(self, connection: Any, request: Any) -> Any:
        host = str(connection.remote_address[0])
        headers = [(name.lower(), value) for name, value in request.headers.raw_items()]
        why = "" if self._doors.lets_in(host) else "its address may not come in"
        why = why or self._doors.knows(request.path, headers)
        if not why and len(self._peers) >= MOST_PEERS:
            why = f"there are {MOST_PEERS} peers already"
        if why:
            self.journal.say(f"{host} is refused: {why}", f"{host}{why}")
            return connection.respond(403, f"{why}\n")
        return None

    async def _meet(self, connection: ServerConnection) -> None:
        from websockets.exceptions import ConnectionClosed

        peer = SocketPeer(connection, self)
        self._peers.add(peer)
        self.journal.say(f"{peer.name} is connected", f"{peer.host} connected")
        why = "it has closed the connection"
        try:
            await self._talk(peer, self.journal)
        except TimeoutError:
            why = f"it took nothing for {PATIENCE:g} s"
        except FloodError:
            why = f"it sends more than {MOST_MESSAGES} messages a second"
        except ConnectionClosed as closed:
            frame = closed.sent or closed.rcvd
            if frame is not None and frame.code not in (1000, 1001):
                why = f"{frame.reason or 'its connection broke'} (code {frame.code})"
        except Exception as error:  # of this peer alone
            why = f"a fault of the link: {type(error).__name__}: {error}"
        finally:
            self._peers.discard(peer)
        self.journal.say(f"{peer.name} is gone: {why}", f"{peer.host} {why}")
        connection.transport.abort()  # nothing waits until a peer that hangs has said goodbye


async def both(*talks: Coroutine[Any, Any, None]) -> None:
    """Let several go on until one of them ends; raise what ended it."""
    tasks = [asyncio.create_task(talk) for talk in talks]
    try:
        done, _ = await asyncio.wait(tasks, return_when=asyncio.FIRST_COMPLETED)
    finally:
        for task in tasks:
            task.cancel()
    await asyncio.gather(*(set(tasks) - done), return_exceptions=True)
    for task in done:
        task.result()


def _quiet() -> Any:
    """Return a logger that says nothing: what matters is in the journal."""
    import logging

    logger = logging.getLogger("acus.links.silent")
    logger.disabled = True
    return logger
