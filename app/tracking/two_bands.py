"""The needle's axis from two bands on its shaft, beside the robot's or in place of it.

With the bands' centres p₁ (towards the tip) and p₂, L = |p₁ - p₂| and P = 1 - a aᵀ,

    a = (p₁ - p₂) / L,        ∂a/∂(p₁, p₂) = [P, -P] / L,
    tip = p₁ + o a,           ∂tip/∂(p₁, p₂) = [1 + o P / L, -o P / L],

o being the first band's distance from the tip; both covariances follow from the 6×6 one of the two
points. With points of σ in every direction, independent: the axis turns by √2 σ / L about either
normal.
"""

from collections.abc import Sequence
from dataclasses import dataclass, replace
from itertools import permutations
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, read_only, unit
from app.tracking.agreement import EpipolarGate
from app.tracking.cameras.feed import Pair
from app.tracking.fix import FixStatus, NeedleFix, without_point
from app.tracking.markers.choice import extractors
from app.tracking.markers.colour import RED, ColourModel
from app.tracking.markers.extractor import Extractor, Hint, MarkerFix, Miss
from app.tracking.optics.rig import RigProfile
from app.tracking.solver import FixSolver
from app.tracking.stereo.calibration_uncertainty import CalibrationUncertainty
from app.tracking.stereo.triangulation import Triangulation
from app.tracking.track import Found, Markers, PixelTrack, sightings_at

SIGMAS: Final = 4.5
"""Difference [standard deviations] up to which a distance is the one between the bands."""

PLACED: Final = 0.05
"""Share of the distance by which the bands may be painted too near or too far."""


@dataclass(frozen=True, slots=True, eq=False)
class ShaftAxis:
    """Axis and tip of a needle from its two bands.

    Attributes:
        axis: unit, from the second band to the first, shape (3,), read-only.
        axis_covariance: of it, shape (3, 3), read-only; zero along itself.
        p_tip: [m], shape (3,), read-only.
        tip_covariance: of it [m²], shape (3, 3), read-only.
    """

    axis: FloatArray
    axis_covariance: FloatArray
    p_tip: FloatArray
    tip_covariance: FloatArray


def shaft_axis(
    points: FloatArray, covariance: FloatArray, offset: float, offset_variance: float = 0.0
) -> ShaftAxis | None:
    """Axis and tip from both bands; None if the points are one.

    Args:
        points: centres of the first and the second band [m], shape (2, 3).
        covariance: of both together [m²], shape (6, 6).
        offset: from the first band to the tip [m].
        offset_variance: of it [m²].
    """
    between = points[0] - points[1]
    length = float(np.linalg.norm(between))
    if not length > 1e-6:
        return None
    axis = between / length
    across = (np.eye(3) - np.outer(axis, axis)) / length
    turns = np.hstack([across, -across])
    moves = np.hstack([np.eye(3), np.zeros((3, 3))]) + offset * turns
    return ShaftAxis(
        read_only(axis),
        read_only(turns @ covariance @ turns.T),
        read_only(points[0] + offset * axis),
        read_only(moves @ covariance @ moves.T + offset_variance * np.outer(axis, axis)),
    )


def fits(points: FloatArray, covariance: FloatArray, distance: float) -> bool:
    """Return whether two points are as far apart as the bands.

    Args:
        points: [m], shape (2, 3).
        covariance: of both together [m²], shape (6, 6).
        distance: between the bands' centres [m].
    """
    between = points[0] - points[1]
    length = float(np.linalg.norm(between))
    if not length > 1e-6:
        return False
    along = np.concatenate([between, -between]) / length
    sigma = float(np.sqrt(max(0.0, float(along @ covariance @ along))))
    return abs(length - distance) <= PLACED * distance + SIGMAS * sigma


def tell_apart(
    points: list[FloatArray], sigma: float, distance: float, towards: FloatArray
) -> tuple[int, int] | None:
    """Return which of some red points are the first and the second band; None unless just two can
    be.

    Args:
        points: [m], each of shape (3,).
        sigma: standard deviation of a point, per axis [m].
        distance: between the bands' centres [m].
        towards: direction, shape (3,), that the needle's tip points to within 90°.
    """
    spread = sigma**2 * np.eye(6)
    found = [
        (i, j)
        for i, j in permutations(range(len(points)), 2)
        if (points[i] - points[j]) @ towards > 0.0
        and fits(np.stack([points[i], points[j]]), spread, distance)
    ]
    return found[0] if len(found) == 1 else None


_DOWN: Final = np.array([0.0, 0.0, -1.0])
_OUTLINE_SIGMA: Final = 0.3e-3
"""Standard deviation [m] of a point from two outlines whose axis is not known yet."""

_ALONE: Final = "the robot gives no needle direction, and both cameras do not see both bands"


class TwoBands:
    """Looks for both bands of a rig that has two; remembers where the second was.

    Args:
        rig: with a second band.
        fulcrum: P_I in world [m], shape (3,).
        solver: of the first band.
        gate: of the rig.
    """

    def __init__(
        self, rig: RigProfile, fulcrum: FloatArray, solver: FixSolver, gate: EpipolarGate
    ) -> None:
        self._needle = rig.needle
        self._models = rig.models
        self._second = rig.of_second_band() or rig
        self._distance = rig.needle.band_distance or 0.0
        self._solvers = (solver, FixSolver(self._second, fulcrum))
        self._gate = gate
        self._fulcrum = fulcrum
        self._error = (
            CalibrationUncertainty(rig.calibration) if rig.calibration is not None else None
        )
        self._offset_variance = rig.marker_offset_variance
        self._tracks = tuple((PixelTrack(), PixelTrack()) for _ in range(2))
        self._towards = _DOWN
        self.use(RED)

    def use(self, colour: ColourModel) -> None:
        """Look for a second band of this colour from the next picture on."""
        self._extractors = extractors(self._second, colour=colour)

    def beside(self, fix: NeedleFix, first: Triangulation | None, frames: Pair) -> NeedleFix:
        """Return a fix by the robot's axis with the cameras' own axis, if both bands are seen.

        Args:
            fix: by the first band.
            first: its point; None if both cameras do not show it.
            frames: the pictures.
        """
        if first is None or fix.axis is None:
            return fix
        p_world = first.p_world - self._distance * fix.axis
        second = self._found(1, self._extractors, frames, p_world, fix.axis, fix.time)[1]
        found = None if second is None else self._shaft(first, second)
        if found is None:
            return fix
        self._towards = found.axis
        return replace(fix, axis_world=found.axis, axis_covariance=found.axis_covariance)

    def alone(
        self, frames: Pair, time: float, first: tuple[Extractor, Extractor]
    ) -> tuple[NeedleFix, Markers]:
        """Fix without the robot's axis, and the first band in both pictures.

        Args:
            frames: the pictures.
            time: of the fix [s].
            first: extractors of the first band.
        """
        searched = [
            first[i].search(frame.image) if frame is not None else ()
            for i, frame in enumerate(frames)
        ]
        best: list[Found] = [found[0] if found else None for found in searched]
        points = self._points(searched, frames)
        chosen = tell_apart(points, _OUTLINE_SIGMA, self._distance, self._towards)
        if chosen is None:
            return self._without(best, time), (best[0], best[1])
        ends = [points[i] for i in chosen]
        axis = unit(ends[0] - ends[1])
        markers, one = self._found(0, first, frames, ends[0], axis, time)
        two = self._found(1, self._extractors, frames, ends[1], axis, time)[1]
        found = None if one is None or two is None else self._shaft(one, two)
        if one is None or two is None or found is None:
            return self._without(list(markers), time), markers
        self._towards = found.axis
        return self._fix(one, two, found, markers, time), markers

    def _points(
        self, searched: Sequence[Sequence[MarkerFix | Miss]], frames: Pair
    ) -> list[FloatArray]:
        """Everything that both pictures may show as one point [m], each of shape (3,)."""
        left, right = frames
        if left is None or right is None:
            return []
        firsts, seconds = ([f for f in found if isinstance(f, MarkerFix)] for found in searched)
        pairs = self._gate.pairings(firsts, seconds, right.time - left.time)
        seen = [
            self._solvers[0].triangulated((pair.first, pair.second), None)
            for pair in pairs
            if pair.agrees
        ]
        return [found.p_world for found in seen if found is not None]

    def _found(
        self,
        band: int,
        by: tuple[Extractor, Extractor],
        frames: Pair,
        p_world: FloatArray,
        axis: FloatArray,
        time: float,
    ) -> tuple[Markers, Triangulation | None]:
        """Look for a band where it should be, and triangulate it at one time."""
        markers: list[Found] = [None, None]
        for i, (frame, track) in enumerate(zip(frames, self._tracks[band], strict=True)):
            if frame is None:
                continue
            markers[i] = by[i].find(
                frame.image, Hint(self._models[i].project(p_world)[0][0], p_world, axis)
            )
            found = markers[i]
            track.add(frame.time, found if isinstance(found, MarkerFix) else None)
        both = (markers[0], markers[1])
        left, right = sightings_at(frames, both, self._tracks[band], time)
        if left is None or right is None:
            return both, None
        return both, self._solvers[band].triangulated((left, right), axis)

    def _shaft(self, first: Triangulation, second: Triangulation) -> ShaftAxis | None:
        """Axis and tip, if both points are bands of this needle."""
        points, joint = np.stack([first.p_world, second.p_world]), _noise(first, second)
        if self._error is not None:
            seen = np.stack([first.covariances, second.covariances])
            joint = joint + self._error.joint(points, seen)
        if not fits(points, joint, self._distance):
            return None
        if not all(self._solvers[0].agrees(found) for found in (first, second)):
            return None
        return shaft_axis(points, joint, self._needle.marker_offset, self._offset_variance)

    def _fix(
        self,
        first: Triangulation,
        second: Triangulation,
        result: ShaftAxis,
        markers: Markers,
        time: float,
    ) -> NeedleFix:
        points = np.stack([first.p_world, second.p_world])
        noise = shaft_axis(points, _noise(first, second), self._needle.marker_offset)
        return NeedleFix(
            result.p_tip,
            result.tip_covariance,
            time,
            FixStatus.VALID,
            _pixels(markers),
            self._solvers[0].residual_px(first),
            float((result.p_tip - self._fulcrum) @ result.axis),
            float(result.axis @ result.tip_covariance @ result.axis),
            has_point=True,
            noise_covariance=None if noise is None else noise.tip_covariance,
            axis_world=result.axis,
            axis_covariance=result.axis_covariance,
        )

    def _without(self, markers: Sequence[Found], time: float) -> NeedleFix:
        both = (markers[0], markers[1])
        return without_point(FixStatus.NO_ORIENTATION, _pixels(both), time, reason=_ALONE)


def _pixels(markers: Markers) -> tuple[FloatArray | None, FloatArray | None]:
    left, right = (one.uv if isinstance(one, MarkerFix) else None for one in markers)
    return left, right


def _noise(first: Triangulation, second: Triangulation) -> FloatArray:
    joint = np.zeros((6, 6))
    joint[:3, :3], joint[3:, 3:] = first.covariance, second.covariance
    return joint
