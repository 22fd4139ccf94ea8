"""What measuring tools and measurements are called."""

from app.planning.measurements import KINDS, Measurement
from app.views.kit.text import tr
from app.views.measure.editor import MeasureTool


def tool_title(tool: MeasureTool) -> str:
    """Name of a tool."""
    return {
        MeasureTool.DISTANCE: tr("Distance"),
        MeasureTool.ANGLE: tr("Angle"),
        MeasureTool.PROBE: tr("HU probe"),
        MeasureTool.REGION: tr("Region (mean)"),
    }.get(tool, "")


def tool_help(tool: MeasureTool) -> str:
    """Say how a tool is used."""
    return {
        MeasureTool.DISTANCE: tr("Drag from point to point"),
        MeasureTool.ANGLE: tr("Drag along one side to the vertex, then click the other side"),
        MeasureTool.PROBE: tr("Click: the value of that voxel"),
        MeasureTool.REGION: tr("Drag from corner to corner: mean ± deviation and area of the "
                               "ellipse"),
    }.get(tool, "")  # fmt: skip


def kind_word(item: Measurement) -> str:
    """Name of a measurement's kind."""
    return tool_title(MeasureTool(KINDS[type(item)]))
