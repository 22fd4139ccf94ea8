"""Frozen dataclasses to JSON and back, checked by pydantic against their annotations.

Nothing that comes from the child is taken as it is: a value of another type than the annotation
says is refused, as is one that is missing or too much, and no class is made but those that the
reader names (which pickle would do). pydantic is loaded with the first reader: the child needs none
for headers, of which every folder is full.
"""

from collections.abc import Callable, Mapping
from dataclasses import fields, is_dataclass
from functools import cache
from pathlib import Path
from typing import Any, get_args

from app.core.messages import sentence
from app.imaging.worker.attachments import Attachments, is_array

Convert = Callable[[Any], Any]
_AS_THEY_ARE = frozenset((str, int, float, bool, type(None)))
_LEAVES: Mapping[str, Mapping[str, Any]] = {
    "str": {"strict": True},
    "int": {"strict": True, "ge": -(1 << 63), "lt": 1 << 63},
    "float": {"strict": True, "allow_inf_nan": False},
    "bool": {"strict": True},
}
"""What is asked of the plain values, by their name in pydantic's schemas."""


class ForeignValueError(ValueError):
    """A value is not of the type that it must have."""


def plain(value: Any, attachments: Attachments | None = None) -> Any:
    """Turn a value into what JSON holds: a dataclass becomes its fields by name.

    Args:
        value: the value.
        attachments: takes up its arrays, which are not for JSON.
    """
    if type(value) in _AS_THEY_ARE:
        return value
    if is_dataclass(value):
        cls: Any = type(value)
        return {name: plain(getattr(value, name), attachments) for name in _names(cls)}
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
    """Return the function that turns JSON into values of a type.

    Args:
        kind: a dataclass, tuple, mapping, union, Path, str, int, float, bool or None, or made of
            these; arrays in it are annotated with `ATTACHED`.

    Returns:
        A function; it raises ForeignValueError for anything else than such a value.
    """
    from pydantic import ConfigDict, TypeAdapter, ValidationError
    from pydantic_core import SchemaValidator

    # Lists become tuples, mappings dataclasses, texts paths; the plain values nothing but what they
    # are. pydantic's own strictness is all or nothing, and its strict JSON knows no path whose
    # bytes are no UTF-8. A dataclass takes no configuration, but those inside a tuple have its.
    loose = TypeAdapter[Any](tuple[kind], config=ConfigDict(extra="forbid"))
    validator = SchemaValidator(_with_strict_leaves(loose.core_schema))

    def read(value: Any) -> Any:
        try:
            (found,) = validator.validate_python((value,))
        except ValidationError as error:
            first = error.errors(include_url=False, include_input=False, include_context=False)[0]
            where = ".".join(map(str, first["loc"][1:]))
            raise ForeignValueError(
                sentence("{where}: {msg}", where=where, msg=first["msg"]) if where else first["msg"]
            ) from None
        return found

    return read


def _with_strict_leaves(schema: Any) -> Any:
    if isinstance(schema, dict):
        if schema.get("type") == "default":  # of a field, which is always sent
            return _with_strict_leaves(schema["schema"])
        inner = {name: _with_strict_leaves(part) for name, part in schema.items()}
        return {**inner, **_LEAVES.get(schema.get("type", ""), {})}
    if isinstance(schema, list | tuple):
        return type(schema)(map(_with_strict_leaves, schema))
    return schema


class _Attached:
    """Tells pydantic what an array is: one of numbers, or of one type of them."""

    def __get_pydantic_core_schema__(self, source: Any, handler: Any) -> Any:
        from pydantic_core import core_schema

        (scalar,) = get_args(get_args(source)[1])

        def read(value: Any) -> Any:
            if not is_array(value):
                raise ValueError(
                    sentence("{type_name} where an array is wanted", type_name=type(value).__name__)
                )
            import numpy as np

            if scalar is not Any and value.dtype != np.dtype(scalar):
                raise ValueError(
                    sentence(
                        "an array of {value_dtype}, not of {dtype}",
                        value_dtype=value.dtype,
                        dtype=np.dtype(scalar),
                    )
                )
            return value

        return core_schema.no_info_plain_validator_function(read)


ATTACHED = _Attached()
"""Stands in the annotation of an array that travels beside a message: `Annotated[…, ATTACHED]`."""
