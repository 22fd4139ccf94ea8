"""A USB camera, named by its port.

One thread alone touches its driver, so that nobody else can hang with it. A picture was captured
when the driver says so where it can be believed, else when it was delivered.
"""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from math import isfinite
from typing import Final

import cv2
import numpy as np

from app.core.clock import Clock, SystemClock
from app.core.messages import sentence
from app.core.units import MILLISECOND
from app.tracking.cameras.camera import Camera, CameraFrame
from app.tracking.cameras.capture import (
    Capture,
    Controls,
    DriverSetting,
    Opener,
    lock,
    open_capture,
)
from app.tracking.cameras.ports import CameraPort, camera_ports, find_port
from app.tracking.errors import CameraError

OLDEST = 1.0
"""A driver's time [s] that lies further back is no time of the clock that is used here."""

AHEAD = 0.002
"""A driver's time may lie this far ahead [s]: clocks are read one after the other."""


class CaptureTime:
    """Makes capture times of one stream.

    V4L2 stamps its buffers with CLOCK_MONOTONIC, the clock of the whole program; OpenCV hands the
    stamp out as `CAP_PROP_POS_MSEC`. Other drivers give zero, a count from the start, or nothing.
    The first stamp that is not plausible ends the trust in all later ones: times of two kinds must
    not alternate.

    Args:
        latency: from capture to delivery [s], taken off the delivery where the driver has no time.
    """

    def __init__(self, latency: float = 0.0) -> None:
        self.latency = latency
        self.trusted = True

    def of(self, driver_ms: float, delivered: float) -> float:
        """Capture time [s] of a picture with the driver's stamp [ms], delivered at a time [s].

        A stamp that repeats or goes back is handed on: such a picture is refused by its time.
        """
        stamp = driver_ms * MILLISECOND
        plausible = isfinite(stamp) and delivered - OLDEST <= stamp <= delivered + AHEAD
        self.trusted = self.trusted and plausible and stamp > 0.0
        return stamp if self.trusted else delivered - self.latency


OPEN_TIME: Final = 5.0
"""Longest time [s] in which a camera opens and delivers its first picture."""

READ_TIME: Final = 0.4
"""Longest time [s] for which a picture is waited."""

_CLOSE_TIME: Final = 0.5
_BROKEN: Final = 10
"""So many broken pictures in a row end the stream."""


class CapturePump:
    """Opens a capture, sets it up, reads it and releases it, all in one thread of its own.

    A driver that hangs keeps this thread only: `close` waits half a second for it and then leaves
    it behind; it lets go of the camera as soon as the driver returns.
    """

    def __init__(
        self, node: str | int, controls: Controls, opener: Opener, clock: Clock, latency: float
    ) -> None:
        self.time = CaptureTime(latency)
        self.settings: tuple[DriverSetting, ...] = ()
        self.broken = 0
        self._node, self._controls, self._opener, self._clock = node, controls, opener, clock
        self._changed = threading.Condition()
        self._frame: CameraFrame | None = None
        self._number = self._taken = 0
        self._error = ""
        self._stopped = False
        self._thread = threading.Thread(target=self._run, name=f"capture {node}", daemon=True)

    def open(self) -> None:
        """Start, and wait for the first picture.

        Raises:
            CameraError: if none comes; says why.
        """
        self._thread.start()
        self._await(OPEN_TIME)

    def read(self) -> CameraFrame:
        """Wait for a picture that was not read yet.

        Raises:
            CameraError: if none comes, or the stream has ended.
        """
        self._await(READ_TIME)
        with self._changed:
            self._taken = self._number
            frame = self._frame
        if frame is None:
            raise CameraError(sentence("the camera is closed"))
        return frame

    def close(self) -> None:
        """End the stream; wakes whoever waits; never waits long."""
        with self._changed:
            self._stopped = True
            self._changed.notify_all()
        if self._thread.is_alive() and self._thread is not threading.current_thread():
            self._thread.join(_CLOSE_TIME)

    @property
    def is_running(self) -> bool:
        """Return whether the driver is still held."""
        return self._thread.is_alive()

    def _await(self, seconds: float) -> None:
        with self._changed:
            self._changed.wait_for(self._is_news, seconds)
            if self._stopped:
                raise CameraError(sentence("the camera was closed"))
            if self._error:
                raise CameraError(self._error)
            if self._number == self._taken:
                raise CameraError(
                    sentence(
                        "no picture for {seconds:g} s; check the camera's cable", seconds=seconds
                    )
                )

    def _is_news(self) -> bool:
        return self._stopped or bool(self._error) or self._number != self._taken

    def _run(self) -> None:
        try:
            capture = self._opener(self._node)
            try:
                if not capture.isOpened():
                    raise CameraError(
                        sentence(
                            "{node} cannot be opened; another program may use it, or the group "
                            "`video` is missing",
                            node=self._node,
                        )
                    )
                self.settings = lock(capture, self._controls)
                while not self._stopped:
                    self._take(capture)
            finally:
                capture.release()
        except CameraError as error:
            self._fail(str(error))
        except Exception as error:  # a driver may raise anything
            self._fail(f"the driver of {self._node} failed: {type(error).__name__}: {error}")

    def _take(self, capture: Capture) -> None:
        if not capture.grab():
            raise CameraError(
                sentence("{node} stopped delivering; was it unplugged?", node=self._node)
            )
        delivered = self._clock.now()
        time = self.time.of(capture.get(cv2.CAP_PROP_POS_MSEC), delivered)
        good, image = capture.retrieve()
        if not good or image is None or image.size == 0:
            self.broken += 1
            if self.broken % _BROKEN == 0:
                raise CameraError(
                    sentence(
                        "{broken} pictures of {node} could not be decoded",
                        broken=_BROKEN,
                        node=self._node,
                    )
                )
            return
        frame = CameraFrame(np.array(image), time)  # of its own: the driver reuses its buffer
        with self._changed:
            self._frame, self._number = frame, self._number + 1
            self._changed.notify_all()

    def _fail(self, message: str) -> None:
        with self._changed:
            self._error = message
            self._changed.notify_all()


class UsbCamera(Camera):
    """A camera at a USB port: the same port is opened again after it was unplugged.

    Args:
        place: port, by-path name, node or number.
        controls: size, rate and what is held.
        clock: monotonic; the driver's stamps are of CLOCK_MONOTONIC as well.
        latency: from capture to delivery [s], where the driver gives no time.
        opener: makes the capture; tests bring their own.
        ports: says what is plugged in.
    """

    def __init__(
        self,
        place: str,
        controls: Controls | None = None,
        clock: Clock | None = None,
        latency: float = 0.0,
        opener: Opener = open_capture,
        ports: Callable[[], Sequence[CameraPort]] = camera_ports,
    ) -> None:
        self.place = place
        self._controls = controls or Controls()
        self._clock = clock or SystemClock()
        self._latency, self._opener, self._ports = latency, opener, ports
        self._pump: CapturePump | None = None

    def open(self) -> None:
        """Open what is plugged in at the port now, and lock it.

        Raises:
            CameraError: if nothing is there, it is busy, or it refuses the size.
        """
        self.close()
        before = self._pump
        if before is not None and before.is_running:
            raise CameraError(
                sentence(
                    "the driver of usb:{place} hangs in its last stream; unplug the camera",
                    place=self.place,
                )
            )
        node = find_port(self.place, self._ports())
        self._pump = pump = CapturePump(
            node, self._controls, self._opener, self._clock, self._latency
        )
        try:
            pump.open()
        except BaseException:
            pump.close()
            raise

    def read(self) -> CameraFrame:
        """Wait for the next picture; never longer than 0.4 s.

        Raises:
            CameraError: if none comes.
        """
        if self._pump is None:
            raise CameraError(
                sentence("camera usb:{place} is not open; call open() first", place=self.place)
            )
        return self._pump.read()

    def close(self) -> None:
        """End the stream, also while it opens in another thread."""
        if self._pump is not None:
            self._pump.close()

    @property
    def settings(self) -> tuple[DriverSetting, ...]:
        """Return what became of rate, exposure, focus and white balance; empty before `open`."""
        return self._pump.settings if self._pump is not None else ()

    @property
    def driver_time(self) -> bool:
        """Return whether capture times are the driver's; False before `open`."""
        return self._pump is not None and self._pump.time.trusted

    @property
    def broken(self) -> int:
        """Pictures that could not be decoded since `open`."""
        return self._pump.broken if self._pump is not None else 0
