"""Which pictures of a stream count: a repeated one and one from the past are refused, and counted.

Filters and interpolation over time divide by the time between two pictures; neither zero nor a
negative one may reach them.
"""

from __future__ import annotations

from collections import deque
from dataclasses import dataclass
from enum import StrEnum
from math import isfinite
from typing import Final

import numpy as np

from app.core.messages import sentence
from app.tracking.cameras.camera import CameraFrame

AHEAD: Final = 0.1
"""A picture may be stamped so far after its arrival [s]; more is another clock's time."""

BEHIND: Final = 10.0
"""A picture may be stamped so long before its arrival [s]."""

_STRIDE: Final = 16
_KEPT: Final = 90
_UNIFORM: Final = 2


class IntakeVerdict(StrEnum):
    """What became of a picture."""

    NEW = "new"
    REPEATED = "repeated"  # the same capture time, or the same to the last bit
    BACKWARDS = "backwards"  # captured before the one before
    IMPOSSIBLE = "at an impossible time"  # after its delivery, long before it, or no number


@dataclass(frozen=True, slots=True)
class StreamFigures:
    """A stream over its last pictures.

    Attributes:
        rate: pictures per second by their capture times; 0 before there are two.
        jitter: standard deviation of the time between two [s].
        taken: pictures that counted.
        repeated, backwards, impossible: pictures that were refused, by the reason.
    """

    rate: float = 0.0
    jitter: float = 0.0
    taken: int = 0
    repeated: int = 0
    backwards: int = 0
    impossible: int = 0

    @property
    def repeated_share(self) -> float:
        """Share of repeated ones among all pictures, 0 to 1."""
        return self.repeated / max(1, self.taken + self.repeated)

    @property
    def text(self) -> str:
        """Counts of refused pictures for people; empty if there were none."""
        counts = (
            (self.repeated, "repeated"),
            (self.backwards, sentence("with times that go back")),
            (self.impossible, sentence("with impossible times")),
        )
        return ", ".join(f"{count} {what}" for count, what in counts if count)


class Intake:
    """Judges the pictures of one stream.

    Args:
        noise_expected: whether two pictures are never the same to the last bit.
    """

    def __init__(self, noise_expected: bool) -> None:
        self._noise_expected = noise_expected
        self._counts = dict.fromkeys(IntakeVerdict, 0)
        self._times: deque[float] = deque(maxlen=_KEPT)
        self._before: CameraFrame | None = None

    def restart(self) -> None:
        """Take the next picture whatever its time: the stream was opened anew."""
        self._before = None
        self._times.clear()

    def judge(self, frame: CameraFrame, now: float) -> IntakeVerdict:
        """Judge a picture that was delivered at `now` [s], and count it."""
        verdict = self._judge(frame, now)
        self._counts[verdict] += 1
        if verdict is IntakeVerdict.NEW:
            self._before = frame
            self._times.append(frame.time)
        return verdict

    def figures(self) -> StreamFigures:
        """Figures of the last pictures; for any thread."""
        steps = np.diff(np.array(self._times.copy()))
        counts = self._counts
        return StreamFigures(
            rate=float(1.0 / steps.mean()) if steps.size else 0.0,
            jitter=float(steps.std()) if steps.size else 0.0,
            taken=counts[IntakeVerdict.NEW],
            repeated=counts[IntakeVerdict.REPEATED],
            backwards=counts[IntakeVerdict.BACKWARDS],
            impossible=counts[IntakeVerdict.IMPOSSIBLE],
        )

    def _judge(self, frame: CameraFrame, now: float) -> IntakeVerdict:
        if not isfinite(frame.time) or not -BEHIND <= frame.time - now <= AHEAD:
            return IntakeVerdict.IMPOSSIBLE
        if self._before is None:
            return IntakeVerdict.NEW
        if frame.time < self._before.time:
            return IntakeVerdict.BACKWARDS
        same = self._noise_expected and _same(frame, self._before)
        return (
            IntakeVerdict.REPEATED if same or frame.time == self._before.time else IntakeVerdict.NEW
        )


def plain(frame: CameraFrame) -> str:
    """Say that a picture shows nothing: `black`, `white`, or empty if it shows something."""
    grid = frame.image[::_STRIDE, ::_STRIDE]
    if int(grid.max()) <= _UNIFORM:
        return "black"
    return "white" if int(grid.min()) >= 255 - _UNIFORM else ""


def _same(frame: CameraFrame, other: CameraFrame) -> bool:
    """Return whether two pictures agree to the last bit; most differ on a grid of their pixels
    already.
    """
    grid = np.array_equal(frame.image[::_STRIDE, ::_STRIDE], other.image[::_STRIDE, ::_STRIDE])
    return grid and np.array_equal(frame.image, other.image)
