"""Hard cases of a hand at the handle of a long tool: handle by the skin, tip at the fulcrum."""

from math import sin
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray, angle_between
from app.planning.placement import PatientOrientation
from app.session.pad.geometry import path_frame
from app.session.pad.hand import LEAST_OUTSIDE, LONGEST_TURN, Handle
from app.studies.hard_cases.case import HardCase, analytic, answers


def _handle_at_the_skin() -> HardCase:
    tool = Handle(0.3)
    depth = 0.3 - 1e-9
    down = np.array([0.0, 0.0, -1.0])
    frame = path_frame(down, PatientOrientation.SUPINE.rotation)
    way = 1e-6

    def moved(turned: Any) -> float:
        after = turned(tool, frame, down, (way, 0.0), depth)
        return depth * float((after - down) @ frame.right)

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
    )


def _tool_at_the_fulcrum() -> HardCase:
    tool, depth = Handle(0.3), 1e-12
    leans = np.array([0.6, 0.0, -0.8])
    frame = path_frame(np.array([0.0, 0.0, -1.0]), PatientOrientation.SUPINE.rotation)

    def moved(turned: Any) -> FloatArray:
        after = turned(tool, frame, leans, (0.0, 3e-3), depth)
        grip = -(tool.length - depth) * (after - leans)
        return np.array([np.linalg.norm(after), grip @ frame.up])

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
    )


CASES: Final = (_handle_at_the_skin(), _tool_at_the_fulcrum())
"""All of them."""
