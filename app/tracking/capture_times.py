"""Keeps pictures whose capture time runs backwards away from the tracks."""

from collections.abc import Callable, Sequence
from dataclasses import replace
from math import isfinite
from typing import Final

from app.tracking.cameras.camera import Frame
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

    def sound(self, frames: tuple[Frame | None, Frame | None]) -> tuple[Frame | None, Frame | None]:
        """Return the frames without those that cannot be put in order."""
        first, second = (self._sound(i, frame) for i, frame in enumerate(frames))
        return first, second

    @property
    def newest(self) -> float:
        """Newest time of any picture that was taken [s]; 0 before the first."""
        return max((last for last in self._last if last is not None), default=0.0)

    def _sound(self, i: int, frame: Frame | None) -> Frame | None:
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
    fix: NeedleFix, frames: tuple[Frame | None, Frame | None], names: Sequence[str]
) -> NeedleFix:
    """Return a fix that says which camera gave no picture, if one did not."""
    absent = [name for name, frame in zip(names, frames, strict=True) if frame is None]
    if not absent:
        return fix
    reason = f"no picture from the {absent[0]} camera"
    if fix.usable:
        return replace(fix, reason=f"{reason}: depth by the other one and the needle's line")
    return replace(fix, status=FixStatus.NO_PICTURE, reason=reason)
