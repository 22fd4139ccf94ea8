"""From what both cameras show and the robot's axis to the needle's tip."""

from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray, frozen, unit
from app.core.units import MILLIMETRE
from app.tracking.confidence import chi_square_quantile
from app.tracking.fix import GATE, FixStatus, NeedleFix, without_point
from app.tracking.markers.extractor import Centre, MarkerFix
from app.tracking.one_camera_fix import OneCameraSolver
from app.tracking.optics.packed import packed
from app.tracking.optics.rig import RigProfile
from app.tracking.pair_kernels import NO_OUTLINE, NO_RAY, SUMMARY, locate, summarise
from app.tracking.stereo.calibration_uncertainty import CalibrationUncertainty
from app.tracking.stereo.epipolar import essential_matrix
from app.tracking.stereo.triangulation import StereoStatus, Triangulation, triangulation

OUTLINE_PX = 0.1
"""What edges of the background do to an outline's centroid, standard deviation per axis [px], and
no covariance of it says: with it the ellipsoid of 95 % held the truth in 95 % of 300 pairs over
rig `wide`."""

_GROSS_PX = 2.0
_LINE_LIMIT = chi_square_quantile(1.0 - GATE, 2)
_RESIDUAL_LIMIT = chi_square_quantile(1.0 - GATE, 1)


@dataclass(frozen=True, slots=True, eq=False)
class Sighting:
    """What one camera shows at the time of the fix: pixel, covariance, and of what point."""

    uv: FloatArray
    covariance: FloatArray
    centre: Centre = Centre.OUTLINE

    @classmethod
    def of(cls, marker: MarkerFix) -> "Sighting":
        """Take them from an extractor's find; an outline's covariance grows by its edges' share."""
        edges = OUTLINE_PX**2 if marker.centre is Centre.OUTLINE else 0.0
        return cls(marker.uv, marker.covariance + edges * np.eye(2), marker.centre)


class FixSolver:
    """From two sightings and the robot's axis to the tip; holds the rig, no memory."""

    def __init__(self, rig: RigProfile, fulcrum: FloatArray) -> None:
        self._rig = rig
        self._models = rig.models
        poses = (self._models[0].T_camera_world, self._models[1].T_camera_world)
        self._cameras = np.array([packed(model) for model in self._models])
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

    def solve(
        self,
        sightings: tuple[Sighting | None, Sighting | None],
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
            return self._one_eyed((first, second), unit(axis), time)
        return self._solve((first, second), unit(axis), time)

    def triangulated(
        self,
        sightings: tuple[Sighting | MarkerFix, Sighting | MarkerFix],
        axis: FloatArray | None,
    ) -> Triangulation | None:
        """Point of two sightings, without the robot's line; None without one.

        With the axis outlines are moved to the band's centre; without it they are taken for it.
        """
        first, second = (Sighting(one.uv, one.covariance, one.centre) for one in sightings)
        found = self._located((first, second), None if axis is None else unit(axis))
        return found if found is not None and found.status is StereoStatus.FOUND else None

    def agrees(self, found: Triangulation) -> bool:
        """Whether both pictures show one point, within their noise."""
        return found.chi_square <= _RESIDUAL_LIMIT

    def band(self, fix: NeedleFix, axis: FloatArray | None) -> FloatArray | None:
        """Centre of the band of a fix [m], shape (3,), where it has a point that counts."""
        if axis is None or not fix.usable:
            return None
        return np.asarray(fix.p_tip_world - self._rig.needle.marker_offset * unit(axis))

    def pixel(self, camera: int, p_world: FloatArray) -> FloatArray | None:
        """Where a camera sees a point [px], shape (2,); None if it does not."""
        return self._models[camera].pixel(p_world)

    def _solve(
        self, sightings: tuple[Sighting, Sighting], axis: FloatArray, time: float
    ) -> NeedleFix:
        pixels = (sightings[0].uv, sightings[1].uv)
        found = self._located(sightings, axis)
        if found is None or found.status is not StereoStatus.FOUND:
            why = "a pixel has no ray" if found is None else f"the rays are {found.status.value}"
            return without_point(FixStatus.INCONSISTENT, pixels, time, reason=why)
        covariance = self._with_calibration(found)
        beside, summary = np.empty(3), np.full(SUMMARY, np.inf)
        summarise(
            found.p_world, covariance, found.residual, found.observations, found.chi_square,
            self._focal, self._essential, self._fulcrum, axis, self._line_variance, beside, summary,
        )  # fmt: skip
        residual, epipolar, off_line = (float(value) for value in summary)
        reason = _contradiction(found.chi_square, residual, beside, off_line)
        tip = found.p_world + self._rig.needle.marker_offset * axis
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
        self, sightings: tuple[Sighting, Sighting], axis: FloatArray | None
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
            self._cameras, self._matrices, pixels, spreads, outlines, self._needle, known,
            point, covariance, residual, observed, seen,
        )  # fmt: skip
        if status in (NO_RAY, NO_OUTLINE):
            return None
        return triangulation(status, point, covariance, square, residual, observed, seen)

    def _with_calibration(self, found: Triangulation) -> FloatArray:
        if self._error is None:
            return found.covariance
        return found.covariance + self._error.covariance(found.p_world, found.covariances)

    def residual_px(self, found: Triangulation) -> float:
        """Root mean square of the reprojection error of a point [px]."""
        return float(np.sqrt(np.mean((found.residual * self._focal) ** 2)))

    def _unseen(self, time: float) -> NeedleFix:
        return without_point(
            FixStatus.OUT_OF_VIEW,
            (None, None),
            time,
            tuple(model.name for model in self._models),
            "the marker is out of view of either camera",
        )

    def _one_eyed(
        self, sightings: tuple[Sighting | None, Sighting | None], axis: FloatArray, time: float
    ) -> NeedleFix:
        camera, sighting = next((i, s) for i, s in enumerate(sightings) if s is not None)
        pixels = (sighting.uv, None) if camera == 0 else (None, sighting.uv)
        missing = (self._models[1 - camera].name,)
        outline = sighting.centre is Centre.OUTLINE
        found = self._single.solve(camera, sighting.uv, sighting.covariance, axis, outline)
        if found.point is None:
            return without_point(FixStatus.ONE_CAMERA, pixels, time, missing, found.reason)
        covariance = found.point.covariance if found.covariance is None else found.covariance
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

    The rig's own figure, and what the calibration's residual says that its model leaves.
    """
    left = rig.calibration.rms_px / np.sqrt(2.0) if rig.calibration is not None else 0.0
    return float(np.hypot(rig.systematic_px, left))


def _contradiction(square: float, residual: float, beside: FloatArray, off_line: float) -> str:
    """Why the point cannot be the marker; empty if it can.

    Args:
        square: chi-square of the point.
        residual: root mean square [px].
        beside: from the robot's line to the point, across it [m], (3,).
        off_line: square of that [variances].
    """
    apart, off = square > _RESIDUAL_LIMIT, not off_line <= _LINE_LIMIT
    if apart and (residual > _GROSS_PX or not off):
        return f"the pictures disagree by {residual:.1f} px: two red things, or a moved camera"
    if off:  # a wrong axis also spoils the outline correction, by a pixel at most
        distance = float(np.linalg.norm(beside)) / MILLIMETRE
        return f"the marker seems {distance:.1f} mm beside the needle's line"
    return ""
