"""Arrays beside a message: all of one message in one piece of memory, never in the JSON.

numpy is loaded with the first array: most messages have none.
"""

import math
import sys
from typing import TYPE_CHECKING, Any

from app.core.messages import sentence
from app.imaging.worker.lent_memory import LentMemory

if TYPE_CHECKING:
    from numpy.typing import NDArray

_ALIGNED = 64
_KINDS = "biuf"
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

    def memory(self) -> LentMemory:
        """Write all of it to a piece of memory; the caller closes it.

        Raises:
            OSError: if there is not enough memory.
        """
        made = LentMemory.made(self._end)
        try:
            end = 0
            for array in self._arrays:
                start = -(-end // _ALIGNED) * _ALIGNED
                end = start + array.nbytes
                _write(made, start, array)
        except BaseException:
            made.close()
            raise
        return made


def _write(memory: LentMemory, start: int, array: "NDArray[Any]") -> None:
    import numpy as np

    if array.size:
        memory.write(start, np.ascontiguousarray(array).data.cast("B"))


def opened(message: Any, memory: LentMemory) -> Any:
    """Put arrays, read-only, to their places in a message.

    Args:
        message: as it came.
        memory: that came beside it; closed here.

    Raises:
        AttachmentsError: if it is no such memory, or an array does not lie in it.
    """
    try:
        held = memory.own()  # nobody changes it under a reader's feet
    except (OSError, ValueError, OverflowError) as error:
        raise AttachmentsError(sentence("the memory beside a message is of no use")) from error
    finally:
        memory.close()
    return _placed(message, held, len(held))


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
