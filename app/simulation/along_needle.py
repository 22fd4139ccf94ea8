"""What the effects along the needle share: layers by depth, and the speed of a depth."""

from typing import Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.simulation.scene import Binding

GAUGE_18: Final = 1.270e-3
"""Outer diameter that the puncture forces of layers belong to [m]."""

FASTEST: Final = 10.0  # [m/s]; faster is a jump of the measurement
SNAP: Final = 1e-12
"""What decays becomes 0 below this: subnormal numbers cost 20 times more."""


def layer_rows(binding: Binding, *quantities: str) -> FloatArray:
    """Return (depth of its end [m], the quantities) of each layer, shape (n, 1 + quantities)."""
    layers = binding.scene.layers
    ends = np.cumsum([layer.thickness for layer in layers])
    columns = [[float(getattr(layer, name)) for layer in layers] for name in quantities]
    return np.column_stack([ends, *columns])


def smoothing_of(binding: Binding, measured: float) -> float:
    """Time constant of the depth's speed [s]: `measured`, or 0 for a simulated needle's own depth.

    A measured depth comes in steps of a camera frame.
    """
    return 0.0 if binding.depth_slot == sv.PLANT_DEPTH else measured


def keep_memory(places: NamedTuple, old: FloatArray, new: FloatArray) -> None:
    """Carry the memory of an effect over to its array for another model."""
    for name in places._field_defaults:
        place = getattr(places, name)
        new[place] = old[place]


@njit
def layer_at(p: FloatArray, first: int, width: int, layers: int, depth: float) -> int:
    """Place of the row of the layer at a depth; rows of `width` begin at `first`, last if below."""
    for i in range(layers - 1):
        if depth < p[first + i * width]:
            return first + i * width
    return first + (layers - 1) * width


@njit
def smoothed_speed(speed: float, travel: float, dt: float, smoothing: float) -> float:
    """Speed after `travel` [m] in `dt` [s], smoothed by a time constant; as before for dt <= 0."""
    if not dt > 0.0:
        return speed
    keep = np.exp(-dt / smoothing) if smoothing > 0.0 else 0.0
    now = min(max(travel / dt, -FASTEST), FASTEST)
    speed = keep * speed + (1.0 - keep) * now
    return speed if abs(speed) > SNAP else 0.0


@njit
def approach(value: float, end: float, way: float) -> float:
    """Value after going a share 1 - exp(-way) towards `end`, `way` 0 or more; 0 near 0."""
    found = end + (value - end) * np.exp(-way)
    return found if abs(found) > SNAP else 0.0
