"""A Haply Inverse3 as a robot: its cursor is the needle's hub.

The loop keeps its own wire. A thread stands where a board would, at the other end of a pair of
sockets: it says the joint angles that a pantograph would have with its hub there, and turns the
torques that come for them into the force at the hub that they are, by virtual work. So every
exercise of a pantograph runs, and what the loop does about a wire that falls silent holds as it is.

No command is answered before the service has answered a question that was asked after it: an angle
is never older than the loop takes it for.
"""

from __future__ import annotations

import select
import socket
import struct
import threading
from collections.abc import Callable
from dataclasses import replace
from math import cos, hypot, isfinite, radians, sin, sqrt
from typing import NamedTuple

import numpy as np

from app.core import paths
from app.core.clock import Clock
from app.core.configuration import Strict, load
from app.core.latest import Latest
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.device.errors import LinkError
from app.device.links import acus_protocol as acus
from app.device.links import framing
from app.device.links.inverse_service import NO_FORCE, PREFIX, Cursor, InverseService
from app.device.links.link import BoardError, BoardInfo
from app.device.links.port import Port
from app.device.links.protocols import AcusSpeech
from app.device.links.serial_link import SerialLink
from app.device.readiness import UNVERIFIED_FORCE, ForceClearance
from app.mechanisms import lever
from app.mechanisms.pantograph import kernels
from app.mechanisms.pantograph.profile import PantographProfile
from app.mechanisms.profile import DeviceProfile
from app.mechanisms.status import OK

ANSWER_WITHIN = 0.02
"""Without a state for so long the service does not answer, and without a command the loop [s]."""

COMES_BACK = 0.25
"""Time in which the force grows to its full size after the hub was where no needle can be [s]."""

SHORTEST = 0.03
"""A hub this near the entry holds no needle [m]."""

BOOT = 1
"""The device finds its zero by itself: there is one power cycle."""


class HaplySettings(Strict):
    """Where the entry stands in the service's frame [mm]: x right, y forward, z up."""

    fulcrum_mm: tuple[float, float, float] = (0.0, -120.0, 0.0)


class Hub(NamedTuple):
    """The needle by its hub.

    Attributes:
        axis: direction, hub to tip.
        l_out: hub to entry [m].
        inside: whether a needle can be there; if not, `axis` is the nearest that can.
    """

    axis: tuple[float, float, float]
    l_out: float
    inside: bool


class _Played(NamedTuple):
    """Hub, the pantograph's joints there [rad], its lever [m] and dP3/dq [m/rad]."""

    hub: Hub
    q: tuple[float, float]
    l_in: float
    jacobian: tuple[float, float, float, float]


class _Command(NamedTuple):
    """What the loop wants: its number, and joint torques [N·m] if they count."""

    sequence: int
    enabled: bool
    torques: tuple[float, float]


class Impersonated:
    """The pantograph that is played, and where its entry stands in the service's frame.

    Args:
        profile: of a pantograph.
        fulcrum: P_I in the service's frame [m].

    Attributes:
        fulcrum: the same.
    """

    def __init__(self, profile: PantographProfile, fulcrum: tuple[float, float, float]) -> None:
        part, self._centre, self.fulcrum = profile.geometry, profile.geometry.fulcrum, fulcrum
        self._links = part.proximal, part.distal, part.base
        self._limit = radians(profile.tilt_limit_deg)

    def pose(self, cursor: Cursor) -> _Played | None:
        """Return the pose with the hub at the cursor; None where nobody could say one."""
        x, y, z = (entry - there for entry, there in zip(self.fulcrum, cursor[:3], strict=True))
        l_out = sqrt(x * x + y * y + z * z)
        across = hypot(x, y)
        if not l_out > 0.0:
            return None
        inside = l_out >= SHORTEST and -z >= l_out * cos(self._limit)
        if inside:
            axis = x / l_out, y / l_out, z / l_out
        elif across > 0.0:
            size = sin(self._limit) / across
            axis = size * x, size * y, -cos(self._limit)
        else:
            return None
        fx, fy, fz = self._centre
        l_in = -fz / axis[2]
        px, py = fx + l_in * axis[0], fy + l_in * axis[1]
        status, left, right = kernels.inverse_kernel(px, py, *self._links, 1.0, -1.0)
        if status != OK:
            return None
        status, *rates = kernels.jacobian_kernel(left, right, px, py, *self._links)
        if status != OK:
            return None
        jxl, jxr, jyl, jyr = rates
        return _Played(Hub(axis, l_out, inside), (left, right), l_in, (jxl, jxr, jyl, jyr))

    def force(self, pose: _Played, torques: tuple[float, float]) -> tuple[float, float, float]:
        """Return the force at the hub [N] that joint torques [N·m] are, at most what is allowed."""
        if not pose.hub.inside:
            return NO_FORCE
        status, gx, gy = lever.tool_force_kernel(*torques, *pose.jacobian)
        if status != OK:
            return NO_FORCE
        x, y, z = lever.felt_kernel(gx, gy, *pose.hub.axis, pose.l_in, pose.hub.l_out)
        size = sqrt(x * x + y * y + z * z)
        if not isfinite(size):
            return NO_FORCE
        share = min(1.0, UNVERIFIED_FORCE / size) if size > 0.0 else 0.0
        return share * x, share * y, share * z


class CursorPort(Port):
    """The loop's end of a pair of sockets, and the thread at the other.

    Args:
        name: of the service.
        profile: of the pantograph that is played.
        hub: takes each place of the hub.
        tell: takes what people must know.
        clock: monotonic, the loop's.
    """

    def __init__(
        self,
        name: str,
        profile: DeviceProfile,
        hub: Latest[Hub],
        tell: Callable[[str], None],
        clock: Clock,
    ) -> None:
        super().__init__(name, 0)
        if not isinstance(profile, PantographProfile):
            raise LinkError(
                sentence(
                    "{name}: an Inverse3 stands in for a pantograph; {profile} is a {kind}",
                    name=name,
                    profile=profile.name,
                    kind=profile.kind,
                )
            )
        self.service = InverseService(name)
        self._played: Impersonated
        self._profile, self._latest, self._tell, self._clock = profile, hub, tell, clock
        self._step = 2.0 * np.pi / profile.encoder.counts_per_turn
        self._pair: tuple[socket.socket, socket.socket] | None = None
        self._thread: threading.Thread | None = None
        self._stop = threading.Event()
        self._rest, self._silent = b"", False
        self._pose: _Played | None = None
        self._inside_since = float(np.inf)
        self._frame, self._payload = np.zeros(256, np.uint8), np.zeros(256, np.uint8)

    @property
    def fd(self) -> int:
        """Descriptor of the loop's end."""
        if self._pair is None:
            raise LinkError(sentence("{name} is closed; call open() first", name=self.path))
        return self._pair[0].fileno()

    @property
    def is_pseudo_terminal(self) -> bool:
        """No terminal: whether hardware is behind the service nobody can tell."""
        return False

    def open(self) -> None:
        """Connect to the service and start the thread.

        Raises:
            LinkError: if there is no service or no device.
        """
        place = paths.settings() / "haply.yaml"
        settings = load(place, HaplySettings) if place.exists() else HaplySettings()
        x, y, z = (MILLIMETRE * one for one in settings.fulcrum_mm)
        self._played = Impersonated(self._profile, (x, y, z))
        self._rehearse()
        self.service.open()
        self._pair = socket.socketpair()
        for end in self._pair:
            end.setblocking(False)
        self._thread = threading.Thread(
            target=self._run, args=(self._pair[1],), name="haply", daemon=True
        )
        self._thread.start()

    def close(self) -> None:
        """End at no force and let go; idempotent."""
        self._stop.set()
        thread, self._thread = self._thread, None
        if thread is not None and thread is not threading.current_thread():
            thread.join(timeout=2.0)
        pair, self._pair = self._pair, None
        for end in pair or ():
            end.close()

    def _rehearse(self) -> None:
        """Load compiled code before anybody waits for an answer."""
        x, y, z = self._played.fulcrum
        pose = self._played.pose(Cursor(x, y, z + 0.1))
        if pose is not None:
            self._played.force(pose, (0.0, 0.0))

    def _run(self, end: socket.socket) -> None:
        try:
            while not self._stop.is_set():
                self._turn(self._commands(end), end)
        except LinkError as error:
            if not self._stop.is_set():
                self._tell(str(error))
        finally:
            self.service.close()
            end.close()  # so the loop's wire is dead, and the robot looked for again

    def _commands(self, end: socket.socket) -> list[_Command]:
        """Wait a while for the loop's commands."""
        ready, _, _ = select.select([end], [], [], ANSWER_WITHIN)
        data = end.recv(1 << 16) if ready else b""
        if ready and not data:
            self._stop.set()
        *whole, self._rest = (self._rest[-framing.FRAME_BYTES :] + data).split(b"\0")
        commands = []
        for piece in whole:
            payload = self._decoded(piece)
            if payload[:1] == bytes([acus.HELLO]):
                bare = self._profile.model_copy(update={"name": ""})
                self._say(acus.pack_info(bare, self.service.device, BOOT, gauge=False), end)
            elif payload[:1] == bytes([acus.COMMAND]) and len(payload) == acus.COMMAND_BYTES:
                _, flags, sequence, left, right = struct.unpack("<BBHff", payload)
                commands.append(_Command(sequence, bool(flags & acus.ENABLE), (left, right)))
        return commands

    def _decoded(self, piece: bytes) -> bytes:
        if not 0 < len(piece) <= framing.FRAME_BYTES:
            return b""
        self._frame[: len(piece)] = np.frombuffer(piece, np.uint8)
        length = framing.decode(self._frame, len(piece), self._payload)
        return self._payload[: max(length, 0)].tobytes()

    def _turn(self, commands: list[_Command], end: socket.socket) -> None:
        """Give the newest force, and answer with the place that the service read after it."""
        cursor = self.service.turn(self._force(commands), ANSWER_WITHIN)
        now = self._clock.now()
        if cursor is None:
            if not self._silent:
                self._tell(sentence("{name}: the Haply service does not answer", name=self.path))
            self._silent, self._pose, self._inside_since = True, None, np.inf
            return
        pose = self._played.pose(cursor)
        inside = pose is not None and pose.hub.inside
        self._inside_since = min(self._inside_since, now) if inside else np.inf
        self._pose = pose or self._pose  # where none can be said the last one stands, forceless
        if self._pose is None:
            return
        self._latest.publish(self._pose.hub._replace(inside=inside), now)
        for command in commands:
            self._say(self._state(command, cursor, self._pose.q, now), end)

    def _force(self, commands: list[_Command]) -> tuple[float, float, float]:
        """Return the force of the newest command [N], in the service's frame."""
        if not commands or self._pose is None:
            return NO_FORCE
        newest = commands[-1]
        if not (newest.enabled and all(map(isfinite, newest.torques))):
            return NO_FORCE
        share = min(1.0, max(0.0, self._clock.now() - self._inside_since) / COMES_BACK)
        x, y, z = self._played.force(self._pose, newest.torques)
        return share * x, share * y, share * z

    def _state(
        self, command: _Command, cursor: Cursor, q: tuple[float, float], now: float
    ) -> bytes:
        """Return what a board would say: STATE of docs/protocol.md."""
        flags = acus.GREETED | (acus.HOMED if cursor.calibrated else 0)
        flags |= acus.ENABLED if command.enabled else 0
        counts = [
            round((angle - home) / self._step)
            for angle, home in zip(q, self._profile.encoder.home_offsets, strict=True)
        ]
        error = BoardError.NONE if cursor.powered else BoardError.SUPPLY_OFF
        time = int(now * 1e6) & 0xFFFFFFFF
        return struct.pack("<BBHIiiB", acus.STATE, flags, command.sequence, time, *counts, error)

    def _say(self, payload: bytes, end: socket.socket) -> None:
        try:
            end.send(framing.frame(payload))
        except BlockingIOError:  # nobody reads: the loop rests
            pass
        except OSError:
            self._stop.set()


class Inverse3Link(SerialLink):
    """An Inverse3 at a service; see `SerialLink`.

    Attributes:
        hub: the needle by its hub, with the time of the reading.
    """

    def __init__(self, port: str, profile: DeviceProfile) -> None:
        super().__init__(port, profile)
        self.hub: Latest[Hub] = Latest()
        self._speech = AcusSpeech(profile)

    def clearance(self) -> ForceClearance:
        """Return that the device knows its zero, and that nobody has weighed its forces."""
        return ForceClearance(
            1.0,
            min(UNVERIFIED_FORCE, self.profile.limits.hand_force),
            sentence(
                "forces are held to {cap:g} N: those of a Haply Inverse3 were never weighed here",
                cap=UNVERIFIED_FORCE,
            ),
        )

    def _make_port(self) -> Port:
        return CursorPort(self.port, self.profile, self.hub, self._say, self._clock)

    def _greeted(self, port: Port) -> BoardInfo:
        info = super()._greeted(port)
        version = port.service.version if isinstance(port, CursorPort) else ""
        return replace(info, firmware=version, protocol="haply inverse3")


def robot_link(port: str, profile: DeviceProfile) -> SerialLink:
    """Return the link to the robot at a port: `haply:…` is an Inverse3, all else a serial port."""
    kind = Inverse3Link if port.startswith(PREFIX) else SerialLink
    return kind(port, profile)
