"""The Haply 2DIY's protocol, the program's side (docs/protocol.md).

It has no checksum, no sequence number and no number of the power cycle. A reply is therefore taken
only with the right length, the right first byte and angles within two turns (whether a joint can
have got there is judged in the loop, for every machine alike); one command is under way at a time,
so that a reply belongs to it, and what else has come when the next goes out is dropped, which keeps
both in step; and every new connection counts as a new power cycle.
"""

import struct
from collections.abc import Sequence
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.messages import sentence
from app.device.links import host_end as host
from app.device.links import wire
from app.mechanisms.profile import DeviceProfile, HaplySection

RESET: Final = 0
SETUP: Final = 1
TORQUES: Final = 2
"""First byte of what the program sends; the second is the board's number."""

COMMAND_BYTES: Final = 10
REPLY_BYTES: Final = 9
SETUP_BYTES: Final = 26

LARGEST_ANGLE_DEG: Final = 720.0
ANSWER_WITHIN: Final = 2.5e-3
"""After this long without an answer [s] the next command goes out all the same."""

DEVICE_ID: Final = host.SPARE
LEFT_SECOND: Final = host.SPARE + 1  # 1 if the left joint has the higher port
AWAITING: Final = host.SPARE + 2  # 1 while a command is under way
LAST_TORQUE: Final = host.SPARE + 3  # largest torque of the last command [N·m]


def setup(profile: DeviceProfile) -> bytes:
    """Bytes that tell a board its motors and encoders; the joints stand at their home angles.

    Motor block, encoder block (ports as a bit mask, then a direction for each), no sensors, no
    pulse outputs, then offset [°] and counts per turn of each encoder; in ascending order of ports.
    """
    section = section_of(profile)
    data = struct.pack("<BB", SETUP, section.device_id)
    data += _block(section.motor_ports, section.motor_ccw)
    data += _block(section.encoder_ports, section.encoder_ccw) + b"\0\0"
    for k in np.argsort(section.encoder_ports):
        data += struct.pack("<ff", section.encoder_offset_deg[k], profile.encoder.counts_per_turn)
    return data


def _block(ports: Sequence[int], ccw: Sequence[bool]) -> bytes:
    mask = sum(1 << (port - 1) for port in ports)
    return bytes([mask, *(int(ccw[k]) for k in np.argsort(ports))])


def section_of(profile: DeviceProfile) -> HaplySection:
    """Section `haply` of a profile.

    Raises:
        ConfigurationError: if the profile has none.
    """
    from app.core.errors import ConfigurationError

    if profile.haply is None:
        raise ConfigurationError(
            sentence(
                "device profile {profile_name} speaks the protocol haply but has no section "
                "haply; add it (see resources/devices/haply-2diy.yaml)",
                profile_name=profile.name,
            )
        )
    return profile.haply


def read_request(profile: DeviceProfile) -> bytes:
    """Command of zero torques, which every board that was set up answers with its angles."""
    return struct.pack("<BBff", TORQUES, section_of(profile).device_id, 0.0, 0.0)


@njit
def _take_reply(state: FloatArray, p: FloatArray, data: Any, k: int) -> bool:
    first, second = wire.get_float(p, data, k + 1), wire.get_float(p, data, k + 5)
    left, right = (second, first) if p[LEFT_SECOND] != 0.0 else (first, second)
    if not (abs(left) <= LARGEST_ANGLE_DEG and abs(right) <= LARGEST_ANGLE_DEG):
        return False  # also NaN
    if p[AWAITING] == 0.0:  # of a command that was answered, or given up: an older reading
        return True
    host.heard(p)
    asked = wire.sent_at(p, int(p[wire.SEQUENCE]))
    p[host.ROUND_TRIP] = p[wire.NOW] - asked
    p[AWAITING] = 0.0
    p[host.HOMED] = 1.0 if p[host.HOME_SENT] > 0.0 else 0.0
    # Here OFFSET is the home pose less the wire's own offset, and STEP the radians of a degree.
    state[sv.Q_LEFT] = p[host.OFFSET] + left * p[host.STEP]
    state[sv.Q_RIGHT] = p[host.OFFSET + 1] + right * p[host.STEP]
    state[sv.Q_TIME] = min(asked, p[wire.NOW])  # read after the question, not when it came
    return True


@stage
def haply_read(state: FloatArray, p: FloatArray) -> None:
    """Parse what has come; the newest reply becomes Q_* and LINK_*."""
    data, count, k = wire.incoming(p), int(p[wire.IN_COUNT]), 0
    in_step = True
    while count - k >= REPLY_BYTES:
        if data[k] == p[DEVICE_ID] and _take_reply(state, p, data, k):
            k += REPLY_BYTES
            in_step = True
            continue
        p[host.ERRORS] += in_step
        in_step = False
        k += 1
    for i in range(count - k):  # the beginning of a reply waits for its rest
        data[i] = data[k + i]
    p[wire.IN_COUNT] = count - k
    host.publish(state, p)


@njit
def _put_torques(state: FloatArray, p: FloatArray) -> None:
    left, right = state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT]
    if not (state[sv.ENABLED] > 0.5 and np.isfinite(left + right)):
        left = right = 0.0
    p[LAST_TORQUE] = max(abs(left), abs(right))
    first, second = (right, left) if p[LEFT_SECOND] != 0.0 else (left, right)
    data, start = wire.outgoing(p), int(p[wire.OUT_COUNT])
    data[start], data[start + 1] = TORQUES, int(p[DEVICE_ID])
    wire.put_float(p, data, start + 2, first)
    wire.put_float(p, data, start + 6, second)
    p[wire.OUT_COUNT] = start + COMMAND_BYTES


@stage
def haply_write(state: FloatArray, p: FloatArray) -> None:
    """Put one torque command into `outgoing` when the last is answered or overdue.

    Zero after a torque never waits.
    """
    if not host.may_send(p):
        return
    host.append_home(p)
    late = not state[sv.TIME] - wire.sent_at(p, int(p[wire.SEQUENCE])) <= ANSWER_WITHIN
    stop = p[LAST_TORQUE] > 0.0 and not state[sv.ENABLED] > 0.5
    if p[AWAITING] != 0.0 and not late and not stop:
        return
    if p[AWAITING] != 0.0 and late:
        p[host.LOST] += 1.0
    p[wire.IN_COUNT] = 0.0  # belongs to no command any more, and would be taken for the next one's
    p[wire.SEQUENCE] += 1.0
    p[host.SENT] += 1.0
    p[AWAITING] = 1.0
    _put_torques(state, p)
