"""Looks for the board in pictures beside the window: of live cameras, or of a folder."""

from __future__ import annotations

import threading
import time
from collections.abc import Iterator, Sequence
from dataclasses import dataclass
from pathlib import Path
from typing import TYPE_CHECKING, Any, Protocol

from numpy.typing import NDArray

from app.core.errors import AcusError
from app.tracking.calibration.collector import Offer, ViewCollector
from app.tracking.calibration.pairing import pair_folder
from app.tracking.calibration.views import BoardView, Rejection, RejectionReason
from app.tracking.cameras.files import read_picture

if TYPE_CHECKING:
    from app.tracking.cameras.camera import CameraFrame

_APART = 0.1
"""Pictures of two cameras further apart than this [s] are not of one moment."""

Picture = NDArray[Any]


class Newest(Protocol):
    """A camera that is open (`views.cameras.live.LiveCamera` is one)."""

    def newest(self) -> CameraFrame | None:
        """Return the newest picture, or None before the first."""
        ...


@dataclass(frozen=True, slots=True, eq=False)
class BoardShot:
    """Pictures of one moment.

    Attributes:
        images: of each camera, or None.
        names: of the pictures.
        unreadable: why a picture could not be read.
    """

    images: tuple[Picture | None, ...]
    names: tuple[str, ...]
    unreadable: tuple[Rejection, ...] = ()


class LiveShots:
    """New pictures of open cameras; waits a little where there are none.

    Args:
        cameras: open ones.
        names: of them.
        end: monotonic time [s] after which no more are waited for.
    """

    def __init__(
        self, cameras: Sequence[Newest], names: Sequence[str], end: float = float("inf")
    ) -> None:
        self._cameras, self._names, self._end = cameras, tuple(names), end
        self._seen: tuple[CameraFrame | None, ...] = tuple(None for _ in cameras)
        self._count = 0

    def shots(self, stop: threading.Event) -> Iterator[BoardShot]:
        """Yield pictures until `stop` is set; those of all cameras are of about one moment."""
        while not stop.is_set() and time.monotonic() < self._end:
            frames = tuple(camera.newest() for camera in self._cameras)
            fresh = [f is not None and f is not s for f, s in zip(frames, self._seen, strict=True)]
            if not all(fresh) or not _together(frames):
                stop.wait(0.01)
                continue
            self._seen, self._count = frames, self._count + 1
            images = tuple(frame.image if frame is not None else None for frame in frames)
            yield BoardShot(images, tuple(f"{name} {self._count:04}" for name in self._names))


class FolderShots:
    """Pairs of pictures of a folder in the order of their names; then those without a partner.

    Attributes:
        paired: what the folder holds.
        count: how many shots that makes.

    Raises:
        CalibrationError: if the names do not pair, or there are no pictures.
    """

    def __init__(self, folder: Path) -> None:
        self.paired = pair_folder(folder)
        self.count = len(self.paired.pairs) + sum(map(len, self.paired.alone))

    def shots(self, stop: threading.Event) -> Iterator[BoardShot]:
        """Yield all pairs, then what serves one camera alone, until `stop` is set."""
        lefts, rights = self.paired.alone
        together: list[tuple[Path | None, Path | None]] = [
            *((pair.left, pair.right) for pair in self.paired.pairs),
            *((path, None) for path in lefts),
            *((None, path) for path in rights),
        ]
        for both in together:
            if stop.is_set():
                return
            images: list[Picture | None] = []
            unreadable = []
            for path in both:
                if path is None:
                    images.append(None)
                    continue
                try:
                    images.append(read_picture(path))
                except AcusError as error:
                    images.append(None)
                    unreadable.append(Rejection(RejectionReason.UNREADABLE, str(error), path.name))
            names = tuple(path.name if path is not None else "" for path in both)
            yield BoardShot(tuple(images), names, tuple(unreadable))


class Shots(Protocol):
    """Where pictures come from."""

    def shots(self, stop: threading.Event) -> Iterator[BoardShot]:
        """Yield pictures until there are no more, or `stop` is set."""
        ...


class Search:
    """Searches shots for the board in a thread of its own; the window looks at what it found.

    Args:
        shots: pictures.
        collector: says which are kept.
    """

    def __init__(self, shots: Shots, collector: ViewCollector) -> None:
        self.collector = collector
        self._shots, self._stop = shots, threading.Event()
        self._newest: tuple[BoardShot, Offer] | None = None
        self._views: list[tuple[BoardView | None, ...]] = []
        self._refused: list[Rejection] = []
        self._thread = threading.Thread(target=self._run, name="acus board search", daemon=True)
        self.done = threading.Event()
        self.error: Exception | None = None
        self.count = 0

    def open(self) -> Search:
        """Start."""
        self._thread.start()
        return self

    def close(self, timeout: float = 3.0) -> None:
        """Stop after the picture that is looked at now; idempotent."""
        self._stop.set()
        if self._thread.is_alive():
            self._thread.join(timeout)

    @property
    def newest(self) -> tuple[BoardShot, Offer] | None:
        """Newest pictures and what was found in them."""
        return self._newest

    @property
    def views(self) -> tuple[tuple[BoardView | None, ...], ...]:
        """Everything found, whether the collector kept it or not."""
        return tuple(self._views)

    @property
    def refused(self) -> tuple[Rejection, ...]:
        """Pictures of no use."""
        return tuple(self._refused)

    def _run(self) -> None:
        try:
            for shot in self._shots.shots(self._stop):
                offer = self.collector.offer(shot.images, shot.names)
                self._note(shot, offer)
        except Exception as error:  # shown by the window
            self.error = error
        finally:
            self.done.set()

    def _note(self, shot: BoardShot, offer: Offer) -> None:
        self.count += 1
        found = tuple(view if isinstance(view, BoardView) else None for view in offer.seen)
        if any(found):
            self._views.append(found)
            del self._views[:-500]  # live pictures go on and on; only a folder's are used
        self._refused += [view for view in offer.seen if isinstance(view, Rejection)]
        self._refused += shot.unreadable
        del self._refused[:-500]
        self._newest = (shot, offer)


def _together(frames: Sequence[CameraFrame | None]) -> bool:
    times = [frame.time for frame in frames if frame is not None]
    return max(times) - min(times) <= _APART
