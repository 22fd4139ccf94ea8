"""Arrays beside a message: all of one message in one piece of memory, never in the JSON.

numpy is loaded with the first array: most messages have none.
"""

import math
import mmap
import os
import sys
from typing import TYPE_CHECKING, Any

from app.core.descriptors import SEAL_GROW, SEAL_SEAL, SEAL_SHRINK, SEAL_WRITE, seal
from app.core.messages import sentence

if TYPE_CHECKING:
    from numpy.typing import NDArray

_ALIGNED = 64
_KINDS = "biuf"
_SEALED = SEAL_SEAL | SEAL_SHRINK | SEAL_GROW | SEAL_WRITE
_KEY = "array"


class AttachmentsError(ValueError):
    """What came beside a message is not what the message says."""


def is_array(value: Any) -> bool:
    """Return whether a value is an array of numpy."""
    numpy = sys.modules.get("numpy")
    return numpy is not None and isinstance(value, numpy.ndarray)


class Attachments:
    """Arrays on their way out."""

    def __init__(self) -> None:
        self._arrays: list[NDArray[Any]] = []
        self._end = 0

    def __bool__(self) -> bool:
        return bool(self._arrays)

    def add(self, array: "NDArray[Any]") -> dict[str, Any]:
        """Take an array along; returns what stands for it in the message."""
        start = -(-self._end // _ALIGNED) * _ALIGNED
        self._arrays.append(array)
        self._end = start + array.nbytes
        return {_KEY: [array.dtype.str, list(array.shape), start]}

    def clear(self) -> None:
        """Leave everything behind."""
        self._arrays, self._end = [], 0

    def descriptor(self) -> int:
        """Write all of it to memory that a file descriptor stands for; the caller closes it.

        Raises:
            OSError: if there is not enough memory.
        """
        made = os.memfd_create("acus-arrays", os.MFD_CLOEXEC | os.MFD_ALLOW_SEALING)
        try:
            os.ftruncate(made, self._end)
            end = 0
            for array in self._arrays:
                start = -(-end // _ALIGNED) * _ALIGNED
                end = start + array.nbytes
                _write(made, start, array)
        except BaseException:
            os.close(made)
            raise
        return made


def _write(descriptor: int, start: int, array: "NDArray[Any]") -> None:
    import numpy as np

    view = np.ascontiguousarray(array).data.cast("B") if array.size else memoryview(b"")
    while view:
        written = os.pwrite(descriptor, view, start)
        view, start = view[written:], start + written


def opened(message: Any, descriptor: int) -> Any:
    """Put arrays, read-only, to their places in a message.

    Args:
        message: as it came.
        descriptor: of the memory; closed here.

    Raises:
        AttachmentsError: if it is no such memory, or an array does not lie in it.
    """
    try:
        seal(descriptor, _SEALED)  # nobody shrinks it under a reader's feet
        size = os.fstat(descriptor).st_size
        memory = mmap.mmap(descriptor, size, flags=mmap.MAP_PRIVATE) if size else b""
    except (OSError, ValueError, OverflowError) as error:
        raise AttachmentsError(sentence("the memory beside a message is of no use")) from error
    finally:
        os.close(descriptor)
    return _placed(message, memory, size)


def _placed(value: Any, memory: Any, size: int) -> Any:
    if isinstance(value, list):
        return [_placed(item, memory, size) for item in value]
    if isinstance(value, dict):
        if value.keys() == {_KEY}:
            return _array(value[_KEY], memory, size)
        return {name: _placed(item, memory, size) for name, item in value.items()}
    return value


def _array(where: Any, memory: Any, size: int) -> "NDArray[Any]":
    import numpy as np

    try:
        kind, shape, start = where
        dtype, count = np.dtype(kind), math.prod(shape)
        fits = all(type(n) is int and n >= 0 for n in (*shape, start))
        if dtype.kind not in _KINDS or not fits or start + count * dtype.itemsize > size:
            raise AttachmentsError(sentence("an array beside a message lies outside its memory"))
        array = np.frombuffer(memory, dtype, count, start).reshape(shape)
    except AttachmentsError:
        raise
    except (TypeError, ValueError, OverflowError) as error:
        raise AttachmentsError(sentence("an array beside a message is none")) from error
    array.setflags(write=False)
    return array
