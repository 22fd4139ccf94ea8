"""What OpenCV's capture is to a camera here, and setting it up so that nothing regulates itself."""

from __future__ import annotations

import sys
from collections.abc import Callable
from dataclasses import dataclass
from math import isclose, isfinite, log2
from typing import Any, Final, Protocol

import cv2

from app.core.messages import sentence
from app.core.units import MILLISECOND
from app.tracking.errors import CameraError

_LINUX: Final = sys.platform.startswith("linux")
_MANUAL: Final = 1.0 if _LINUX else 0.25
"""`CAP_PROP_AUTO_EXPOSURE` for manual: V4L2_EXPOSURE_MANUAL; elsewhere OpenCV's old scale."""

_SETTLE: Final = 15
"""Pictures in which a camera's own regulation settles before it is held."""


class Capture(Protocol):
    """The part of `cv2.VideoCapture` that is used; tests bring their own."""

    def isOpened(self) -> bool:
        """Return whether there is a camera behind it."""
        ...

    def set(self, prop: int, value: float) -> bool:
        """Set a property; whether the driver knows it."""
        ...

    def get(self, prop: int) -> float:
        """Value of a property; 0 or -1 if unknown."""
        ...

    def grab(self) -> bool:
        """Wait for the next picture."""
        ...

    def retrieve(self) -> tuple[bool, Any]:
        """Decode the picture that was grabbed."""
        ...

    def release(self) -> None:
        """Let go of the camera."""
        ...


Opener = Callable[[str | int], Capture]


def open_capture(node: str | int) -> Capture:
    """Open a camera by its node, or by its number where the system has no nodes."""
    return cv2.VideoCapture(node, cv2.CAP_V4L2 if _LINUX else cv2.CAP_ANY)


@dataclass(frozen=True, slots=True)
class Controls:
    """What a USB camera is asked for; None holds what its own regulation has found.

    Attributes:
        size: width, height [px].
        rate_hz: pictures per second.
        exposure: time [s].
        focus: the driver's number.
        white_balance: colour temperature [K].
    """

    size: tuple[int, int] = (640, 480)
    rate_hz: float = 30.0
    exposure: float | None = None
    focus: float | None = None
    white_balance: float | None = None


@dataclass(frozen=True, slots=True)
class DriverSetting:
    """What became of one thing that was asked of the driver.

    Attributes:
        name: for people.
        wanted: value; None if it was only to be held.
        got: what the driver says it is now.
        accepted: whether it took it.
    """

    name: str
    wanted: float | None
    got: float
    accepted: bool

    @property
    def text(self) -> str:
        """One line for people."""
        if not self.accepted:
            asked = "holding it" if self.wanted is None else f"{self.wanted:g}"
            return sentence(
                "{name}: the driver did not accept {asked} (it is at {got:g})",
                name=self.name,
                asked=asked,
                got=self.got,
            )
        return f"{self.name}: {'held at ' if self.wanted is None else ''}{self.got:g}"


def lock(capture: Capture, controls: Controls) -> tuple[DriverSetting, ...]:
    """Set size, rate and format, then stop exposure, focus and white balance from regulating.

    Raises:
        CameraError: if the pictures have another size than wanted.
    """
    capture.set(cv2.CAP_PROP_FOURCC, cv2.VideoWriter.fourcc(*"MJPG"))  # raw fills a USB 2 bus
    width, height = controls.size
    capture.set(cv2.CAP_PROP_FRAME_WIDTH, width)
    capture.set(cv2.CAP_PROP_FRAME_HEIGHT, height)
    capture.set(cv2.CAP_PROP_FPS, controls.rate_hz)
    capture.set(cv2.CAP_PROP_BUFFERSIZE, 1)  # no old pictures
    given = (
        round(capture.get(cv2.CAP_PROP_FRAME_WIDTH)),
        round(capture.get(cv2.CAP_PROP_FRAME_HEIGHT)),
    )
    if given != (width, height):
        raise CameraError(
            sentence(
                "the camera gives pictures of {given_width}x{given_height} where "
                "{width}x{height} was asked for; set `size` in the camera settings to one that "
                "the camera has and calibrate at it",
                given_width=given[0],
                given_height=given[1],
                width=width,
                height=height,
            )
        )
    if any(v is None for v in (controls.exposure, controls.focus, controls.white_balance)):
        for _ in range(_SETTLE):
            if not capture.grab():
                break
    rate = capture.get(cv2.CAP_PROP_FPS)
    return (
        DriverSetting("rate [Hz]", controls.rate_hz, rate, _near(rate, controls.rate_hz)),
        _exposure(capture, controls.exposure),
        _held(capture, "focus", cv2.CAP_PROP_AUTOFOCUS, cv2.CAP_PROP_FOCUS, controls.focus),
        _held(
            capture,
            "white balance [K]",
            cv2.CAP_PROP_AUTO_WB,
            cv2.CAP_PROP_WB_TEMPERATURE,
            controls.white_balance,
        ),
    )


def _exposure(capture: Capture, wanted: float | None) -> DriverSetting:
    present = capture.get(cv2.CAP_PROP_EXPOSURE)
    manual = bool(capture.set(cv2.CAP_PROP_AUTO_EXPOSURE, _MANUAL))
    value = present if wanted is None else _exposure_number(wanted)
    taken = bool(capture.set(cv2.CAP_PROP_EXPOSURE, value))
    got = capture.get(cv2.CAP_PROP_EXPOSURE)
    accepted = manual and taken and _near(got, value)
    asked = None if wanted is None else wanted / MILLISECOND
    return DriverSetting("exposure [ms]", asked, _exposure_time(got) / MILLISECOND, accepted)


def _held(
    capture: Capture, name: str, automatic: int, prop: int, wanted: float | None
) -> DriverSetting:
    present = capture.get(prop)
    off = bool(capture.set(automatic, 0.0))
    value = present if wanted is None else wanted
    taken = bool(capture.set(prop, value))
    got = capture.get(prop)
    return DriverSetting(name, wanted, got, off and taken and _near(got, value))


def _exposure_number(seconds: float) -> float:
    """V4L2 counts 100 µs; DirectShow takes the power of two of a second."""
    return round(seconds / 1e-4) if _LINUX else round(log2(seconds))


def _exposure_time(number: float) -> float:
    return number * 1e-4 if _LINUX else 2.0 ** min(number, 4.0)


def _near(value: float, wanted: float) -> bool:
    return isfinite(value) and isclose(value, wanted, rel_tol=0.05, abs_tol=0.5)
