"""The two languages side by side: how to greet a board, fill a wire's array, and which stages."""

from __future__ import annotations

import secrets
from abc import ABC, abstractmethod
from collections.abc import Callable
from typing import Any

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.device.errors import LinkError
from app.device.links import acus_protocol as acus
from app.device.links import cable_protocol as cables
from app.device.links import haply_protocol as haply
from app.device.links import host_end as host
from app.device.links import wire
from app.device.links.framing import Deframer
from app.device.links.link import BoardInfo
from app.mechanisms.profile import DeviceProfile, Protocol

Exchange = Callable[[bytes], bytes]
"""Send bytes, wait a while, return what has come (maybe nothing)."""

ATTEMPTS = 32
"""Greetings before a board counts as silent: two seconds, since some boards restart when their port
is opened."""


class Speech(ABC):
    """One protocol. Shared by every link, whatever carries its bytes."""

    name: str
    stages: tuple[Any, Any]

    @abstractmethod
    def greet(self, exchange: Exchange) -> BoardInfo:
        """Find out who is there.

        Raises:
            LinkError: if nobody answers, or a board of another version or kind.
        """

    @abstractmethod
    def fill(self, end: FloatArray) -> None:
        """Write the profile's constants into the program's end of a wire.

        What was measured on one robot is no part of them: `control.corrections` adds it.
        """

    @abstractmethod
    def greeted(self, end: FloatArray, info: BoardInfo) -> None:
        """Begin anew with a board that has just been greeted."""


class AcusSpeech(Speech):
    """Acus' own protocol: version 1 for motors on the joints, version 2 for four winches."""

    name = "acus"

    def __init__(self, profile: DeviceProfile) -> None:
        self._profile, self._version = profile, acus.VERSION
        self.stages = (acus.acus_read, acus.acus_write)
        if profile.tension_range is not None:
            self._version, self.stages = cables.VERSION, (cables.cables_read, cables.cables_write)

    def greet(self, exchange: Exchange) -> BoardInfo:
        """Say HELLO until an INFO comes, and compare it with the profile."""
        deframer, seen = Deframer(), 0
        for _ in range(ATTEMPTS):
            data = exchange(acus.hello(self._version))
            seen += len(data)
            for payload in deframer.feed(data):
                if payload[0] == acus.INFO:
                    return self._checked(payload)
        raise LinkError(silence(seen, sentence("no board that speaks Acus' protocol")))

    def _checked(self, payload: bytes) -> BoardInfo:
        info, counts, _, watchdog = acus.read_info(payload, self._version)
        wanted = self._profile
        if info.profile and info.profile != wanted.name:
            raise LinkError(
                sentence(
                    "the board says that it belongs to a robot of the profile {info_profile!r}, "
                    "the program was started for {wanted_name!r}; choose the profile "
                    "{right_profile}",
                    info_profile=info.profile,
                    wanted_name=wanted.name,
                    right_profile=info.profile,
                )
            )
        if counts != wanted.encoder.counts_per_turn:
            raise LinkError(
                sentence(
                    "the board counts {counts} per turn, the profile {wanted_name} says"
                    " {encoder_counts_per_turn}; correct the profile or the firmware",
                    counts=counts,
                    wanted_name=wanted.name,
                    encoder_counts_per_turn=wanted.encoder.counts_per_turn,
                )
            )
        if watchdog > wanted.wire.watchdog_ms * 1e-3 + 1e-9:
            raise LinkError(
                sentence(
                    "the board's watchdog waits {watchdog:g} ms, the profile {wanted_name}"
                    " allows {wanted_wire_watchdog_ms:g} ms; update the firmware",
                    watchdog=watchdog * 1e3,
                    wanted_name=wanted.name,
                    wanted_wire_watchdog_ms=wanted.wire.watchdog_ms,
                )
            )
        return info

    def fill(self, end: FloatArray) -> None:
        """Angles from counts."""
        end[host.SILENT_AFTER] = self._profile.wire.watchdog_ms * 1e-3
        end[host.OFFSET : host.OFFSET + 2] = self._profile.encoder.home_offsets
        end[host.STEP] = 2.0 * np.pi / self._profile.encoder.counts_per_turn

    def greeted(self, end: FloatArray, info: BoardInfo) -> None:
        """Its homing message carries the number of the power cycle."""
        _begin(end, acus.home(info.boot))
        end[host.GAUGE] = 0.0


class HaplySpeech(Speech):
    """The Haply 2DIY's protocol."""

    name = "haply"
    stages = (haply.haply_read, haply.haply_write)

    def __init__(self, profile: DeviceProfile) -> None:
        self._profile = profile
        self._setup = haply.setup(profile)

    def greet(self, exchange: Exchange) -> BoardInfo:
        """Set the board up, and ask for its angles until they come."""
        number, seen = haply.section_of(self._profile).device_id, 0
        request = haply.read_request(self._profile)
        exchange(self._setup)
        for _ in range(ATTEMPTS):
            data = exchange(request)
            seen += len(data)
            if len(data) == haply.REPLY_BYTES and data[0] == number:
                return self._found()
        raise LinkError(
            silence(
                seen, sentence("no Haply board with number {board_number}", board_number=number)
            )
        )

    def _found(self) -> BoardInfo:
        # A number that no other connection has, of any program: records outlive them.
        boot = 1 + secrets.randbelow(2**31 - 1)
        return BoardInfo(profile="", serial="", firmware="", protocol="haply", boot=boot)

    def fill(self, end: FloatArray) -> None:
        """Angles come in degrees, the profile's offsets included."""
        end[host.SILENT_AFTER] = self._profile.wire.watchdog_ms * 1e-3
        section = haply.section_of(self._profile)
        end[haply.DEVICE_ID] = section.device_id
        end[haply.LEFT_SECOND] = section.encoder_ports[0] > section.encoder_ports[1]
        own = np.radians(section.encoder_offset_deg)
        end[host.OFFSET : host.OFFSET + 2] = np.array(self._profile.encoder.home_offsets) - own
        end[host.STEP] = np.pi / 180.0

    def greeted(self, end: FloatArray, info: BoardInfo) -> None:
        """Set it up again with the next homing message."""
        _begin(end, self._setup)
        end[haply.AWAITING] = end[haply.LAST_TORQUE] = 0.0


def speech_of(profile: DeviceProfile) -> Speech:
    """Protocol of a profile.

    Raises:
        ConfigurationError: if the profile lacks the section that its protocol needs.
    """
    return HaplySpeech(profile) if profile.wire.protocol is Protocol.HAPLY else AcusSpeech(profile)


def silence(seen: int, whom: str) -> str:
    """Say that nobody answers, and why that may be."""
    if seen:
        return sentence(
            "{whom} answers: {seen} bytes came, but they make no sense; check that this is "
            "the robot's port (acus device list), its profile, and the baud rate there "
            "(wire.baud)",
            whom=whom,
            seen=seen,
        )
    return sentence(
        "{whom} answers; check its power and cable, that this is the robot's port (acus "
        "device list), its profile, and the baud rate there (wire.baud)",
        whom=whom,
    )


def _begin(end: FloatArray, homing: bytes) -> None:
    """Forget the connection before: sequence, half frames, homing."""
    end[host.HOME_BYTES : host.RECEIVER_AT].view(np.uint8)[: len(homing)] = np.frombuffer(
        homing, np.uint8
    )
    end[host.HOME_COUNT] = len(homing)
    end[[host.HOME_WANTED, host.HOME_SENT, host.HOMED, host.ESTRANGED, host.ERROR]] = 0.0
    end[[wire.IN_COUNT, wire.OUT_COUNT, wire.DEAD, host.FORCE, host.GAUGE]] = 0.0
    end[host.ANSWERED] = -1.0
    end[host.RECEIVER_AT : host.SPARE] = 0.0
