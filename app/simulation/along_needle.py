"""What the effects along the needle share: tissue at the tip, and the speed of a depth.

Tissue lies in layers by depth or, where the scene has a field, where the field's stage finds the
tip: one row of values for each layer or each of the field's codes, and one law for both.
"""

from typing import Final, NamedTuple

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.compiled import njit
from app.simulation.scene import Binding

FASTEST: Final = 10.0  # [m/s]; faster is a jump of the measurement
SNAP: Final = 1e-12
"""What decays becomes 0 below this: subnormal numbers cost 20 times more."""


def layer_rows(binding: Binding, *quantities: str) -> FloatArray:
    """Return (depth of its end [m], the quantities) of each layer, shape (n, 1 + quantities)."""
    layers = binding.scene.layers
    ends = np.cumsum([layer.thickness for layer in layers])
    columns = [[float(getattr(layer, name)) for layer in layers] for name in quantities]
    return np.column_stack([ends, *columns])


def tissue_rows(binding: Binding, *quantities: str) -> FloatArray:
    """Return (depth of its end [m], the quantities) of each tissue, shape (n, 1 + quantities).

    Of a scene with a field a row per code, whose ends mean nothing; else a row per layer.
    """
    met = binding.scene.met
    ends = np.cumsum([tissue.thickness for tissue in met])
    columns = [[float(getattr(tissue, name)) for tissue in met] for name in quantities]
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
def tissue_row(
    p: FloatArray,
    state: FloatArray,
    first: int,
    width: int,
    rows: int,
    by_field: float,
    place: float,
) -> int:
    """Place of the row of the tissue at the tip: by TISSUE in a field, else by the depth `place`.

    A code that the table does not have is that of what nobody labelled, 0.
    """
    if by_field > 0.0:
        code = state[sv.TISSUE]
        return first + width * (int(code) if 0.0 <= code < rows else 0)
    return layer_at(p, first, width, rows, place)


@njit
def in_tissue(p: FloatArray, at: int, state: FloatArray, by_field: float, depth: float) -> float:
    """Depth of the tip as the tissue sees it [m]: less what breathing has carried it since.

    Only while the tip stays in one tissue: where another one begins it is carried otherwise, and
    the step between both moves nothing. Memory of three places from `at` on: what is taken off,
    what CARRIED along the needle was, and in which tissue; the last begins as NaN. Without a field
    it is the depth itself.
    """
    if by_field == 0.0:
        return depth
    along = (
        state[sv.CARRIED_X] * state[sv.AXIS_X]
        + state[sv.CARRIED_Y] * state[sv.AXIS_Y]
        + state[sv.CARRIED_Z] * state[sv.AXIS_Z]
    )
    if np.isfinite(along):
        if p[at + 2] == state[sv.TISSUE]:
            p[at] += along - p[at + 1]
        p[at + 1], p[at + 2] = along, state[sv.TISSUE]
    return depth - p[at]


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
