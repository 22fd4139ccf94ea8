"""Where a board that lies still is, from pictures of one or both calibrated cameras.

Least squares of the reprojection error by Gauss-Newton over the pose T_left_board = exp(ξ)·T and,
where both cameras see the board, over the factor s by which it is larger than it should be:

    p = R·(s·X) + t,   ∂p/∂ξ = [I, -[p]×],   ∂p/∂s = R·X,   x = p_xy / p_z.

Where the cameras are taken a little wrongly the board is found a little elsewhere: with r the
residual and J = ∂x/∂ξ, ∂ξ/∂θ = (Jᵀ J)⁻¹ Jᵀ ∂r/∂θ. What is measured later errs with the same
cameras.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.tracking.calibration.applies import require_size
from app.tracking.calibration.sightings import project_with_derivatives
from app.tracking.calibration.views import BoardView
from app.tracking.errors import CalibrationError
from app.tracking.optics.calibration import StereoCalibration

Pair = tuple[BoardView | None, BoardView | None]
"""What the left and the right camera see of the board at one time."""

_STEPS: Final = 20
_NEAREST: Final = 1e-3
"""Depth [m] in front of a camera below which a board cannot be."""


@dataclass(frozen=True, slots=True, eq=False)
class BoardRays:
    """Corners in one camera.

    Attributes:
        camera: 0 left, 1 right.
        points: in the board's frame [m], (n, 3).
        rays: undistorted normalised coordinates, (n, 2).
        focal: fx, fy [px].
        name: of the picture.
    """

    camera: int
    points: FloatArray
    rays: FloatArray
    focal: FloatArray
    name: str


@dataclass(frozen=True, slots=True, eq=False)
class FittedBoardPose:
    """Result of a fit.

    Attributes:
        T_left_board: pose of the board in the left camera.
        covariance: of its twist on the left, (6, 6), from the scatter of the corners alone.
        by_cameras: change of that twist with what `StereoCalibration.covariance` is of, (6, 24).
        rms_px: root mean square distance of the corners to their prediction (2D).
        by_picture: the same, picture by picture: (name, rms).
        scale: size of the board over its true size; None if only one camera saw it.
        scale_sd: standard deviation of `scale`.
    """

    T_left_board: RigidTransform
    covariance: FloatArray
    by_cameras: FloatArray
    rms_px: float
    by_picture: tuple[tuple[str, float], ...]
    scale: float | None
    scale_sd: float


def board_rays(calibration: StereoCalibration, pairs: Sequence[Pair]) -> list[BoardRays]:
    """Corners of all pictures as rays; those beyond the distortion's fold are left out.

    Raises:
        CalibrationError: if a picture has another size than its camera was calibrated at, or no
            picture shows the board.
    """
    models = calibration.models()
    found = []
    for pair in pairs:
        for i, view in enumerate(pair):
            if view is None:
                continue
            require_size(calibration.cameras[i], view.image_size, view.name or "the picture")
            rays, exists = models[i].undistort(view.pixels)
            if int(exists.sum()) >= 4:
                name = view.name or calibration.cameras[i].name
                focal = models[i].intrinsics[:2]
                found.append(BoardRays(i, view.points[exists], rays[exists], focal, name))
    if not found:
        raise CalibrationError(
            sentence("no picture shows the board: take one with all of it in view")
        )
    return found


def fit_pose(calibration: StereoCalibration, seen: Sequence[BoardRays]) -> FittedBoardPose:
    """Fit the pose of a board that lay still in all these pictures.

    Raises:
        CalibrationError: if no pose in front of the cameras explains them.
    """
    T_right_left = calibration.pose.transform
    fits = []
    for start in _starts(seen, T_right_left):
        fit = _descend(seen, T_right_left, start, 1.0, scaled=False)
        if fit is not None:
            fits.append(fit)
    if not fits:
        raise CalibrationError(
            sentence(
                "no place in front of the cameras explains the corners; are the pictures of "
                "these cameras, left and right not exchanged?"
            )
        )
    pose, _, residual, jacobian = min(fits, key=lambda fit: float(fit[2] @ fit[2]))
    freedom = max(1, residual.size - 6)
    inverse = np.linalg.inv(jacobian.T @ jacobian)
    covariance = inverse * float(residual @ residual) / freedom
    by_cameras = inverse @ jacobian.T @ _by_cameras(calibration, seen, pose)
    scale, scale_sd = _scale(seen, T_right_left, pose)
    return FittedBoardPose(
        pose, covariance, by_cameras, _rms(residual), _by_picture(seen, residual), scale, scale_sd
    )


def _by_cameras(
    calibration: StereoCalibration, seen: Sequence[BoardRays], pose: RigidTransform
) -> FloatArray:
    """Change of the residual with both cameras' parameters and T_right_left's twist, (2n, 24)."""
    T_right_left, parts = calibration.pose.transform, []
    for one in seen:
        camera = calibration.cameras[one.camera]
        parameters = np.concatenate([camera.intrinsics, camera.distortion])
        rays = np.column_stack([one.rays, np.ones(len(one.rays))])
        _, by_ray, by_parameter = project_with_derivatives(rays, parameters)
        change = np.zeros((len(rays), 2, len(calibration.covariance)))
        first = one.camera * len(calibration.cameras[0].lens.parameters)
        own = slice(first, first + len(parameters))
        change[:, :, own] = -np.linalg.solve(by_ray[:, :, :2], by_parameter)
        if one.camera == 1:
            p_right = T_right_left @ (pose @ one.points)
            moved = np.concatenate(
                [np.tile(np.eye(3), (len(p_right), 1, 1)), -_skews(p_right)],
                axis=2,
            )
            change[:, :, -6:] = -_by_ray(p_right, moved)
        parts.append((change * one.focal[:, None]).reshape(2 * len(rays), -1))
    return np.concatenate(parts)


def _skews(points: FloatArray) -> FloatArray:
    """Matrices [p]x of points, (n, 3) -> (n, 3, 3)."""
    return np.asarray(np.cross(np.eye(3), points[:, None, :]).swapaxes(1, 2) * -1.0)


def _by_ray(points: FloatArray, by: FloatArray) -> FloatArray:
    """Change of p_xy / p_z where that of p, (n, 3, k), is known, (n, 2, k)."""
    z = points[:, 2]
    xy = points[:, :2] / z[:, None]
    return np.asarray((by[:, :2] - xy[:, :, None] * by[:, 2:]) / z[:, None, None])


def _starts(seen: Sequence[BoardRays], T_right_left: RigidTransform) -> list[RigidTransform]:
    """Both poses that a single picture of a plane allows."""
    first = max(seen, key=lambda one: len(one.points))
    result = cv2.solvePnPGeneric(
        first.points, first.rays[:, None, :], np.eye(3), None, flags=cv2.SOLVEPNP_IPPE
    )
    to_left = RigidTransform.identity() if first.camera == 0 else T_right_left.inverse()
    poses = []
    for turn, shift in zip(result[1], result[2], strict=True):
        rotation, _ = cv2.Rodrigues(turn)
        u, _, vt = np.linalg.svd(rotation)
        poses.append(to_left @ RigidTransform(u @ vt, np.ravel(shift)))
    return poses


_Fit = tuple[RigidTransform, float, FloatArray, FloatArray]


def _descend(
    seen: Sequence[BoardRays],
    T_right_left: RigidTransform,
    pose: RigidTransform,
    scale: float,
    scaled: bool,
) -> _Fit | None:
    """Gauss-Newton; a step that does not lower the error is halved, then the end is reached."""
    system = _system(seen, T_right_left, pose, scale)
    if system is None:
        return None
    residual, jacobian = system
    columns = 7 if scaled else 6
    for _ in range(_STEPS):
        step = np.linalg.lstsq(jacobian[:, :columns], residual, rcond=None)[0]
        for factor in (1.0, 0.5, 0.25, 0.0625):
            new_pose = RigidTransform.exp(factor * step[:6]) @ pose
            new_scale = scale + (factor * float(step[6]) if scaled else 0.0)
            system = _system(seen, T_right_left, new_pose, new_scale)
            if system is not None and system[0] @ system[0] < residual @ residual:
                break
        else:
            break
        better = residual @ residual - system[0] @ system[0] > 1e-12 * (residual @ residual)
        pose, scale, (residual, jacobian) = new_pose, new_scale, system
        if not better:
            break
    return pose, scale, residual, jacobian[:, :columns]


def _system(
    seen: Sequence[BoardRays], T_right_left: RigidTransform, pose: RigidTransform, scale: float
) -> tuple[FloatArray, FloatArray] | None:
    """Residual observed minus predicted [px], (2n,), and Jacobian by (ξ, s), (2n, 7)."""
    residuals, jacobians = [], []
    for one in seen:
        turned = pose.rotate(one.points)
        p_left = scale * turned + pose.translation
        by_left = np.zeros((len(p_left), 3, 7))
        by_left[:, :, :3] = np.eye(3)
        by_left[:, :, 3:6] = -_skews(p_left)
        by_left[:, :, 6] = turned
        p, by = p_left, by_left
        if one.camera == 1:
            p, by = T_right_left @ p_left, T_right_left.rotation @ by_left
        z = p[:, 2]
        if z.min() < _NEAREST or not np.isfinite(p).all():
            return None
        xy = p[:, :2] / z[:, None]
        residuals.append(((one.rays - xy) * one.focal).ravel())
        jacobians.append((_by_ray(p, by) * one.focal[:, None]).reshape(-1, 7))
    return np.concatenate(residuals), np.concatenate(jacobians)


def _scale(
    seen: Sequence[BoardRays], T_right_left: RigidTransform, pose: RigidTransform
) -> tuple[float | None, float]:
    if {one.camera for one in seen} != {0, 1}:
        return None, 0.0
    fit = _descend(seen, T_right_left, pose, 1.0, scaled=True)
    if fit is None:
        return None, 0.0
    _, scale, residual, jacobian = fit
    covariance = np.linalg.inv(jacobian.T @ jacobian)
    variance = float(residual @ residual) / max(1, residual.size - 7)
    return scale, float(np.sqrt(covariance[6, 6] * variance))


def _rms(residual: FloatArray) -> float:
    return float(np.sqrt(2.0 * np.mean(residual**2)))


def _by_picture(seen: Sequence[BoardRays], residual: FloatArray) -> tuple[tuple[str, float], ...]:
    ends = np.cumsum([2 * len(one.points) for one in seen])[:-1]
    parts = np.split(residual, ends)
    return tuple((one.name, _rms(part)) for one, part in zip(seen, parts, strict=True))
