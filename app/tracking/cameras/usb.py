"""A USB camera, named by its port."""

from __future__ import annotations

from collections.abc import Callable, Sequence

from app.core.clock import Clock, SystemClock
from app.tracking.cameras.camera import Camera, Frame
from app.tracking.cameras.capture import Controls, Opener, Setting, open_capture
from app.tracking.cameras.ports import CameraPort, camera_ports, find_port
from app.tracking.cameras.pump import CapturePump
from app.tracking.errors import CameraError


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
                f"the driver of usb:{self.place} hangs in its last stream; unplug the camera"
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

    def read(self) -> Frame:
        """Wait for the next picture; never longer than 0.4 s.

        Raises:
            CameraError: if none comes.
        """
        if self._pump is None:
            raise CameraError(f"camera usb:{self.place} is not open; call open() first")
        return self._pump.read()

    def close(self) -> None:
        """End the stream, also while it opens in another thread."""
        if self._pump is not None:
            self._pump.close()

    @property
    def settings(self) -> tuple[Setting, ...]:
        """What became of rate, exposure, focus and white balance; empty before `open`."""
        return self._pump.settings if self._pump is not None else ()

    @property
    def driver_time(self) -> bool:
        """Whether capture times are the driver's; False before `open`."""
        return self._pump is not None and self._pump.time.trusted

    @property
    def broken(self) -> int:
        """Pictures that could not be decoded since `open`."""
        return self._pump.broken if self._pump is not None else 0
