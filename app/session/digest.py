"""A number per tick that any changed bit of the state changes: 4 bytes in place of 900."""

from typing import Final

import numpy as np
from numpy.typing import NDArray

from app.core import state_vector as sv
from app.core.arrays import FloatArray

MEASURED: Final = ("tick_cost",)
"""Slots that are neither given nor computed but measured while computing: never compared."""

_GOLDEN: Final = 0x9E3779B97F4A7C15
_MIX: Final = np.uint64(0xBF58476D1CE4E5B9)
_HALF: Final = np.uint64(32)


def _factors(slots: tuple[str, ...]) -> NDArray[np.uint64]:
    """Return an odd factor per slot, and zero for what is measured."""
    index = np.arange(1, len(slots) + 1, dtype=np.uint64)
    x = index * np.uint64(_GOLDEN)
    x = (x ^ (x >> np.uint64(30))) * _MIX
    factors: NDArray[np.uint64] = (x ^ (x >> np.uint64(27))) | np.uint64(1)
    factors[[place for place, name in enumerate(slots) if name in MEASURED]] = 0
    return factors


_SLOTS: Final = tuple(sorted(sv.INDEX, key=sv.INDEX.__getitem__))
_FACTORS: Final = _factors(_SLOTS)


def digests(rows: FloatArray, slots: tuple[str, ...] = _SLOTS) -> NDArray[np.uint32]:
    """Digest of each state, shape (n, SLOTS) → (n,).

    The sum of the slots' bit patterns times an odd factor each, modulo 2⁶⁴, so that a change of one
    slot always changes it; folded to 32 bits (another state passes for the same once in 4·10⁹).

    Args:
        rows: the states.
        slots: names of the slots that count, in the order of the program that recorded them.
    """
    factors = _FACTORS
    if slots != _SLOTS:
        rows, factors = rows[:, [sv.INDEX[name] for name in slots]], _factors(slots)
    bits = np.ascontiguousarray(rows, dtype=np.float64).view(np.uint64)
    total = (bits * factors).sum(axis=1, dtype=np.uint64)
    mixed: NDArray[np.uint64] = (total ^ (total >> _HALF)) * _MIX
    return (mixed >> _HALF).astype("<u4")
