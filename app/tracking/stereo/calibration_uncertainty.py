"""What an uncertain calibration does to a triangulated point.

The point is where the gradient of the weighted reprojection error vanishes, g(p, θ) = Jᵀ W r = 0,
so by the implicit function theorem (residuals are small: Gauss–Newton's Hessian)

    ∂p/∂θ = H⁻¹ Jᵀ W ∂r/∂θ,   H = Jᵀ W J (+ the prior's information),   Σ = ∂p/∂θ Σ_θ ∂p/∂θᵀ

with r = observed minus predicted normalised coordinates, and the parameters θ: intrinsics and lens
of either camera (9 of the usual lens: 30 in all), the pose of the right camera in the left one's
frame, and that of the left one in world. Cameras and relative pose have the covariance of their
common estimate, where the calibration keeps it (lenses and pose make up for each other), and so has
the world frame, which these cameras found: near the board that gave it their errors hardly count.
Otherwise each has its own.

This error is the same in every picture of a place: a bias, not noise. It must not be averaged away.
"""

import numpy as np

from app.core.arrays import FloatArray, read_only
from app.core.rotation import skew
from app.tracking.optics.calibration import StereoCalibration
from app.tracking.optics.distortion import distort_with_derivatives
from app.tracking.stereo.reprojection import inverse, reprojection

_REUSED = 2e-3
"""How far [m] a point may move before its sensitivities are computed anew: they change by 1 %."""

_ALIKE = 0.1
"""By how much of the largest any entry of the pixels' covariances may differ meanwhile: they are
the weights of both cameras, by which the point divides their errors."""


class CalibrationUncertainty:
    """Covariance of triangulated points from that of a calibration; remembers the last place."""

    def __init__(self, calibration: StereoCalibration) -> None:
        self._models = calibration.models()
        left, right = (len(camera.lens.parameters) for camera in calibration.cameras)
        self._lenses = slice(0, left), slice(left, left + right)
        self._pose = slice(left + right, left + right + 6)
        self._world = slice(self._pose.stop, self._pose.stop + 6)
        self._spread = calibration.covariance_with_world
        self._last: dict[tuple[int, ...], tuple[FloatArray, FloatArray, FloatArray]] = {}

    def covariance(
        self,
        p_world: FloatArray,
        covariances: FloatArray,
        cameras: tuple[int, ...] = (0, 1),
        prior: FloatArray | None = None,
    ) -> FloatArray:
        """Covariance of a point by the calibration alone [m²], shape (3, 3).

        Args:
            p_world: the point [m], shape (3,).
            covariances: of the normalised coordinates that it was found from, shape (n, 2, 2).
            cameras: which of the two saw it.
            prior: information that the shaft's line added [1/m²], shape (3, 3), or None.
        """
        known = self._last.get(cameras)
        if known is not None and _near(known[0], p_world) and _alike(known[1], covariances):
            return known[2]
        gain = self._gain(p_world, covariances, cameras, prior)
        spread = read_only(gain @ self._spread @ gain.T)
        self._last[cameras] = (np.array(p_world), np.array(covariances), spread)
        return spread

    def joint(self, points: FloatArray, covariances: FloatArray) -> FloatArray:
        """Covariance of several points together by the calibration [m²], shape (3 n, 3 n).

        Points near each other are wrong by nearly the same: their difference is far more certain.

        Args:
            points: that both cameras saw [m], shape (n, 3).
            covariances: of their normalised coordinates, shape (n, 2, 2, 2).
        """
        pairs = zip(points, covariances, strict=True)
        gain = np.vstack([self._gain(p_world, seen, (0, 1), None) for p_world, seen in pairs])
        return np.asarray(gain @ self._spread @ gain.T)

    def _gain(
        self,
        p_world: FloatArray,
        covariances: FloatArray,
        cameras: tuple[int, ...],
        prior: FloatArray | None,
    ) -> FloatArray:
        """∂p/∂θ, shape (3, parameters); zero where the point is not determined at all."""
        models = [self._models[i] for i in cameras]
        poses = tuple(model.T_camera_world for model in models)
        n = len(cameras)
        jacobian = reprojection(poses, np.zeros((n, 2)), p_world)[1]
        weights = np.zeros((2 * n, 2 * n))
        for i in range(n):
            weights[2 * i : 2 * i + 2, 2 * i : 2 * i + 2] = np.linalg.inv(covariances[i])
        information = jacobian.T @ weights @ jacobian
        spread = inverse(information if prior is None else information + prior)
        if spread is None:
            return np.zeros((3, len(self._spread)))
        change = np.vstack([self._change(i, p_world) for i in cameras])
        return np.asarray(spread @ jacobian.T @ weights @ change)

    def _change(self, camera: int, p_world: FloatArray) -> FloatArray:
        """∂r/∂θ of one camera, shape (2, parameters)."""
        model = self._models[camera]
        p_camera = model.T_camera_world @ p_world
        x, y, z = p_camera
        projection = np.array([[1.0, 0.0, -x / z], [0.0, 1.0, -y / z]]) / z
        ray = p_camera[:2] / z
        change = np.zeros((2, len(self._spread)))
        by_parameters = pixel_by_parameters(model.intrinsics, model.distortion, ray)
        change[:, self._lenses[camera]] = -model.ray_jacobian(ray) @ by_parameters
        if camera:
            change[:, self._pose] = -projection @ _moved(p_camera)
        # World: p_left = T̂⁻¹ exp(-ξ) p_world, carried on into this camera.
        change[:, self._world] = projection @ model.T_camera_world.rotation @ _moved(p_world)
        return change


def _near(known: FloatArray, p_world: FloatArray) -> bool:
    return float(np.abs(known - p_world).max()) < _REUSED


def _alike(known: FloatArray, covariances: FloatArray) -> bool:
    return float(np.abs(known - covariances).max()) <= _ALIKE * float(np.abs(known).max())


def pixel_by_parameters(
    intrinsics: FloatArray, distortion: FloatArray, ray: FloatArray
) -> FloatArray:
    """Change of a pixel with the lens' parameters at a fixed ray, shape (2, parameters)."""
    fx, fy = intrinsics[:2]
    bent, _, by_lens = distort_with_derivatives(np.array([ray]), distortion)
    (x_d, y_d), (along, down) = bent[0], by_lens[0]
    return np.array([[x_d, 0.0, 1.0, 0.0, *(fx * along)], [0.0, y_d, 0.0, 1.0, *(fy * down)]])


def _moved(point: FloatArray) -> FloatArray:
    """Change of exp(twist) @ point with the twist (translation, rotation vector), shape (3, 6)."""
    return np.hstack([np.eye(3), -skew(point)])
