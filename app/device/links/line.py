"""A piece of wire that can fail: chunks of bytes go in, and come out later, damaged or not at all.

A line is a float64 array of `SIZE` numbers. Its random numbers are its own (xorshift), seeded, so
that a run with faults can be repeated.
"""

from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray
from app.core.compiled import njit

DROP: Final = 0  # probability that a chunk disappears
GARBLE: Final = 1  # probability that a chunk is damaged
DELAY: Final = 2  # [s]
CUT: Final = 3  # 1 while the wire is cut
_RANDOM: Final = 4
_HEAD: Final = 5
_TAIL: Final = 6
REPEAT: Final = 7  # probability that a chunk comes twice
OVERTAKE: Final = 8  # probability that a chunk comes after the next one
_CHUNK: Final = 514  # time, length, 4096 bytes
_CHUNKS: Final = 64
_RING: Final = 9
CHUNK_BYTES: Final = 4096
SIZE: Final = _RING + _CHUNKS * _CHUNK


def line(seed: int = 1) -> FloatArray:
    """Return a sound line."""
    array = np.zeros(SIZE)
    array[_RANDOM : _RANDOM + 1].view(np.int64)[0] = 88172645463325252 + seed
    return array


@njit
def _random(p: FloatArray) -> float:
    """Next random number in [0, 1)."""
    word = p[_RANDOM : _RANDOM + 1].view(np.uint64)
    x = word[0]
    x ^= x << np.uint64(13)
    x ^= x >> np.uint64(7)
    x ^= x << np.uint64(17)
    word[0] = x
    return np.float64(x >> np.uint64(11)) / 9007199254740992.0


@njit
def _damage(p: FloatArray, data: Any, count: int) -> int:
    """Flip bits of a byte, or cut the chunk short; return its new length."""
    where = int(_random(p) * count)
    if _random(p) < 0.3:
        return where
    data[where] = np.int64(data[where]) ^ (1 + int(_random(p) * 255))
    return count


@njit
def push(p: FloatArray, now: float, data: Any, count: int) -> None:
    """Send `data[:count]` into the line at `now`."""
    if count == 0 or p[CUT] != 0.0 or _random(p) < p[DROP]:
        return
    head = int(p[_HEAD])
    if head - p[_TAIL] >= _CHUNKS:
        p[_TAIL] += 1.0
    start = _RING + (head % _CHUNKS) * _CHUNK
    chunk = p[start + 2 : start + _CHUNK].view(np.uint8)
    count = min(count, CHUNK_BYTES)
    for k in range(count):
        chunk[k] = data[k]
    if _random(p) < p[GARBLE]:
        count = _damage(p, chunk, count)
    p[start], p[start + 1] = now + p[DELAY], count
    p[_HEAD] = head + 1.0
    if p[OVERTAKE] > 0.0 and head > p[_TAIL] and _random(p) < p[OVERTAKE]:
        _swap(p, head, head - 1)
    if p[REPEAT] > 0.0 and _random(p) < p[REPEAT]:
        _append(p, start)


@njit
def _swap(p: FloatArray, first: int, second: int) -> None:
    """Exchange what two chunks say; each comes when the other would have."""
    a, b = _RING + (first % _CHUNKS) * _CHUNK, _RING + (second % _CHUNKS) * _CHUNK
    for k in range(1, _CHUNK):
        p[a + k], p[b + k] = p[b + k], p[a + k]


@njit
def _append(p: FloatArray, start: int) -> None:
    """Append a copy of the chunk at `start`."""
    head = int(p[_HEAD])
    if head - p[_TAIL] >= _CHUNKS:
        p[_TAIL] += 1.0
    copy = _RING + (head % _CHUNKS) * _CHUNK
    for k in range(_CHUNK):
        p[copy + k] = p[start + k]
    p[_HEAD] = head + 1.0


@njit
def pop(p: FloatArray, now: float, out: Any, fill: int, room: int) -> int:
    """Append what has arrived by `now` to `out[fill:]`; return the new fill."""
    if p[CUT] != 0.0:
        p[_TAIL] = p[_HEAD]
    while p[_TAIL] < p[_HEAD]:
        start = _RING + (int(p[_TAIL]) % _CHUNKS) * _CHUNK
        count = int(p[start + 1])
        if p[start] > now or fill + count > room:
            break
        chunk = p[start + 2 : start + _CHUNK].view(np.uint8)
        for k in range(count):
            out[fill + k] = chunk[k]
        fill += count
        p[_TAIL] += 1.0
    return fill
