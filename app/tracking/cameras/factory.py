"""Makes the camera that a source names."""

from __future__ import annotations

from pathlib import Path

from app.core.clock import Clock
from app.core.messages import sentence
from app.core.units import MILLISECOND
from app.tracking.cameras.camera import Camera
from app.tracking.cameras.capture import Controls, Opener, open_capture
from app.tracking.cameras.files import FolderCamera, VideoCamera
from app.tracking.cameras.settings import CameraSettings, OneCamera
from app.tracking.cameras.source import SourceKind
from app.tracking.cameras.usb import UsbCamera
from app.tracking.errors import CameraError


def make_camera(
    settings: CameraSettings, camera: OneCamera, clock: Clock, opener: Opener = open_capture
) -> Camera:
    """Make the camera of a source; opens nothing.

    Raises:
        CameraError: for a simulated one, which needs a scene.
    """
    source = camera.origin
    if source.kind is SourceKind.USB:
        controls = Controls(
            settings.size,
            settings.rate_hz,
            None if camera.exposure_ms is None else camera.exposure_ms * MILLISECOND,
            camera.focus,
            camera.white_balance_k,
        )
        latency = (camera.latency_ms or 0.0) * MILLISECOND
        return UsbCamera(source.place, controls, clock, latency, opener)
    if source.kind is SourceKind.FOLDER:
        return FolderCamera(Path(source.place), settings.rate_hz, clock)
    if source.kind is SourceKind.VIDEO:
        return VideoCamera(Path(source.place), clock)
    raise CameraError(
        sentence("a simulated camera needs a needle to look at; choose a real source here")
    )
