"""The tool and the trocar in two pictures, and the fulcrum."""

from app.arm.eyes.blob import AreaMoments, ToolBlob, ToolMiss, ToolMissReason, find_tool, moments
from app.arm.eyes.fulcrum import Fulcrum, FulcrumStatus, ShaftLine, meet_lines, meet_planes
from app.arm.eyes.pictures import ToolRenderer, ToolScene, eyes, tool_outline
from app.arm.eyes.pose import ToolPose, ToolStatus
from app.arm.eyes.trocar import TrocarStatus, ring_outline, solve_trocar
from app.arm.eyes.watching import Pair, ToolEyes

__all__ = [
    "AreaMoments",
    "Fulcrum",
    "FulcrumStatus",
    "Pair",
    "ShaftLine",
    "ToolBlob",
    "ToolEyes",
    "ToolMiss",
    "ToolMissReason",
    "ToolPose",
    "ToolRenderer",
    "ToolScene",
    "ToolStatus",
    "TrocarStatus",
    "eyes",
    "find_tool",
    "meet_lines",
    "meet_planes",
    "moments",
    "ring_outline",
    "solve_trocar",
    "tool_outline",
]
