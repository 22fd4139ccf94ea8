"""Bytes between one end of a wire and a file descriptor, from the compiled loop. Linux only.

The descriptor is open for reading and writing and does not block. Its number never changes while a
loop may use it: whoever loses the port puts another file behind the same number (`os.dup2`).
"""

import sys
from typing import Any

from app.core.arrays import FloatArray
from app.core.compiled import njit, stage
from app.core.messages import sentence
from app.device.errors import LinkError
from app.device.links import wire

from numba import types  # isort: skip  (after core.compiled)

if sys.platform != "linux":
    raise LinkError(
        sentence(
            "serial robots are driven on Linux only; this is {sys_platform}",
            sys_platform=sys.platform,
        )
    )

_MONOTONIC = 1
_READABLE = 0x001
_GONE = 0x008 | 0x010 | 0x020  # error, hung up, not open

_clock_gettime = types.ExternalFunction("clock_gettime", types.int32(types.int32, types.voidptr))
_ppoll = types.ExternalFunction(
    "ppoll", types.int32(types.voidptr, types.uint64, types.voidptr, types.intp)
)
_read = types.ExternalFunction("read", types.intp(types.int32, types.voidptr, types.uintp))
_write = types.ExternalFunction("write", types.intp(types.int32, types.voidptr, types.uintp))


@njit
def _clock(p: FloatArray) -> float:
    time = wire.timespec(p)
    _clock_gettime(_MONOTONIC, time.ctypes)
    return time[0] + time[1] * 1e-9


@njit
def _poll(p: FloatArray, wait: float) -> int:
    poll, time = wire.poll_words(p), wire.timespec(p)
    poll[0], poll[1] = int(p[wire.FD]), _READABLE
    time[0], time[1] = 0, int(wait * 1e9)
    if _ppoll(poll.ctypes, 1, time.ctypes, 0) <= 0:
        return 0
    return poll[1] >> 16


@njit
def _append(p: FloatArray, data: Any, fill: int) -> int:
    if fill >= wire.IN_BYTES:  # a flood that no protocol takes: start afresh
        p[wire.REFUSED] += 1.0
        fill = 0
    count = _read(int(p[wire.FD]), data[fill:].ctypes, wire.IN_BYTES - fill)
    p[wire.IN_COUNT] = fill + max(count, 0)
    return count


@njit
def _receive(p: FloatArray, wait: float) -> None:
    events = _poll(p, wait)
    if events & _READABLE:
        _append(p, wire.incoming(p), int(p[wire.IN_COUNT]))
    if events & _GONE:
        p[wire.DEAD] = 1.0
    p[wire.NOW] = _clock(p)


@stage
def fd_receive(state: FloatArray, p: FloatArray) -> None:
    """Append what has arrived to `incoming`."""
    _receive(p, 0.0)


@stage
def fd_await(state: FloatArray, p: FloatArray) -> None:
    """Append what has arrived to `incoming`; wait for it up to WAIT if there is nothing."""
    _receive(p, p[wire.WAIT])


@stage
def fd_send(state: FloatArray, p: FloatArray) -> None:
    """Send `outgoing`; what the port does not take at once is dropped and counted."""
    count = int(p[wire.OUT_COUNT])
    if count == 0:
        return
    wire.note_sent(p, _clock(p))
    if _write(int(p[wire.FD]), wire.outgoing(p).ctypes, count) != count:
        p[wire.REFUSED] += 1.0
    p[wire.OUT_COUNT] = 0.0
