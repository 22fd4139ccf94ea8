"""What the hand feels as far as the depth is known: at the last trusted lever, and its bounds.

The loop's force at the hub is that of a lever L_out, and a force at the tool gives γ L_in / L_out
there. Where no camera measures the depth the loop goes on with the model's, which is a guess: the
force is then said at the depth that was measured last, and that of the interval's two ends is said
beside it.
"""

from __future__ import annotations

from dataclasses import dataclass
from math import isfinite, nan
from typing import Final

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray, read_only
from app.device.state import DeviceState
from app.session.needle import NeedlePose

SHORTEST: Final = 0.005
"""No lever is taken for shorter [m], as in the loop."""


@dataclass(frozen=True, slots=True, eq=False)
class FeltForce:
    """Force at the hub point after all limits, estimated from the torques.

    Attributes:
        force: at the last trusted depth; where none was ever measured at the one that makes it
            largest [N], shape (3,), read-only.
        least: smallest size that it can have [N]; NaN where the depth's interval is not known.
        most: largest size that it can have [N]; likewise.
    """

    force: FloatArray
    least: float
    most: float


def felt_force(device: DeviceState, pose: NeedlePose) -> FeltForce:
    """Return what is felt in a state of the loop, with what its pose says of the depth."""
    row = np.asarray(device.row)
    lever = float(row[sv.L_OUT])
    length = lever + float(row[sv.DEPTH])
    low, high = float(row[sv.DEPTH_LEAST]), float(row[sv.DEPTH_MOST])
    felt = np.asarray(device.felt, dtype=np.float64)
    if not (lever > 0.0 and isfinite(length + low + high)):
        return FeltForce(read_only(felt.copy()), nan, nan)
    longest, shortest = max(length - low, SHORTEST), max(length - high, SHORTEST)
    if not pose.measured:
        trusted = pose.trusted_depth
        at = shortest if trusted is None else max(length - trusted, SHORTEST)
        felt = felt * (lever / at)
        lever = at
    size = float(np.linalg.norm(felt))
    least = size * min(lever / longest, 1.0)
    return FeltForce(read_only(np.array(felt)), least, size * max(lever / shortest, 1.0))
