"""A robot's board in software: what a microcontroller does with the bytes that it receives.

One float64 array holds everything it knows; `work` is one round of its program, compiled, for both
protocols. The emulator's process and the link in memory run the same one. What it promises:

- torque zero at power-up, and until it is greeted in its own version (Acus) or set up (Haply);
- torque zero within the watchdog's time of the last valid command with `enable`;
- both torques scaled down together to the largest one; a torque that is not finite counts as zero.
"""

from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.device.links import acus_protocol as acus
from app.device.links import framing, wire
from app.device.links import haply_protocol as haply
from app.device.links.framing import RECEIVER
from app.mechanisms.profile import DeviceProfile, Protocol

WATCHDOG: Final = wire.END  # [s]
LIMIT: Final = wire.END + 1  # largest joint torque [N·m]
VERSION: Final = wire.END + 2  # of the protocol that it claims
BOOT: Final = wire.END + 3  # number of the power cycle
STEP: Final = wire.END + 4  # joint angle of a count [rad]
HAPLY: Final = wire.END + 5  # 1 for a Haply board
DEVICE_ID: Final = wire.END + 6
LEFT_SECOND: Final = wire.END + 7  # 1 if the left joint has the higher port
GAUGE: Final = wire.END + 8  # 1 if it has a force gauge
GAUGE_READING: Final = wire.END + 9
FROZEN: Final = wire.END + 10  # 1: its program hangs; the watchdog is a circuit of its own
RESET: Final = wire.END + 11  # 1: power goes off and on again
Q: Final = wire.END + 12  # true joint angles [rad]: left, right
ZERO: Final = wire.END + 14  # joint angles at zero counts [rad]: left, right
TORQUE: Final = wire.END + 16  # of its motors [N·m]: left, right
ENABLED: Final = wire.END + 18
HOMED: Final = wire.END + 19
GREETED: Final = wire.END + 20
TRIPPED: Final = wire.END + 21
ERROR: Final = wire.END + 22
COMMANDED: Final = wire.END + 23  # [s] time of the newest valid command
COMMANDS: Final = wire.END + 24
ERRORS: Final = wire.END + 25  # frames dropped
LARGEST: Final = wire.END + 26  # largest torque since power-up [N·m]
BORN: Final = wire.END + 27  # [s]
LAST: Final = wire.END + 28  # [s] time of the round before
HEARD: Final = wire.END + 29  # [s] when bytes came last
ANGLE_OFFSET: Final = wire.END + 30  # Haply: [°], in the order of ports
ENCODER_SIGN: Final = wire.END + 32  # -1 for a joint wired the wrong way round: left, right
MOTOR_SIGN: Final = wire.END + 34
TEMPLATE: Final = wire.END + 36  # 56 bytes: the INFO message
WORK: Final = TEMPLATE + 7  # 72 bytes: a message being built
RECEIVER_AT: Final = WORK + 9
SIZE: Final = RECEIVER_AT + RECEIVER

TRIPS_EARLY: Final = 2e-3
"""The watchdog trips this long before its time is over [s], so that the torque is zero by then."""

FORGETS_AFTER: Final = 2e-3
"""A Haply command that stays incomplete for this long is forgotten [s]."""

# Compiled code takes plain integers as constants.
_BAD_TORQUE = int(acus.BoardError.TORQUE_NOT_FINITE)
_HOME_REFUSED = int(acus.BoardError.HOME_REFUSED)


def board(profile: DeviceProfile, serial: str = "EMULATED", boot: int = 1) -> FloatArray:
    """Return a board that has just been switched on, for a profile's protocol and numbers."""
    p = np.zeros(SIZE)
    p[WATCHDOG], p[LIMIT] = profile.wire.watchdog_ms * 1e-3, profile.limits.joint_torque
    p[VERSION], p[BOOT] = acus.VERSION, boot
    p[STEP] = 2.0 * np.pi / profile.encoder.counts_per_turn
    p[ENCODER_SIGN : MOTOR_SIGN + 2] = 1.0
    p[RESET] = 1.0
    if profile.wire.protocol is Protocol.HAPLY:
        section = haply.section_of(profile)
        p[HAPLY], p[DEVICE_ID] = 1.0, section.device_id
        p[LEFT_SECOND] = section.encoder_ports[0] > section.encoder_ports[1]
    template = p[TEMPLATE:WORK].view(np.uint8)
    text = acus.pack_info(profile, serial, boot, gauge=False)
    template[: len(text)] = np.frombuffer(text, np.uint8)
    return p


@njit
def _stop(p: FloatArray) -> None:
    p[TORQUE] = p[TORQUE + 1] = p[ENABLED] = 0.0


@njit
def _power_up(p: FloatArray, now: float) -> None:
    _stop(p)
    p[RESET] = p[HOMED] = p[GREETED] = p[TRIPPED] = p[ERROR] = p[LARGEST] = 0.0
    p[ZERO], p[ZERO + 1] = p[Q], p[Q + 1]
    p[BORN] = p[COMMANDED] = now
    p[BOOT] += 1.0
    p[wire.IN_COUNT] = p[RECEIVER_AT] = p[RECEIVER_AT + 1] = 0.0


@njit
def _count(p: FloatArray, joint: int) -> int:
    turned = p[ENCODER_SIGN + joint] * (p[Q + joint] - p[ZERO + joint])
    return int(np.floor(turned / p[STEP] + 0.5)) if np.isfinite(turned) else 0


@njit
def _apply(p: FloatArray, now: float, left: float, right: float, enable: bool) -> None:
    """Obey a valid command: limit both torques together; the watchdog begins anew."""
    p[COMMANDS] += 1.0
    p[COMMANDED], p[TRIPPED] = now, 0.0
    if not np.isfinite(left + right):
        p[ERROR] = _BAD_TORQUE
        _stop(p)
        return
    if p[ERROR] == _BAD_TORQUE:
        p[ERROR] = 0.0
    if not enable or p[GREETED] == 0.0 or p[ERROR] != 0.0:
        _stop(p)
        return
    largest = max(abs(left), abs(right))
    scale = p[LIMIT] / largest if largest > p[LIMIT] else 1.0
    p[ENABLED] = 1.0
    p[TORQUE], p[TORQUE + 1] = scale * left, scale * right
    p[LARGEST] = max(p[LARGEST], scale * largest)


@njit
def _say(p: FloatArray, message: Any, length: int) -> None:
    start = int(p[wire.OUT_COUNT])
    if start + length + 4 <= wire.OUT_BYTES:
        p[wire.OUT_COUNT] = framing.encode(message, length, wire.outgoing(p), start)


@njit
def _say_info(p: FloatArray) -> None:
    template, message = p[TEMPLATE:WORK].view(np.uint8), p[WORK:RECEIVER_AT].view(np.uint8)
    for k in range(acus.INFO_BYTES):
        message[k] = template[k]
    message[1] = int(p[VERSION])
    wire.put_int(message, 4, int(p[BOOT]), 4)
    message[16] = 1 if p[GAUGE] != 0.0 else 0
    _say(p, message, acus.INFO_BYTES)


@njit
def _say_state(p: FloatArray, now: float, sequence: int) -> None:
    message = p[WORK:RECEIVER_AT].view(np.uint8)
    flags = int(p[ENABLED]) | int(p[HOMED]) << 1 | int(p[TRIPPED]) << 2
    flags |= int(p[GAUGE]) << 3 | int(p[GREETED]) << 4
    message[0], message[1], message[16] = acus.STATE, flags, int(p[ERROR])
    wire.put_int(message, 2, sequence, 2)
    wire.put_int(message, 4, int((now - p[BORN]) * 1e6) & 0xFFFFFFFF, 4)
    wire.put_int(message, 8, _count(p, 0), 4)
    wire.put_int(message, 12, _count(p, 1), 4)
    length = acus.STATE_BYTES
    if p[GAUGE] != 0.0:
        wire.put_float(p, message, length, p[GAUGE_READING])
        length = acus.STATE_WITH_FORCE_BYTES
    _say(p, message, length)


@njit
def _home(p: FloatArray, boot: int) -> None:
    if boot != int(p[BOOT]) or p[ENABLED] != 0.0:
        p[ERROR] = _HOME_REFUSED
        return
    p[ZERO], p[ZERO + 1], p[HOMED] = p[Q], p[Q + 1], 1.0
    if p[ERROR] == _HOME_REFUSED:
        p[ERROR] = 0.0


@njit
def _message(p: FloatArray, now: float, data: Any, length: int) -> None:
    kind = data[0]
    if kind == acus.HELLO and length >= 2:
        _stop(p)
        p[GREETED] = 1.0 if data[1] == p[VERSION] else 0.0
        p[ERROR] = 0.0
        _say_info(p)
    elif kind == acus.COMMAND and length == acus.COMMAND_BYTES:
        left, right = wire.get_float(p, data, 4), wire.get_float(p, data, 8)
        _apply(p, now, left, right, data[1] & acus.ENABLE != 0)
        _say_state(p, now, wire.get_int(data, 2, 2))
    elif kind == acus.HOME and length == 5:
        _home(p, wire.get_int(data, 1, 4))


@njit
def _work_acus(p: FloatArray, now: float) -> None:
    receiver = p[RECEIVER_AT : RECEIVER_AT + RECEIVER]
    frame, payload = framing.frame_bytes(receiver), framing.payload_bytes(receiver)
    data = wire.incoming(p)
    for k in range(int(p[wire.IN_COUNT])):
        length = framing.receive(receiver, frame, payload, data[k])
        if length > 0:
            _message(p, now, payload, length)
        elif length < 0:
            p[ERRORS] += 1.0
    p[wire.IN_COUNT] = 0.0


@njit
def _haply_reply(p: FloatArray) -> None:
    out, start = wire.outgoing(p), int(p[wire.OUT_COUNT])
    if start + haply.REPLY_BYTES > wire.OUT_BYTES:
        return
    out[start] = int(p[DEVICE_ID])
    for k in range(2):
        joint = 1 - k if p[LEFT_SECOND] != 0.0 else k
        angle = p[ANGLE_OFFSET + k] + _count(p, joint) * p[STEP] * 180.0 / np.pi
        wire.put_float(p, out, start + 1 + 4 * k, angle)
    p[wire.OUT_COUNT] = start + haply.REPLY_BYTES


@njit
def _haply_command(p: FloatArray, now: float, data: Any, k: int) -> int:
    """Obey the command at `data[k:]`; return its length, 0 if incomplete, -1 if it is none."""
    left = int(p[wire.IN_COUNT]) - k
    if data[k] > haply.TORQUES or (left > 1 and data[k + 1] != p[DEVICE_ID]):
        return -1
    length = 2
    if data[k] == haply.SETUP:
        length = haply.SETUP_BYTES
    elif data[k] == haply.TORQUES:
        length = haply.COMMAND_BYTES
    if left < length:
        return 0
    if data[k] == haply.SETUP:
        _stop(p)
        p[ZERO], p[ZERO + 1] = p[Q], p[Q + 1]
        p[GREETED] = p[HOMED] = 1.0
        for i in range(2):
            p[ANGLE_OFFSET + i] = wire.get_float(p, data, k + 10 + 8 * i)
    elif data[k] == haply.RESET:
        _stop(p)
    elif p[GREETED] != 0.0:
        first, second = wire.get_float(p, data, k + 2), wire.get_float(p, data, k + 6)
        if p[LEFT_SECOND] != 0.0:
            first, second = second, first
        _apply(p, now, first, second, True)
        _haply_reply(p)
    return length


@njit
def _work_haply(p: FloatArray, now: float) -> None:
    data, k, count = wire.incoming(p), 0, int(p[wire.IN_COUNT])
    while k < count:
        length = _haply_command(p, now, data, k)
        if length == 0 and now - p[HEARD] <= FORGETS_AFTER:
            break
        if length <= 0:
            p[ERRORS] += 1.0
        k += max(length, 1)
    for i in range(count - k):
        data[i] = data[k + i]
    p[wire.IN_COUNT] = count - k


@njit
def work(p: FloatArray, now: float) -> None:
    """One round: read `incoming`, answer in `outgoing`, set TORQUE; the watchdog last."""
    if p[RESET] != 0.0:
        _power_up(p, now)
    if p[FROZEN] == 0.0:
        if p[HAPLY] != 0.0:
            _work_haply(p, now)
        else:
            _work_acus(p, now)
    else:
        p[wire.IN_COUNT] = 0.0
    round_time = min(max(now - p[LAST], 0.0), TRIPS_EARLY)
    p[LAST] = now
    late = now + round_time - p[COMMANDED] > p[WATCHDOG] - TRIPS_EARLY
    if p[ENABLED] != 0.0 and late:
        _stop(p)
        p[TRIPPED] = 1.0
