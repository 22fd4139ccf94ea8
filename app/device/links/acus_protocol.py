"""Acus' own protocol, version 1, the program's side (docs/protocol.md, byte by byte)."""

import struct
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.messages import sentence
from app.device.errors import BoardVersionError
from app.device.links import framing, wire
from app.device.links import host_end as host
from app.device.links.framing import RECEIVER
from app.device.links.link import BoardInfo
from app.mechanisms.profile import DeviceProfile

VERSION: Final = 1
"""Version of the protocol that this program speaks to a robot with motors on its joints."""

HELLO: Final = 0x01
COMMAND: Final = 0x02
HOME: Final = 0x03
INFO: Final = 0x81
STATE: Final = 0x82
"""First byte of a message; the board's have the highest bit set."""

COMMAND_BYTES: Final = 12
STATE_BYTES: Final = 17
STATE_WITH_FORCE_BYTES: Final = 21
INFO_FORMAT: Final = "<BBBBIIfBB16s16s"
INFO_BYTES: Final = 50

ENABLE: Final = 1
"""Flag of a command: the torques count."""

ENABLED: Final = 1
HOMED: Final = 2
TRIPPED: Final = 4
FORCE_VALID: Final = 8
GREETED: Final = 16
LIMITED: Final = 32
"""Flags of a state."""

FEATURE_GAUGE: Final = 1
FEATURE_EMULATED: Final = 2
FEATURE_LIMITED: Final = 4
"""Features of a board: it measures the force; it is a program, no hardware; it says LIMITED."""


def hello(version: int = VERSION) -> bytes:
    """Frame that asks a board who it is; a zero before it ends whatever was on the line."""
    return b"\x00" + framing.frame(bytes([HELLO, version]))


def home(boot: int) -> bytes:
    """Frame that makes the present joint angles the zero of the counters, in this power cycle."""
    return framing.frame(struct.pack("<BI", HOME, boot))


def pack_info(
    profile: DeviceProfile, serial: str, boot: int, gauge: bool, emulated: bool = False
) -> bytes:
    """INFO of a board of a profile (without frame), as firmware would send it.

    A robot with cables says version 2, and its largest tension [N] in place of the largest torque.
    """
    cables = profile.tension_range
    version, most = (VERSION, profile.limits.joint_torque) if cables is None else (2, cables[1])
    features = FEATURE_GAUGE * gauge + FEATURE_EMULATED * emulated
    return struct.pack(
        INFO_FORMAT,
        *(INFO, version, 1, 0, boot, profile.encoder.counts_per_turn, most),
        *(features, round(profile.wire.watchdog_ms)),
        *(serial.encode("ascii"), profile.name.encode("ascii")),
    )


def read_info(payload: bytes, wanted: int = VERSION) -> tuple[BoardInfo, int, float, float]:
    """Parse an INFO of a board that should speak the `wanted` version.

    Returns:
        The board, its counts per turn, largest torque [N·m] (of cables: tension [N]) and watchdog
        time [s].

    Raises:
        BoardVersionError: if the board speaks another version; names both. Type and version stand
            in the same two bytes in every version.
    """
    if len(payload) < 2 or payload[1] != wanted or len(payload) != INFO_BYTES:
        theirs = payload[1] if len(payload) > 1 else 0
        raise BoardVersionError(
            sentence(
                "the board speaks version {theirs} of the protocol, this program version {wanted}"
                " ({received_bytes} bytes): update the"
                " {older_side} (docs/protocol.md)",
                theirs=theirs,
                wanted=wanted,
                received_bytes=len(payload),
                older_side="board" if theirs < wanted else "program",
            )
        )
    _, version, major, minor, boot, counts, torque, features, watchdog, serial, name = (
        struct.unpack(INFO_FORMAT, payload)
    )
    info = BoardInfo(
        profile=_text(name),
        serial=_text(serial),
        firmware=f"{major}.{minor}",
        protocol=f"acus {version}",
        boot=boot,
        gauge=bool(features & FEATURE_GAUGE),
        emulated=bool(features & FEATURE_EMULATED),
    )
    return info, counts, torque, watchdog * 1e-3


def _text(field: bytes) -> str:
    return field.split(b"\0")[0].decode("ascii", errors="replace")


@njit
def _answered(p: FloatArray, sequence: int) -> bool:
    """Match a reply with its command: round trip, and commands that were never answered.

    Returns:
        Whether it answers one of the last commands, and a newer one than the reply before.
    """
    newest, before = int(p[wire.SEQUENCE]), int(p[host.ANSWERED])
    if ((newest - sequence) & 0xFFFF) >= wire.SENT_RING:
        return False
    if before >= 0:
        passed = (sequence - before) & 0xFFFF
        if not 0 < passed < 0x8000:
            return False
        p[host.LOST] += passed - 1
    p[host.ROUND_TRIP] = p[wire.NOW] - wire.sent_at(p, sequence)
    p[host.ANSWERED] = sequence
    return True


@njit
def take_joints(state: FloatArray, p: FloatArray, data: Any) -> bool:
    """Take flags, error and joint angles of a STATE of either version; whether they are new."""
    flags = np.int64(data[1])
    p[host.BOARD_FLAGS] = flags
    p[host.ESTRANGED] = 0.0 if flags & GREETED else 1.0
    p[host.HOMED] = 1.0 if flags & HOMED and flags & GREETED else 0.0
    p[host.ERROR] = data[16]
    fresh = _answered(p, wire.get_int(data, 2, 2))
    if fresh:  # what was recorded or held back is no sign of life
        host.heard(p)
    if (
        not flags & GREETED or not fresh
    ):  # restarted: its counters mean nothing yet; or old readings
        return False
    state[sv.Q_LEFT] = p[host.OFFSET] + wire.get_int32(data, 8) * p[host.STEP]
    state[sv.Q_RIGHT] = p[host.OFFSET + 1] + wire.get_int32(data, 12) * p[host.STEP]
    state[sv.Q_TIME] = p[wire.NOW] - p[host.ROUND_TRIP]  # read after that, not when it came
    return True


@njit
def _take_state(state: FloatArray, p: FloatArray, data: Any, length: int) -> None:
    if not take_joints(state, p, data):
        return
    flags = np.int64(data[1])
    p[host.GAUGE] = 1.0 if flags & FORCE_VALID and length == STATE_WITH_FORCE_BYTES else 0.0
    if p[host.GAUGE] != 0.0:
        force = wire.get_float(p, data, 17)
        if np.isfinite(force):
            p[host.FORCE] = force
        else:
            p[host.GAUGE] = 0.0


@stage
def acus_read(state: FloatArray, p: FloatArray) -> None:
    """Parse what has come; the newest STATE becomes Q_*, GAUGE_* and LINK_*."""
    receiver = p[host.RECEIVER_AT : host.RECEIVER_AT + RECEIVER]
    frame, payload = framing.frame_bytes(receiver), framing.payload_bytes(receiver)
    data = wire.incoming(p)
    for k in range(int(p[wire.IN_COUNT])):
        length = framing.receive(receiver, frame, payload, data[k])
        if length < 0:
            p[host.ERRORS] += 1.0
        elif length in (STATE_BYTES, STATE_WITH_FORCE_BYTES) and payload[0] == STATE:
            _take_state(state, p, payload, length)
    p[wire.IN_COUNT] = 0.0
    host.publish(state, p)


@stage
def acus_write(state: FloatArray, p: FloatArray) -> None:
    """Put one COMMAND with TORQUE_* into `outgoing`, and a HOME when one is asked for."""
    if not host.may_send(p):
        return
    host.append_home(p)
    left, right = state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT]
    enable = state[sv.ENABLED] > 0.5 and np.isfinite(left + right)
    p[wire.SEQUENCE] = (int(p[wire.SEQUENCE]) + 1) & 0xFFFF
    p[host.SENT] += 1.0
    receiver = p[host.SPARE : host.SPARE + 8]
    data = receiver.view(np.uint8)
    data[0], data[1] = COMMAND, ENABLE if enable else 0
    wire.put_int(data, 2, int(p[wire.SEQUENCE]), 2)
    wire.put_float(p, data, 4, left if enable else 0.0)
    wire.put_float(p, data, 8, right if enable else 0.0)
    start = int(p[wire.OUT_COUNT])
    p[wire.OUT_COUNT] = framing.encode(data, COMMAND_BYTES, wire.outgoing(p), start)
