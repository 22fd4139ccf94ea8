"""The marker's way through one camera's pictures: memory for prediction and interpolation."""

from collections.abc import Sequence

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.cameras.feed import Pair
from app.tracking.markers.extractor import MarkerFix, Miss
from app.tracking.solver import SeenMarker

_SYNCHRONOUS = 0.5e-3
"""Capture times [s] this close count as the same."""

Found = MarkerFix | Miss | None
"""Marker in a picture, or why there is none; None without a picture."""

Markers = tuple[Found, Found]

_GAP = 0.1
"""Longest time [s] between two pictures over which positions are interpolated or predicted."""

_UNKNOWN_SPEED = 150.0
"""Standard deviation of the marker's speed in the picture [px/s] where it is not known: 50 mm/s of
a needle at 40 cm."""

_FARTHEST = 60.0
"""Longest predicted way [px] between two pictures."""


class PixelTrack:
    """The last two finds of one camera, and the one before for the prediction."""

    def __init__(self) -> None:
        self._fixes: list[tuple[float, MarkerFix]] = []
        self._before: tuple[float, MarkerFix] | None = None
        self._doubted = False

    def add(self, time: float, marker: MarkerFix | None) -> None:
        """Remember a find; a picture without the marker, or not newer, begins a new track."""
        earlier = [entry for entry in self._fixes[-1:] if entry[0] < time]
        self._before = self._fixes[0] if earlier and len(self._fixes) == 2 else None
        self._fixes = [] if marker is None else [*earlier, (time, marker)]
        self._doubted = False

    def doubt(self) -> None:
        """Predict nothing next time, so that the whole picture is searched.

        The finds are kept: with unsynchronised cameras the first pair of a moving needle always
        looks inconsistent, until there are two finds to interpolate between.
        """
        self._doubted = True

    def predict(self, time: float) -> FloatArray | None:
        """Pixel where the marker should be at `time` [s]; None if lost.

        At constant acceleration by three finds, at constant speed by two: a hand's acceleration
        between two pictures is some tenths of a pixel, which would cost the fit another step.
        """
        if not self._fixes or self._doubted:
            return None
        last_time, last = self._fixes[-1]
        if not 0.0 <= time - last_time <= _GAP:
            return None
        if len(self._fixes) < 2 or last_time - self._fixes[0][0] > _GAP:
            return last.uv
        first_time, first = self._fixes[0]
        ahead, span = time - last_time, max(last_time - first_time, 1e-6)
        speed = (last.uv - first.uv) / span
        if self._before is not None and 0.0 < first_time - self._before[0] <= _GAP:
            earlier = first_time - self._before[0]
            change = speed - (first.uv - self._before[1].uv) / earlier
            speed = speed + change * (ahead + span) / (earlier + span)
        step = speed * ahead
        return np.asarray(last.uv + np.clip(step, -_FARTHEST, _FARTHEST))

    def at(self, time: float) -> SeenMarker | None:
        """Sighting at `time` [s], on the line between the last two finds; None if lost.

        Only interpolates. Later than the newest find, before both, or with too wide a gap, the
        nearest find counts, less exactly the further its capture is away: the marker may move.
        """
        if not self._fixes:
            return None
        (first_time, first), (last_time, last) = self._fixes[0], self._fixes[-1]
        span = last_time - first_time
        if not 0.0 < span <= _GAP or time >= last_time or first.centre is not last.centre:
            return _moved(last, time - last_time)
        if time < first_time:
            return _moved(first, time - first_time)
        share = (time - first_time) / span
        uv = (1.0 - share) * first.uv + share * last.uv
        before, after = SeenMarker.of(first).covariance, SeenMarker.of(last).covariance
        return SeenMarker(uv, (1.0 - share) ** 2 * before + share**2 * after, last.centre)


def sightings_at(
    frames: Pair, markers: Markers, tracks: Sequence[PixelTrack], time: float
) -> tuple[SeenMarker | None, SeenMarker | None]:
    """Bring the finds of both pictures to `time` [s], the earlier capture, by their tracks."""
    sightings: list[SeenMarker | None] = []
    for frame, marker, track in zip(frames, markers, tracks, strict=True):
        if frame is None or not isinstance(marker, MarkerFix):
            sightings.append(None)
        elif frame.time - time > _SYNCHRONOUS:
            sightings.append(track.at(time))
        else:
            sightings.append(SeenMarker.of(marker))
    return sightings[0], sightings[1]


def _moved(marker: MarkerFix, dt: float) -> SeenMarker:
    """Return what a find says `dt` [s] away from its capture, at an unknown speed."""
    spread = (_UNKNOWN_SPEED * dt) ** 2 * np.eye(2)
    return SeenMarker(marker.uv, SeenMarker.of(marker).covariance + spread, marker.centre)
