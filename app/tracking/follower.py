"""Follows the marker through both cameras' pictures and brings its pixels to one time.

Two certain finds that disagree: a camera that was moved, or two cables exchanged.

A thing that a fit with the robot's axis takes for the band, on a bare shaft, can be nothing but the
marker. Where either picture shows one such thing, and the two are not one point, the cameras are
not where they were; where each is what the other camera should see, they are exchanged.
"""

from collections.abc import Callable
from dataclasses import replace
from functools import partial
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.agreement import EpipolarGate, Pairing
from app.tracking.cameras.feed import Pair
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.markers.extractor import Centre, Extractor, Hint, MarkerFix, Miss, MissReason
from app.tracking.solver import FixSolver, SeenMarker
from app.tracking.track import Found, Markers, PixelTrack, sightings_at

_SAME_PX: Final = 2.0
"""Finds nearer to each other than this [px] are one thing."""

Extractors = tuple[Extractor, Extractor]


def certain_pair(
    extractors: Extractors,
    solver: FixSolver,
    frames: Pair,
    candidates: list[list[Found]],
    axis: FloatArray,
) -> tuple[MarkerFix, MarkerFix] | None:
    """Return what can be nothing but the marker, where either picture shows one such thing.

    Args:
        extractors: of both cameras.
        solver: of the rig.
        frames: their pictures.
        candidates: what a search found in either.
        axis: needle's direction by the robot, shape (3,).
    """
    first = _bands(extractors[0], partial(solver.nearest, 0), frames, 0, candidates, axis)
    second = _bands(extractors[1], partial(solver.nearest, 1), frames, 1, candidates, axis)
    return (first[0], second[0]) if len(first) == len(second) == 1 else None


def fits_exchanged(
    extractors: Extractors,
    solver: FixSolver,
    gate: EpipolarGate,
    frames: Pair,
    candidates: list[list[Found]],
    axis: FloatArray,
) -> bool:
    """Return whether both pictures show one marker if the left one is the right camera's.

    Args:
        extractors: see `certain_pair`.
        solver: likewise.
        gate: of the rig.
        frames: as above.
        candidates: as above.
        axis: as above.
    """
    left, right = frames
    if left is None or right is None or left.image.shape != right.image.shape:
        return False
    first = _bands(extractors[0], partial(solver.nearest, 0), frames, 1, candidates, axis)
    second = _bands(extractors[1], partial(solver.nearest, 1), frames, 0, candidates, axis)
    if not len(first) == len(second) == 1:
        return False
    if not gate.pairings(first, second, left.time - right.time)[0].agrees:
        return False
    fix = solver.solve((SeenMarker.of(first[0]), SeenMarker.of(second[0])), axis, left.time)
    return fix.status is FixStatus.VALID


def _bands(
    extractor: Extractor,
    nearest: Callable[[FloatArray, FloatArray], FloatArray | None],
    frames: Pair,
    picture: int,
    candidates: list[list[Found]],
    axis: FloatArray,
) -> list[MarkerFix]:
    """Candidates in a picture that the extractor's camera would show as a band on its shaft."""
    frame, sure = frames[picture], list[MarkerFix]()
    if frame is None:
        return sure
    for one in candidates[picture]:
        if not isinstance(one, MarkerFix):
            continue
        found = extractor.find(frame.image, Hint(one.uv, nearest(one.uv, axis), axis))
        if not isinstance(found, MarkerFix) or found.centre is not Centre.BAND:
            continue
        if all(np.abs(other.uv - found.uv).max() >= _SAME_PX for other in sure):
            sure.append(found)
    return sure


_PLACED = 2e-3
"""By how much [m] two bands found by their outlines may differ from their distance."""


class MarkerFollower:
    """Looks where the marker should be, and everywhere when it is lost.

    Args:
        extractors: of both cameras.
        solver: of the rig.
        gate: of the rig.
        distance: from a second band on the shaft to the marker [m]; None where there is none. With
            one a search begins with nothing less than both: alone, either looks like the other.
    """

    def __init__(
        self,
        extractors: tuple[Extractor, Extractor],
        solver: FixSolver,
        gate: EpipolarGate,
        distance: float | None = None,
    ) -> None:
        self._distance = distance
        self._extractors = extractors
        self._solver = solver
        self._gate = gate
        self._tracks = (PixelTrack(), PixelTrack())
        self._p_world: FloatArray | None = None
        self._exchanged = False

    @property
    def exchanged(self) -> bool:
        """Return whether the last pictures fit with left and right exchanged, and not as they
        came.
        """
        return self._exchanged

    def use(self, extractors: tuple[Extractor, Extractor]) -> None:
        """Find the marker by other extractors from the next picture on; any thread may call it."""
        self._extractors = extractors

    def find(self, frames: Pair, axis: FloatArray | None, time: float) -> Markers:
        """Marker in each picture; of several red things the pair that geometry and robot allow."""
        markers: list[Found] = [None, None]
        self._exchanged = False
        for i, (frame, track) in enumerate(zip(frames, self._tracks, strict=True)):
            if frame is not None and (predicted := track.predict(frame.time)) is not None:
                hint = Hint(predicted, self._p_world, axis)
                markers[i] = self._extractors[i].find(frame.image, hint)
        if any(
            f is not None and not isinstance(m, MarkerFix)
            for m, f in zip(markers, frames, strict=True)
        ):
            markers = self._search(frames, markers, axis, time)
            bands = [isinstance(m, MarkerFix) and m.centre is Centre.BAND for m in markers]
            if axis is not None and self._distance is None and not (all(bands) or self._exchanged):
                markers = self._occluded(frames, markers, axis, time)
        for frame, marker, track in zip(frames, markers, self._tracks, strict=True):
            if frame is not None:
                track.add(frame.time, marker if isinstance(marker, MarkerFix) else None)
        return markers[0], markers[1]

    def sightings(
        self, frames: Pair, markers: Markers, time: float
    ) -> tuple[SeenMarker | None, SeenMarker | None]:
        """Bring both pixels to `time` [s], the earlier capture, by interpolating the other."""
        return sightings_at(frames, markers, self._tracks, time)

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
        followed = any(isinstance(marker, MarkerFix) for marker in markers)
        if pairings and not pairings[0].agrees and followed:  # what is followed may be wrong
            candidates = [
                [*one, *self._candidates(i, frames)] if isinstance(markers[i], MarkerFix) else one
                for i, one in enumerate(candidates)
            ]
            pairings = self._pairings(candidates, frames)
        agreeing = [pair for pair in pairings if pair.agrees]
        if agreeing:
            chosen = self._chosen(agreeing, markers, candidates, frames, axis, time)
            found = any(isinstance(one, MarkerFix) for one in chosen)
            if found or self._exchanged or self._distance is not None:
                return chosen
            return self._wrong(candidates, frames, axis) or _unproven(agreeing[0])
        if pairings and (wrong := self._wrong(candidates, frames, axis)) is not None:
            return wrong
        if pairings and not pairings[0].hopeless:  # a bumped camera: the solver says how far off
            near = pairings[:1]  # or outlines far from their bands' centres, which the axis tells
            if self._distance is None:
                chosen = self._chosen(near, markers, candidates, frames, axis, time)
                one_found = any(isinstance(one, MarkerFix) for one in chosen)
                return chosen if one_found else _unproven(near[0])
            return [near[0].first, near[0].second]
        best = [found[0] if found else None for found in candidates]
        if pairings:  # the marker that is followed goes on; what has no partner is none
            return [
                one if one is marker or not isinstance(one, MarkerFix) else _unpaired(one)
                for one, marker in zip(best, markers, strict=True)
            ]
        return [
            one
            if not isinstance(one, MarkerFix)
            else _either(one)
            if self._distance is not None and one is not marker
            else self._closer(i, frames, one, None, axis)
            for i, (one, marker) in enumerate(zip(best, markers, strict=True))
        ]

    def _occluded(
        self, frames: Pair, markers: list[Found], axis: FloatArray, time: float
    ) -> list[Found]:
        """Return both cameras' markers where something hides a part of them, if they agree."""
        seen: list[MarkerFix] = []
        for i, frame in enumerate(frames):
            if frame is None:
                return markers
            nearest = partial(self._solver.nearest, i, axis=axis)
            hidden = self._extractors[i].find_occluded(frame.image, axis, nearest)
            if not isinstance(hidden, MarkerFix):  # a whole band has to be one for this look too:
                return markers  # what hides a flank may pass for the band's own edge
            seen.append(hidden)
        fix = self._solver.solve((SeenMarker.of(seen[0]), SeenMarker.of(seen[1])), axis, time)
        return [*seen] if fix.status is FixStatus.VALID else markers

    def _wrong(
        self, candidates: list[list[Found]], frames: Pair, axis: FloatArray | None
    ) -> list[Found] | None:
        """Look for signs of a camera that was moved, or of left and right exchanged."""
        if self._distance is not None or axis is None:
            return None
        certain = certain_pair(self._extractors, self._solver, frames, candidates, axis)
        if certain is not None:
            return list(certain)
        return self._as_exchanged(candidates, frames, axis)

    def _as_exchanged(
        self, candidates: list[list[Found]], frames: Pair, axis: FloatArray
    ) -> list[Found] | None:
        """Return two misses if the pictures fit with left and right exchanged."""
        extractors, solver = self._extractors, self._solver
        if self._distance is not None or not fits_exchanged(
            extractors, solver, self._gate, frames, candidates, axis
        ):
            return None
        self._exchanged = True
        return [Miss(MissReason.EXCHANGED), Miss(MissReason.EXCHANGED)]

    def _pairings(self, candidates: list[list[Found]], frames: Pair) -> list[Pairing]:
        firsts, seconds = (
            [one for one in found if isinstance(one, MarkerFix)] for found in candidates
        )
        times = [frame.time for frame in frames if frame is not None]
        return self._gate.pairings(firsts, seconds, times[-1] - times[0]) if times else []

    def _chosen(
        self,
        agreeing: list[Pairing],
        markers: list[Found],
        candidates: list[list[Found]],
        frames: Pair,
        axis: FloatArray | None,
        time: float,
    ) -> list[Found]:
        """Of the pairings that the epipolar geometry allows the one that the robot allows."""
        best = agreeing[0]
        if axis is None:
            return [best.first, best.second]
        solved = ((pair, self._solved(pair, axis, time)) for pair in agreeing)
        if self._distance is not None:
            every = list(solved)
            allowed = [one for one in every if one[1].status is FixStatus.VALID]
            first = self._first_band(allowed or every, markers, self._distance)
            if first is None:
                return [_either(best.first), _either(best.second)]
            best, solved = first[0], (one for one in [first])
        for pair, fix in solved:
            if fix.status is FixStatus.VALID:
                p_world = self._solver.band(fix, axis)
                return [
                    self._closer(i, frames, one, p_world, axis)
                    for i, one in enumerate((pair.first, pair.second))
                ]
        if best.agrees and (exchanged := self._as_exchanged(candidates, frames, axis)) is not None:
            return exchanged
        return [  # a moving pair needs its track
            self._closer(i, frames, one, None, axis)
            for i, one in enumerate((best.first, best.second))
        ]

    def _solved(self, pair: Pairing, axis: FloatArray, time: float) -> NeedleFix:
        return self._solver.solve(
            (SeenMarker.of(pair.first), SeenMarker.of(pair.second)), axis, time
        )

    def _first_band(
        self, solved: list[tuple[Pairing, NeedleFix]], markers: list[Found], distance: float
    ) -> tuple[Pairing, NeedleFix] | None:
        """Return the band that has the other one behind it, or is followed; None without."""
        for pair, fix in solved:
            if pair.first is markers[0] or pair.second is markers[1]:
                return pair, fix
        for pair, fix in solved:
            behind = [fix.depth - other.depth - distance for _, other in solved if other.has_point]
            if fix.has_point and min((abs(gap) for gap in behind), default=1.0) < _PLACED:
                return pair, fix
        return None

    def _closer(
        self,
        camera: int,
        frames: Pair,
        result: MarkerFix,
        p_world: FloatArray | None,
        axis: FloatArray | None,
    ) -> Found:
        """Look again where a search has found something, now that the axis is known."""
        frame = frames[camera]
        if frame is None or axis is None or result.centre is Centre.BAND:
            return result
        uv = None if p_world is None else self._solver.pixel(camera, p_world)
        hint = Hint(result.uv if uv is None else uv, p_world, axis)
        return self._extractors[camera].find(frame.image, hint)

    def _candidates(self, camera: int, frames: Pair) -> list[Found]:
        frame = frames[camera]
        if frame is None:
            return []
        return [*self._extractors[camera].search(frame.image)] or [Miss(MissReason.NOTHING_RED)]


def _either(result: MarkerFix) -> Miss:
    return Miss(MissReason.ONE_OF_TWO, result.uv)


def _unproven(pair: Pairing) -> list[Found]:
    """Two outlines in which no fit finds the band: they tell people what is wrong, no more."""
    return [replace(one, alone=False) for one in (pair.first, pair.second)]


def _unpaired(result: MarkerFix) -> Miss:
    return Miss(MissReason.OFF_EPIPOLAR, result.uv)
