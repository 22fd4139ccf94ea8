"""Slices into one array of Hounsfield values.

Pixels that lie in their file as they are get copied here, on two threads: a copy of so many bytes
from such a place can do no harm. Whatever has to be decoded is decoded in the worker process,
which writes to the same memory.
"""

import math
from collections.abc import Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from dataclasses import replace
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging import memory
from app.imaging.decoding import is_raw, stored_type
from app.imaging.errors import SeriesRefusedError
from app.imaging.header import Rescale, SliceHeader
from app.imaging.rescaling import fill_slice, fresh_array, padding_ends, padding_stands_out
from app.imaging.worker.lent_memory import LentMemory
from app.imaging.worker.service import fill_slices

_THREADS = 2
_TURN = 8
"""Slices that a thread copies before it says so."""


def filled(
    headers: Sequence[SliceHeader], dtype: np.dtype[Any], progress: Progress | None = None
) -> NDArray[Any]:
    """Read slices of one size, in the order given.

    Args:
        headers: usable ones, of the same rows and columns.
        dtype: int16 or float32.
        progress: told how far it is; cancels.

    Returns:
        Hounsfield values, shape (slices, rows, columns).

    Raises:
        NotExactError: if a value does not fit 16 bits and int16 was asked for.
        FileDamagedError: if a file has changed since the scan or cannot be decoded; names it.
        WorkerError: if the process that decodes cannot be started.
        SeriesRefusedError: if the machine has not enough memory.
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    shape = (len(headers), headers[0].format.rows, headers[0].format.columns)
    hu = _all_filled(headers, shape, dtype, progress)
    memory.hold(hu)
    return hu


_APART = 131072.0
"""Beyond all that 16 bits store."""


def padding_of(header: SliceHeader, picture: NDArray[Any]) -> NDArray[np.bool_] | None:
    """Find the pixels at which nothing was measured (PS3.3 C.7.5.1.1.2).

    Args:
        header: of a usable slice.
        picture: its values as `filled` gives them, shape (rows, columns).

    Returns:
        True where padding stands, shape (rows, columns); None where the file knows of none.

    Raises:
        FileDamagedError: if the file has changed since the scan.
    """
    if header.format.padding is None:
        return None
    low, high = sorted(padding_ends(header))
    if not padding_stands_out(header) and low >= np.iinfo(np.int16).min:
        result: NDArray[np.bool_] = (picture >= np.float32(low)) & (picture <= np.float32(high))
        return result
    apart = replace(header, rescale=Rescale(1.0, _APART))  # measured values lie far above padding
    result = filled((apart,), np.dtype(np.float32))[0] < _APART / 2.0
    return result


def _all_filled(
    headers: Sequence[SliceHeader],
    shape: tuple[int, int, int],
    dtype: np.dtype[Any],
    progress: Progress,
) -> NDArray[Any]:
    encoded = [k for k, header in enumerate(headers) if not is_raw(header)]
    if not encoded:
        hu = fresh_array(shape, dtype)
        _copy(headers, range(len(headers)), hu, progress)
        return hu
    lent = _lent(math.prod(shape) * dtype.itemsize)
    try:
        share = len(encoded) / len(headers)
        some = [headers[k] for k in encoded]
        fill_slices(some, encoded, dtype, lent, progress.part(0.0, share))
        hu = np.frombuffer(lent.settled(), dtype, math.prod(shape)).reshape(shape)
    finally:
        lent.close()
    rest = sorted(set(range(len(headers))) - set(encoded))
    _copy(headers, rest, hu, progress.part(share, 1.0))
    return hu


def _lent(size: int) -> LentMemory:
    """Return memory for a volume, whose size the child cannot change where the system sees to it.

    Raises:
        SeriesRefusedError: if there is not enough.
    """
    try:
        lent = LentMemory.made(size)
        lent.fix_size()
        lent.shared()  # whether it can be mapped, before anything is decoded
    except (OSError, ValueError, OverflowError) as error:
        raise SeriesRefusedError(
            sentence(
                "the volume needs {size:.1f} GB of memory, which this machine cannot give",
                size=size / 1e9,
            )
        ) from error
    return lent


def _copy(
    headers: Sequence[SliceHeader], places: Sequence[int], hu: NDArray[Any], progress: Progress
) -> None:
    """Copy raw slices to their places; numpy and the system let both threads work at once."""

    def copy(turn: Sequence[int]) -> int:
        stored: dict[np.dtype[Any], NDArray[Any]] = {}
        for k in turn:
            progress.check()
            wanted = stored_type(headers[k].format)
            scratch = stored.setdefault(wanted, np.empty(hu.shape[1:], wanted))
            fill_slice(headers[k], hu[k], scratch)
        return len(turn)

    turns = [places[start : start + _TURN] for start in range(0, len(places), _TURN)]
    done = 0
    for count in _spread(copy, turns):
        done += count
        progress.report(
            done / len(places), sentence("slice {ready} of {count}", ready=done, count=len(places))
        )


def _spread(copy: Any, turns: Sequence[Sequence[int]]) -> Iterator[int]:
    if len(turns) < 2:
        yield from map(copy, turns)
        return
    with ThreadPoolExecutor(_THREADS) as threads:
        futures = [threads.submit(copy, turn) for turn in turns]
        try:
            for future in futures:
                yield future.result()
        finally:
            for future in futures:
                future.cancel()
