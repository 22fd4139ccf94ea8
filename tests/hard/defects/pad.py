"""Defects of the hard cases of a hand at the handle of a long tool: scales without bound."""

from typing import Any

from app.core.arrays import FloatArray
from app.session.pad.geometry import PathFrame
from app.session.pad.hand import Handle
from tests.hard.defects import Defect


def unbounded(tool: Handle, frame: PathFrame, down: FloatArray, way: Any, depth: float) -> Any:
    return down - way[0] / (tool.length - depth) * frame.right


def by_tip(tool: Handle, frame: PathFrame, axis: FloatArray, way: Any, depth: float) -> Any:
    # As if the tip went that way: over its depth, as it is found from inside.
    return axis - way[1] / depth * frame.up


DEFECTS = {
    "planning": {
        "tool: way of the tip with the handle as near to the skin as it may be": Defect(
            "a scale by what is outside, without bound", unbounded
        ),
        "tool: way of the handle with the tip at the fulcrum": Defect(
            "turned by the tip's way over its depth", by_tip
        ),
    },
}
