"""Stages of a tick, and their parameters by name: one record gives the places and packs them.

The record is a `NamedTuple` of `int`; a field with a default is memory and begins at that value.

    class _Places(NamedTuple):
        stiffness: int
        limit: int
        last: int = 0

    _AT: Final = numbered(_Places)

    p[_AT.stiffness]                        # in compiled code: a constant, as fast as p[0]
    packed(_AT, stiffness=3.0, limit=1.0)   # the array; a name too many or too few is refused

Places and packing follow from one list of names, so that neither order nor number means anything.
"""

from collections.abc import Callable, Iterable
from typing import NamedTuple, TypeVar

import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence

Places = TypeVar("Places", bound=NamedTuple)

StageFunction = Callable[[FloatArray, FloatArray], None]
"""`void(state, parameters)`, compiled with `core.compiled.stage`."""


class Stage(NamedTuple):
    """One step of a tick.

    Attributes:
        name: what faults, costs and `acus explain` call it.
        function: compiled with `core.compiled.stage`.
        parameters: its constants and its memory, shape (n,); belongs to this stage of this loop.
    """

    name: str
    function: StageFunction
    parameters: FloatArray


def numbered(kind: type[Places], first: int = 0) -> Places:
    """Return the record with every field holding its place in the array, from `first` on."""
    return kind._make(range(first, first + len(kind._fields)))


def packed(places: NamedTuple, *behind: Iterable[float], **values: float) -> FloatArray:
    """Return a fresh array of parameters, shape (number of fields + those behind,).

    Args:
        places: a record of `numbered`.
        behind: arrays that follow the record, in their order, beginning at place `len(places)`.
        values: by field; memory that is not given has its default.

    Raises:
        TypeError: naming the fields that are unknown or missing.
    """
    if unknown := sorted(set(values) - set(places._fields)):
        raise TypeError(
            sentence(
                "{group} has no field {unknown}; it has {places_fields}",
                group=type(places).__name__,
                unknown=", ".join(unknown),
                places_fields=", ".join(places._fields),
            )
        )
    given = places._field_defaults | values
    if missing := [name for name in places._fields if name not in given]:
        raise TypeError(
            sentence(
                "{group} needs {missing} as well",
                group=type(places).__name__,
                missing=", ".join(missing),
            )
        )
    head = np.array([given[name] for name in places._fields], dtype=np.float64)
    return np.concatenate([head, *(np.asarray(values, dtype=np.float64) for values in behind)])
