"""Both cameras of the rig, opened and let go beside the window."""

from __future__ import annotations

import threading
from collections.abc import Callable, Sequence
from typing import Protocol

from app.core.progress import Progress
from app.tracking.calibration.capture import Newest


class OpenCamera(Newest, Protocol):
    """A camera that is open and must be closed."""

    def close(self) -> None:
        """Let go of it; idempotent; may wait for threads."""
        ...


OpenPair = Callable[[Progress], Sequence[OpenCamera]]
"""Opens both cameras, left and right, or none; called beside the window."""


def open_both(item: Callable[[str, Progress], OpenCamera], sides: Sequence[str]) -> OpenPair:
    """Return what opens one side after the other; if one fails, those that are open are closed.

    Args:
        item: opens the camera of a side.
        sides: left, right.
    """

    def open_pair(progress: Progress) -> Sequence[OpenCamera]:
        cameras: list[OpenCamera] = []
        try:
            for side in sides:
                cameras.append(item(side, progress))
        except BaseException:
            close_all(cameras)
            raise
        return cameras

    return open_pair


def close_all(cameras: Sequence[OpenCamera]) -> None:
    """Close all, also if one fails."""
    failure: Exception | None = None
    for camera in cameras:
        try:
            camera.close()
        except Exception as error:  # the others must be closed first
            failure = error
    if failure is not None:
        raise failure


class PairOpening:
    """Cameras that are being opened, or are open; who no longer wants them need not wait."""

    def __init__(self, open_pair: OpenPair, before: PairOpening | None = None) -> None:
        self._open, self._before = open_pair, before
        self._lock = threading.Lock()
        self._stopped = False
        self._cameras: Sequence[OpenCamera] | None = None
        self.ended = threading.Event()

    def run(self, progress: Progress) -> Sequence[OpenCamera]:
        """Open them, in another thread; waits until those opened before are let go."""
        try:
            if self._before is not None:
                self._before.ended.wait(8.0)  # one port is opened once
            cameras = self._open(progress)
        except BaseException:
            self.ended.set()
            raise
        with self._lock:
            self._cameras, stopped = cameras, self._stopped
        if stopped:
            self._close(cameras)
        return cameras

    def stop(self) -> None:
        """Close them, now or as soon as they are open; `ended` says when. Idempotent."""
        with self._lock:
            stopped, self._stopped, cameras = self._stopped, True, self._cameras
        if cameras is not None and not stopped:
            threading.Thread(target=self._close, args=(cameras,), daemon=True).start()

    def _close(self, cameras: Sequence[OpenCamera]) -> None:
        try:
            close_all(cameras)
        finally:
            self.ended.set()
