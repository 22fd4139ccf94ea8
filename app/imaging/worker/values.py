"""Frozen dataclasses to JSON and back, checked by their annotations.

Nothing that comes from the child is taken as it is: a value of another type than the annotation
says is refused, and no class is made but those that the reader names (which pickle would do).
"""

import types
from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from pathlib import Path
from typing import Any, Union, get_args, get_origin, get_type_hints

from app.imaging.worker.attachments import Attachments, is_array

Convert = Callable[[Any], Any]
_AS_THEY_ARE = frozenset((str, int, float, bool, type(None)))


class ForeignValueError(ValueError):
    """A value is not of the type that it must have."""


def plain(value: Any, attachments: Attachments | None = None) -> Any:
    """Turn a value into what JSON holds: a dataclass becomes the list of its fields.

    Args:
        value: the value.
        attachments: takes up its arrays, which are not for JSON.
    """
    if type(value) in _AS_THEY_ARE:
        return value
    if is_dataclass(value):
        cls: Any = type(value)
        return [plain(getattr(value, name), attachments) for name in _names(cls)]
    if isinstance(value, tuple):
        return [plain(item, attachments) for item in value]
    if attachments is not None and is_array(value):
        return attachments.add(value)
    return str(value) if isinstance(value, Path) else value


@cache
def _names(cls: Any) -> tuple[str, ...]:
    return tuple(field.name for field in fields(cls))


@cache
def reader(kind: Any) -> Convert:
    """Make the function that turns JSON into values of a type.

    Args:
        kind: a dataclass, tuple, mapping, union, array, Path, str, int, float, bool or None, or
            made of these.

    Returns:
        A function; it raises ForeignValueError for anything else than such a value.
    """
    if is_dataclass(kind):
        return _dataclass_reader(kind)
    if get_origin(kind) in (Union, types.UnionType):
        return _union_reader(get_args(kind))
    if get_origin(kind) is tuple:
        return _tuple_reader(get_args(kind))
    if getattr(get_origin(kind), "__module__", "") == "numpy":
        return _array_reader(get_args(get_args(kind)[1])[0])
    if get_origin(kind) is Mapping:
        return _mapping_reader(*get_args(kind))
    if kind is None:
        kind = type(None)
    if kind is Path:
        return lambda value: Path(_checked(value, str))
    if kind is float:
        return _float
    if isinstance(kind, type) and issubclass(kind, str) and kind is not str:
        return lambda value: kind(_checked(value, str))
    return lambda value: _checked(value, kind)


def _checked(value: Any, kind: Any) -> Any:
    if type(value) is not kind:
        raise ForeignValueError(f"{type(value).__name__} where {kind.__name__} is wanted")
    return value


def _float(value: Any) -> float:
    if type(value) not in (float, int):
        raise ForeignValueError(f"{type(value).__name__} where a number is wanted")
    return float(value)


def _array_reader(scalar: Any) -> Convert:
    def read(value: Any) -> Any:
        if not is_array(value):
            raise ForeignValueError(f"{type(value).__name__} where an array is wanted")
        import numpy as np

        if scalar is not Any and value.dtype != np.dtype(scalar):
            raise ForeignValueError(f"an array of {value.dtype}, not of {np.dtype(scalar)}")
        return value

    return read


def _dataclass_reader(kind: Any) -> Convert:
    hints = get_type_hints(kind)
    converts = [reader(hints[name]) for name in _names(kind)]

    def read(value: Any) -> Any:
        items = _checked(value, list)
        if len(items) != len(converts):
            raise ForeignValueError(f"{kind.__name__} has {len(converts)} fields, not {len(items)}")
        return kind(*(convert(item) for convert, item in zip(converts, items, strict=True)))

    return read


def _tuple_reader(kinds: tuple[Any, ...]) -> Convert:
    if len(kinds) == 2 and kinds[1] is Ellipsis:
        convert = reader(kinds[0])
        return lambda value: tuple(convert(item) for item in _checked(value, list))
    converts = [reader(kind) for kind in kinds]

    def read(value: Any) -> Any:
        items = _checked(value, list)
        if len(items) != len(converts):
            raise ForeignValueError(f"{len(items)} values where {len(converts)} are wanted")
        return tuple(convert(item) for convert, item in zip(converts, items, strict=True))

    return read


def _mapping_reader(keys: Any, values: Any) -> Convert:
    key, convert = reader(keys), reader(values)
    return lambda found: {key(k): convert(v) for k, v in _checked(found, dict).items()}


def _union_reader(kinds: tuple[Any, ...]) -> Convert:
    converts = [reader(kind) for kind in kinds if kind is not type(None)]
    may_be_none = type(None) in kinds

    def read(value: Any) -> Any:
        if value is None and may_be_none:
            return None
        for convert in converts:
            try:
                return convert(value)
            except ForeignValueError as error:
                refused = error
        raise refused

    return read
