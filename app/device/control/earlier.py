"""Arrays of stages as older records hold them.

Before machines had stages of their own, kinematics, governor, plant and the laws that know the
dynamics began with, or ended in, numbers of the pantograph, which was the only machine. Those
numbers now stand in the machine's own stages, made from the profile that the record has attached;
all else, memory included, goes over as it was. `tests/data/records-machines` are such records.
"""

from typing import Final

import numpy as np

from app.core.arrays import FloatArray

_MODEL: Final = 21
"""Numbers of the pantograph's dynamic model, as it stood in arrays."""

_CENTRE, _WEIGHT, _COULOMB, _VISCOUS = (3, 4, 5), (15, 16, 17), 18, 19
_NEEDLE_MASS, _NEEDLE_OFFSET = 12, 14
"""Places in it: remote centre, gravity, friction of the joints, the needle."""

_PLANT: Final = (
    *range(_MODEL, _MODEL + 17),
    *(*_CENTRE, _COULOMB, _VISCOUS, *_WEIGHT, _NEEDLE_MASS, _NEEDLE_OFFSET),
    *range(_MODEL + 17, _MODEL + 26),
    *range(_MODEL),
)
_IMPEDANCE: Final = (*range(8), *(15 + place for place in _CENTRE), *range(8, 15))
_COMPENSATION: Final = (
    *range(5),
    *(7 + place for place in (_COULOMB, _VISCOUS, _NEEDLE_MASS, _NEEDLE_OFFSET, *_WEIGHT)),
    *(5, 6),
)

_BEFORE: Final[dict[tuple[str, int], tuple[int, ...]]] = {
    ("kinematics", 14): tuple(range(3, 14)),
    ("governor", 125): tuple(range(7, 125)),
    ("plant", _MODEL + 26): _PLANT,
    ("impedance", 15 + _MODEL): _IMPEDANCE,
    ("compensation", 7 + _MODEL): _COMPENSATION,
}
"""Stage and length of its array then -> which of its numbers the array has now, in order."""


def as_now(name: str, values: FloatArray) -> FloatArray:
    """Return a stage's array of a record as this program has it; one of today's as it is."""
    order = _BEFORE.get((name, len(values)))
    return values if order is None else values[np.array(order)]
