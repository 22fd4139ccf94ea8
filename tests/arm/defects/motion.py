"""Defects of the hard cases of motion at a trocar: not scaled, aimed at nothing, by angles."""

from math import atan2, cos, sin
from types import SimpleNamespace
from typing import Any

import numpy as np

from app.arm.hard_cases.motion import ASIDE, posture, slid
from app.arm.motion import Pivot
from app.core.arrays import FloatArray
from tests.hard.defects import Defect


def unscaled(*_: Any) -> Any:
    return SimpleNamespace(velocity=-ASIDE)


def aimed(pivot: Pivot, direction: FloatArray, depth: float) -> list[float]:
    toward, found = pivot.aim(pivot.p_world + depth * direction)
    return slid(pivot, toward, found)


def by_acos(pivot: Pivot, place: FloatArray) -> tuple[FloatArray, float]:
    depth = float(np.linalg.norm(place))
    lean = float(np.float32(np.arccos(-place[2] / depth)))
    return np.array([sin(lean), 0.0, -cos(lean)]), depth


def by_angles(pivot: Pivot, angles: FloatArray) -> list[float]:
    needle = pivot.tool.needle_pose(pivot.arm, angles).rotation
    return [atan2(needle[2, 1], -needle[2, 0]), *posture(pivot, angles)[1:]]


DEFECTS = {
    "planning": {
        "arm: rates of the grip with the tip as near to the fulcrum as it may be": Defect(
            "inverted, but not scaled by depth", unscaled
        ),
        "arm: the tip at the fulcrum, where it aims nowhere, slid along a given direction": Defect(
            "direction from the fulcrum to the tip", aimed
        ),
        "arm: a shaft through the fulcrum 1 µrad from lying flat": Defect(
            "tilt in single precision", by_acos
        ),
        "arm: roll, depth and distance from the fulcrum of a flat shaft, from joint angles": Defect(
            "roll as an Euler angle", by_angles
        ),
    },
}
