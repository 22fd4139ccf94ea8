"""Follows the marker through both cameras' pictures and brings its pixels to one time."""

from app.core.arrays import FloatArray
from app.tracking.cameras.feed import Pair
from app.tracking.fix import FixStatus
from app.tracking.markers.extractor import Centre, Extractor, Hint, MarkerFix, Miss, MissReason
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
        self._p_world: FloatArray | None = None

    def use(self, extractors: tuple[Extractor, Extractor]) -> None:
        """Find the marker by other extractors from the next picture on; any thread may call it."""
        self._extractors = extractors

    def find(self, frames: Pair, axis: FloatArray | None, time: float) -> Markers:
        """Marker in each picture; of several red things the pair that geometry and robot allow."""
        markers: list[Found] = [None, None]
        for i, (frame, track) in enumerate(zip(frames, self._tracks, strict=True)):
            if frame is not None and (predicted := track.predict(frame.time)) is not None:
                hint = Hint(predicted, self._p_world, axis)
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

    def remember(self, p_world: FloatArray | None) -> None:
        """Keep the band's centre [m], shape (3,), for the next pictures, or None."""
        self._p_world = p_world

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
        if axis is None:
            return best
        for first in firsts:
            for second in seconds:
                fix = self._solver.solve((Sighting.of(first), Sighting.of(second)), axis, time)
                if fix.status is FixStatus.VALID:
                    p_world = self._solver.band(fix, axis)
                    return [
                        self._closer(i, frames, one, p_world, axis)
                        for i, one in enumerate((first, second))
                    ]
        if firsts and seconds:  # the solver says what contradicts; a moving pair needs its track
            return best
        return [
            self._closer(i, frames, one, None, axis) if isinstance(one, MarkerFix) else one
            for i, one in enumerate(best)
        ]

    def _closer(
        self,
        camera: int,
        frames: Pair,
        found: MarkerFix,
        p_world: FloatArray | None,
        axis: FloatArray,
    ) -> Found:
        """Look again where a search has found something, now that the axis is known."""
        frame = frames[camera]
        if frame is None or found.centre is Centre.BAND:
            return found
        return self._extractors[camera].find(frame.image, Hint(found.uv, p_world, axis))

    def _candidates(self, camera: int, frames: Pair) -> tuple[MarkerFix | Miss, ...]:
        frame = frames[camera]
        if frame is None:
            return ()
        return self._extractors[camera].search(frame.image) or (Miss(MissReason.NOTHING_RED),)
