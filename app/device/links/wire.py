"""One end of a wire as a float64 array: what every transport and every protocol finds in it.

Stages of one end share one array. A transport moves bytes between the outside and the regions
`incoming` and `outgoing`; a protocol turns them into slots of the state and back. The same protocol
therefore runs over a serial port, a pseudo-terminal or memory.
"""

from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit

FD: Final = 0  # file descriptor of the port
WAIT: Final = 1  # [s] longest wait for bytes in a tick
DEAD: Final = 2  # 1 after the port has gone
NOW: Final = 3  # [s] when bytes were looked for last
IN_COUNT: Final = 4  # bytes waiting in `incoming`
OUT_COUNT: Final = 5  # bytes waiting in `outgoing`
SEQUENCE: Final = 6  # number of the newest command
REFUSED: Final = 7  # times that the port took fewer bytes than given, or the buffer was full
SCRATCH: Final = 8  # for conversions between floats and bytes
_POLL: Final = 9
_TIMESPEC: Final = 10  # two numbers
_SENT: Final = 12
SENT_RING: Final = 64
_IN: Final = _SENT + SENT_RING
_OUT: Final = _IN + 256
END: Final = _OUT + 512
"""Fields of one end; a protocol's own fields begin at `END`."""

IN_BYTES: Final = 2048
OUT_BYTES: Final = 4096


@njit
def incoming(p: FloatArray) -> Any:
    """Bytes received and not yet parsed."""
    return p[_IN:_OUT].view(np.uint8)


@njit
def outgoing(p: FloatArray) -> Any:
    """Bytes to send in this tick."""
    return p[_OUT:END].view(np.uint8)


@njit
def poll_words(p: FloatArray) -> Any:
    """One `struct pollfd`, as two 32-bit words."""
    return p[_POLL : _POLL + 1].view(np.int32)


@njit
def timespec(p: FloatArray) -> Any:
    """One `struct timespec`: seconds and nanoseconds."""
    return p[_TIMESPEC : _TIMESPEC + 2].view(np.int64)


@njit
def note_sent(p: FloatArray, now: float) -> None:
    """Remember when the newest command left."""
    p[_SENT + int(p[SEQUENCE]) % SENT_RING] = now


@njit
def sent_at(p: FloatArray, sequence: int) -> float:
    """Return when a command left [s]; only of the last `SENT_RING`."""
    return p[_SENT + sequence % SENT_RING]


@njit
def put_int(data: Any, k: int, value: int, count: int) -> None:
    """Write an integer to `data[k:k + count]`, low byte first."""
    for i in range(count):
        data[k + i] = (value >> (8 * i)) & 0xFF


@njit
def get_int(data: Any, k: int, count: int) -> int:
    """Read an unsigned integer, low byte first."""
    value: Any = 0
    for i in range(count):
        value |= np.int64(data[k + i]) << (8 * i)
    return value


@njit
def get_int32(data: Any, k: int) -> int:
    """Read a signed integer of four bytes, low byte first."""
    value = get_int(data, k, 4)
    return value - (1 << 32) if value >= 1 << 31 else value


@njit
def put_float(p: FloatArray, data: Any, k: int, value: float) -> None:
    """Write an IEEE 754 single to `data[k:k + 4]`, low byte first."""
    scratch = p[SCRATCH : SCRATCH + 1]
    scratch.view(np.float32)[0] = value
    source = scratch.view(np.uint8)
    for i in range(4):
        data[k + i] = source[i]


@njit
def get_float(p: FloatArray, data: Any, k: int) -> float:
    """Read an IEEE 754 single, low byte first; may be NaN."""
    scratch = p[SCRATCH : SCRATCH + 1]
    target = scratch.view(np.uint8)
    for i in range(4):
        target[i] = data[k + i]
    return np.float64(scratch.view(np.float32)[0])
