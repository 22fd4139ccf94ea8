"""Motion of the simulated arm: pivoting, Cartesian motion, timing, search, pick and place."""

from app.arm.motion.errors import FulcrumError
from app.arm.motion.following import PoseLine, follow
from app.arm.motion.path import JointPath
from app.arm.motion.pivot import LEAST_DEPTH, HeldTool, Pivot
from app.arm.motion.searching import (
    Budget,
    Collisions,
    FoundWay,
    Planner,
    SearchError,
    import_ompl,
    search,
)
from app.arm.motion.timing import free_move, import_ruckig, timed

__all__ = [
    "LEAST_DEPTH",
    "Budget",
    "Collisions",
    "FoundWay",
    "FulcrumError",
    "HeldTool",
    "JointPath",
    "Pivot",
    "Planner",
    "PoseLine",
    "SearchError",
    "follow",
    "free_move",
    "import_ompl",
    "import_ruckig",
    "search",
    "timed",
]
