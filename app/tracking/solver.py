"""From what both cameras show and the robot's axis to the needle's tip."""

from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray, frozen, unit
from app.core.units import MILLIMETRE
from app.tracking.confidence import chi_square_quantile
from app.tracking.fix import FixStatus, NeedleFix, without_point
from app.tracking.fusion import GATE
from app.tracking.markers.extractor import Centre, MarkerFix
from app.tracking.markers.silhouette import centroid_shift
from app.tracking.one_camera_fix import OneCameraSolver
from app.tracking.optics.rig import RigProfile
from app.tracking.stereo.calibration_uncertainty import CalibrationUncertainty
from app.tracking.stereo.epipolar import essential_matrix
from app.tracking.stereo.rays import normalised
from app.tracking.stereo.triangulation import StereoStatus, Triangulation, Way, triangulate

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
        self._poses = (self._models[0].T_camera_world, self._models[1].T_camera_world)
        self._fulcrum = frozen(fulcrum, (3,), "fulcrum")
        self._systematic = systematic_px(rig) ** 2 * np.eye(2)
        self._essential = essential_matrix(self._poses)
        self._focal = np.concatenate([model.intrinsics[:2] for model in self._models])
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
        found = self._triangulate((first, second), (np.zeros(2), np.zeros(2)))
        if axis is not None and found is not None and found.status is StereoStatus.FOUND:
            found = self._corrected((first, second), found.p_world, axis)
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
        found = self._triangulate(sightings, (np.zeros(2), np.zeros(2)), Way.MIDPOINT)
        if found is not None and found.status is StereoStatus.FOUND:
            found = self._corrected(sightings, found.p_world, axis)
        if found is None or found.status is not StereoStatus.FOUND:
            why = "a pixel has no ray" if found is None else f"the rays are {found.status.value}"
            return without_point(FixStatus.INCONSISTENT, pixels, time, reason=why)
        covariance = self._with_calibration(found)
        reason = self._contradiction(found, covariance, axis)
        tip = found.p_world + self._rig.needle.marker_offset * axis
        return NeedleFix(
            tip,
            covariance,
            time,
            FixStatus.INCONSISTENT if reason else FixStatus.VALID,
            pixels,
            self.residual_px(found),
            float((tip - self._fulcrum) @ axis),
            float(axis @ covariance @ axis),
            has_point=True,
            reason=reason,
            noise_covariance=found.covariance,
            beside=_across(found.p_world - self._fulcrum, axis),
            epipolar=self._signed(found),
            line_variance=self._line_variance,
            axis=axis,
        )

    def _signed(self, found: Triangulation) -> float:
        """Root of chi-square with the sign of x₂ᵀ E x₁ [standard deviations]."""
        first, second = (np.append(xy, 1.0) for xy in found.observations)
        return float(np.copysign(np.sqrt(found.chi_square), second @ self._essential @ first))

    def _corrected(
        self, sightings: tuple[Sighting, Sighting], p_world: FloatArray, axis: FloatArray
    ) -> Triangulation | None:
        """Triangulate again with the outlines' centroids moved to the band's centre."""
        shape = self._rig.needle.shape
        first, second = (
            np.zeros(2)
            if sighting.centre is Centre.BAND
            else centroid_shift(model, shape, p_world, axis)
            for model, sighting in zip(self._models, sightings, strict=True)
        )
        if first is None or second is None:
            return None
        return self._triangulate(sightings, (first, second))

    def _triangulate(
        self,
        sightings: tuple[Sighting, Sighting],
        shifts: tuple[FloatArray, FloatArray],
        way: Way = Way.REPROJECTION,
    ) -> Triangulation | None:
        """None if a pixel belongs to no direction (beyond the fold of the distortion)."""
        rays, covariances = np.empty((2, 2)), np.empty((2, 2, 2))
        for i, (model, sighting, shift) in enumerate(
            zip(self._models, sightings, shifts, strict=True)
        ):
            found = normalised(model, sighting.uv - shift, sighting.covariance + self._systematic)
            if found is None:
                return None
            rays[i], covariances[i] = found
        return triangulate(self._poses, rays, covariances, way)

    def _with_calibration(self, found: Triangulation) -> FloatArray:
        if self._error is None:
            return found.covariance
        return found.covariance + self._error.covariance(found.p_world, found.covariances)

    def _contradiction(self, found: Triangulation, covariance: FloatArray, axis: FloatArray) -> str:
        """Why the point cannot be the marker; empty if it can."""
        residual = self.residual_px(found)
        beside = _across(found.p_world - self._fulcrum, axis)
        across = np.eye(3) - np.outer(axis, axis)
        spread = across @ covariance @ across + self._line_variance * np.eye(3)
        off_line = float(beside @ np.linalg.solve(spread, beside)) > _LINE_LIMIT
        apart = found.chi_square > _RESIDUAL_LIMIT
        if apart and (residual > _GROSS_PX or not off_line):
            return f"the pictures disagree by {residual:.1f} px: two red things, or a moved camera"
        if off_line:  # a wrong axis also spoils the outline correction, by a pixel at most
            distance = float(np.linalg.norm(beside)) / MILLIMETRE
            return f"the marker seems {distance:.1f} mm beside the needle's line"
        return ""

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


def _across(offset: FloatArray, axis: FloatArray) -> FloatArray:
    return np.asarray(offset - (offset @ axis) * axis)
