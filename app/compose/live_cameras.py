"""One camera for the window's dialogs: its newest picture, its health, every picture's light."""

from __future__ import annotations

import threading
from collections import deque
from typing import Final

import numpy as np

from app.compose.cameras import checked_cameras
from app.core.arrays import FloatArray
from app.core.clock import Clock, SystemClock
from app.core.messages import listed, sentence
from app.tracking.cameras.camera import Camera, CameraFrame
from app.tracking.cameras.latency import grid_means
from app.tracking.cameras.settings import SIDES, CameraSettings
from app.tracking.cameras.usb import UsbCamera
from app.tracking.cameras.watch import CameraHealth, CameraReader
from app.tracking.errors import CameraError

_KEPT: Final = 20_000
"""Pictures of which the light is kept: more than the longest test of latency takes."""


class LiveReader:
    """A camera that is read in a thread of its own (`views.cameras.live.LiveCamera`).

    Args:
        camera: to read.
        name: of it.
        clock: of capture and delivery.
    """

    def __init__(self, camera: Camera, name: str, clock: Clock) -> None:
        self._camera, self._clock = camera, clock
        self._light: deque[tuple[float, FloatArray]] | None = None
        arrived = threading.Condition()
        self._reader = CameraReader(camera, name, clock, arrived, True, self._keep)

    def open(self) -> None:
        """Open the camera.

        Raises:
            CameraError: if it cannot be opened.
        """
        self._reader.open()

    def close(self) -> None:
        """Let go of the camera; idempotent."""
        self._reader.close()

    def newest(self) -> CameraFrame | None:
        """Return the newest picture, or None before the first."""
        return self._reader.newest()

    def health(self) -> CameraHealth:
        """Return how the camera does now."""
        return self._reader.health(self._clock.now())

    def settings(self) -> tuple[str, ...]:
        """Return what became of what was asked of the driver, a line each."""
        return driver_settings(self._camera)

    def measure_light(self, wanted: bool) -> None:
        """Begin to keep the light of every picture, from none, or stop."""
        self._light = deque(maxlen=_KEPT) if wanted else None

    def light(self) -> tuple[FloatArray, FloatArray]:
        """Return times of delivery [s], (m,), and the light of the tiles, (m, tiles)."""
        kept = list(self._light.copy()) if self._light is not None else []
        times = np.array([time for time, _ in kept])
        return times, np.array([tiles for _, tiles in kept])

    def _keep(self, frame: CameraFrame, delivered: float) -> None:
        light = self._light
        if light is not None:
            light.append((delivered, grid_means(frame.image)))


def driver_settings(camera: Camera) -> tuple[str, ...]:
    """Return what became of what was asked of a camera's driver, a line each."""
    inner = getattr(camera, "camera", camera)
    if not isinstance(inner, UsbCamera):
        return ()
    return tuple(setting.text for setting in inner.settings)


def open_live(settings: CameraSettings, side: str) -> LiveReader:
    """Open the camera of a side.

    Raises:
        CameraError: if it is simulated, cannot be opened or has another size than the settings.
    """
    if side not in SIDES:
        raise CameraError(
            sentence(
                "there is no {side!r} camera; there are {sides}",
                side=side,
                sides=listed(SIDES),
            )
        )
    clock, index = SystemClock(), SIDES.index(side)
    camera = checked_cameras(settings, clock, "the camera settings", (index,))[0]
    live = LiveReader(camera, side, clock)
    live.open()
    return live
