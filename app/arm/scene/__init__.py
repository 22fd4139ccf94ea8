"""The scene of the laparoscopic manipulator in MuJoCo: arm, hand, tool, tray, trocar.

Simulation only: it never drives a real arm. MuJoCo (the extra `arm`) is imported when a scene is
opened.
"""

from app.arm.laparoscopy import SceneBox, ToolBody, TrocarRing
from app.arm.scene.carrying import (
    CarryError,
    CarryFailure,
    CarryPhase,
    Insertion,
    SeenTool,
    carry,
    could_carry,
    plan,
)
from app.arm.scene.layout import ArmScene
from app.arm.scene.performance import ArmMoment, ArmPerformance, ArmTimeline, ArmTrial
from app.arm.scene.running import ArmSceneState, RunningScene, SceneClearance

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
