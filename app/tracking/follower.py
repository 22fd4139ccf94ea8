"""Follows the marker through both cameras' pictures and brings its pixels to one time."""

from app.core.arrays import FloatArray
from app.tracking.cameras.feed import Pair
from app.tracking.fix import FixStatus
from app.tracking.markers.extractor import Extractor, Hint, MarkerFix, Miss, MissReason
from app.tracking.solver import FixSolver, Sighting
from app.tracking.track import PixelTrack

_SYNCHRONOUS = 0.5e-3
"""Capture times [s] this close count as the same."""

Found = MarkerFix | Miss | None
"""Marker in a picture, or why there is none; None without a picture."""

Markers = tuple[Found, Found]


class MarkerFollower:
    """Looks where the marker should be, and everywhere when it is lost."""

    def __init__(self, extractors: tuple[Extractor, Extractor], solver: FixSolver) -> None:
        self._extractors = extractors
        self._solver = solver
        self._tracks = (PixelTrack(), PixelTrack())

    def find(self, frames: Pair, axis: FloatArray | None, time: float) -> Markers:
        """Marker in each picture; of several red things the pair that geometry and robot allow."""
        markers: list[Found] = [None, None]
        for i, (frame, track) in enumerate(zip(frames, self._tracks, strict=True)):
            if frame is not None and (predicted := track.predict(frame.time)) is not None:
                hint = Hint(predicted, axis_world=axis)
                markers[i] = self._extractors[i].find(frame.image, hint)
        if any(
            f is not None and not isinstance(m, MarkerFix)
            for m, f in zip(markers, frames, strict=True)
        ):
            markers = self._search(frames, markers, axis, time)
        for frame, marker, track in zip(frames, markers, self._tracks, strict=True):
            if frame is not None:
                track.add(frame.time, marker if isinstance(marker, MarkerFix) else None)
        return markers[0], markers[1]

    def sightings(
        self, frames: Pair, markers: Markers, time: float
    ) -> tuple[Sighting | None, Sighting | None]:
        """Bring both pixels to `time` [s], the earlier capture, by interpolating the other."""
        sightings: list[Sighting | None] = []
        for frame, marker, track in zip(frames, markers, self._tracks, strict=True):
            if frame is None or not isinstance(marker, MarkerFix):
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
        self, frames: Pair, markers: list[Found], axis: FloatArray | None, time: float
    ) -> list[Found]:
        candidates = [
            (marker,) if isinstance(marker, MarkerFix) else self._candidates(i, frames)
            for i, marker in enumerate(markers)
        ]
        best: list[Found] = [found[0] if found else None for found in candidates]
        firsts, seconds = (
            [one for one in found if isinstance(one, MarkerFix)] for found in candidates
        )
        if axis is None or len(firsts) * len(seconds) < 2:
            return best
        for first in firsts:
            for second in seconds:
                pair = (Sighting.of(first), Sighting.of(second))
                if self._solver.solve(pair, axis, time).status is FixStatus.VALID:
                    return [first, second]
        return best

    def _candidates(self, camera: int, frames: Pair) -> tuple[MarkerFix | Miss, ...]:
        frame = frames[camera]
        if frame is None:
            return ()
        return self._extractors[camera].search(frame.image) or (Miss(MissReason.NOTHING_RED),)
