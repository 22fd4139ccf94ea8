"""Follows the marker through both cameras' pictures and brings its pixels to one time."""

from app.core.arrays import FloatArray
from app.tracking.agreement import EpipolarGate, Pairing
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

    def __init__(
        self, extractors: tuple[Extractor, Extractor], solver: FixSolver, gate: EpipolarGate
    ) -> None:
        self._extractors = extractors
        self._solver = solver
        self._gate = gate
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
        candidates: list[list[Found]] = [
            [marker] if isinstance(marker, MarkerFix) else self._candidates(i, frames)
            for i, marker in enumerate(markers)
        ]
        pairings = self._pairings(candidates, frames)
        if pairings and not pairings[0].agrees:  # the one that is followed may be the wrong one
            candidates = [
                [*one, *self._candidates(i, frames)] if isinstance(markers[i], MarkerFix) else one
                for i, one in enumerate(candidates)
            ]
            pairings = self._pairings(candidates, frames)
        agreeing = [pair for pair in pairings if pair.agrees]
        if agreeing:
            return self._chosen(agreeing, frames, axis, time)
        if pairings and not pairings[0].hopeless:  # a bumped camera: the solver says how far off
            return [pairings[0].first, pairings[0].second]
        best = [found[0] if found else None for found in candidates]
        if pairings:  # the marker that is followed goes on; what has no partner is none
            return [
                one if one is marker or not isinstance(one, MarkerFix) else _unpaired(one)
                for one, marker in zip(best, markers, strict=True)
            ]
        return [
            self._closer(i, frames, one, None, axis) if isinstance(one, MarkerFix) else one
            for i, one in enumerate(best)
        ]

    def _pairings(self, candidates: list[list[Found]], frames: Pair) -> list[Pairing]:
        firsts, seconds = (
            [one for one in found if isinstance(one, MarkerFix)] for found in candidates
        )
        times = [frame.time for frame in frames if frame is not None]
        return self._gate.pairings(firsts, seconds, times[-1] - times[0]) if times else []

    def _chosen(
        self, agreeing: list[Pairing], frames: Pair, axis: FloatArray | None, time: float
    ) -> list[Found]:
        """Of the pairings that the epipolar geometry allows the one that the robot allows."""
        best = agreeing[0]
        if axis is None:
            return [best.first, best.second]
        for pair in agreeing:
            sightings = (Sighting.of(pair.first), Sighting.of(pair.second))
            fix = self._solver.solve(sightings, axis, time)
            if fix.status is FixStatus.VALID:
                p_world = self._solver.band(fix, axis)
                return [
                    self._closer(i, frames, one, p_world, axis)
                    for i, one in enumerate((pair.first, pair.second))
                ]
        return [best.first, best.second]  # a moving pair needs its track

    def _closer(
        self,
        camera: int,
        frames: Pair,
        found: MarkerFix,
        p_world: FloatArray | None,
        axis: FloatArray | None,
    ) -> Found:
        """Look again where a search has found something, now that the axis is known."""
        frame = frames[camera]
        if frame is None or axis is None or found.centre is Centre.BAND:
            return found
        return self._extractors[camera].find(frame.image, Hint(found.uv, p_world, axis))

    def _candidates(self, camera: int, frames: Pair) -> list[Found]:
        frame = frames[camera]
        if frame is None:
            return []
        return [*self._extractors[camera].search(frame.image)] or [Miss(MissReason.NOTHING_RED)]


def _unpaired(found: MarkerFix) -> Miss:
    return Miss(MissReason.OFF_EPIPOLAR, found.uv)
