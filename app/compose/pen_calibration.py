"""Calibrating a pen before a real webcam."""

from __future__ import annotations

from collections.abc import Callable, Iterator
from pathlib import Path

from app.compose.live_pen import attached_camera
from app.core.clock import Clock, SystemClock
from app.mechanisms.profile import load_profile
from app.tracking.calibration.pictures import list_pictures
from app.tracking.cameras.camera import CameraFrame
from app.tracking.cameras.files import read_picture
from app.tracking.cameras.source import SourceKind, parse_source
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
    pen, collector = settings.profile(), PoseCollector()
    _collect(settings, collector, seconds, tell, clock)
    return collector.finish(pen)


def measure_shaft(
    settings: PenSettings,
    found: PenCalibration,
    seconds: float,
    tell: Callable[[str], None],
    clock: Clock | None = None,
) -> PenCalibration:
    """Look at the pen being rolled about itself; return the calibration with the shaft measured.

    Args:
        settings: source of these pictures, and pen.
        found: tip, as rocking gave it.
        seconds: at most.
        tell: takes a line now and then.
        clock: for the time.

    Raises:
        PenError: if the pictures do not tell the shaft; says what to do.
        CameraError: if the webcam cannot be used.
    """
    collector = PoseCollector()
    _collect(settings, collector, seconds, tell, clock)
    return collector.finish_rolling(found)


def _collect(
    settings: PenSettings,
    collector: PoseCollector,
    seconds: float,
    tell: Callable[[str], None],
    clock: Clock | None,
) -> None:
    time, said = clock or SystemClock(), ""
    fulcrum = load_profile("icube").pantograph.fulcrum
    step = PenStep(settings.profile(), settings.webcam(), fulcrum)
    for frame in _frames(settings, seconds, time):
        seen = step.look(frame)
        kept = collector.add(seen)
        line = seen.fix.reason or f"{len(collector.poses)} of {WANTED} poses"
        if line != said and (not kept or len(collector.poses) % 10 == 0):
            said = line
            tell(line)
        if len(collector.poses) >= WANTED:
            break
    if step.webcam is not None and step.webcam.guessed:
        tell(step.webcam.words)


def _frames(settings: PenSettings, seconds: float, time: Clock) -> Iterator[CameraFrame]:
    """Pictures of a webcam until the time is over, or all of a folder, once, in their order."""
    source = parse_source(settings.source)
    if source.kind is SourceKind.FOLDER:
        for number, path in enumerate(list_pictures(Path(source.place))):
            yield CameraFrame(read_picture(path), number / settings.rate_hz)
        return
    camera = attached_camera(settings, time)
    camera.open()
    try:
        end = time.now() + seconds
        while time.now() < end:
            yield camera.read()
    finally:
        camera.close()
