"""Where the browser brings the answer: an address of this computer that takes one, then ends.

RFC 8252, section 7.3: IPv4 loopback, a port that the system chooses. What is not the answer to the
question (another path, another state, a picture that the browser asks for) is refused and waited
past: a page somewhere could otherwise end everybody's sign-in.
"""

from __future__ import annotations

import hmac
import secrets
import threading
from collections.abc import Mapping
from contextlib import suppress
from html import escape
from http.server import BaseHTTPRequestHandler
from socketserver import ThreadingTCPServer
from types import MappingProxyType
from typing import Any, Final
from urllib.parse import parse_qs, urlsplit

HOST: Final = "127.0.0.1"
PATH: Final = "/acus"

_READS_WITHIN_S: Final = 5.0
_LONGEST_LINE: Final = 16384
_MANY_AT_ONCE: Final = 16


class Listener:
    """Waits for one answer.

    Attributes:
        state: that the answer has to carry.
        refused: how many requests were refused.

    Args:
        done: what the browser then shows, in the user's language.
        wrong: what it shows of a request that is no answer.
    """

    def __init__(self, done: str, wrong: str) -> None:
        self.state = secrets.token_urlsafe(32)
        self.refused = 0
        self._pages = _page(done), _page(wrong)
        self._answer: Mapping[str, str] = MappingProxyType({})
        self._arrived, self._lock = threading.Event(), threading.Lock()
        self._server: ThreadingTCPServer | None = None
        self._port = 0

    def open(self) -> Listener:
        """Begin to listen.

        Raises:
            OSError: if this computer has no port left.
        """
        listener = self

        class Handler(_Handler):
            of = listener

        self._server = _Server((HOST, 0), Handler)
        self._port = int(self._server.server_address[1])
        threading.Thread(
            target=self._server.serve_forever, args=(0.05,), name="acus-openid", daemon=True
        ).start()
        return self

    @property
    def redirect(self) -> str:
        """Return the address that the provider sends the browser to."""
        return f"http://{HOST}:{self._port}{PATH}"

    def wait(self, seconds: float) -> Mapping[str, str] | None:
        """Return the answer's parameters; None if it did not come within so many seconds."""
        return self._answer if self._arrived.wait(seconds) else None

    def close(self) -> None:
        """Listen no more; idempotent."""
        server, self._server = self._server, None
        if server is not None:
            server.shutdown()
            server.server_close()

    def take(self, target: str, host: str) -> tuple[int, bytes]:
        """Judge a request; return status and page. The first right one is the answer."""
        parts = urlsplit(target)
        if parts.path != PATH or host != f"{HOST}:{self._port}":
            return self._refuse(404)
        try:
            fields = parse_qs(parts.query, keep_blank_values=True, max_num_fields=20)
        except ValueError:
            return self._refuse(400)
        answer = {name: values[0] for name, values in fields.items() if len(values) == 1}
        given = answer.get("state", "").encode("utf-8", "surrogatepass")
        right = hmac.compare_digest(given, self.state.encode()) and len(answer) == len(fields)
        if not right or not ("code" in answer) ^ ("error" in answer):
            return self._refuse(400)
        with self._lock:
            if self._arrived.is_set():
                return self._refuse(400)  # an answer is taken once
            self._answer = MappingProxyType(answer)
            self._arrived.set()
        return 200, self._pages[0]

    def _refuse(self, status: int) -> tuple[int, bytes]:
        self.refused += 1
        return status, self._pages[1]


class _Server(ThreadingTCPServer):
    daemon_threads = True
    block_on_close = False
    request_queue_size = _MANY_AT_ONCE

    def handle_error(self, request: Any, client_address: Any) -> None:
        """Say nothing: a browser that hangs up is no fault."""


class _Handler(BaseHTTPRequestHandler):
    of: Listener
    timeout = _READS_WITHIN_S
    server_version, sys_version = "Acus", ""

    def do_GET(self) -> None:
        """Answer, and close."""
        if len(self.path) > _LONGEST_LINE:
            self._send(414, b"")
            return
        status, page = self.of.take(self.path, self.headers.get("Host", ""))
        self._send(status, page)

    def log_message(self, *_: Any) -> None:
        """Log nothing: a request holds the code."""

    def _send(self, status: int, page: bytes) -> None:
        self.close_connection = True
        with suppress(OSError):
            self.send_response(status)
            for name, value in (
                ("Content-Type", "text/html; charset=utf-8"),
                ("Content-Length", str(len(page))),
                ("Cache-Control", "no-store"),
                ("Referrer-Policy", "no-referrer"),
                ("Content-Security-Policy", "default-src 'none'; style-src 'unsafe-inline'"),
                ("Connection", "close"),
            ):
                self.send_header(name, value)
            self.end_headers()
            self.wfile.write(page)


def _page(words: str) -> bytes:
    """Return a page of one sentence."""
    style = "font: 1.3em sans-serif; margin: 4em auto; max-width: 30em; color-scheme: light dark"
    text = (
        "<!DOCTYPE html><meta charset='utf-8'><meta name='viewport' content='width=device-width'>"
        f"<title>Acus</title><body style='{style}'><h1>Acus</h1><p>{escape(words)}</p>"
    )
    return text.encode()
