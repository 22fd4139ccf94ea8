"""A line to a server on loopback that passes, stalls or is cut, from any byte on."""

import socket
import threading
from collections.abc import Callable
from contextlib import suppress
from types import TracebackType


class StallingProxy:
    """Passes bytes between a client and a port, as long as it behaves."""

    def __init__(self, to: int) -> None:
        self._to = to
        self._way, self._after = "pass", 0
        self._server = socket.create_server(("127.0.0.1", 0))
        self.port = int(self._server.getsockname()[1])
        self._ended = threading.Event()
        self._threads: list[threading.Thread] = []

    def behave(self, way: str, after: int = 0) -> None:
        """Let connections that come now `pass`, `stall`, or be `cut` after so many bytes."""
        self._way, self._after = way, after

    def __enter__(self) -> "StallingProxy":
        self._begin(self._serve)
        return self

    def __exit__(
        self,
        kind: type[BaseException] | None,
        error: BaseException | None,
        trace: TracebackType | None,
    ) -> None:
        self._ended.set()
        with suppress(OSError):
            self._server.shutdown(socket.SHUT_RDWR)
        self._server.close()
        for thread in self._threads:
            thread.join(10.0)

    def _begin(self, work: Callable[..., None], *arguments: object) -> None:
        thread = threading.Thread(target=work, args=arguments, daemon=True)
        self._threads.append(thread)
        thread.start()

    def _serve(self) -> None:
        while not self._ended.is_set():
            try:
                client, _ = self._server.accept()
            except OSError:
                return
            try:
                server = socket.create_connection(("127.0.0.1", self._to), 5.0)
            except OSError:
                client.close()
                continue
            server.settimeout(None)
            self._begin(self._both, client, server, self._way, [self._after])

    def _both(
        self, client: socket.socket, server: socket.socket, way: str, budget: list[int]
    ) -> None:
        back = threading.Thread(target=self._pass, args=(server, client, way, budget), daemon=True)
        back.start()
        self._pass(client, server, way, budget)
        back.join()
        client.close()
        server.close()

    def _pass(self, source: socket.socket, to: socket.socket, way: str, budget: list[int]) -> None:
        with suppress(OSError):
            while block := source.recv(1 << 16):
                budget[0] -= len(block)
                if way != "pass" and budget[0] < 0:
                    if way == "stall":
                        self._ended.wait()
                    break
                to.sendall(block)
        for one in (source, to):
            with suppress(OSError):
                one.shutdown(socket.SHUT_RDWR)
