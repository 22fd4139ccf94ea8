"""Noticing that a camera has stopped, repeats itself or has failed."""

import threading
from dataclasses import dataclass
from enum import StrEnum

import numpy as np

from app.core.clock import Clock
from app.tracking.cameras.camera import Camera, Frame
from app.tracking.errors import CameraError

STALL = 0.4
"""Time [s] without a new picture after which a camera counts as stopped."""

_PAUSE = 0.2
_STRIDE = 16


class CameraState(StrEnum):
    """How a camera is."""

    WAITING = "waiting"  # no picture yet
    LIVE = "live"
    STALLED = "stalled"  # no picture for `STALL` seconds
    FROZEN = "frozen"  # pictures, but always the same
    FAILED = "failed"  # an error; it is tried again


@dataclass(frozen=True, slots=True)
class CameraHealth:
    """State of one camera, its newest picture's age [s], and the message of its last error."""

    name: str
    state: CameraState
    age: float
    message: str = ""

    @property
    def text(self) -> str:
        """One line for people about what is wrong."""
        if self.message:
            return self.message
        if self.state is CameraState.FROZEN:
            return "the picture does not change any more; plug the camera in again"
        return f"no picture for {self.age:.1f} s; check its cable"


class CameraReader:
    """Reads one camera in its own thread and keeps the newest picture.

    A camera that hangs or fails so neither stops the other one nor the tracker; it is read again
    after a pause. `noise_expected` says that two pictures are never the same to the last bit, so
    that a repetition means a frozen driver.
    """

    def __init__(
        self,
        camera: Camera,
        name: str,
        clock: Clock,
        arrived: threading.Condition,
        noise_expected: bool,
    ) -> None:
        self.name = name
        self.lost = 0
        self._camera = camera
        self._clock = clock
        self._arrived = arrived
        self._noise_expected = noise_expected
        self._thread: threading.Thread | None = None
        self._stop = threading.Event()
        self._frame: Frame | None = None
        self._changed = 0.0  # when a picture differed last
        self._received = 0.0
        self._error = ""

    def open(self) -> None:
        """Open the camera and start reading.

        Raises:
            CameraError: if the camera cannot be opened.
        """
        self._camera.open()
        self._stop.clear()
        self._received = self._changed = self._clock.now()
        self._thread = threading.Thread(target=self._run, name=f"camera {self.name}", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Stop reading and close the camera; closing twice is fine."""
        self._stop.set()
        thread, self._thread = self._thread, None
        if thread is not None:
            thread.join(timeout=1.0)
        self._camera.close()

    def newest(self) -> Frame | None:
        """Newest picture, or None before the first."""
        return self._frame

    def health(self, now: float) -> CameraHealth:
        """State at `now` [s]; needs no cooperation of the camera, so a hanging one is noticed."""
        age = now - (self._frame.time if self._frame is not None else self._received)
        return CameraHealth(self.name, self._state(now), max(0.0, age), self._error)

    def _state(self, now: float) -> CameraState:
        if self._error:
            return CameraState.FAILED
        if now - self._received > STALL:
            return CameraState.STALLED
        if self._frame is None:
            return CameraState.WAITING
        frozen = self._noise_expected and now - self._changed > STALL
        return CameraState.FROZEN if frozen else CameraState.LIVE

    def _run(self) -> None:
        while not self._stop.is_set():
            try:
                self._take(self._camera.read())
                self._error = ""
            except CameraError as error:
                self._fail(str(error))
            except Exception as error:  # a driver may raise anything
                self._fail(f"{type(error).__name__}: {error}")

    def _take(self, frame: Frame) -> None:
        now = self._clock.now()
        self._received = now
        if self._frame is None or not _same(frame, self._frame):
            self._changed = now
        with self._arrived:
            self._frame = frame
            self._arrived.notify_all()

    def _fail(self, message: str) -> None:
        self._error = message
        self.lost += 1
        with self._arrived:
            self._arrived.notify_all()
        self._stop.wait(_PAUSE)


def _same(frame: Frame, other: Frame) -> bool:
    """Whether two pictures agree to the last bit on a grid of their pixels."""
    return np.array_equal(frame.image[::_STRIDE, ::_STRIDE], other.image[::_STRIDE, ::_STRIDE])
