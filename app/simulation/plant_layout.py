"""Parameters and types that the kernels of the simulated robot share."""

from typing import Final

from app.mechanisms.dynamic_model import MODEL_SIZE

# Parameters array: the model of the dynamics first, see `mechanisms.dynamic_model`.
MODEL: Final = 0
LENGTH, RADIUS, STOP_K, STOP_B, DEPTH_MIN, DEPTH_MAX = range(MODEL_SIZE, MODEL_SIZE + 6)
MASS, SEAL, SEAL_VISCOUS = range(MODEL_SIZE + 6, MODEL_SIZE + 9)
HAND_K, HAND_B, HAND_AXIAL_K, HAND_AXIAL_B, HAND_MOST = range(MODEL_SIZE + 9, MODEL_SIZE + 14)
START_LEFT, START_RIGHT, START_DEPTH = range(MODEL_SIZE + 14, MODEL_SIZE + 17)
MOTION: Final = MODEL_SIZE + 17  # of the hand, see `hand_motion`

SHORTEST_LEVER: Final = 0.01  # [m] of needle outside the fulcrum

Pose = tuple[bool, float, float, float, float, float, float]
"""Whether the mechanism can have the pose, its tool point and Jacobian (jxl, jxr, jyl, jyr)."""

System = tuple[float, float, float, float, float]
"""Force at the tool (x, y) and the matrix (xx, xy, yy) that its spring-damper adds."""
