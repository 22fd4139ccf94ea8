"""The eyes of the machine: tool, trocar and fulcrum from the pictures of two calibrated cameras."""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass, field

from app.arm.eyes.blob import GREEN, ToolMiss, find_tool
from app.arm.eyes.fulcrum import Fulcrum, meet_planes
from app.arm.eyes.pose import ToolOutline, ToolPose, ToolStatus, solve_tool
from app.arm.eyes.trocar import (
    BLUE,
    TrocarFix,
    TrocarStatus,
    no_trocar,
    ring_outline,
    solve_trocar,
)
from app.core.units import MILLIMETRE
from app.tracking.cameras.camera import Image
from app.tracking.markers.colour import ColourModel
from app.tracking.optics.calibration import StereoCalibration
from app.tracking.optics.camera_model import CameraModel
from app.tracking.stereo.calibration_uncertainty import CalibrationUncertainty

Pair = tuple[Image, Image]
"""Pictures of both cameras, of one moment."""


@dataclass(frozen=True, slots=True, kw_only=True)
class ToolEyes:
    """Two cameras and what they look for. Frozen; every question is answered from its pictures.

    Attributes:
        models: both cameras in the robot's frame.
        outline: of the tool, if it is known: its centre along the shaft is then known better.
        tool_colour: of the tool.
        trocar_colour: of the trocar's ring.
        trocar_radius: of the ring's outer rim [m]; None if it is not known.
        noise_grey: standard deviation of a grey value.
        systematic_px: what calibration and outline leave besides noise, per axis [px].
        calibration: of the cameras; its uncertainty enters the covariances. None: exact cameras.
    """

    models: tuple[CameraModel, CameraModel]
    outline: ToolOutline | None = None
    tool_colour: ColourModel = GREEN
    trocar_colour: ColourModel = BLUE
    trocar_radius: float | None = 16.0 * MILLIMETRE
    noise_grey: float = 4.0
    systematic_px: float = 0.05
    calibration: StereoCalibration | None = None
    _uncertainty: CalibrationUncertainty | None = field(init=False, repr=False, compare=False)

    def __post_init__(self) -> None:
        known = None if self.calibration is None else CalibrationUncertainty(self.calibration)
        object.__setattr__(self, "_uncertainty", known)

    def tool(self, pictures: Pair) -> ToolPose | ToolMiss:
        """Return where the tool lies, or why a picture shows none."""
        first, second = (find_tool(one, self.tool_colour, self.noise_grey) for one in pictures)
        if isinstance(first, ToolMiss):
            return first
        if isinstance(second, ToolMiss):
            return second
        return solve_tool(
            self.models, (first, second), self.outline, self.systematic_px, self._uncertainty
        )

    def trocar(self, pictures: Pair) -> TrocarFix:
        """Return the trocar's ring; its centre is the fulcrum."""
        first, second = (ring_outline(one, self.trocar_colour) for one in pictures)
        if isinstance(first, TrocarStatus):
            return no_trocar(first)
        if isinstance(second, TrocarStatus):
            return no_trocar(second)
        return solve_trocar(
            self.models,
            (first, second),
            self.trocar_radius,
            self.systematic_px,
            self._uncertainty,
        )

    def fulcrum(self, poses: Sequence[ToolPose]) -> Fulcrum:
        """Return what the shaft has turned about; poses without a line do not count.

        The calibration's own share is not in its covariance: that of `trocar` has it.
        """
        found = [pose for pose in poses if pose.status is ToolStatus.FOUND]
        return meet_planes([sight for pose in found for sight in pose.sights])
