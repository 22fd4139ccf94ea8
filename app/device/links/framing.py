"""Frames on a byte stream: COBS with a zero at the end, and a CRC-16 (docs/protocol.md).

A frame is COBS(payload, CRC-16/CCITT-FALSE of it, low byte first), then 0x00. No other byte of a
frame is zero (consistent overhead byte stuffing, Cheshire and Baker 1999), so a receiver that sees
garbage is in step again after the next zero.

A receiver is a float64 array of `RECEIVER` numbers, so that it can live in a stage's parameters;
`frame_bytes` and `payload_bytes` are its buffers.
"""

from collections.abc import Iterator
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.core.messages import sentence

LARGEST_PAYLOAD: Final = 64
"""Longest payload [bytes], without its CRC."""

FRAME_BYTES: Final = 72
RECEIVER: Final = 20
_FILL: Final = 0
_OVERLONG: Final = 1
_FRAME: Final = 2
_PAYLOAD: Final = 11


@njit
def crc16(data: Any, count: int) -> int:
    """CRC-16/CCITT-FALSE of the first `count` bytes: polynomial 0x1021, start 0xFFFF.

    Its check value, over the ASCII digits 1 to 9, is 0x29B1.
    """
    crc: Any = 0xFFFF
    for k in range(count):
        x = ((crc >> 8) ^ np.int64(data[k])) & 0xFF
        x ^= x >> 4
        crc = ((crc << 8) ^ (x << 12) ^ (x << 5) ^ x) & 0xFFFF
    return crc


@njit
def encode(payload: Any, count: int, out: Any, start: int) -> int:
    """Write the frame of `payload[:count]` to `out[start:]`; return where it ends.

    The payload's buffer needs two more bytes, for the CRC; `out` needs `count` + 4.
    """
    crc = crc16(payload, count)
    payload[count], payload[count + 1] = crc & 0xFF, crc >> 8
    mark, k, code = start, start + 1, 1
    for i in range(count + 2):
        if payload[i] == 0:
            out[mark] = code
            mark, k, code = k, k + 1, 1
        else:
            out[k] = payload[i]
            k, code = k + 1, code + 1
    out[mark], out[k] = code, 0
    return k + 1


@njit
def decode(frame: Any, count: int, payload: Any) -> int:
    """Undo `encode` for a frame without its zero; return the payload's length, -1 if damaged."""
    k: Any = 0
    length = 0
    while k < count:
        code = np.int64(frame[k])
        if code == 0 or k + code > count:
            return -1
        for i in range(1, code):
            payload[length] = frame[k + i]
            length += 1
        k += code
        if k < count:
            payload[length] = 0
            length += 1
    if length < 3:
        return -1
    crc = np.int64(payload[length - 2]) | (np.int64(payload[length - 1]) << 8)
    return length - 2 if crc == crc16(payload, length - 2) else -1


@njit
def frame_bytes(receiver: FloatArray) -> Any:
    """Bytes of the frame that is coming in."""
    return receiver[_FRAME:_PAYLOAD].view(np.uint8)


@njit
def payload_bytes(receiver: FloatArray) -> Any:
    """Payload of the frame that `receive` has just completed."""
    return receiver[_PAYLOAD:RECEIVER].view(np.uint8)


@njit
def receive(receiver: FloatArray, frame: Any, payload: Any, byte: int) -> int:
    """Take one byte.

    Returns:
        0: no whole frame yet; > 0: length of the payload that is complete now; -1: a frame was
        dropped because it was damaged or too long.
    """
    fill = int(receiver[_FILL])
    if byte != 0:
        if fill < FRAME_BYTES:
            frame[fill] = byte
            receiver[_FILL] = fill + 1
        else:
            receiver[_OVERLONG] = 1.0
        return 0
    overlong = receiver[_OVERLONG] != 0.0
    receiver[_FILL] = receiver[_OVERLONG] = 0.0
    if fill == 0:
        return 0
    return -1 if overlong or fill > LARGEST_PAYLOAD + 3 else decode(frame, fill, payload)


def frame(payload: bytes) -> bytes:
    """Return the frame of a payload.

    Raises:
        ValueError: if it is empty or longer than `LARGEST_PAYLOAD`.
    """
    if not 1 <= len(payload) <= LARGEST_PAYLOAD:
        raise ValueError(
            sentence(
                "payload of {given_bytes} bytes; a frame holds 1 to {largest_payload}",
                given_bytes=len(payload),
                largest_payload=LARGEST_PAYLOAD,
            )
        )
    buffer, out = np.zeros(FRAME_BYTES, np.uint8), np.zeros(2 * FRAME_BYTES, np.uint8)
    buffer[: len(payload)] = np.frombuffer(payload, np.uint8)
    return out[: encode(buffer, len(payload), out, 0)].tobytes()


class Deframer:
    """Payloads of a byte stream, outside the loop. `errors` counts dropped frames."""

    def __init__(self) -> None:
        self.errors = 0
        self._receiver = np.zeros(RECEIVER)

    def feed(self, data: bytes) -> Iterator[bytes]:
        """Take bytes and return the payloads that they complete."""
        inside, payload = frame_bytes(self._receiver), payload_bytes(self._receiver)
        for byte in data:
            length = receive(self._receiver, inside, payload, byte)
            self.errors += length < 0
            if length > 0:
                yield payload[:length].tobytes()
