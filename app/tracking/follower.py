"""Follows the marker through both cameras' pictures and brings its pixels to one time."""

from app.core.arrays import FloatArray
from app.tracking.cameras.feed import Pair
from app.tracking.fix import FixStatus
from app.tracking.markers.extractor import Extractor, MarkerFix
from app.tracking.solver import FixSolver, Sighting
from app.tracking.track import PixelTrack

_SYNCHRONOUS = 0.5e-3
"""Capture times [s] this close count as the same."""

Markers = tuple[MarkerFix | None, MarkerFix | None]


class MarkerFollower:
    """Looks where the marker should be, and everywhere when it is lost."""

    def __init__(self, extractor: Extractor, solver: FixSolver) -> None:
        self._extractor = extractor
        self._solver = solver
        self._tracks = (PixelTrack(), PixelTrack())

    def find(self, frames: Pair, axis: FloatArray | None, time: float) -> Markers:
        """Marker in each picture; of several red things the pair that geometry and robot allow."""
        markers: list[MarkerFix | None] = [None, None]
        for i, (frame, track) in enumerate(zip(frames, self._tracks, strict=True)):
            if frame is not None and (predicted := track.predict(frame.time)) is not None:
                markers[i] = self._extractor.find(frame.image, predicted)
        if any(m is None and f is not None for m, f in zip(markers, frames, strict=True)):
            markers = self._search(frames, markers, axis, time)
        for frame, marker, track in zip(frames, markers, self._tracks, strict=True):
            if frame is not None:
                track.add(frame.time, marker)
        return markers[0], markers[1]

    def sightings(
        self, frames: Pair, markers: Markers, time: float
    ) -> tuple[Sighting | None, Sighting | None]:
        """Bring both pixels to `time` [s], the earlier capture, by interpolating the other."""
        sightings: list[Sighting | None] = []
        for frame, marker, track in zip(frames, markers, self._tracks, strict=True):
            if frame is None or marker is None:
                sightings.append(None)
            elif frame.time - time > _SYNCHRONOUS:
                sightings.append(track.at(time))
            else:
                sightings.append(Sighting.of(marker))
        return sightings[0], sightings[1]

    def doubt(self) -> None:
        """Search the whole pictures next time."""
        for track in self._tracks:
            track.doubt()

    def _search(
        self,
        frames: Pair,
        markers: list[MarkerFix | None],
        axis: FloatArray | None,
        time: float,
    ) -> list[MarkerFix | None]:
        candidates = [
            (marker,)
            if marker is not None
            else ()
            if frame is None
            else self._extractor.search(frame.image)
            for frame, marker in zip(frames, markers, strict=True)
        ]
        best: list[MarkerFix | None] = [found[0] if found else None for found in candidates]
        if axis is None or len(candidates[0]) * len(candidates[1]) < 2:
            return best
        for first in candidates[0]:
            for second in candidates[1]:
                pair = (Sighting.of(first), Sighting.of(second))
                if self._solver.solve(pair, axis, time).status is FixStatus.VALID:
                    return [first, second]
        return best
