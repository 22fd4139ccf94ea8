"""Filters of the depth by name."""

from enum import StrEnum

from app.tracking.motion.constant_velocity import ConstantVelocity
from app.tracking.motion.depth_filter import DepthFilter
from app.tracking.motion.hold import Hold
from app.tracking.motion.one_euro import OneEuro


class FilterName(StrEnum):
    """Named filters; `acus study depth_motion` compares them."""

    HOLD = "hold"
    CONSTANT_VELOCITY = "constant_velocity"
    ONE_EURO = "one_euro"


DEFAULT = FilterName.CONSTANT_VELOCITY
"""Chosen by `acus study depth_motion`."""


def depth_filter(name: FilterName = DEFAULT) -> DepthFilter:
    """Return a new filter."""
    match name:
        case FilterName.HOLD:
            return Hold()
        case FilterName.CONSTANT_VELOCITY:
            return ConstantVelocity()
        case FilterName.ONE_EURO:
            return OneEuro()
