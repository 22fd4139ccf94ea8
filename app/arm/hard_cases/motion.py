"""Hard cases of motion at a trocar: tip at the fulcrum, grazing shaft."""

from functools import partial
from math import atan2, cos, pi, sin
from typing import Any, Final

import numpy as np

from app.arm.mechanics import load_arm, solve
from app.arm.motion import LEAST_DEPTH, FulcrumError, HeldTool, JointPath, Pivot
from app.core.arrays import FloatArray
from app.studies.hard_cases.case import HardCase, analytic, answers, named

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

ROLL: Final = 2.0
"""Of the tool about its shaft [rad]."""


def _tip_at_the_fulcrum() -> HardCase:
    depth = LEAST_DEPTH * (1.0 + 1e-9)
    tip = np.array([0.0, 0.0, -depth])

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
    )


def slid(pivot: Pivot, direction: FloatArray, depth: float) -> list[float]:
    """Return direction, depth, roll and distance from the fulcrum of a tool that was slid there."""
    q = solve(ARM, pivot.wrist_pose(pivot.pose(direction, depth, ROLL))).q
    there = pivot.state(q)
    return [*there.axis_world, there.depth, there.roll, there.off]


def _slid_through_the_fulcrum() -> HardCase:
    trocar = Pivot(ARM, TOOL, np.array([0.5, 0.0, 0.4]), np.array([0.0, 0.0, -1.0]))
    axis = np.array([0.0, -0.28, -0.96])

    return HardCase(
        subsystem="planning",
        case="arm: the tip at the fulcrum, where it aims nowhere, slid along a given direction",
        given="depth 0, direction (0, -0.28, -0.96), roll 2 rad, through the joint angles",
        way=slid,
        found=lambda way: way(trocar, axis, 0.0),
        reference=analytic("what the pose was made of, and 0", [*axis, 0.0, ROLL, 0.0]),
        unit="1, m, rad",
        bound=1e-14,
        beyond=named(FulcrumError, lambda: trocar.aim(trocar.p_world)),
    )


def _grazing() -> HardCase:
    axis = np.array([sin(GRAZING), 0.0, -cos(GRAZING)])
    tip = 0.1 * axis

    def tilt(away: tuple[FloatArray, float]) -> float:
        d, _ = away
        return atan2(float(np.hypot(d[0], d[1])), float(-d[2]))

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
    )


def posture(pivot: Pivot, angles: FloatArray) -> list[float]:
    """Return roll, depth and distance from the fulcrum of a tool that joint angles hold."""
    there = pivot.state(angles)
    return [there.roll, there.depth, there.off]


def _roll_of_a_flat_shaft() -> HardCase:
    flat = Pivot(ARM, TOOL, np.array([0.5, 0.0, 0.4]), np.array([0.0, 0.0, -1.0]), tilt=GRAZING)
    axis = np.array([-sin(1.3), 0.0, -cos(1.3)])
    q = solve(ARM, flat.wrist_pose(flat.pose(axis, 0.1, ROLL))).q

    def between() -> bool:
        other = solve(ARM, flat.wrist_pose(flat.pose(axis, 0.12, ROLL)), near=q).q
        path = JointPath.straight(q, other)
        seen = max(flat.state(one).off for one in path.at(np.linspace(0.0, 1.0, 200)))
        return bool(0.0 < seen <= flat.off(path))

    return HardCase(
        subsystem="planning",
        case="arm: roll, depth and distance from the fulcrum of a flat shaft, from joint angles",
        given="tilt 1.3 rad, roll 2 rad, depth 100 mm",
        way=posture,
        found=lambda way: way(flat, q),
        reference=analytic("what the posture was made of, and 0", [ROLL, 0.1, 0.0]),
        unit="rad, m",
        bound=1e-14,
        beyond=answers("between postures: the bound of the distance holds", between),
    )


CASES: Final = (
    _tip_at_the_fulcrum(),
    _slid_through_the_fulcrum(),
    _grazing(),
    _roll_of_a_flat_shaft(),
)
"""All of them."""
