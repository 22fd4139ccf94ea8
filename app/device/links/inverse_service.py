"""The Haply Inverse Service, which owns the device: its web socket, one question and one answer.

By the maker's pages of version 3.5: on connecting the service sends an inventory (configuration,
state, status); then one state for each message that it gets. A force holds for one message; without
messages the device idles. Positions are metres, forces newtons, x right, y forward, z up.
"""

from __future__ import annotations

import json
import re
from collections.abc import Mapping
from contextlib import suppress
from http.client import HTTPConnection, HTTPException
from typing import Any, NamedTuple
from urllib.parse import urlsplit

from app.core.messages import sentence
from app.device.errors import BoardVersionError, LinkError
from app.device.links.web_client import WebClient

PREFIX = "haply:"
"""What a port's name begins with that is such a service."""

PORT = 10001

PATIENCE = 2.0
"""Longest that connecting waits for anything [s]."""

LARGEST = 1 << 17
"""Bytes of a message of the service."""

FARTHEST = 2.0
"""No cursor is as far from its base [m]."""

NO_FORCE = (0.0, 0.0, 0.0)

_MOST_UNASKED = 64
_GOODBYE = 0.05
_NAME = re.compile(r"[A-Za-z0-9][A-Za-z0-9._-]{0,15}")


class Cursor(NamedTuple):
    """Where the cursor is [m], and whether the device knows its zero and has power."""

    x: float
    y: float
    z: float
    calibrated: bool = True
    powered: bool = True


class InverseService:
    """One device of one service.

    Args:
        name: `haply:`, `haply:HOST` or `haply:HOST:PORT`; by default on this computer, 10001.

    Attributes:
        device: its identity, of the inventory; empty before `open`.
        version: of the service; empty where it does not say.

    Raises:
        LinkError: if the name is no address.
    """

    def __init__(self, name: str) -> None:
        self.name, self.device, self.version = name, "", ""
        try:
            place = urlsplit(f"ws://{name.removeprefix(PREFIX)}")
            self._host, self._port = place.hostname or "localhost", place.port or PORT
            known = not (place.path or place.query or place.username)
        except ValueError:
            known = False
        if not known:
            raise LinkError(
                sentence(
                    "{name} is no address of a Haply service; valid are haply:, haply:HOST and"
                    " haply:HOST:PORT",
                    name=name,
                )
            )
        self._client: WebClient | None = None
        self._key, self._owed = "vector", 0
        self._greeting: dict[str, Any] = {}

    def open(self) -> Cursor:
        """Connect, and return where the cursor of the first device is.

        Raises:
            BoardVersionError: if the service speaks another version.
            LinkError: if there is no service or no device, or it says what cannot be used.
        """
        self.version = self._asked_version()
        major = self.version.partition(".")[0]
        if self.version and major != "3":
            raise self._another_version(self.version)
        self._client = WebClient(self._host, self._port, LARGEST)
        try:
            self._client.open(PATIENCE)
        except OSError as error:
            raise LinkError(
                sentence(
                    "no Haply service answers at {host} port {port} ({error}): start it (Haply"
                    " Hub, or `systemctl start haply-inverse-service`) and plug the Inverse3 in",
                    host=self._host,
                    port=self._port,
                    error=error,
                )
            ) from error
        try:
            self._owed = 1
            text = self._heard(PATIENCE)
            if text is None:
                raise self._unusable(sentence("it says nothing"))
            return self._inventory(self._document(text))
        except BaseException:
            self.close()
            raise

    def turn(self, force: tuple[float, float, float], wait: float) -> Cursor | None:
        """Give a force [N] and return the cursor that the service read after it.

        While an answer is owed nothing more is asked but, once, no force.

        Args:
            force: for the cursor, in the service's frame.
            wait: longest time [s] for the answer.

        Returns:
            None where nothing came in that time.

        Raises:
            LinkError: if the service is gone, or what it says cannot be used.
        """
        if self._owed == 0:
            for _ in range(_MOST_UNASKED):
                if self._heard(0.0) is None:
                    break
            else:
                raise self._unusable(sentence("it does not stop sending"))
            self._owed = 0
            self._command(force)
        while (text := self._heard(wait)) is not None:
            cursor = self._cursor(self._entry(self._document(text)))
            if self._owed == 0:
                return cursor
        if self._owed == 1:
            self._command(NO_FORCE)
        return None

    def close(self) -> None:
        """Give no force and let go; idempotent."""
        client, self._client = self._client, None
        if client is None:
            return
        if self.device:
            with suppress(OSError):  # an answer left unread would take the last word back
                client.send(self._message(NO_FORCE))
                while self._owed >= 0 and client.receive(_GOODBYE) is not None:
                    self._owed -= 1
        client.close()

    def _asked_version(self) -> str:
        """Ask by HTTP, on the same port; a service that does not say is known by its inventory."""
        asked = HTTPConnection(self._host, self._port, timeout=PATIENCE)
        try:
            asked.request("GET", "/version")
            document = json.loads(asked.getresponse().read(4096))
            document = document.get("data", document)
            return str(document.get("project_version", ""))[:32]
        except (OSError, HTTPException, ValueError, RecursionError, AttributeError):
            return ""
        finally:
            asked.close()

    def _command(self, force: tuple[float, float, float]) -> None:
        if self._client is None:
            raise self._gone(sentence("it is closed"))
        try:
            self._client.send(self._message(force))
        except OSError as error:
            raise self._gone(error) from error
        self._owed += 1

    def _message(self, force: tuple[float, float, float]) -> str:
        x, y, z = force
        commands = {"set_cursor_force": {self._key: {"x": x, "y": y, "z": z}}}
        greeting, self._greeting = self._greeting, {}
        devices = [{"device_id": self.device, "commands": commands}]
        return json.dumps(greeting | {"inverse3": devices})

    def _heard(self, wait: float) -> bytes | None:
        if self._client is None:
            raise self._gone(sentence("it is closed"))
        try:
            text = self._client.receive(wait)
        except OSError as error:
            raise self._gone(error) from error
        self._owed -= text is not None
        return text

    def _document(self, text: bytes) -> Mapping[str, Any]:
        try:
            document = json.loads(text)
        except (ValueError, RecursionError) as error:
            raise self._unusable(sentence("it sends no JSON")) from error
        if not isinstance(document, dict):
            raise self._unusable(sentence("it sends no state"))
        return document

    def _entry(self, document: Mapping[str, Any]) -> Mapping[str, Any]:
        """Return what a message says of the device, or of the first where none is known yet."""
        devices = document.get("inverse3")
        if isinstance(devices, dict):  # by its own pages, the format of 3.0
            raise self._another_version("3.0")
        if not isinstance(devices, list):
            raise self._another_version(sentence("unknown"))
        if not devices:
            raise LinkError(
                sentence(
                    "{name}: no Inverse3 is plugged in: look at cable and power", name=self.name
                )
            )
        for one in devices:
            if isinstance(one, dict) and self.device in ("", one.get("device_id")):
                return one
        raise LinkError(
            sentence(
                "{name}: the Inverse3 {device} is gone; another is there",
                name=self.name,
                device=self.device,
            )
        )

    def _inventory(self, document: Mapping[str, Any]) -> Cursor:
        entry = self._entry(document)
        device = entry.get("device_id")
        if not isinstance(device, str) or not _NAME.fullmatch(device):
            raise self._unusable(sentence("it names no device"))
        cursor = self._cursor(entry)
        try:
            scale = entry["config"]["mount"]["scale"]
            scaled = not all(abs(float(scale[axis]) - 1.0) < 1e-6 for axis in "xyz")
        except (KeyError, TypeError):  # older services have none
            scaled = False
        except ValueError:
            scaled = True
        if scaled:
            raise self._unusable(
                sentence("its mount is scaled: set the scale to 1, so that a metre is one")
            )
        known = tuple(map(int, re.findall(r"\d+", self.version)[:2]))
        newer = known >= (3, 5) if self.version else "session_id" in document
        self.device, self._key = device, "vector" if newer else "values"
        if newer:  # for this session the axes of the maker's own frame, whatever else is set
            configure = {"profile": {"name": "acus"}, "basis": {"permutation": "XYZ"}}
            self._greeting = {"session": {"configure": configure}}
        return cursor

    def _cursor(self, entry: Mapping[str, Any]) -> Cursor:
        try:
            place = entry["state"]["cursor_position"]
            x, y, z = (place[axis] for axis in "xyz")
            fine = all(isinstance(one, int | float) and abs(one) <= FARTHEST for one in (x, y, z))
        except (KeyError, TypeError):
            raise self._unusable(sentence("it sends no position of the cursor")) from None
        if not fine:
            raise self._unusable(
                sentence("its cursor is at {place}, which is no place", place=repr((x, y, z))[:80])
            )
        status = entry.get("status")
        says = status if isinstance(status, dict) else {}
        return Cursor(
            float(x),
            float(y),
            float(z),
            calibrated=says.get("calibrated") is not False,
            powered=says.get("power_supply") is not False,
        )

    def _another_version(self, version: str) -> BoardVersionError:
        return BoardVersionError(
            sentence(
                "{name}: the Haply service there speaks version {version}, this program 3.1 to 3.5"
                " on port {port}; update the older of the two",
                name=self.name,
                version=version,
                port=PORT,
            )
        )

    def _unusable(self, reason: str) -> LinkError:
        return LinkError(
            sentence(
                "{name}: the Haply service cannot be used: {reason}", name=self.name, reason=reason
            )
        )

    def _gone(self, error: object) -> LinkError:
        return LinkError(sentence("{name} is gone: {error}", name=self.name, error=error))


def answering(patience: float) -> str | None:
    """Return the first device of the service on this computer; None if no service answers.

    It is told nothing: a force that another program gives there holds. Empty where it has no
    device.

    Args:
        patience: longest time [s] for each step.
    """
    client = WebClient("localhost", PORT, LARGEST)
    try:
        client.open(patience)
        devices = json.loads(client.receive(patience) or b"")["inverse3"]
        device = devices[0]["device_id"] if devices else ""
        return device if _NAME.fullmatch(device) else ""
    except (OSError, LinkError, ValueError, RecursionError, LookupError, TypeError):
        return None  # nobody, somebody else, or the package `websockets` is not installed
    finally:
        client.close()


def refuse_inverse3(port: str) -> None:
    """Refuse to commission, or to test as firmware, what is no board.

    Raises:
        LinkError: if the port is a Haply service's.
    """
    if port.startswith(PREFIX):
        raise LinkError(
            sentence(
                "{port} is an Inverse3: it finds its zero by itself and has no board of ours:"
                " there is nothing to commission; try `acus device test {port}`",
                port=port,
            )
        )
