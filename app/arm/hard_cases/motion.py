"""Hard cases of motion at a trocar: tip at the fulcrum, grazing shaft."""

from functools import partial
from math import atan2, cos, pi, sin
from types import SimpleNamespace
from typing import Any, Final

import numpy as np

from app.arm.mechanics import load_arm, solve
from app.arm.motion import LEAST_DEPTH, FulcrumError, HeldTool, JointPath, Pivot
from app.core.arrays import FloatArray
from app.studies.hard_cases.case import Defect, HardCase, analytic, answers, named

DECLARATION: Final[dict[str, Any]] = {
    "title": "Motion at a trocar",
}

ARM: Final = load_arm()
TOOL: Final = HeldTool(0.35, 0.25, np.array([1.0, 0.0, 0.0]))
GRAZING: Final = 0.5 * pi - 1e-6
"""A tilt that hardly goes into the body any more [rad]."""

PIVOT: Final = Pivot(ARM, TOOL, np.zeros(3), np.array([0.0, 0.0, -1.0]), tilt=GRAZING + 1e-9)
ASIDE: Final = np.array([0.0, 0.01, 0.0])
"""A velocity across the shaft [m/s]."""


def _tip_at_the_fulcrum() -> HardCase:
    depth = LEAST_DEPTH * (1.0 + 1e-9)
    tip = np.array([0.0, 0.0, -depth])

    def unscaled(*_: Any) -> Any:
        return SimpleNamespace(velocity=-ASIDE)

    def undefined() -> bool:
        places = (np.zeros(3), 1e-300 * tip, 0.5 * tip)
        calls = [partial(PIVOT.rates, place, ASIDE) for place in places]
        return all(named(FulcrumError, call).happens() for call in calls)

    return HardCase(
        subsystem="planning",
        case="arm: rates of the grip with the tip as near to the fulcrum as it may be",
        given="the tip 1 mm (1 + 1e-9) in, moved across at 10 mm/s; the grip 249 mm outside",
        way=Pivot.rates,
        found=lambda way: way(PIVOT, tip, ASIDE).velocity,
        reference=analytic(
            "-(grip - depth) / depth of the tip's", -(TOOL.grip - depth) / depth * ASIDE
        ),
        unit="m/s",
        bound=1e-14,
        beyond=answers("nearer, and at the fulcrum: FulcrumError, never a scale", undefined),
        defect=Defect("inverted, but not scaled by depth", unscaled),
    )


def _slid_through_the_fulcrum() -> HardCase:
    trocar = Pivot(ARM, TOOL, np.array([0.5, 0.0, 0.4]), np.array([0.0, 0.0, -1.0]))
    axis, roll = np.array([0.0, -0.28, -0.96]), 2.0

    def slid(pivot: Pivot, direction: FloatArray, depth: float) -> list[float]:
        q = solve(ARM, pivot.wrist_pose(pivot.pose(direction, depth, roll))).q
        there = pivot.state(q)
        return [*there.axis_world, there.depth, there.roll, there.off]

    def aimed(pivot: Pivot, direction: FloatArray, depth: float) -> list[float]:
        toward, found = pivot.aim(pivot.p_world + depth * direction)
        return slid(pivot, toward, found)

    return HardCase(
        subsystem="planning",
        case="arm: the tip at the fulcrum, where it aims nowhere, slid along a given direction",
        given="depth 0, direction (0, -0.28, -0.96), roll 2 rad, through the joint angles",
        way=slid,
        found=lambda way: way(trocar, axis, 0.0),
        reference=analytic("what the pose was made of, and 0", [*axis, 0.0, roll, 0.0]),
        unit="1, m, rad",
        bound=1e-14,
        beyond=named(FulcrumError, lambda: trocar.aim(trocar.p_world)),
        defect=Defect("direction from the fulcrum to the tip", aimed),
    )


def _grazing() -> HardCase:
    axis = np.array([sin(GRAZING), 0.0, -cos(GRAZING)])
    tip = 0.1 * axis

    def tilt(away: tuple[FloatArray, float]) -> float:
        d, _ = away
        return atan2(float(np.hypot(d[0], d[1])), float(-d[2]))

    def by_acos(pivot: Pivot, place: FloatArray) -> tuple[FloatArray, float]:
        depth = float(np.linalg.norm(place))
        lean = float(np.float32(np.arccos(-place[2] / depth)))
        return np.array([sin(lean), 0.0, -cos(lean)]), depth

    beyond = GRAZING + 2e-9
    return HardCase(
        subsystem="planning",
        case="arm: a shaft through the fulcrum 1 µrad from lying flat",
        given="the tip 100 mm from the fulcrum, tilt 90° - 1 µrad",
        way=Pivot.aim,
        found=lambda way: [tilt(way(PIVOT, tip)), way(PIVOT, tip)[1]],
        reference=analytic("the tilt and the depth that it was made of", [GRAZING, 0.1]),
        unit="rad, m",
        bound=1e-15,
        beyond=named(
            FulcrumError,
            lambda: PIVOT.aim(0.1 * np.array([sin(beyond), 0.0, -cos(beyond)])),
        ),
        defect=Defect("tilt in single precision", by_acos),
    )


def _roll_of_a_flat_shaft() -> HardCase:
    flat = Pivot(ARM, TOOL, np.array([0.5, 0.0, 0.4]), np.array([0.0, 0.0, -1.0]), tilt=GRAZING)
    axis = np.array([-sin(1.3), 0.0, -cos(1.3)])
    roll = 2.0
    q = solve(ARM, flat.wrist_pose(flat.pose(axis, 0.1, roll))).q

    def state(pivot: Pivot, angles: FloatArray) -> list[float]:
        there = pivot.state(angles)
        return [there.roll, there.depth, there.off]

    def by_angles(pivot: Pivot, angles: FloatArray) -> list[float]:
        needle = pivot.tool.needle_pose(pivot.arm, angles).rotation
        return [atan2(needle[2, 1], -needle[2, 0]), *state(pivot, angles)[1:]]

    def between() -> bool:
        other = solve(ARM, flat.wrist_pose(flat.pose(axis, 0.12, roll)), near=q).q
        path = JointPath.straight(q, other)
        seen = max(flat.state(one).off for one in path.at(np.linspace(0.0, 1.0, 200)))
        return bool(0.0 < seen <= flat.off(path))

    return HardCase(
        subsystem="planning",
        case="arm: roll, depth and distance from the fulcrum of a flat shaft, from joint angles",
        given="tilt 1.3 rad, roll 2 rad, depth 100 mm",
        way=state,
        found=lambda way: way(flat, q),
        reference=analytic("what the posture was made of, and 0", [roll, 0.1, 0.0]),
        unit="rad, m",
        bound=1e-14,
        beyond=answers("between postures: the bound of the distance holds", between),
        defect=Defect("roll as an Euler angle", by_angles),
    )


CASES: Final = (
    _tip_at_the_fulcrum(),
    _slid_through_the_fulcrum(),
    _grazing(),
    _roll_of_a_flat_shaft(),
)
"""All of them."""
