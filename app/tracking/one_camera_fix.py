"""The tip from one camera and the robot's line, while the other camera does not show the marker.

The ray leaves one direction open, the line by the robot another. Both together are a least squares
problem with the point p as unknown,

    minimise  rᵀ Σ_ray⁻¹ r  +  |(I - d̂d̂ᵀ)(p - P_I)|² / σ_line²,

whose inverse information is the point's covariance. Where the ray runs nearly along the shaft the
two say the same, and the place along it stays open: such a point is refused.
"""

from dataclasses import dataclass
from enum import StrEnum
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.core.units import DEGREE, MILLIMETRE
from app.tracking.confidence import chi_square_quantile
from app.tracking.markers.silhouette import centroid_shift
from app.tracking.optics.rig import RigProfile
from app.tracking.stereo.calibration_uncertainty import CalibrationUncertainty
from app.tracking.stereo.closed_form import closest, ray
from app.tracking.stereo.epipolar import normalised
from app.tracking.stereo.reprojection import NEAREST, refine

LEAST_ANGLE: Final = 15.0 * DEGREE
"""Angle between ray and shaft [rad] below which there is no point: there an error of the line
counts four times along the needle."""


class RayStatus(StrEnum):
    """What became of a ray and the shaft's line."""

    FOUND = "found"
    ALONG_THE_SHAFT = "along_the_shaft"  # the camera looks along the needle
    BEHIND = "behind"  # the line passes the ray behind the camera
    NOT_FINITE = "not_finite"


@dataclass(frozen=True, slots=True, eq=False)
class LinePoint:
    """A point seen by one camera on a line.

    Attributes:
        status: the rest means something only for `found`.
        p_world: the point [m], shape (3,).
        covariance: of the point [m²], shape (3, 3).
        chi_square: squared, weighted distance of ray and line, one degree of freedom.
        residual: observed minus predicted normalised coordinates, shape (2,).
    """

    status: RayStatus
    p_world: FloatArray
    covariance: FloatArray
    chi_square: float
    residual: FloatArray


def point_on_line(
    T_camera_world: RigidTransform,
    observation: FloatArray,
    covariance: FloatArray,
    line: tuple[FloatArray, FloatArray],
    line_variance: float,
) -> LinePoint:
    """Point on a line that one camera sees.

    Args:
        T_camera_world: of the camera.
        observation: normalised coordinates, shape (2,).
        covariance: of the observation, shape (2, 2), positive definite.
        line: a point of it [m] and its unit direction, both shape (3,).
        line_variance: of the line's place across itself, per axis [m²].
    """
    if not (np.isfinite(observation).all() and np.isfinite(line[0]).all()):
        return _nothing(RayStatus.NOT_FINITE)
    seen = ray(T_camera_world, observation)
    if float(np.linalg.norm(np.cross(seen[1], line[1]))) < np.sin(LEAST_ANGLE):
        return _nothing(RayStatus.ALONG_THE_SHAFT)
    start = closest(seen, line)[1]
    poses, observed = (T_camera_world,), np.asarray(observation)[None]
    prior = (np.eye(3) - np.outer(line[1], line[1])) / line_variance
    p_world, spread, chi_square, nearest, residual = refine(
        poses, observed, np.asarray(covariance)[None], start, (line[0], prior)
    )
    if nearest <= NEAREST:
        return _nothing(RayStatus.BEHIND)
    if spread is None:
        return _nothing(RayStatus.ALONG_THE_SHAFT)
    return LinePoint(
        RayStatus.FOUND, read_only(p_world), read_only(spread), chi_square, read_only(residual)
    )


def _nothing(status: RayStatus) -> LinePoint:
    zero = np.zeros(3)
    return LinePoint(
        status, read_only(zero), read_only(np.zeros((3, 3))), 0.0, read_only(np.zeros(2))
    )


@dataclass(frozen=True, slots=True, eq=False)
class OneEyed:
    """What one camera tells of the band.

    Attributes:
        point: the band's centre; None if there is none.
        consistent: whether ray and line meet as well as both are known.
        reason: one line for people about the point, or why there is none.
        covariance: of the point with the calibration's error [m²]; None without a point.
    """

    point: LinePoint | None
    consistent: bool
    reason: str
    covariance: FloatArray | None = None


class OneCameraSolver:
    """Finds the band on the needle's line in one camera's picture; no memory."""

    def __init__(
        self, rig: RigProfile, fulcrum: FloatArray, gate: float, systematic_px: float
    ) -> None:
        self._models = rig.models
        self._shape = rig.needle.shape
        self._fulcrum = fulcrum
        self._systematic = systematic_px**2 * np.eye(2)
        self._line_variance = (rig.line_sd_mm * MILLIMETRE) ** 2
        self._error = (
            CalibrationUncertainty(rig.calibration) if rig.calibration is not None else None
        )
        self._limit = chi_square_quantile(1.0 - gate, 1)

    def solve(
        self,
        camera: int,
        uv: FloatArray,
        covariance: FloatArray,
        axis: FloatArray,
        outline: bool = True,
    ) -> OneEyed:
        """Find the band.

        Args:
            camera: 0 or 1, which one shows the marker.
            uv: pixel [px], shape (2,).
            covariance: of it [px²], shape (2, 2).
            axis: unit direction of the needle, hub to tip.
            outline: whether the pixel is the centroid of the outline; else the band's centre.
        """
        name, other = self._models[camera].name, self._models[1 - camera].name
        lost = sentence("the marker is out of view of the {other} camera", other=other)
        point = self._point(camera, uv, covariance, axis, np.zeros(2))
        if outline and point is not None and point.status is RayStatus.FOUND:
            shift = centroid_shift(self._models[camera], self._shape, point.p_world, axis)
            point = shift if shift is None else self._point(camera, uv, covariance, axis, shift)
        if point is None:
            return OneEyed(
                None,
                True,
                sentence("{lost}; the {name} camera's pixel has no ray", lost=lost, name=name),
            )
        if point.status is RayStatus.ALONG_THE_SHAFT:
            return OneEyed(
                None,
                True,
                sentence(
                    "{lost}, and the {name} camera looks along the needle, within "
                    "{least_angle_deg:.0f}°: it cannot tell the depth",
                    lost=lost,
                    name=name,
                    least_angle_deg=np.degrees(LEAST_ANGLE),
                ),
            )
        if point.status is not RayStatus.FOUND:
            return OneEyed(
                None,
                True,
                sentence(
                    "{lost}; the {name} camera sees it off the needle's line", lost=lost, name=name
                ),
            )
        if point.chi_square > self._limit:
            pixels = float(np.linalg.norm(point.residual * self._models[camera].intrinsics[:2]))
            return OneEyed(
                point,
                False,
                sentence(
                    "{lost}; the {name} camera sees it {pixels:.1f} px beside the needle's line",
                    lost=lost,
                    name=name,
                    pixels=pixels,
                ),
                point.covariance,
            )
        return OneEyed(
            point,
            True,
            sentence(
                "{lost}: depth by the {name} camera and the needle's line", lost=lost, name=name
            ),
            self._with_calibration(camera, point, covariance, axis),
        )

    def _with_calibration(
        self, camera: int, point: LinePoint, covariance: FloatArray, axis: FloatArray
    ) -> FloatArray:
        if self._error is None:
            return point.covariance
        model = self._models[camera]
        p_camera = model.T_camera_world @ point.p_world
        jacobian = model.ray_jacobian(p_camera[:2] / p_camera[2])
        seen = jacobian @ (covariance + self._systematic) @ jacobian.T
        prior = (np.eye(3) - np.outer(axis, axis)) / self._line_variance
        return point.covariance + self._error.covariance(
            point.p_world, seen[None], (camera,), prior
        )

    def _point(
        self,
        camera: int,
        uv: FloatArray,
        covariance: FloatArray,
        axis: FloatArray,
        shift: FloatArray,
    ) -> LinePoint | None:
        model = self._models[camera]
        found = normalised(model, uv - shift, covariance + self._systematic)
        if found is None:
            return None
        line = (self._fulcrum, axis)
        return point_on_line(model.T_camera_world, *found, line, self._line_variance)
