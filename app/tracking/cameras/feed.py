"""Pictures of both cameras, paired as they come, and events about their health.

Keeps pictures whose capture time runs backwards away from the tracks.
"""

import threading
from collections import deque
from collections.abc import Callable, Sequence
from dataclasses import dataclass, replace
from math import isfinite
from typing import Final

import numpy as np

from app.core.clock import Clock
from app.core.messages import sentence
from app.core.paced_clock import PacedClock
from app.tracking.cameras.camera import Camera, CameraFrame
from app.tracking.cameras.watch import STALL, CameraHealth, CameraReader, CameraState
from app.tracking.fix import FixStatus, NeedleFix

PATIENCE: Final = 15
"""So many pictures in a row with an earlier time are a clock that was set back: it is followed."""


class CaptureTimes:
    """Refuses pictures that claim to be older than the last one of their camera.

    Args:
        names: of the cameras.
        report: takes (kind, message) when a camera's times run backwards.
    """

    def __init__(self, names: Sequence[str], report: Callable[[str, str], None]) -> None:
        self._names = names
        self._report = report
        self._last: list[float | None] = [None] * len(names)
        self._refused = [0] * len(names)

    def sound(
        self, frames: tuple[CameraFrame | None, CameraFrame | None]
    ) -> tuple[CameraFrame | None, CameraFrame | None]:
        """Return the frames without those that cannot be put in order."""
        first, second = (self._sound(i, frame) for i, frame in enumerate(frames))
        return first, second

    @property
    def newest(self) -> float:
        """Newest time of any picture that was taken [s]; 0 before the first."""
        return max((last for last in self._last if last is not None), default=0.0)

    def _sound(self, i: int, frame: CameraFrame | None) -> CameraFrame | None:
        if frame is None:
            return None
        last = self._last[i]
        if isfinite(frame.time) and (last is None or frame.time >= last):
            self._last[i], self._refused[i] = frame.time, 0
            return frame
        self._refused[i] += 1
        if self._refused[i] == 1:
            self._report(
                "camera",
                f"camera {self._names[i]}: a picture's capture time {frame.time:.3f} s lies "
                "before the last one's; it is left out",
            )
        if isfinite(frame.time) and self._refused[i] >= PATIENCE:
            self._last[i], self._refused[i] = frame.time, 0
            return frame
        return None


def without_picture(
    fix: NeedleFix, frames: tuple[CameraFrame | None, CameraFrame | None], names: Sequence[str]
) -> NeedleFix:
    """Return a fix that says which camera gave no picture, if one did not."""
    absent = [name for name, frame in zip(names, frames, strict=True) if frame is None]
    if not absent:
        return fix
    reason = sentence("no picture from the {side} camera", side=absent[0])
    if fix.usable:
        return replace(fix, reason=f"{reason}: depth by the other one and the needle's line")
    return replace(fix, status=FixStatus.NO_PICTURE, reason=reason)


_WAIT = 0.05
"""Longest wait [s] for a picture before the cameras' health is looked at."""

_PAIRING = 0.15
"""Time [s] that the faster camera waits for the other before it goes on alone: a picture that is
late beside a busy window is not a marker out of view, and 0.2 s are bridged anyway."""

_TROUBLE = frozenset({CameraState.STALLED, CameraState.FROZEN, CameraState.FAILED})

_SKEWS = 60
"""Pairs over which the skew is taken: two seconds at 30 Hz."""

Pair = tuple[CameraFrame | None, CameraFrame | None]
"""New pictures of both cameras; None where a camera has none."""


@dataclass(frozen=True, slots=True)
class Skew:
    """How far apart two cameras capture: median and standard deviation of (right - left) [s].

    It is that of pictures which arrived together; free running cameras drift through it.
    """

    median: float
    sd: float


class CameraFeed:
    """Two cameras, each read in its own thread.

    Args:
        cameras: two.
        names: of them.
        clock: for ages.
        noise_expected: whether a picture that repeats to the last bit means a frozen driver.
        report: takes (kind, message) when a camera stops, freezes, fails or recovers.
    """

    def __init__(
        self,
        cameras: Sequence[Camera],
        names: Sequence[str],
        clock: Clock,
        noise_expected: bool,
        report: Callable[[str, str], None],
    ) -> None:
        self._arrived = threading.Condition()
        self._clock = clock
        self._report = report
        self._readers = tuple(
            CameraReader(camera, name, clock, self._arrived, noise_expected)
            for camera, name in zip(cameras, names, strict=True)
        )
        self._states = [CameraState.WAITING, CameraState.WAITING]
        self._seen: list[CameraFrame | None] = [None, None]
        self._stopped = False
        self._apart: deque[float] = deque(maxlen=_SKEWS)

    def open(self) -> None:
        """Open both cameras.

        Raises:
            CameraError: if one cannot be opened; the other is closed again.
        """
        self._stopped = False
        self._seen = [None, None]
        try:
            for reader in self._readers:
                reader.open()
        except Exception:
            self.close()
            raise

    def close(self) -> None:
        """Close both cameras and wake who waits; closing twice is fine."""
        with self._arrived:
            self._stopped = True
            self._arrived.notify_all()
        for reader in self._readers:
            reader.close()

    def wait(self) -> Pair:
        """Wait for new pictures: for one at most 0.05 s, then for the other a little longer.

        Nobody waits for a camera that is known to have stopped: the other alone is to be followed
        at its own rate.
        """
        with self._arrived:
            self._arrived.wait_for(lambda: self._stopped or any(self._fresh()), _WAIT)
            if any(self._fresh()):
                self._await(lambda: self._stopped or self._complete(), self._patience())
            fresh = self._fresh()
            frames = [reader.newest() for reader in self._readers]
        self._watch()
        usable: list[CameraFrame | None] = [None, None]
        for i in range(2):
            if fresh[i]:
                self._seen[i] = frames[i]
                usable[i] = None if self._states[i] is CameraState.FROZEN else frames[i]
        if usable[0] is not None and usable[1] is not None:
            self._apart.append(usable[1].time - usable[0].time)
        return usable[0], usable[1]

    def health(self, now: float) -> tuple[CameraHealth, ...]:
        """Health of both cameras at `now` [s], also of one that hangs."""
        return tuple(reader.health(now) for reader in self._readers)

    def skew(self) -> Skew | None:
        """Return how far apart the last pairs were captured; None before there was one."""
        apart = np.array(self._apart.copy())
        return Skew(float(np.median(apart)), float(apart.std())) if apart.size else None

    def _await(self, predicate: Callable[[], bool], duration: float) -> None:
        """Wait for at most `duration` [s] of the clock that the cameras run by."""
        if isinstance(self._clock, PacedClock):
            self._clock.wait_for(self._arrived, predicate, duration)
        else:
            self._arrived.wait_for(predicate, duration)

    def _fresh(self) -> list[bool]:
        newest = [reader.newest() for reader in self._readers]
        return [n is not None and n is not s for n, s in zip(newest, self._seen, strict=True)]

    def _patience(self) -> float:
        """Return how long [s] the other camera is waited for: not past the moment when it has
        stopped.
        """
        now = self._clock.now()
        pairs = zip(self._readers, self._fresh(), strict=True)
        age = max((reader.health(now).age for reader, fresh in pairs if not fresh), default=0.0)
        return min(_PAIRING, max(0.0, STALL - age))

    def _complete(self) -> bool:
        pairs = zip(self._fresh(), self._states, strict=True)
        return all(fresh or state in _TROUBLE for fresh, state in pairs)

    def _watch(self) -> None:
        for i, health in enumerate(self.health(self._clock.now())):
            before, self._states[i] = self._states[i], health.state
            if health.state is before:
                continue
            if health.state in _TROUBLE:
                self._report("camera", health.named)
            elif before in _TROUBLE:
                self._report("camera", f"camera {health.name} delivers pictures again")
