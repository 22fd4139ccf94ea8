"""The client's end of a web socket, for one thread that waits for each answer."""

from __future__ import annotations

import select
import socket
import time
from collections import deque
from contextlib import suppress

from app.core.extras import not_installed
from app.core.messages import sentence
from app.device.errors import LinkError

_CONTROL = 8  # least opcode of a frame that is no data (RFC 6455)


class WebClient:
    """A web socket of one thread; not thread-safe.

    The frames are those of the package `websockets`, which does no I/O here: its own thread would
    have to be given the interpreter before any answer is read.

    Args:
        host: name or address of the server.
        port: where it listens.
        largest: bytes of a message; a longer one ends the connection.
    """

    def __init__(self, host: str, port: int, largest: int) -> None:
        self._host, self._port, self._largest = host, port, largest
        self._socket: socket.socket | None = None
        self._messages: deque[bytes] = deque()
        self._begun = b""

    def open(self, patience: float) -> None:
        """Connect, waiting at most `patience` [s] for each step.

        Raises:
            LinkError: if the package is not installed.
            OSError: if nobody is there, or no web socket.
        """
        try:
            from websockets.client import ClientProtocol
            from websockets.uri import parse_uri
        except ImportError as error:
            raise not_installed(LinkError, "websockets", "links") from error
        uri = parse_uri(f"ws://[{self._host}]" if ":" in self._host else f"ws://{self._host}")
        self._protocol = ClientProtocol(uri, max_size=self._largest)
        self._socket = socket.create_connection((self._host, self._port), patience)
        try:
            self._socket.setsockopt(socket.IPPROTO_TCP, socket.TCP_NODELAY, 1)
            self._socket.setblocking(False)
            self._protocol.send_request(self._protocol.connect())
            self._flush()
            end = time.monotonic() + patience
            while self._protocol.state.name == "CONNECTING":
                if not self._read(end - time.monotonic()):
                    raise TimeoutError(sentence("it does not answer a greeting"))
        except BaseException:
            self.close()
            raise

    def send(self, text: str) -> None:
        """Send a message; what the peer does not take at once ends the connection.

        Raises:
            OSError: if the connection is gone.
        """
        if self._protocol.state.name != "OPEN":
            raise ConnectionError(sentence("it is closed"))
        self._protocol.send_text(text.encode())
        self._flush()

    def receive(self, wait: float) -> bytes | None:
        """Return the next message; None if none has come within `wait` [s].

        Raises:
            OSError: if the connection is gone.
        """
        end = time.monotonic() + wait
        while not self._messages:
            if not self._read(end - time.monotonic()):
                return None
        return self._messages.popleft()

    def close(self) -> None:
        """Say good-bye and let go; idempotent."""
        held, self._socket = self._socket, None
        if held is None:
            return
        with suppress(Exception), held:  # in whatever state it is
            self._protocol.send_close()
            held.sendall(b"".join(self._protocol.data_to_send()))
        held.close()

    def _flush(self) -> None:
        if self._socket is None:
            raise ConnectionError(sentence("it is closed"))
        for data in self._protocol.data_to_send():
            if data:
                self._socket.sendall(data)

    def _read(self, wait: float) -> bool:
        """Wait for bytes and take them; whether there were any."""
        from websockets.frames import Frame

        if self._socket is None:
            raise ConnectionError(sentence("it is closed"))
        ready, _, _ = select.select([self._socket], [], [], max(wait, 0.0))
        if not ready:
            return False
        data = self._socket.recv(1 << 16)
        if not data:
            raise ConnectionError(sentence("the other side has closed it"))
        protocol = self._protocol
        protocol.receive_data(data)
        for event in protocol.events_received():
            if isinstance(event, Frame) and event.opcode < _CONTROL:
                self._begun += bytes(event.data)
                if event.fin:
                    self._messages.append(self._begun)
                    self._begun = b""
        failed = protocol.handshake_exc or protocol.parser_exc
        if failed is not None:
            raise ConnectionError(str(failed)) from failed
        self._flush()  # answers to pings
        if protocol.state.name in ("CLOSING", "CLOSED"):
            raise ConnectionError(sentence("the other side has closed it"))
        return True
