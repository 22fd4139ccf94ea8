"""Parameters and types that the kernels of the simulated robot share."""

from typing import Final, NamedTuple

from app.core.parameters import numbered
from app.mechanisms.dynamic_model import MODEL_SIZE

MODEL: Final = 0
"""Place of the model of the dynamics, see `mechanisms.dynamic_model`; the others follow it."""


class PlantPlaces(NamedTuple):
    """Needle, stops, what slides along the needle, hand, and the starting pose."""

    length: int
    radius: int
    stop_k: int
    stop_b: int
    depth_min: int
    depth_max: int
    mass: int
    seal: int
    seal_viscous: int
    hand_k: int
    hand_b: int
    hand_axial_k: int
    hand_axial_b: int
    hand_most: int
    start_left: int
    start_right: int
    start_depth: int


AT: Final = numbered(PlantPlaces, MODEL_SIZE)
MOTION: Final = MODEL_SIZE + len(AT)  # of the hand, see `hand_motion`

SHORTEST_LEVER: Final = 0.01  # [m] of needle outside the fulcrum

Pose = tuple[bool, float, float, float, float, float, float]
"""Whether the mechanism can have the pose, its tool point and Jacobian (jxl, jxr, jyl, jyr)."""

System = tuple[float, float, float, float, float]
"""Force at the tool (x, y) and the matrix (xx, xy, yy) that its spring-damper adds."""
