"""Looking at the chosen cameras, and how much of the needle's cone they see."""

from __future__ import annotations

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np

from app.compose.cameras import calibration_of, checked_cameras
from app.core.arrays import FloatArray
from app.core.clock import SystemClock
from app.core.configuration import parse
from app.core.messages import sentence
from app.core.units import MILLISECOND
from app.mechanisms.profile import load_profile
from app.tracking.calibration.applies import require_cameras
from app.tracking.cameras.camera import CameraFrame, Image
from app.tracking.cameras.factory import make_camera
from app.tracking.cameras.settings import CameraSettings, OneCamera
from app.tracking.cameras.source import parse_source
from app.tracking.cameras.survey import CameraReport, survey, with_outline, write_pictures
from app.tracking.errors import CameraError
from app.tracking.markers.choice import extractors
from app.tracking.markers.colour import RED
from app.tracking.markers.extractor import MarkerFix
from app.tracking.optics.rig import RangeProfile, RigProfile, ViewCone, load_rig, view_cone
from app.tracking.stereo.epipolar import check_order

_MOMENT = 0.5


@dataclass(frozen=True, slots=True, eq=False)
class CameraCheck:
    """What was seen: a report per camera, skew [ms] and the order of the two in words."""

    reports: tuple[CameraReport, ...]
    skew_ms: float | None
    order: str

    def write_pictures(self, folder: Path) -> None:
        """Write the newest picture of each camera as `<name>.png`."""
        write_pictures(folder, {r.name: r.image for r in self.reports if r.image is not None})


@dataclass(frozen=True, slots=True, eq=False)
class Aim:
    """The cone in both pictures, and whose cameras they are: calibrated, or as designed.

    Attributes:
        cone: the cone in both pictures.
        rig: cameras it was computed for.
        basis: calibration, or the rig as designed.
        assumed: whether real cameras are taken to stand as designed: no picture was asked.
    """

    cone: ViewCone
    rig: RigProfile
    basis: str
    assumed: bool = False

    @property
    def image_size(self) -> tuple[int, int]:
        """Width, height [px] that the outlines count in."""
        return self.rig.models[0].image_size

    def write_pictures(self, settings: CameraSettings, folder: Path) -> None:
        """Write both pictures with the cone's outline as `<name>.png`; simulated ones are grey."""
        images: list[Image] = []
        if settings.simulated:
            for model in self.rig.models:
                width, height = model.image_size
                images.append(np.full((height, width, 3), 60, np.uint8))
        else:
            pair = checked_cameras(settings, SystemClock(), "the camera settings")
            reports = survey(pair, self.cone.names, SystemClock(), _MOMENT)
            images = [report.image for report in reports if report.image is not None]
        drawn = [
            with_outline(image, outline * (np.array(image.shape[1::-1]) / self.image_size))
            for image, outline in zip(images, self.cone.outlines, strict=True)
        ]
        write_pictures(folder, dict(zip(self.cone.names, drawn, strict=True)))


def survey_cameras(settings: CameraSettings, source: str, seconds: float) -> CameraCheck:
    """Look at the cameras of the settings, or at one source.

    Raises:
        CameraError: if they are simulated, or one cannot be opened.
    """
    clock = SystemClock()
    if source:
        camera = make_camera(settings, OneCamera(source=str(parse_source(source))), clock)
        return CameraCheck(survey([camera], [source], clock, seconds), None, "")
    if settings.simulated:
        raise CameraError(
            sentence(
                "the cameras are simulated; choose real ones with `acus camera use --left SOURCE "
                "--right SOURCE`, or look at one with --source"
            )
        )
    settings.check()
    rig = load_rig(settings.rig)
    pair = checked_cameras(settings, clock, "the camera settings")
    frames: list[tuple[CameraFrame, ...]] = []
    names = [camera.name for camera in rig.cameras]
    reports = survey(pair, names, clock, seconds, frames.append)
    apart = [right.time - left.time for left, right in frames]
    skew = float(np.median(apart)) / MILLISECOND if apart else None
    return CameraCheck(reports, skew, _order(settings, rig, frames))


def _order(
    settings: CameraSettings, rig: RigProfile, frames: Sequence[tuple[CameraFrame, ...]]
) -> str:
    calibration = calibration_of(settings)
    if calibration is None:
        return sentence(
            "left and right are not checked: there is no calibration yet (`acus calibrate`)"
        )
    finders = extractors(rig, colour=settings.marker_colour or RED)
    pixels: list[tuple[FloatArray, FloatArray]] = []
    for left, right in frames[:: max(1, len(frames) // 20)]:
        found = [f.search(p.image)[:1] for f, p in zip(finders, (left, right), strict=True)]
        first, second = (next(iter(f), None) for f in found)
        if isinstance(first, MarkerFix) and isinstance(second, MarkerFix):
            pixels.append((first.uv, second.uv))
    return check_order(calibration.models(), pixels).text


def aim_of(settings: CameraSettings, device: str, reach: Mapping[str, float] | None = None) -> Aim:
    """Return what the cameras see of the needle's cone: calibrated ones, else as designed.

    Args:
        settings: of the cameras.
        device: name of the device profile: where the fulcrum is.
        reach: fields of the rig's range that are to be others.

    Raises:
        CalibrationError: if the calibration is of other cameras or another size.
        RigError: if there is no such rig, or the range is empty.
        ConfigurationError: if the range cannot be.
    """
    rig = load_rig(settings.rig)
    fulcrum = load_profile(device).fulcrum
    basis, assumed = sentence("rig {rig_name} as designed", rig_name=rig.name), False
    calibration = None if settings.simulated else calibration_of(settings)
    if calibration is not None and calibration.world is not None:
        names = [camera.name for camera in rig.cameras]
        require_cameras(calibration, names, [settings.size] * 2)
        rig = rig.calibrated(calibration)
        basis = sentence("calibration {name}", name=calibration.id)
    elif not settings.simulated:
        basis, assumed = (
            sentence("{basis}; the cameras are not calibrated with a world frame yet", basis=basis),
            True,
        )
    wanted = parse(rig.range.model_dump() | dict(reach or {}), RangeProfile, "range")
    return Aim(view_cone(rig.models, rig.needle, wanted, fulcrum), rig, basis, assumed)
