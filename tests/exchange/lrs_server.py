"""A record store of plain sockets that answers by a script: what no proper server would.

Each request takes the next answer of the script: bytes that are sent as they are, `HANG`, `CLOSE`,
or a function of the statements and the store. Written from RFC 9112 and xAPI-Communication.md; it
shares no code with the program.
"""

import json
import socket
import threading
import time
from contextlib import suppress

HANG, CLOSE, DRIBBLE = object(), object(), object()


def answer(status, body=b"", **headers):
    raw = body if isinstance(body, bytes) else json.dumps(body).encode()
    given = {name.replace("_", "-"): value for name, value in headers.items()}
    named = {"Content-Type": "application/json", "Content-Length": len(raw)} | given
    lines = "".join(f"{name}: {value}\r\n" for name, value in named.items())
    return f"HTTP/1.1 {status} said\r\n{lines}\r\n".encode() + raw


class ScriptedLrs:
    """Holds what it took in `held`, all requests in `requests` as (method, target, headers, body).

    Without a script, or once it is used up, it does as xAPI says: takes a batch whole, refuses one
    with an id that it has (409), and shows what it holds.
    """

    def __init__(self, *script, voided=(), tls=None):
        self.script, self.held, self.requests = list(script), {}, []
        self.voided, self._tls = set(voided), tls
        self._listening = socket.create_server(("127.0.0.1", 0))
        self.port = self._listening.getsockname()[1]
        self._over = threading.Event()
        self._thread = threading.Thread(target=self._serve, daemon=True)

    def __enter__(self):
        self._thread.start()
        return self

    def __exit__(self, *_):
        self._over.set()
        with suppress(OSError):
            socket.create_connection(("127.0.0.1", self.port), 1.0).close()
        self._listening.close()
        self._thread.join(5.0)

    @property
    def url(self):
        return f"http://127.0.0.1:{self.port}/xAPI"

    def posts(self):
        """The ids of each POST."""
        return [
            [one["id"] for one in json.loads(body)]
            for method, _, _, body in self.requests
            if method == "POST"
        ]

    def take(self, some):
        """Hold statements, and answer with their ids."""
        self.held |= {one["id"]: one | {"stored": "now", "authority": {}} for one in some}
        return answer(200, [one["id"] for one in some])

    def _serve(self):
        while not self._over.is_set():
            try:
                link, _ = self._listening.accept()
            except OSError:
                return  # closed
            threading.Thread(target=self._meet, args=(link,), daemon=True).start()

    def _meet(self, link):
        with link, suppress(OSError, ValueError, IndexError):
            link.settimeout(5.0)
            if self._tls is None:
                self._one(link)
            else:
                with self._tls.wrap_socket(link, server_side=True) as safe:
                    self._one(safe)

    def _one(self, link):
        head = b""
        while b"\r\n\r\n" not in head:
            head += self._some(link)
        head, _, body = head.partition(b"\r\n\r\n")
        first, *lines = head.decode().split("\r\n")
        headers = dict(line.split(": ", 1) for line in lines)
        while len(body) < int(headers.get("Content-Length", 0)):
            body += self._some(link)
        method, target, _ = first.split(" ")
        self.requests.append((method, target, headers, body))
        said = self.script.pop(0) if self.script else self._properly
        if said is HANG:
            self._over.wait(5.0)
        elif said is DRIBBLE:
            link.sendall(b"HTTP/1.1 200 said\r\nContent-Length: 9999\r\n\r\n")
            for _ in range(100):
                link.sendall(b" ")
                if self._over.wait(0.05):
                    return
        elif said is not CLOSE:
            link.sendall(said if isinstance(said, bytes) else said(method, target, body))
            time.sleep(0.001)

    @staticmethod
    def _some(link):
        found = link.recv(65536)
        if not found:
            raise OSError("closed")
        return found

    def _properly(self, method, target, body):
        if method == "POST":
            some = json.loads(body)
            if any(one["id"] in self.held for one in some):
                return answer(409, b"conflict")
            return self.take(some)
        _, _, query = target.partition("?")
        key, _, name = query.partition("=")
        if key == "limit":
            return answer(200, {"statements": [], "more": ""})
        shown = name in self.held and (name in self.voided) == (key == "voidedStatementId")
        return answer(200, self.held[name]) if shown else answer(404, b"")
