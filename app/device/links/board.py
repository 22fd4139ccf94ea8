"""A robot's board in software: what a microcontroller does with the bytes that it receives.

It stands behind two faulty pieces of wire: what the emulator and the link in memory consist of. One
float64 array holds the program's end of the wire, the board and both lines, so that one stage can
work on all of it.

One float64 array holds everything it knows; `work` is one round of its program, compiled, for both
protocols. The emulator's process and the link in memory run the same one. What it promises:

- torque zero at power-up, and until it is greeted in its own version (Acus) or set up (Haply);
- torque zero within the watchdog's time of the last valid command with `enable`;
- both torques scaled down together to the largest one; a torque that is not finite counts as zero;
- with four winches: each tension within 0 and the largest, each speed within the fastest.
"""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.messages import sentence
from app.device.errors import LinkError
from app.device.links import acus_protocol as acus
from app.device.links import board_layout as at
from app.device.links import cable_protocol as cables
from app.device.links import framing, line, wire
from app.device.links import haply_protocol as haply
from app.device.links.framing import RECEIVER
from app.device.links.link import BoardError

# Compiled code takes plain integers as constants.
_BAD_TORQUE = int(BoardError.TORQUE_NOT_FINITE)
_HOME_REFUSED = int(BoardError.HOME_REFUSED)


@njit
def _stop(p: FloatArray) -> None:
    p[at.TORQUE] = p[at.TORQUE + 1] = p[at.ENABLED] = p[at.HOLDS] = p[at.LIMITED] = 0.0
    for k in range(cables.CHANNELS):
        p[at.PULL + k] = 0.0


@njit
def _fail(p: FloatArray, error: int) -> None:
    """Stop and report an error; a smaller number does not hide a greater one."""
    _stop(p)
    p[at.ERROR] = max(p[at.ERROR], error)


@njit
def _power_up(p: FloatArray, now: float) -> None:
    _stop(p)
    p[at.RESET] = p[at.HOMED] = p[at.GREETED] = p[at.TRIPPED] = p[at.ERROR] = p[at.LARGEST] = 0.0
    p[at.ZERO], p[at.ZERO + 1] = p[at.Q], p[at.Q + 1]
    p[at.BORN] = p[at.COMMANDED] = now
    p[at.BOOT] += 1.0
    p[wire.IN_COUNT] = p[at.RECEIVER_AT] = p[at.RECEIVER_AT + 1] = 0.0


@njit
def _count(p: FloatArray, joint: int) -> int:
    angle = p[at.Q + joint]
    if joint == 0 and p[at.REVERSED] != 0.0:
        if p[at.TURNING] == 0.0:
            p[at.TURNING_AT] = angle
        angle = 2.0 * p[at.TURNING_AT] - angle
    p[at.TURNING] = p[at.REVERSED]
    turned = p[at.ENCODER_SIGN + joint] * (angle - p[at.ZERO + joint])
    count = int(np.floor(turned / p[at.STEP] + 0.5)) if np.isfinite(turned) else 0
    return _faulty(p, count) if joint == 0 else count


@njit
def _faulty(p: FloatArray, count: int) -> int:
    """Return the left encoder's count as its faults leave it."""
    if p[at.STUCK] != 0.0:
        count = int(p[at.LAST_COUNT])
    p[at.LAST_COUNT] = count
    p[at.RANDOM] = (16807.0 * p[at.RANDOM]) % 2147483647.0  # Park and Miller, exact in a double
    if p[at.RANDOM] < p[at.FLIPS] * 2147483647.0:
        count ^= 1 << (int(p[at.RANDOM]) % 31)
    return count + int(p[at.JUMP])


@njit
def _trip(p: FloatArray, now: float) -> None:
    """Stop the motors if the last command with enable is too old."""
    if p[at.ENABLED] != 0.0 and now - p[at.COMMANDED] > p[at.WATCHDOG] - at.TRIPS_EARLY:
        _stop(p)
        p[at.TRIPPED] = 1.0


@njit
def _apply(p: FloatArray, now: float, left: float, right: float, enable: bool) -> None:
    """Obey a valid command: limit both torques together; the watchdog begins anew."""
    p[at.COMMANDS] += 1.0
    _trip(p, now)
    p[at.COMMANDED] = now
    if not np.isfinite(left + right):
        _fail(p, _BAD_TORQUE)
        return
    if p[at.ERROR] == _BAD_TORQUE:
        p[at.ERROR] = 0.0
    if not enable or p[at.GREETED] == 0.0 or p[at.ERROR] != 0.0:
        _stop(p)
        return
    largest = max(abs(left), abs(right))
    p[at.LIMITED] = largest > np.float32(p[at.LIMIT])  # a command has singles
    scale = p[at.LIMIT] / largest if largest > p[at.LIMIT] else 1.0
    p[at.ENABLED], p[at.TRIPPED] = 1.0, 0.0
    p[at.TORQUE], p[at.TORQUE + 1] = scale * left, scale * right
    p[at.LARGEST] = max(p[at.LARGEST], scale * largest)


@njit
def _pull(p: FloatArray, now: float, data: Any) -> None:
    """Obey a valid command of four channels; the watchdog begins anew."""
    p[at.COMMANDS] += 1.0
    _trip(p, now)
    p[at.COMMANDED] = now
    total = 0.0
    for k in range(cables.CHANNELS):
        total += wire.get_float(p, data, 4 + 4 * k)
    if not np.isfinite(total):
        _fail(p, _BAD_TORQUE)
        return
    if p[at.ERROR] == _BAD_TORQUE:
        p[at.ERROR] = 0.0
    if data[1] & acus.ENABLE == 0 or p[at.GREETED] == 0.0 or p[at.ERROR] != 0.0:
        _stop(p)
        return
    holds = data[1] & cables.HOLD != 0
    low, high = (-p[at.FASTEST], p[at.FASTEST]) if holds else (0.0, p[at.LIMIT])
    p[at.ENABLED], p[at.HOLDS] = 1.0, 1.0 if holds else 0.0
    p[at.LIMITED] = p[at.TRIPPED] = 0.0
    for k in range(cables.CHANNELS):
        wanted = wire.get_float(p, data, 4 + 4 * k)
        asked = min(max(wanted, low), high)
        if np.float32(asked) != np.float32(wanted):
            p[at.LIMITED] = 1.0
        p[at.PULL + k] = asked
        if not holds:
            p[at.LARGEST] = max(p[at.LARGEST], asked)


@njit
def winches(state: FloatArray, p: FloatArray) -> None:
    """Let the board's winches do what it tells them: TENSION_*, REEL_RATE_* and HOLDING."""
    if p[at.CHANNELS] == 0.0:
        return
    state[sv.HOLDING] = p[at.HOLDS]
    for k in range(cables.CHANNELS):
        held = p[at.HOLDS] != 0.0
        state[sv.TENSION_1 + k] = 0.0 if held else p[at.PULL + k]
        state[sv.REEL_RATE_1 + k] = p[at.PULL + k] if held else 0.0


@njit
def _say(p: FloatArray, message: Any, length: int) -> None:
    start = int(p[wire.OUT_COUNT])
    if start + length + 4 <= wire.OUT_BYTES:
        p[wire.OUT_COUNT] = framing.encode(message, length, wire.outgoing(p), start)


@njit
def _say_info(p: FloatArray) -> None:
    template = p[at.TEMPLATE : at.WORK].view(np.uint8)
    message = p[at.WORK : at.RECEIVER_AT].view(np.uint8)
    for k in range(acus.INFO_BYTES):
        message[k] = template[k]
    message[1] = int(p[at.VERSION])
    wire.put_int(message, 4, int(p[at.BOOT]), 4)
    message[16] = acus.FEATURE_EMULATED | acus.FEATURE_LIMITED | (1 if p[at.GAUGE] != 0.0 else 0)
    _say(p, message, acus.INFO_BYTES)


@njit
def _say_state(p: FloatArray, now: float, sequence: int) -> None:
    message = p[at.WORK : at.RECEIVER_AT].view(np.uint8)
    flags = int(p[at.ENABLED]) | int(p[at.HOMED]) << 1 | int(p[at.TRIPPED]) << 2
    flags |= int(p[at.GAUGE]) << 3 | int(p[at.GREETED]) << 4 | int(p[at.LIMITED]) << 5
    channels = int(p[at.CHANNELS])
    message[0] = cables.STATE if channels > 0 else acus.STATE
    message[1], message[16] = flags, int(p[at.ERROR])
    wire.put_int(message, 2, sequence, 2)
    wire.put_int(message, 4, int((now - p[at.BORN]) * 1e6) & 0xFFFFFFFF, 4)
    wire.put_int(message, 8, _count(p, 0), 4)
    wire.put_int(message, 12, _count(p, 1), 4)
    length = acus.STATE_BYTES
    if channels > 0:
        for k in range(channels):
            wire.put_float(p, message, length + 4 * k, p[at.CABLE + k])
            wire.put_float(p, message, length + 4 * (channels + k), p[at.REEL + k])
        length = cables.STATE_BYTES
    elif p[at.GAUGE] != 0.0:
        wire.put_float(p, message, length, p[at.GAUGE_READING])
        length = acus.STATE_WITH_FORCE_BYTES
    _say(p, message, length)


@njit
def _home(p: FloatArray, now: float, boot: int) -> None:
    _trip(p, now)
    if boot != int(p[at.BOOT]) or p[at.ENABLED] != 0.0:
        _fail(p, _HOME_REFUSED)
        return
    p[at.ZERO], p[at.ZERO + 1], p[at.HOMED] = p[at.Q], p[at.Q + 1], 1.0
    if p[at.ERROR] == _HOME_REFUSED:
        p[at.ERROR] = 0.0


@njit
def _message(p: FloatArray, now: float, data: Any, length: int) -> None:
    kind = data[0]
    if kind == acus.HELLO and length >= 2:
        _stop(p)
        p[at.GREETED] = 1.0 if data[1] == p[at.VERSION] else 0.0
        p[at.ERROR] = 0.0
        _say_info(p)
    elif p[at.CHANNELS] > 0.0 and kind == cables.COMMAND and length == cables.COMMAND_BYTES:
        _pull(p, now, data)
        _say_state(p, now, wire.get_int(data, 2, 2))
    elif p[at.CHANNELS] == 0.0 and kind == acus.COMMAND and length == acus.COMMAND_BYTES:
        left, right = wire.get_float(p, data, 4), wire.get_float(p, data, 8)
        _apply(p, now, left, right, data[1] & acus.ENABLE != 0)
        _say_state(p, now, wire.get_int(data, 2, 2))
    elif kind == acus.HOME and length == 5:
        _home(p, now, wire.get_int(data, 1, 4))


@njit
def _work_acus(p: FloatArray, now: float) -> None:
    receiver = p[at.RECEIVER_AT : at.RECEIVER_AT + RECEIVER]
    frame, payload = framing.frame_bytes(receiver), framing.payload_bytes(receiver)
    data = wire.incoming(p)
    for k in range(int(p[wire.IN_COUNT])):
        length = framing.receive(receiver, frame, payload, data[k])
        if length > 0:
            _message(p, now, payload, length)
        elif length < 0:
            p[at.ERRORS] += 1.0
    p[wire.IN_COUNT] = 0.0


@njit
def _haply_reply(p: FloatArray) -> None:
    out, start = wire.outgoing(p), int(p[wire.OUT_COUNT])
    if start + haply.REPLY_BYTES > wire.OUT_BYTES:
        return
    out[start] = int(p[at.DEVICE_ID])
    for k in range(2):
        joint = 1 - k if p[at.LEFT_SECOND] != 0.0 else k
        angle = p[at.ANGLE_OFFSET + k] + _count(p, joint) * p[at.STEP] * 180.0 / np.pi
        wire.put_float(p, out, start + 1 + 4 * k, angle)
    p[wire.OUT_COUNT] = start + haply.REPLY_BYTES


@njit
def _haply_command(p: FloatArray, now: float, data: Any, k: int) -> int:
    """Obey the command at `data[k:]`; return its length, 0 if incomplete, -1 if it is none."""
    left = int(p[wire.IN_COUNT]) - k
    if data[k] > haply.TORQUES or (left > 1 and data[k + 1] != p[at.DEVICE_ID]):
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
        p[at.ZERO], p[at.ZERO + 1] = p[at.Q], p[at.Q + 1]
        p[at.GREETED] = p[at.HOMED] = 1.0
        for i in range(2):
            p[at.ANGLE_OFFSET + i] = wire.get_float(p, data, k + 10 + 8 * i)
    elif data[k] == haply.RESET:
        _stop(p)
    elif p[at.GREETED] != 0.0:
        first, second = wire.get_float(p, data, k + 2), wire.get_float(p, data, k + 6)
        if p[at.LEFT_SECOND] != 0.0:
            first, second = second, first
        _apply(p, now, first, second, True)
        _haply_reply(p)
    return length


@njit
def _work_haply(p: FloatArray, now: float) -> None:
    data, k, count = wire.incoming(p), 0, int(p[wire.IN_COUNT])
    while k < count:
        length = _haply_command(p, now, data, k)
        if length == 0 and now - p[at.HEARD] <= at.FORGETS_AFTER:
            break
        if length <= 0:
            p[at.ERRORS] += 1.0
        k += max(length, 1)
    for i in range(count - k):
        data[i] = data[k + i]
    p[wire.IN_COUNT] = count - k


@njit
def work(p: FloatArray, now: float) -> None:
    """One round: read `incoming`, answer in `outgoing`, set TORQUE; the watchdog last."""
    if p[at.RESET] != 0.0:
        _power_up(p, now)
    if p[at.FROZEN] == 0.0:
        if p[at.HAPLY] != 0.0:
            _work_haply(p, now)
        else:
            _work_acus(p, now)
    else:
        p[wire.IN_COUNT] = 0.0
    round_time = min(max(now - p[at.LAST], 0.0), at.TRIPS_EARLY)
    p[at.LAST] = now
    _trip(p, now + round_time)


DOWN: Final = at.SIZE  # line to the board
UP: Final = DOWN + line.SIZE  # line from it
SIZE: Final = UP + line.SIZE


@njit
def exchange(p: FloatArray, now: float, sent: Any, count: int, answer: Any, fill: int) -> int:
    """Carry `sent[:count]` to the board, let it work, append what arrives to `answer[fill:]`.

    Returns:
        The new fill of `answer`.
    """
    the_board = p[: at.SIZE]
    down, up = p[DOWN:UP], p[UP:SIZE]
    line.push(down, now, sent, count)
    the_board[wire.IN_COUNT] = line.pop(
        down, now, wire.incoming(the_board), int(the_board[wire.IN_COUNT]), wire.IN_BYTES
    )
    if count > 0:
        the_board[at.HEARD] = now
    work(the_board, now)
    line.push(up, now, wire.outgoing(the_board), int(the_board[wire.OUT_COUNT]))
    the_board[wire.OUT_COUNT] = 0.0
    return line.pop(up, now, answer, fill, len(answer))


_SWITCHES: Final = {  # most, factor, places in the box
    "drop": (1.0, 1.0, (DOWN + line.DROP, UP + line.DROP)),
    "garble": (1.0, 1.0, (DOWN + line.GARBLE, UP + line.GARBLE)),
    "delay": (30.0, 1e-3, (DOWN + line.DELAY, UP + line.DELAY)),
    "cut": (1.0, 1.0, (DOWN + line.CUT, UP + line.CUT)),
    "freeze": (1.0, 1.0, (at.FROZEN,)),
    "reset": (1.0, 1.0, (at.RESET,)),
    "version": (255.0, 1.0, (at.VERSION,)),
    "error": (255.0, 1.0, (at.ERROR,)),
    "repeat": (1.0, 1.0, (UP + line.REPEAT,)),
    "overtake": (1.0, 1.0, (UP + line.OVERTAKE,)),
    "jump": (float(1 << 30), 1.0, (at.JUMP,)),
    "stick": (1.0, 1.0, (at.STUCK,)),
    "reverse": (1.0, 1.0, (at.REVERSED,)),
    "flip": (1.0, 1.0, (at.FLIPS,)),
}

FAULTS: Final = tuple(_SWITCHES)
"""Names of the faults."""

NUMBERED: Final = (
    *("drop", "garble", "delay", "version", "error"),
    *("repeat", "overtake", "jump", "flip"),
)
"""Those that need a number; the others are on or off, or happen."""


@dataclass(frozen=True, slots=True)
class Faults:
    """Switches of a board and its wire; `array` is the box that they act on.

    `drop` and `garble` are probabilities per message in each direction, `delay` is in milliseconds
    each way, `freeze` and `cut` are on or off, `reset` happens once, `version` is what the board
    claims, `error` is what it reports. `repeat` and `overtake` are probabilities that an answer
    comes twice, or after the next one. Of the left encoder: `jump` is by how many counts it is off,
    `stick` and `reverse` are on or off, `flip` is the probability that a bit of its count is wrong
    in an answer whose checksum is right.
    """

    array: FloatArray

    def set(self, name: str, value: float) -> None:
        """Switch one fault.

        Raises:
            LinkError: if there is no such fault, or the value is out of range; names those valid.
        """
        if name not in _SWITCHES:
            raise LinkError(
                sentence(
                    "no fault {name!r}; valid names: {faults}", name=name, faults=", ".join(FAULTS)
                )
            )
        most, factor, places = _SWITCHES[name]
        if not 0.0 <= value <= most:
            raise LinkError(
                sentence(
                    "fault {name} is {setting:g}; it must be from 0 to {most:g}",
                    name=name,
                    setting=value,
                    most=most,
                )
            )
        for place in places:
            self.array[place] = value * factor
