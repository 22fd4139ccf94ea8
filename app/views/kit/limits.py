"""What a pydantic model says of its numbers, for the boxes that they are typed into."""

from typing import Any, get_args

LARGEST = 2**31 - 1
"""Largest number that a box takes."""


def limits(model: Any, *where: str, step: float = 1) -> tuple[Any, Any, Any]:
    """Return smallest and largest value and the default of a number in a model, or within it.

    Args:
        model: pydantic class that has the field.
        where: name of the field, after those of the models that it stands in.
        step: between neighbouring numbers: what must be more than a limit is a step above it.

    Raises:
        KeyError: if there is no such field.
    """
    field = model.model_fields[where[0]]
    if where[1:]:
        kinds = (field.annotation, *get_args(field.annotation))
        inner = next(kind for kind in kinds if hasattr(kind, "model_fields"))
        return limits(inner, *where[1:], step=step)
    low, high = -LARGEST, LARGEST
    for rule in field.metadata:
        low = getattr(rule, "ge", getattr(rule, "gt", low - step) + step)
        high = getattr(rule, "le", high)
    return low, high, field.default
