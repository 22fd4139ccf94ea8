"""A Haply Inverse3 as a robot: its cursor is the needle's hub.

The loop keeps its own wire. A process stands where a board would (`inverse_bridge`), at the other
end of a pair of sockets. So every exercise of a pantograph runs, and what the loop does about a
wire that falls silent holds as it is.
"""

from __future__ import annotations

import json
import socket
import subprocess
import threading
from collections.abc import Callable, Mapping
from contextlib import suppress
from dataclasses import replace
from typing import IO, Any, cast

from app.core import paths
from app.core.child_process import environment, module_command
from app.core.configuration import Strict, load
from app.core.latest import Latest
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.device.errors import LinkError
from app.device.links import inverse_bridge
from app.device.links.inverse_service import PREFIX, InverseService
from app.device.links.link import BoardInfo, Hub, ToldHub
from app.device.links.port import Port
from app.device.links.protocols import AcusSpeech
from app.device.links.serial_link import SerialLink
from app.mechanisms.pantograph.profile import PantographProfile
from app.mechanisms.profile import DeviceProfile

ANSWER_WITHIN = 0.02
"""Without a state for so long the service does not answer, and without a command the loop [s]."""

BEGINS_WITHIN = 60.0
"""Time for the process to load what it needs [s]."""


class HaplySettings(Strict):
    """Where the entry stands in the service's frame [mm]: x right, y forward, z up."""

    fulcrum_mm: tuple[float, float, float] = (0.0, -120.0, 0.0)


class BridgeProcess:
    """The process of a bridge, and the loop's end of the wire to it; it outlives connections.

    Args:
        given: what the process is told at its beginning.
        hub: takes each place of the hub.
        tell: takes what people must know.

    Attributes:
        end: the loop's.
        trouble: why there is no device now; empty if there is.
    """

    def __init__(
        self, given: Mapping[str, Any], hub: Latest[Hub], tell: Callable[[str], None]
    ) -> None:
        self.end, other = socket.socketpair()
        self.end.setblocking(False)
        self.trouble, self._latest, self._tell = "", hub, tell
        with other:
            self._process = subprocess.Popen(
                [*module_command(inverse_bridge.__name__), str(other.fileno()), json.dumps(given)],
                stdin=subprocess.DEVNULL,
                stdout=subprocess.PIPE,
                pass_fds=(other.fileno(),),
                env=environment(),
            )
        self._begun = threading.Event()
        threading.Thread(target=self._listen, name="haply", daemon=True).start()

    @property
    def begun(self) -> bool:
        """Wait for the first that it says; whether it lives."""
        return self._begun.wait(BEGINS_WITHIN) and self._process.poll() is None

    def close(self) -> None:
        """Close the loop's end: the process gives no force and ends."""
        self.end.close()
        with suppress(subprocess.TimeoutExpired):
            self._process.wait(timeout=2.0)
        self._process.kill()
        self._process.wait()

    def _listen(self) -> None:
        with cast(IO[bytes], self._process.stdout) as lines:
            for line in lines:
                kind, *content = json.loads(line)
                if kind == "hub":
                    moment, (axis, l_out, inside) = content
                    self._latest.publish(Hub(tuple(axis), l_out, inside), moment)
                elif kind == "state":
                    self.trouble = content[0]
                    self._begun.set()
                else:
                    self._tell(content[0])
        self._begun.set()


class CursorPort(Port):
    """The end of the loop's wire as a port; the process stays when it is closed.

    Args:
        name: of the service.
        bridge: at the other end.
    """

    def __init__(self, name: str, bridge: BridgeProcess) -> None:
        super().__init__(name, 0)
        self._bridge = bridge

    @property
    def fd(self) -> int:
        """Descriptor of the loop's end."""
        return self._bridge.end.fileno()

    @property
    def is_pseudo_terminal(self) -> bool:
        """No terminal: whether hardware is behind the service nobody can tell."""
        return False

    def open(self) -> None:
        """See whether the device is there.

        Raises:
            LinkError: if it is not; says why.
        """
        if not self._bridge.begun:
            raise LinkError(sentence("{name}: its process has ended", name=self.path))
        if self._bridge.trouble:
            raise LinkError(self._bridge.trouble)


class Inverse3Link(SerialLink):
    """An Inverse3 at a service; see `SerialLink`."""

    def __init__(self, port: str, profile: DeviceProfile) -> None:
        super().__init__(port, profile)
        self.hub: ToldHub = ToldHub(Latest(), self.events)
        self._speech = AcusSpeech(profile)
        self._service = InverseService(port)
        self._bridge: BridgeProcess | None = None

    def open(self) -> None:
        """See who is there, and start the process; see `SerialLink.open`."""
        if not isinstance(self.profile, PantographProfile):
            raise LinkError(
                sentence(
                    "{name}: an Inverse3 stands in for a pantograph; {profile} is a {kind}",
                    name=self.port,
                    profile=self.profile.name,
                    kind=self.profile.kind,
                )
            )
        try:
            super().open()
        except BaseException:
            self._leave()
            raise

    def close(self) -> None:
        """Let go; see `SerialLink.close`."""
        super().close()
        self._leave()

    def _leave(self) -> None:
        bridge, self._bridge = self._bridge, None
        if bridge is not None:
            bridge.close()

    def _make_port(self) -> Port:
        if self._bridge is None:
            place = paths.settings() / "haply.yaml"
            settings = load(place, HaplySettings) if place.exists() else HaplySettings()
            self._service.open()
            self._service.close()
            given = {
                "name": self.port,
                "profile": self.profile.model_dump(mode="json"),
                "fulcrum": [MILLIMETRE * one for one in settings.fulcrum_mm],
                "wait": ANSWER_WITHIN,
            }
            self._bridge = BridgeProcess(given, self.hub.latest, self._say)
        return CursorPort(self.port, self._bridge)

    def _greeted(self, port: Port) -> BoardInfo:
        info = super()._greeted(port)
        return replace(info, firmware=self._service.version, protocol="haply inverse3", ready=True)


def robot_link(port: str, profile: DeviceProfile) -> SerialLink:
    """Return the link to the robot at a port: `haply:…` is an Inverse3, all else a serial port."""
    kind = Inverse3Link if port.startswith(PREFIX) else SerialLink
    return kind(port, profile)
