"""Values by the names of their fields: in a document, and what a model says of them."""

from __future__ import annotations

from collections.abc import Mapping
from typing import Any, get_args

from pydantic import BaseModel
from pydantic.fields import FieldInfo

Document = dict[str, Any]
Where = tuple[str, ...]
"""Names of fields, from the outside to the inside."""

Range = tuple[Any, Any, Any]
"""Smallest and largest value, and the one to begin with."""


def field_of(model: type[BaseModel], *where: str) -> FieldInfo:
    """Return a field of a model, or of one within it.

    Raises:
        KeyError: if there is no such field.
    """
    inner: Any = model
    for name in where:
        field: FieldInfo = getattr(inner, "model_fields", {})[name]
        kinds = field.annotation, *get_args(field.annotation)
        inner = next((kind for kind in kinds if hasattr(kind, "model_fields")), None)
    return field


def limits(model: type[BaseModel], *where: str) -> Range:
    """Return smallest and largest value and default of a number, as a model has them.

    Where it has no largest one it is that of a box of whole numbers; what must be more than a limit
    is a hundredth above it.

    Raises:
        KeyError: if there is no such field.
    """
    low, high, field = None, 2**31 - 1, field_of(model, *where)
    for rule in field.metadata:
        low = rule.gt + 0.01 if hasattr(rule, "gt") else getattr(rule, "ge", low)
        high = getattr(rule, "le", high)
    return low, high, field.default


def value_at(document: object, *where: str, default: Any = None) -> Any:
    """Return a value of a document; `default` where nothing is said of it."""
    for name in where:
        if not isinstance(document, Mapping) or name not in document:
            return default
        document = document[name]
    return document


def put_value(document: Document, where: Where, value: Any) -> None:
    """Set a value of a document, or take it away with None."""
    for name in where[:-1]:
        inner = document.get(name)
        if not isinstance(inner, dict):
            inner = document[name] = {}
        document = inner
    if value is None:
        document.pop(where[-1], None)
    else:
        document[where[-1]] = value
