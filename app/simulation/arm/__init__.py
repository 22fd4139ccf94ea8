"""The scene of the laparoscopic manipulator in MuJoCo: arm, hand, tool, tray, trocar.

Simulation only: it never drives a real arm. MuJoCo (the extra `arm`) is imported when a scene is
opened.
"""

from app.mechanisms.laparoscopy import SceneBox, ToolBody, TrocarRing
from app.simulation.arm.carrying import (
    CarryError,
    CarryFailure,
    CarryPhase,
    Insertion,
    SeenTool,
    carry,
    could_carry,
    plan,
)
from app.simulation.arm.performance import ArmMoment, ArmPerformance, ArmTimeline, ArmTrial
from app.simulation.arm.running import ArmSceneState, RunningScene, SceneClearance
from app.simulation.arm.scene import ArmScene

__all__ = [
    "ArmMoment",
    "ArmPerformance",
    "ArmScene",
    "ArmSceneState",
    "ArmTimeline",
    "ArmTrial",
    "CarryError",
    "CarryFailure",
    "CarryPhase",
    "Insertion",
    "RunningScene",
    "SceneBox",
    "SceneClearance",
    "SeenTool",
    "ToolBody",
    "TrocarRing",
    "carry",
    "could_carry",
    "plan",
]
