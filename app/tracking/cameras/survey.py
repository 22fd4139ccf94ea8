"""Looking at cameras for a moment: what they deliver, how evenly, how bright.

Whether what a source names is there is asked when it is chosen, not only when it is opened;
pictures go to a folder with the marker's outline drawn in.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import Final

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.core.clock import Clock
from app.core.messages import sentence
from app.tracking.cameras.camera import Camera, CameraFrame, Image
from app.tracking.cameras.checked import CheckedCamera
from app.tracking.cameras.files import FolderCamera
from app.tracking.cameras.intake import StreamFigures
from app.tracking.cameras.ports import CameraPort, find_port
from app.tracking.cameras.source import SourceKind, parse_source
from app.tracking.cameras.usb import UsbCamera
from app.tracking.cameras.watch import CameraHealth, CameraReader
from app.tracking.errors import CameraError
from app.tracking.picture_quality import noise_level

_OUTLINE = (80, 220, 80)


def write_pictures(folder: Path, images: Mapping[str, Image]) -> None:
    """Write each picture as `<name>.png`.

    Raises:
        CameraError: if one cannot be written.
    """
    try:
        folder.mkdir(parents=True, exist_ok=True)
        for name, image in images.items():
            if not cv2.imwrite(str(folder / f"{name}.png"), image):
                raise CameraError(sentence("cannot write {folder}.png", folder=folder / name))
    except OSError as error:
        raise CameraError(
            sentence(
                "cannot write into {folder}: {error_strerror}",
                folder=folder,
                error_strerror=error.strerror or error,
            )
        ) from error


def with_outline(image: Image, outline: FloatArray) -> Image:
    """Return a copy with a closed line [px], (m, 2); as it is without points."""
    drawn = image.copy()
    if outline.size:
        points = np.rint(outline).astype(np.int32)
        cv2.polylines(drawn, [points], True, _OUTLINE, 2, cv2.LINE_AA)
    return drawn


def missing(source: str, ports: Sequence[CameraPort]) -> str:
    """Say that what a source names is not there now, and what is; empty if it is.

    Args:
        source: as `parse_source` takes it.
        ports: cameras that are plugged in.

    Raises:
        CameraError: if it has another form.
    """
    origin = parse_source(source)
    if origin.kind is SourceKind.USB:
        try:
            find_port(origin.place, ports)
        except CameraError as error:
            return str(error)
    if origin.kind is SourceKind.FOLDER and not Path(origin.place).is_dir():
        return sentence("there is no folder {origin_place}", origin_place=origin.place)
    if origin.kind is SourceKind.VIDEO and not Path(origin.place).is_file():
        return sentence("there is no video {origin_place}", origin_place=origin.place)
    return ""


SATURATED: Final = 250
"""Grey value from which a pixel counts as overexposed."""

_LOOK: Final = 0.05
_TOO_BRIGHT: Final = 0.05
_TOO_DARK: Final = 30.0
_TOO_NOISY: Final = 4.5


@dataclass(frozen=True, slots=True, eq=False)
class CameraReport:
    """What one camera delivered.

    Attributes:
        name: of it.
        size: width, height [px]; (0, 0) without a picture.
        figures: rate, jitter, refused pictures.
        health: at the end.
        age: median time from capture to delivery [s], by the capture times it gives.
        driver_time: whether those are the driver's; None where that is no question.
        brightness: mean grey value of the newest picture.
        saturated: share of its pixels that are overexposed, 0 to 1.
        noise: standard deviation of its noise as it is delivered [grey values].
        settings: what became of what was asked of the driver, a line each.
        image: newest picture, or None.
        faults: pictures of a folder that cannot be used, a line each.
    """

    name: str
    size: tuple[int, int]
    figures: StreamFigures
    health: CameraHealth
    age: float
    driver_time: bool | None
    brightness: float
    saturated: float
    noise: float
    settings: tuple[str, ...]
    image: Image | None
    faults: tuple[str, ...] = ()

    def advice(self) -> tuple[str, ...]:
        """Say what to do; empty if nothing is wrong."""
        lines = list(self.faults)
        if self.image is None or self.health.message:
            lines += [self.health.text] if self.health.text not in lines else []
        elif self.saturated > _TOO_BRIGHT:
            lines.append(
                sentence(
                    "{saturated:.0%} of the picture is overexposed: lower the exposure",
                    saturated=self.saturated,
                )
            )
        elif self.brightness < _TOO_DARK:
            lines.append(
                sentence(
                    "the picture is dark (mean {brightness:.0f} of 255): more light",
                    brightness=self.brightness,
                )
            )
        elif self.noise > _TOO_NOISY:
            lines.append(
                sentence(
                    "the picture is noisy ({noise:.0f} grey values where it is even): more "
                    "light, so that the camera amplifies less, or a longer exposure",
                    noise=self.noise,
                )
            )
        if self.figures.repeated_share > 0.02:
            lines.append(
                sentence(
                    "{figures_repeated_share:.0%} of the pictures repeat: lower the rate, or "
                    "plug the cameras into ports of different USB controllers",
                    figures_repeated_share=self.figures.repeated_share,
                )
            )
        return tuple(lines)


def survey(
    cameras: Sequence[Camera],
    names: Sequence[str],
    clock: Clock,
    seconds: float,
    on_pictures: Callable[[tuple[CameraFrame, ...]], None] | None = None,
) -> tuple[CameraReport, ...]:
    """Open the cameras together, look at them for a while and close them.

    Args:
        cameras: to look at.
        names: of them.
        clock: for ages.
        seconds: how long.
        on_pictures: gets the newest pictures of all, whenever there are new ones of all.

    Raises:
        CameraError: if one cannot be opened; all are closed then.
    """
    if len(cameras) != len(names):
        raise CameraError(
            sentence(
                "{cameras} cameras have {names} names",
                cameras=len(cameras),
                names=len(names),
            )
        )
    arrived = threading.Condition()
    readers = [
        CameraReader(camera, name, clock, arrived, noise_expected=True)
        for camera, name in zip(cameras, names, strict=True)
    ]
    ages: list[list[float]] = [[] for _ in readers]
    try:
        for reader in readers:
            reader.open()
        _watch(readers, arrived, clock, seconds, ages, on_pictures)
        return tuple(
            _report(reader, camera, clock.now(), age)
            for reader, camera, age in zip(readers, cameras, ages, strict=True)
        )
    finally:
        for reader in readers:
            reader.close()


def _watch(
    readers: Sequence[CameraReader],
    arrived: threading.Condition,
    clock: Clock,
    seconds: float,
    ages: list[list[float]],
    on_pictures: Callable[[tuple[CameraFrame, ...]], None] | None,
) -> None:
    seen: list[CameraFrame | None] = [None] * len(readers)
    told: list[CameraFrame | None] = list(seen)
    end = clock.now() + seconds
    while clock.now() < end:
        with arrived:
            arrived.wait(_LOOK)
        now = clock.now()
        for i, reader in enumerate(readers):
            frame = reader.newest()
            if frame is not None and frame is not seen[i]:
                ages[i].append(now - frame.time)
            seen[i] = frame
        whole = tuple(frame for frame in seen if frame is not None)
        new = all(a is not b for a, b in zip(seen, told, strict=True))
        if on_pictures is not None and new and len(whole) == len(readers):
            on_pictures(whole)
            told = list(seen)


def _report(reader: CameraReader, camera: Camera, now: float, ages: list[float]) -> CameraReport:
    frame, health = reader.newest(), reader.health(now)
    inner = camera.camera if isinstance(camera, CheckedCamera) else camera
    folder = inner if isinstance(inner, FolderCamera) else None
    usb = inner if isinstance(inner, UsbCamera) else None
    image = None if frame is None else frame.image
    return CameraReport(
        reader.name,
        (0, 0) if image is None else (image.shape[1], image.shape[0]),
        health.figures,
        health,
        float(np.median(ages)) if ages else 0.0,
        None if usb is None else usb.driver_time,
        0.0 if image is None else float(image.mean()),
        0.0 if image is None else float((image.max(axis=2) >= SATURATED).mean()),
        0.0 if image is None else noise_level(image),
        () if usb is None else tuple(setting.text for setting in usb.settings),
        image,
        () if folder is None else folder.faults(),
    )
