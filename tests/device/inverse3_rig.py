"""A scripted Haply Inverse Service, written from the maker's pages alone; it shares no code.

https://docs.haply.co/inverseSDK/service/realtime/websocket-protocol (3.5): an inventory when a
client connects, then one state for each message. `/version` is answered on the same port.
"""

import json
import threading
import time
from http import HTTPStatus

from websockets.exceptions import ConnectionClosed
from websockets.sync.server import serve

DEVICE = "049D"


def vector(values):
    return dict(zip("xyz", values, strict=True))


class ScriptedService:
    """Answers on a free port of this computer, until it is closed.

    Attributes:
        place: of the cursor [m].
        forces: (time [s], force [N]) of every command that came.
        script: turns the next state, a dict, into what is sent: text, bytes, a dict, or None for
            no answer at all.
    """

    def __init__(self, place, version="3.5.0.0", key="vector", scale=1.0, port=0):
        self.place, self.version, self.key, self.scale = place, version, key, scale
        self.device, self.status = DEVICE, {"calibrated": True, "power_supply": True}
        self.forces, self.messages, self.greetings = [], [], 0
        self.script = lambda state: state
        self.inventory = lambda inventory: inventory
        self._server = serve(
            self._serve, "localhost", port, process_request=self._request, compression=None
        )
        self.port = self._server.socket.getsockname()[1]
        self.name = f"haply:localhost:{self.port}"
        self._open = set()
        threading.Thread(target=self._server.serve_forever, daemon=True).start()

    def _request(self, connection, request):
        if request.path != "/version":
            return None
        if self.version is None:
            return connection.respond(HTTPStatus.NOT_FOUND, "none")
        text = json.dumps({"ok": True, "data": {"project_version": self.version}})
        return connection.respond(HTTPStatus.OK, text)

    def state(self):
        return {
            "inverse3": [
                {
                    "device_id": self.device,
                    "state": {"cursor_position": vector(self.place)},
                    "status": self.status,
                }
            ]
        }

    def _inventory(self):
        inventory = self.state()
        if self.key == "vector":
            inventory["session_id"] = 7
            mount = {"scale": vector([self.scale] * 3)}
            inventory["inverse3"][0]["config"] = {"type": "inverse3", "mount": mount}
        return self.inventory(inventory)

    def _serve(self, connection):
        self.greetings += 1
        self._open.add(connection)
        try:
            connection.send(json.dumps(self._inventory()))
            for message in connection:
                self._take(json.loads(message))
                answer = self.script(self.state())
                if answer is not None:
                    connection.send(json.dumps(answer) if isinstance(answer, dict) else answer)
        except ConnectionClosed:
            pass
        finally:
            self._open.discard(connection)

    def _take(self, message):
        self.messages.append(message)
        (one,) = message["inverse3"]
        assert one["device_id"] == self.device
        given = one["commands"]["set_cursor_force"]
        assert list(given) == [self.key], given  # what this version does not know moves nothing
        force = tuple(given[self.key][axis] for axis in "xyz")
        self.forces.append((time.monotonic(), force))

    def force(self):
        return self.forces[-1][1]

    def drop(self):
        for connection in list(self._open):
            connection.close()

    def close(self):
        self._server.shutdown()
        self.drop()
