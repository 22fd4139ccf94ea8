"""From what both cameras show and the robot's axis to the needle's tip.

Of both pictures' pixels that is compiled and done in one go, because it is a pair's every-day path:
as dozens of small array operations it took as long as a fit.
`tests/tracking/test_tracking_pair_kernels.py` holds it against the same steps in plain numpy.
"""

from dataclasses import dataclass
from typing import Any, Final

import numpy as np

from app.core.arrays import FloatArray, frozen, read_only, unit
from app.core.compiled import njit
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.tracking.confidence import chi_square_quantile
from app.tracking.fix import GATE, FixStatus, NeedleFix, without_point
from app.tracking.markers.extractor import Centre, MarkerFix
from app.tracking.markers.silhouette import outline_shift
from app.tracking.one_camera_fix import LEAST_ANGLE, OneCameraSolver
from app.tracking.optics.packed import normalise, packed
from app.tracking.optics.rig import RigProfile
from app.tracking.stereo.calibration_uncertainty import CalibrationUncertainty
from app.tracking.stereo.closed_form import closest, ray
from app.tracking.stereo.epipolar import essential_matrix
from app.tracking.stereo.kernels import BEHIND, DEGENERATE, FOUND, NEAREST, inverse3, meet, optimum
from app.tracking.stereo.triangulation import StereoStatus, Triangulation, triangulation

NO_RAY: Final = 5
NO_OUTLINE: Final = 6
"""What `locate` returns besides `stereo.kernels.FOUND` and its like."""

_STEPS: Final = 10

SUMMARY: Final = 3
"""Root mean square residual [px], signed root of chi-square (the sign is that of x₂ᵀ E x₁), squared
distance from the line [variances]."""


@njit
def locate(
    cameras: Any,
    poses: Any,
    pixels: Any,
    spreads: Any,
    outlines: Any,
    needle: Any,
    axis: Any,
    point: Any,
    covariance: Any,
    residual: Any,
    observed: Any,
    seen: Any,
) -> Any:
    """Triangulate the band, outlines moved to its centre; returns status and chi-square.

    Args:
        cameras: rows of both, see `optics.packed`, (2, CAMERA).
        poses: rotations and translations of T_camera_world, (2, 3, 4).
        pixels: (2, 2) [px].
        spreads: covariances of them [px²], (2, 2, 2).
        outlines: whether each is an outline's centroid, (2,).
        needle: a `rig.NeedleShape` as an array.
        axis: unit vector from hub to tip, (3,).
        point: out [m], (3,).
        covariance: of it, out [m²], (3, 3).
        residual: out, observed minus predicted normalised coordinates, (4,).
        observed: out, normalised coordinates, (2, 2).
        seen: out, covariances of them, (2, 2, 2).
    """
    shift = np.zeros((2, 2))
    for attempt in range(2):
        for i in range(2):
            u, v = pixels[i, 0] - shift[i, 0], pixels[i, 1] - shift[i, 1]
            if not normalise(cameras[i], u, v, spreads[i], observed[i], seen[i]):
                return NO_RAY, 0.0
        steps = _STEPS if attempt else 0
        status, square = _triangulate(poses, observed, seen, steps, point, covariance, residual)
        if status != FOUND or attempt:
            break
        for i in range(2):
            if outlines[i] and outline_shift(cameras[i], needle, point, axis, shift[i]) <= 0.0:
                return NO_OUTLINE, 0.0
    return status, square


@njit
def _triangulate(
    poses: Any, observed: Any, seen: Any, steps: int, point: Any, covariance: Any, residual: Any
) -> Any:
    """See `stereo.triangulation.triangulate`: status and chi-square."""
    rotations, translations = poses[:, :, :3], poses[:, :, 3]
    status = meet(rotations, translations, observed, point)
    if status != FOUND:
        return status, 0.0
    square, nearest, found = optimum(
        rotations,
        translations,
        observed,
        seen,
        point,
        point.copy(),
        np.zeros((3, 3)),
        steps,
        residual,
        covariance,
    )
    if nearest <= NEAREST:
        return BEHIND, 0.0
    return (FOUND if found else DEGENERATE), square


@njit
def summarise(
    point: Any,
    covariance: Any,
    residual: Any,
    observed: Any,
    square: float,
    focal: Any,
    essential: Any,
    fulcrum: Any,
    axis: Any,
    line_variance: float,
    beside: Any,
    summary: Any,
) -> bool:
    """Compare a point with the robot's line and the pictures with each other.

    Args:
        point: [m], (3,).
        covariance: of it, with the calibration's share [m²], (3, 3).
        residual: observed minus predicted normalised coordinates, (4,).
        observed: normalised coordinates, (2, 2).
        square: chi-square of the point.
        focal: of both cameras, (4,) [px].
        essential: of the pair, (3, 3).
        fulcrum: a point of the line [m], (3,).
        axis: its unit vector, (3,).
        line_variance: of the line across itself [m²].
        beside: out, from the line to the point, across it [m], (3,).
        summary: out, see SUMMARY.

    Returns:
        False where the distance from the line cannot be weighed.
    """
    along, total, miss = 0.0, 0.0, 0.0
    for k in range(3):
        along += (point[k] - fulcrum[k]) * axis[k]
    for k in range(3):
        beside[k] = point[k] - fulcrum[k] - along * axis[k]
    for k in range(4):
        total += (residual[k] * focal[k]) ** 2
    for i in range(3):
        second = observed[1, i] if i < 2 else 1.0
        for k in range(3):
            first = observed[0, k] if k < 2 else 1.0
            miss += second * essential[i, k] * first
    summary[0], summary[1] = np.sqrt(0.25 * total), np.copysign(np.sqrt(square), miss)
    spread, inverse = np.empty((3, 3)), np.empty((3, 3))
    _across(covariance, axis, line_variance, spread)
    if not inverse3(spread, inverse):
        return False
    summary[2] = 0.0
    for i in range(3):
        for k in range(3):
            summary[2] += beside[i] * inverse[i, k] * beside[k]
    return True


@njit
def _across(covariance: Any, axis: Any, line_variance: float, out: Any) -> None:
    """P Σ Pᵀ + σ² I with P = I - d dᵀ, in place."""
    turned = np.empty((3, 3))
    for i in range(3):
        for k in range(3):
            turned[i, k] = covariance[i, k]
            for j in range(3):
                turned[i, k] -= axis[i] * axis[j] * covariance[j, k]
    for i in range(3):
        for k in range(3):
            out[i, k] = turned[i, k]
            for j in range(3):
                out[i, k] -= turned[i, j] * axis[j] * axis[k]
        out[i, i] += line_variance


OUTLINE_PX = 0.1
"""What edges of the background do to an outline's centroid, standard deviation per axis [px], and
no covariance of it says: with it the ellipsoid of 95 % held the truth in 95 % of 300 pairs over
rig `wide`."""

_GROSS_PX = 2.0
_LINE_LIMIT = chi_square_quantile(1.0 - GATE, 2)
_RESIDUAL_LIMIT = chi_square_quantile(1.0 - GATE, 1)


@dataclass(frozen=True, slots=True, eq=False)
class SeenMarker:
    """What one camera shows at the time of the fix: pixel, covariance, and of what point."""

    uv: FloatArray
    covariance: FloatArray
    centre: Centre = Centre.OUTLINE

    @classmethod
    def of(cls, marker: MarkerFix) -> "SeenMarker":
        """Take them from an extractor's find; an outline's covariance grows by its edges' share."""
        edges = OUTLINE_PX**2 if marker.centre is Centre.OUTLINE else 0.0
        return cls(marker.uv, marker.covariance + edges * np.eye(2), marker.centre)


class FixSolver:
    """From two sightings and the robot's axis to the tip; holds the rig, no memory."""

    def __init__(self, rig: RigProfile, fulcrum: FloatArray) -> None:
        self._rig = rig
        self._models = rig.models
        poses = (self._models[0].T_camera_world, self._models[1].T_camera_world)
        # Read-only as `packed` is: what reads a camera is compiled once.
        self._cameras = read_only(np.array([packed(model) for model in self._models]))
        self._matrices = np.array([pose.matrix()[:3] for pose in poses])
        self._needle = np.array(rig.needle.shape)
        self._fulcrum = frozen(fulcrum, (3,), "fulcrum")
        self._systematic = systematic_px(rig) ** 2 * np.eye(2)
        self._essential = essential_matrix(poses)
        self._focal = self._cameras[:, 12:14].ravel()
        self._single = OneCameraSolver(rig, self._fulcrum, GATE, systematic_px(rig))
        self._error = (
            CalibrationUncertainty(rig.calibration) if rig.calibration is not None else None
        )
        self._line_variance = (rig.line_sd_mm * MILLIMETRE) ** 2
        self._offset_variance = rig.marker_offset_variance

    def solve(
        self,
        sightings: tuple[SeenMarker | None, SeenMarker | None],
        axis: FloatArray | None,
        time: float,
    ) -> NeedleFix:
        """Fix of one moment; every failure is a status, never an exception."""
        pixels = tuple(None if sighting is None else sighting.uv for sighting in sightings)
        first, second = sightings
        if first is None and second is None:
            return self._unseen(time)
        if axis is None or not np.isfinite(axis).all() or not np.any(axis):
            return without_point(
                FixStatus.NO_ORIENTATION,
                (pixels[0], pixels[1]),
                time,
                reason="the robot gives no needle direction",
            )
        if first is None or second is None:
            return self._by_one_camera((first, second), unit(axis), time)
        return self._solve((first, second), unit(axis), time)

    def triangulated(
        self,
        sightings: tuple[SeenMarker | MarkerFix, SeenMarker | MarkerFix],
        axis: FloatArray | None,
    ) -> Triangulation | None:
        """Point of two sightings, without the robot's line; None without one.

        With the axis outlines are moved to the band's centre; without it they are taken for it.
        """
        first, second = (SeenMarker(one.uv, one.covariance, one.centre) for one in sightings)
        found = self._located((first, second), None if axis is None else unit(axis))
        return found if found is not None and found.status is StereoStatus.FOUND else None

    def agrees(self, result: Triangulation) -> bool:
        """Return whether both pictures show one point, within their noise."""
        return result.chi_square <= _RESIDUAL_LIMIT

    def band(self, fix: NeedleFix, axis: FloatArray | None) -> FloatArray | None:
        """Centre of the band of a fix [m], shape (3,), where it has a point that counts."""
        if axis is None or not fix.usable:
            return None
        return np.asarray(fix.p_tip_world - self._rig.needle.marker_offset * unit(axis))

    def pixel(self, camera: int, p_world: FloatArray) -> FloatArray | None:
        """Return where a camera sees a point [px], shape (2,); None if it does not."""
        return self._models[camera].pixel(p_world)

    def nearest(self, camera: int, uv: FloatArray, axis: FloatArray) -> FloatArray | None:
        """Point of the needle's line that is nearest to a camera's ray [m], shape (3,).

        None where the ray runs along the line, or a pixel has none.
        """
        model, direction = self._models[camera], unit(axis)
        seen = model.ray(uv)
        if seen is None:
            return None
        sight = ray(model.T_camera_world, np.array(seen))
        if float(np.linalg.norm(np.cross(sight[1], direction))) < np.sin(LEAST_ANGLE):
            return None
        return closest((self._fulcrum, direction), sight)[0]

    def _solve(
        self, sightings: tuple[SeenMarker, SeenMarker], axis: FloatArray, time: float
    ) -> NeedleFix:
        pixels = (sightings[0].uv, sightings[1].uv)
        found = self._located(sightings, axis)
        if found is None or found.status is not StereoStatus.FOUND:
            why = (
                sentence("a pixel has no ray")
                if found is None
                else sentence("the rays are {status}", status=found.status.value)
            )
            return without_point(FixStatus.INCONSISTENT, pixels, time, reason=why)
        covariance = self._with_calibration(found)
        beside, summary = np.empty(3), np.full(SUMMARY, np.inf)
        summarise(
            found.p_world,
            covariance,
            found.residual,
            found.observations,
            found.chi_square,
            self._focal,
            self._essential,
            self._fulcrum,
            axis,
            self._line_variance,
            beside,
            summary,
        )
        residual, epipolar, off_line = (float(value) for value in summary)
        reason = _contradiction(found.chi_square, residual, beside, off_line)
        tip = found.p_world + self._rig.needle.marker_offset * axis
        covariance = self._of_tip(covariance, axis)
        return NeedleFix(
            tip,
            covariance,
            time,
            FixStatus.INCONSISTENT if reason else FixStatus.VALID,
            pixels,
            residual,
            float((tip - self._fulcrum) @ axis),
            float(axis @ covariance @ axis),
            has_point=True,
            reason=reason,
            noise_covariance=found.covariance,
            beside=beside,
            epipolar=epipolar,
            line_variance=self._line_variance,
            axis=axis,
        )

    def _located(
        self, sightings: tuple[SeenMarker, SeenMarker], axis: FloatArray | None
    ) -> Triangulation | None:
        """Point of two pixels, outlines moved to the band's centre where the axis is known.

        None if a pixel belongs to no direction (beyond the fold of the distortion).
        """
        pixels = np.array([one.uv for one in sightings])
        spreads = np.array([one.covariance for one in sightings]) + self._systematic
        known = np.zeros(3) if axis is None else axis
        outlines = np.array(
            [axis is not None and one.centre is not Centre.BAND for one in sightings]
        )
        point, covariance, residual = np.empty(3), np.empty((3, 3)), np.empty(4)
        observed, seen = np.empty((2, 2)), np.empty((2, 2, 2))
        status, square = locate(
            self._cameras,
            self._matrices,
            pixels,
            spreads,
            outlines,
            self._needle,
            known,
            point,
            covariance,
            residual,
            observed,
            seen,
        )
        if status in (NO_RAY, NO_OUTLINE):
            return None
        return triangulation(status, point, covariance, square, residual, observed, seen)

    def _with_calibration(self, result: Triangulation) -> FloatArray:
        if self._error is None:
            return result.covariance
        return result.covariance + self._error.covariance(result.p_world, result.covariances)

    def _of_tip(self, band: FloatArray, axis: FloatArray) -> FloatArray:
        """Covariance of the tip from that of the band [m²]: its place along the shaft is added."""
        return band + self._offset_variance * np.outer(axis, axis)

    def residual_px(self, result: Triangulation) -> float:
        """Root mean square of the reprojection error of a point [px]."""
        return float(np.sqrt(np.mean((result.residual * self._focal) ** 2)))

    def _unseen(self, time: float) -> NeedleFix:
        return without_point(
            FixStatus.OUT_OF_VIEW,
            (None, None),
            time,
            tuple(model.name for model in self._models),
            "the marker is out of view of either camera",
        )

    def _by_one_camera(
        self, sightings: tuple[SeenMarker | None, SeenMarker | None], axis: FloatArray, time: float
    ) -> NeedleFix:
        camera, sighting = next((i, s) for i, s in enumerate(sightings) if s is not None)
        pixels = (sighting.uv, None) if camera == 0 else (None, sighting.uv)
        missing = (self._models[1 - camera].name,)
        outline = sighting.centre is Centre.OUTLINE
        found = self._single.solve(camera, sighting.uv, sighting.covariance, axis, outline)
        if found.point is None:
            return without_point(FixStatus.ONE_CAMERA, pixels, time, missing, found.reason)
        band = found.point.covariance if found.covariance is None else found.covariance
        covariance = self._of_tip(band, axis)
        tip = found.point.p_world + self._rig.needle.marker_offset * axis
        residual = found.point.residual * self._models[camera].intrinsics[:2]
        return NeedleFix(
            tip,
            covariance,
            time,
            FixStatus.ONE_CAMERA if found.consistent else FixStatus.INCONSISTENT,
            pixels,
            float(np.sqrt(np.mean(residual**2))),
            float((tip - self._fulcrum) @ axis),
            float(axis @ covariance @ axis),
            missing,
            has_point=True,
            reason=found.reason,
            noise_covariance=found.point.covariance,
            axis=axis,
        )


def systematic_px(rig: RigProfile) -> float:
    """Error of a pixel that no picture's noise explains, standard deviation per axis [px].

    The rig's own figure, and what the calibration's lens models leave besides the noise of its
    corners; the whole residual where a file does not tell the two apart.
    """
    known = rig.calibration
    left = 0.0
    if known is not None:
        left = known.rms_px / np.sqrt(2.0) if known.misfit_px is None else known.misfit_px
    return float(np.hypot(rig.systematic_px, left))


def _contradiction(square: float, residual: float, beside: FloatArray, off_line: float) -> str:
    """Return why the point cannot be the marker; empty if it can.

    Args:
        square: chi-square of the point.
        residual: root mean square [px].
        beside: from the robot's line to the point, across it [m], (3,).
        off_line: square of that [variances].
    """
    apart, off = square > _RESIDUAL_LIMIT, not off_line <= _LINE_LIMIT
    if apart and (residual > _GROSS_PX or not off):
        return sentence(
            "the pictures disagree by {residual:.1f} px: two red things, or a moved camera",
            residual=residual,
        )
    if off:  # a wrong axis also spoils the outline correction, by a pixel at most
        distance = float(np.linalg.norm(beside)) / MILLIMETRE
        return sentence(
            "the marker seems {distance:.1f} mm beside the needle's line", distance=distance
        )
    return ""
