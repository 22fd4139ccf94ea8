"""Hard cases of motion at a trocar: tip at the fulcrum, grazing shaft, handle by the skin."""

from functools import partial
from math import atan2, cos, pi, sin
from types import SimpleNamespace
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray, angle_between
from app.mechanisms.arm import load_arm, solve
from app.planning.arm.path import JointPath
from app.planning.arm.pivot import LEAST_DEPTH, HeldTool, Pivot
from app.planning.errors import FulcrumError
from app.planning.placement import PatientOrientation
from app.session.pad.geometry import PathFrame, path_frame
from app.session.pad.hand import LEAST_OUTSIDE, LONGEST_TURN, Handle
from app.studies.hard_cases.case import Defect, HardCase, analytic, answers, named

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


def _handle_at_the_skin() -> HardCase:
    tool = Handle(0.3)
    depth = 0.3 - 1e-9
    down = np.array([0.0, 0.0, -1.0])
    frame = path_frame(down, PatientOrientation.SUPINE.rotation)
    way = 1e-6

    def moved(turned: Any) -> float:
        after = turned(tool, frame, down, (way, 0.0), depth)
        return depth * float((after - down) @ frame.right)

    def unbounded(tool: Handle, frame: PathFrame, down: FloatArray, way: Any, depth: float) -> Any:
        return down - way[0] / (tool.length - depth) * frame.right

    def bounded() -> bool:
        far = [tool.turned(frame, down, (1e9, -1e9), depth) for depth in (0.3, 0.5, 1e3)]
        return all(abs(angle_between(one, down) - LONGEST_TURN) < 1e-9 for one in far)

    return HardCase(
        subsystem="planning",
        case="tool: way of the tip with the handle as near to the skin as it may be",
        given="a tool of 300 mm, 1 nm of it outside; its handle goes 1 µm across",
        way=Handle.turned,
        found=moved,
        reference=analytic(
            "-depth sin(way / 20 mm): no less than 20 mm counts", -depth * sin(way / LEAST_OUTSIDE)
        ),
        unit="m",
        bound=1e-16,
        beyond=answers("deeper, or a way of 10⁹ m: a turn of 0.5 rad at most", bounded),
        defect=Defect("a scale by what is outside, without bound", unbounded),
    )


def _tool_at_the_fulcrum() -> HardCase:
    tool, depth = Handle(0.3), 1e-12
    leans = np.array([0.6, 0.0, -0.8])
    frame = path_frame(np.array([0.0, 0.0, -1.0]), PatientOrientation.SUPINE.rotation)

    def moved(turned: Any) -> FloatArray:
        after = turned(tool, frame, leans, (0.0, 3e-3), depth)
        grip = -(tool.length - depth) * (after - leans)
        return np.array([np.linalg.norm(after), grip @ frame.up])

    def by_tip(tool: Handle, frame: PathFrame, axis: FloatArray, way: Any, depth: float) -> Any:
        # As if the tip went that way: over its depth, as it is found from inside.
        return axis - way[1] / depth * frame.up

    def slides() -> bool:
        before, there, behind = (tool.scale(depth) for depth in (-1e-3, 0.0, 1e-3))
        return before > 0.0 == there > behind > -4e-3

    outside = 0.3 - depth
    return HardCase(
        subsystem="planning",
        case="tool: way of the handle with the tip at the fulcrum",
        given="a tool of 300 mm that leans by 37°, its tip 1 pm in; its handle goes 3 mm across",
        way=Handle.turned,
        found=moved,
        reference=analytic(
            "a unit vector; outside · sin(way / outside)", [1.0, outside * sin(3e-3 / outside)]
        ),
        unit="m",
        bound=1e-15,
        beyond=answers("at the fulcrum the scale is 0, before it the tip goes along", slides),
        defect=Defect("turned by the tip's way over its depth", by_tip),
    )


CASES: Final = (
    _tip_at_the_fulcrum(),
    _slid_through_the_fulcrum(),
    _grazing(),
    _roll_of_a_flat_shaft(),
    _handle_at_the_skin(),
    _tool_at_the_fulcrum(),
)
"""All of them."""
