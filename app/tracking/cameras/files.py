"""Pictures from a folder or a video file, as a camera would deliver them."""

from __future__ import annotations

from math import floor, isfinite
from pathlib import Path
from typing import Final

import cv2
import numpy as np

from app.core.clock import Clock, SystemClock
from app.core.messages import sentence
from app.core.units import MILLISECOND
from app.tracking.cameras.camera import Camera, CameraFrame, Image
from app.tracking.errors import CameraError, TrackingError
from app.tracking.picture_file import check_size, no_folder, read_pixels

ENDINGS: Final = frozenset({".png", ".jpg", ".jpeg", ".bmp", ".tif", ".tiff", ".webp"})


class FolderCamera(Camera):
    """The pictures of a folder in the order of their names.

    Picture k is due at k / rate_hz of the clock itself, so that two folders stay in step. Who reads
    too slowly misses pictures. A file that is no picture is an error, and the next one follows.

    Args:
        folder: of the pictures.
        rate_hz: pictures per second.
        clock: for the pace.
        loops: whether it begins anew; else the end is an error, and the first picture the first.
    """

    may_repeat = True

    def __init__(
        self, folder: Path, rate_hz: float = 30.0, clock: Clock | None = None, loops: bool = True
    ) -> None:
        self.folder, self._rate, self._loops = folder, rate_hz, loops
        self._clock = clock or SystemClock()
        self._files: list[Path] = []
        self._first = self._last = 0

    def open(self) -> None:
        """List the folder.

        Raises:
            CameraError: if there is no picture in it.
        """
        self._files = pictures_in(self.folder)
        self._last = self._due()
        self._first = 0 if self._loops else self._last + 1

    def read(self) -> CameraFrame:
        """Wait until the next picture is due.

        Raises:
            CameraError: if it cannot be read, or all have been.
        """
        if not self._files:
            raise CameraError(
                sentence("folder {folder} is not open; call open() first", folder=self.folder)
            )
        number = max(self._last + 1, self._due()) if self._loops else self._last + 1
        if not self._loops and number - self._first >= len(self._files):
            raise CameraError(
                sentence(
                    "the {pictures} pictures of {folder} are over",
                    pictures=len(self._files),
                    folder=self.folder,
                )
            )
        time = number / self._rate
        self._clock.sleep_until(time)
        self._last = number
        return CameraFrame(
            read_picture(self._files[(number - self._first) % len(self._files)]), time
        )

    def close(self) -> None:
        """Forget the folder."""
        self._files = []

    def faults(self, most: int = 500) -> tuple[str, ...]:
        """Look at the pictures one by one, whatever the pace; say what is wrong, a line each.

        Args:
            most: so many are looked at; that there are more is said too.

        Raises:
            CameraError: if the folder cannot be listed.
        """
        files = pictures_in(self.folder)
        found, sizes = [], dict[tuple[int, int], Path]()
        for path in files[:most]:
            try:
                height, width = read_picture(path).shape[:2]
            except CameraError as error:
                found.append(str(error))
            else:
                sizes.setdefault((width, height), path)
        if len(sizes) > 1:
            each = ", ".join(f"{w}x{h} ({path.name} …)" for (w, h), path in sizes.items())
            found.append(
                sentence(
                    "the pictures of {folder} are of different sizes: {each}",
                    folder=self.folder,
                    each=each,
                )
            )
        if len(files) > most:
            found.append(
                sentence(
                    "only the first {most} of {pictures} pictures were looked at",
                    most=most,
                    pictures=len(files),
                )
            )
        return tuple(found)

    def _due(self) -> int:
        return floor(self._clock.now() * self._rate + 1e-6)


def pictures_in(folder: Path) -> list[Path]:
    """Return the files of a folder that should be pictures, by name.

    Raises:
        CameraError: if there is none, or no such folder.
    """
    if not folder.is_dir():
        raise CameraError(
            sentence("{no_folder}; folder:PATH names a folder", no_folder=no_folder(folder))
        )
    files = sorted(path for path in folder.iterdir() if path.suffix.lower() in ENDINGS)
    if not files:
        raise CameraError(
            sentence(
                "no picture in {folder}; files that end in {endings} count",
                folder=folder,
                endings=", ".join(sorted(ENDINGS)),
            )
        )
    return files


def read_picture(path: Path) -> Image:
    """Read a picture in colour, its pixels as they are stored.

    Raises:
        CameraError: if the file is none, is cut off or has too many pixels; names it.
    """
    try:
        return read_pixels(path)
    except OSError as error:
        raise CameraError(
            sentence(
                "cannot read {path}: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error
    except TrackingError as error:
        raise CameraError(sentence("{path} {error}", path=path, error=error)) from error


class VideoCamera(Camera):
    """A video file at its own pace, with the times of its own pictures.

    Args:
        path: of the file.
        clock: for the pace.
        loops: whether it begins anew; else its end is an error.
    """

    may_repeat = True

    def __init__(self, path: Path, clock: Clock | None = None, loops: bool = True) -> None:
        self.path, self._loops = path, loops
        self._clock = clock or SystemClock()
        self._capture: cv2.VideoCapture | None = None
        self._start = 0.0
        self._newest = 0.0  # of the file's times [s]
        self._period = 1.0 / 30.0

    def open(self) -> None:
        """Open the file; its first picture is due now.

        Raises:
            CameraError: if it is not there, is no video, or its pictures have too many pixels.
        """
        self.close()
        if not self.path.is_file():
            raise CameraError(
                sentence("there is no video {path}; video:PATH names a file", path=self.path)
            )
        capture = cv2.VideoCapture(str(self.path))
        if not capture.isOpened():
            raise CameraError(sentence("{path} is no video that can be read", path=self.path))
        try:
            sides = cv2.CAP_PROP_FRAME_WIDTH, cv2.CAP_PROP_FRAME_HEIGHT
            check_size(*(int(capture.get(side)) for side in sides))
        except TrackingError as error:
            capture.release()
            raise CameraError(sentence("{path} {error}", path=self.path, error=error)) from error
        capture.set(cv2.CAP_PROP_ORIENTATION_AUTO, 0.0)  # as stored; see `picture_file`
        rate = capture.get(cv2.CAP_PROP_FPS)
        self._period = 1.0 / rate if isfinite(rate) and rate > 0.0 else 1.0 / 30.0
        self._capture, self._start = capture, self._clock.now()
        self._newest = -self._period

    def read(self) -> CameraFrame:
        """Wait until the next picture is due; pictures that are long due are left out.

        Raises:
            CameraError: at the end, if it does not loop.
        """
        capture = self._capture
        if capture is None:
            raise CameraError(
                sentence("video {path} is not open; call open() first", path=self.path)
            )
        time = self._grab(capture)
        while time is not None and time + self._period < self._clock.now() - self._start:
            time = self._grab(capture)
        if time is None:
            return self._again()
        good, image = capture.retrieve()
        if not good or image is None:
            raise CameraError(sentence("a picture of {path} is damaged", path=self.path))
        due = self._start + time
        self._clock.sleep_until(due)
        return CameraFrame(np.array(image), due)

    def close(self) -> None:
        """Close the file."""
        capture, self._capture = self._capture, None
        if capture is not None:
            capture.release()

    def _grab(self, capture: cv2.VideoCapture) -> float | None:
        """Time [s] of the next picture in the file, or None at its end."""
        if not capture.grab():
            return None
        stamp = capture.get(cv2.CAP_PROP_POS_MSEC) * MILLISECOND
        if not isfinite(stamp) or stamp <= self._newest:
            stamp = self._newest + self._period  # a file without times
        self._newest = stamp
        return stamp

    def _again(self) -> CameraFrame:
        if not self._loops or self._newest < 0.0:
            self.close()
            raise CameraError(sentence("the video {path} is over", path=self.path))
        due = self._start + self._newest + self._period
        self.open()
        self._start = max(self._start, due)
        return self.read()
