"""Calibrating a pen before a real webcam."""

from __future__ import annotations

from collections.abc import Callable

from app.compose.pen import attached_camera
from app.core.clock import Clock, SystemClock
from app.mechanisms.profile import load_profile
from app.tracking.errors import PenError
from app.tracking.pen.calibrating import WANTED, PenCalibration, PoseCollector
from app.tracking.pen.settings import PenSettings
from app.tracking.pen.step import PenStep


def calibrate_pen(
    settings: PenSettings,
    seconds: float,
    tell: Callable[[str], None],
    clock: Clock | None = None,
) -> PenCalibration:
    """Look at the pen until its tip is known, or the time is over.

    Args:
        settings: webcam and pen.
        seconds: at most.
        tell: takes a line now and then: how far it is, or why a picture is of no use.
        clock: for the time.

    Raises:
        PenError: if the pictures do not tell the tip; says what to do.
        CameraError: if the webcam cannot be used.
    """
    if settings.simulated:
        raise PenError("a simulated pen has no tip to measure; give --source usb:0")
    time = clock or SystemClock()
    camera = attached_camera(settings, time)
    pen = settings.profile()
    step = PenStep(pen, settings.webcam(), load_profile("icube").pantograph.fulcrum)
    collector, said = PoseCollector(), ""
    camera.open()
    try:
        end = time.now() + seconds
        while time.now() < end and len(collector.poses) < WANTED:
            seen = step.look(camera.read())
            kept = collector.add(seen)
            line = seen.fix.reason or f"{len(collector.poses)} of {WANTED} poses"
            if line != said and (not kept or len(collector.poses) % 10 == 0):
                said = line
                tell(line)
    finally:
        camera.close()
    if step.webcam is not None and step.webcam.guessed:
        tell(step.webcam.words)
    return collector.finish(pen)
