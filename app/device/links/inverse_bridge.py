"""The process between the loop and a Haply service: it stands where a board would.

It says the joint angles that a pantograph would have with its hub at the cursor, and turns the
torques that come for them into the force at the hub that they are, by virtual work. No command is
answered before the service has answered a question that was asked after it: an angle is never older
than the loop takes it for. In a process of its own nobody takes its interpreter away.
"""

from __future__ import annotations

import json
import os
import select
import signal
import socket
import struct
import sys
import time
from collections.abc import Callable
from contextlib import suppress
from math import cos, hypot, isfinite, radians, sin, sqrt
from typing import NamedTuple

import numpy as np

from app.core.configuration import parse
from app.core.messages import sentence
from app.device.errors import LinkError
from app.device.links import acus_protocol as acus
from app.device.links import framing
from app.device.links.inverse_service import NO_FORCE, Cursor, InverseService
from app.device.links.link import BoardError, Hub
from app.device.readiness import UNVERIFIED_FORCE
from app.mechanisms import lever
from app.mechanisms.pantograph import kernels
from app.mechanisms.pantograph.profile import PantographProfile
from app.mechanisms.status import OK

SHORTEST = 0.03
"""A hub this near the entry holds no needle [m]."""


class Played(NamedTuple):
    """Hub, the pantograph's joints there [rad], its lever [m] and dP3/dq [m/rad]."""

    hub: Hub
    q: tuple[float, float]
    l_in: float
    jacobian: tuple[float, float, float, float]


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

    def pose(self, cursor: Cursor) -> Played | None:
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
        return Played(Hub(axis, l_out, inside), (left, right), l_in, (jxl, jxr, jyl, jyr))

    def force(self, pose: Played, torques: tuple[float, float]) -> tuple[float, float, float]:
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


LOOKS_EVERY = 0.5
"""Time between two looks for a device that is not there [s]."""

TELLS_EVERY = 0.01
"""Time between two places of the hub that the window is told [s]."""

COMES_BACK = 0.25
"""Time in which the force grows to its full size after the hub was where no needle can be [s]."""

BOOT = 1
"""The device finds its zero by itself: there is one power cycle."""


class _Command(NamedTuple):
    """What the loop wants: its number, and joint torques [N·m] if they count."""

    sequence: int
    enabled: bool
    torques: tuple[float, float]


class Bridge:
    """The other end of the loop's wire, in a process of its own: nobody takes its interpreter away.

    Args:
        service: of the device, not open yet.
        profile: of the pantograph that is played.
        fulcrum: P_I in the service's frame [m].
        wait: longest time [s] for an answer, and for a command.
        tell: takes a kind, and what there is to say of it.
    """

    def __init__(
        self,
        service: InverseService,
        profile: PantographProfile,
        fulcrum: tuple[float, float, float],
        wait: float,
        tell: Callable[..., None],
    ) -> None:
        self._service, self._profile, self._wait, self._tell = service, profile, wait, tell
        self._played = Impersonated(profile, fulcrum)
        self._step = 2.0 * np.pi / profile.encoder.counts_per_turn
        self._rest, self._silent, self._ended = b"", False, False
        self._pose: Played | None = None
        self._inside_since, self._shown = float(np.inf), 0.0
        self._frame, self._payload = np.zeros(256, np.uint8), np.zeros(256, np.uint8)

    def run(self, end: socket.socket) -> None:
        """Look for the device, and answer for it, until the loop's side is closed."""
        x, y, z = self._played.fulcrum
        if (pose := self._played.pose(Cursor(x, y, z + 0.1))) is not None:
            self._played.force(pose, (0.0, 0.0))  # compiled code is loaded before anybody waits
        while not self._ended:
            try:
                self._service.open()
                self._tell("state", "")
                while not self._ended:
                    self._turn(self._commands(end), end)
            except LinkError as error:
                self._tell("state", str(error))
            finally:
                self._service.close()
            self._silent, self._pose, self._inside_since = False, None, np.inf
            again = time.monotonic() + LOOKS_EVERY
            while not self._ended and time.monotonic() < again:
                self._commands(end)

    def _commands(self, end: socket.socket) -> list[_Command]:
        """Wait a while for the loop's commands."""
        ready, _, _ = select.select([end], [], [], self._wait)
        data = b""
        if ready:
            with suppress(ConnectionError):  # the loop's side was closed with something unread
                data = end.recv(1 << 16)
            self._ended = not data
        *whole, self._rest = (self._rest[-framing.FRAME_BYTES :] + data).split(b"\0")
        commands = []
        for piece in whole:
            payload = self._decoded(piece)
            if payload[:1] == bytes([acus.HELLO]):
                bare = self._profile.model_copy(update={"name": ""})
                self._say(acus.pack_info(bare, self._service.device, BOOT, gauge=False), end)
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
        cursor = self._service.turn(self._force(commands), self._wait)
        now = time.monotonic()
        if cursor is None:
            if not self._silent:
                name = self._service.name
                self._tell(
                    "event", sentence("{name}: the Haply service does not answer", name=name)
                )
            self._silent, self._pose, self._inside_since = True, None, np.inf
            return
        pose = self._played.pose(cursor)
        inside = pose is not None and pose.hub.inside
        self._inside_since = min(self._inside_since, now) if inside else np.inf
        self._pose = pose or self._pose  # where none can be said the last one stands, forceless
        if self._pose is None:
            return
        if now - self._shown >= TELLS_EVERY:
            self._shown = now
            self._tell("hub", now, self._pose.hub._replace(inside=inside))
        for command in commands:
            self._say(self._state(command, cursor, self._pose.q, now), end)

    def _force(self, commands: list[_Command]) -> tuple[float, float, float]:
        """Return the force of the newest command [N], in the service's frame."""
        if not commands or self._pose is None:
            return NO_FORCE
        newest = commands[-1]
        if not (newest.enabled and all(map(isfinite, newest.torques))):
            return NO_FORCE
        share = min(1.0, max(0.0, time.monotonic() - self._inside_since) / COMES_BACK)
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
        micros = int(now * 1e6) & 0xFFFFFFFF
        return struct.pack("<BBHIiiB", acus.STATE, flags, command.sequence, micros, *counts, error)

    def _say(self, payload: bytes, end: socket.socket) -> None:
        try:
            end.send(framing.frame(payload))
        except BlockingIOError:  # nobody reads: the loop rests
            pass
        except OSError:
            self._ended = True


def main() -> None:
    """Be the process: a descriptor and what is given are its arguments."""
    descriptor, given = int(sys.argv[1]), json.loads(sys.argv[2])
    signal.signal(signal.SIGINT, signal.SIG_IGN)  # it ends when the loop's side is closed
    os.set_blocking(sys.stdout.fileno(), False)

    def tell(*message: object) -> None:
        with suppress(OSError):  # nobody reads: what is newer comes later
            os.write(sys.stdout.fileno(), json.dumps(message).encode() + b"\n")

    profile = parse(given["profile"], PantographProfile, "the profile for a Haply service")
    with socket.socket(fileno=descriptor) as end:
        end.setblocking(False)
        service = InverseService(given["name"])
        Bridge(service, profile, tuple(given["fulcrum"]), given["wait"], tell).run(end)


if __name__ == "__main__":
    main()
