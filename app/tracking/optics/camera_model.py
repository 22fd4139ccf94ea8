"""The pinhole camera with lens distortion: points to pixels, pixels to rays."""

from dataclasses import dataclass, field

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray, frozen
from app.core.messages import sentence
from app.core.transform import RigidTransform
from app.tracking.errors import RigError
from app.tracking.optics.distortion import (
    distort_grid,
    distort_with_derivatives,
    distortion_jacobian,
    fold_radius,
    undistort_grid,
    undistort_point,
)
from app.tracking.optics.lens import LensModel

_NEAREST = 1e-6
"""Depth [m] in front of the camera below which a point counts as not in front of it."""


WILDEST = 1e6
"""Magnitude that no coefficient of distortion has; long lenses come to some tens."""


@dataclass(frozen=True, eq=False)
class CameraModel:
    """One calibrated camera. Camera frame as in OpenCV: x right, y down, z into the scene.

    Pixel (u, v) = (0, 0) is the *centre* of the upper left pixel.

    Attributes:
        name: as the rig profile calls it.
        intrinsics: fx, fy, cx, cy [px], shape (4,).
        distortion: coefficients of `lens` in OpenCV's order, shape (5,), (12,) or (4,).
        image_size: width, height [px].
        T_world_camera: pose of the camera.
        lens: model of the distortion.
        fold: see `distortion.fold_radius`.
    """

    name: str
    intrinsics: FloatArray
    distortion: FloatArray
    image_size: tuple[int, int]
    T_world_camera: RigidTransform
    lens: LensModel = LensModel.BROWN
    fold: float = field(init=False)
    T_camera_world: RigidTransform = field(init=False)

    def __post_init__(self) -> None:
        object.__setattr__(self, "intrinsics", frozen(self.intrinsics, (4,), "intrinsics"))
        count = len(self.lens.coefficients)
        object.__setattr__(self, "distortion", frozen(self.distortion, (count,), "distortion"))
        if np.abs(self.distortion).max() > WILDEST:
            raise RigError(
                sentence(
                    "camera {name}: distortion {distortion}: no lens has a "
                    "coefficient beyond {wildest:g}; calibrate the camera again",
                    name=self.name,
                    distortion=self.distortion.tolist(),
                    wildest=WILDEST,
                )
            )
        object.__setattr__(self, "fold", fold_radius(self.distortion))
        object.__setattr__(self, "T_camera_world", self.T_world_camera.inverse())
        if self.intrinsics[:2].min() <= 0.0 or min(self.image_size) < 16:
            raise RigError(
                sentence(
                    "camera {name}: focal lengths {intrinsics} px and image "
                    "size {image_size} must be positive, the size at least 16 px",
                    name=self.name,
                    intrinsics=self.intrinsics[:2].tolist(),
                    image_size=self.image_size,
                )
            )

    @property
    def matrix(self) -> FloatArray:
        """Camera matrix K, shape (3, 3)."""
        fx, fy, cx, cy = self.intrinsics
        return np.array([[fx, 0.0, cx], [0.0, fy, cy], [0.0, 0.0, 1.0]])

    @property
    def centre(self) -> FloatArray:
        """Centre of projection in world [m], shape (3,)."""
        return self.T_world_camera.translation

    def project(self, p_world: ArrayLike) -> tuple[FloatArray, NDArray[np.bool_]]:
        """Pixels of points, (n, 3) [m] -> (n, 2), and whether each has a picture, (n,).

        A point has one if it lies in front of the camera and inside the fold of the distortion; it
        may still fall outside the image. Pixels of points without one are zero, never NaN.
        """
        p_camera = self.T_camera_world @ np.atleast_2d(np.asarray(p_world, dtype=np.float64))
        return self.project_camera(p_camera)

    def project_camera(self, p_camera: FloatArray) -> tuple[FloatArray, NDArray[np.bool_]]:
        """Like `project`, for points in the camera frame."""
        z = p_camera[:, 2]
        ok = np.isfinite(p_camera).all(axis=1) & (z > _NEAREST)
        xy = np.where(ok[:, None], p_camera[:, :2], 0.0) / np.where(ok, z, 1.0)[:, None]
        bent, seen = distort_grid(xy, self.distortion, self.fold)
        ok &= seen
        uv: FloatArray = bent * self.intrinsics[:2] + self.intrinsics[2:]
        uv[~ok] = 0.0
        return uv, ok

    def pixel(self, p_world: ArrayLike) -> FloatArray | None:
        """Pixel of one point, shape (2,), or None if it has no picture."""
        uv, ok = self.project(p_world)
        return uv[0] if ok[0] else None

    def sees(self, p_world: ArrayLike, margin_px: float = 0.0) -> NDArray[np.bool_]:
        """Return whether points, (n, 3), fall inside the image by at least `margin_px`, shape
        (n,).
        """
        uv, ok = self.project(p_world)
        limit = np.array(self.image_size) - 1.0 - margin_px
        inside: NDArray[np.bool_] = ok & (uv >= margin_px).all(axis=1) & (uv <= limit).all(axis=1)
        return inside

    def undistort(self, pixels: ArrayLike) -> tuple[FloatArray, NDArray[np.bool_]]:
        """Normalised coordinates x/z, y/z of pixels, (n, 2) -> (n, 2), and which exist, (n,)."""
        points = np.ascontiguousarray(np.atleast_2d(np.asarray(pixels, dtype=np.float64)))
        rays, found = undistort_grid(points, self.intrinsics, self.distortion, self.fold)
        return rays, found

    def ray(self, pixel: FloatArray) -> tuple[float, float] | None:
        """Normalised coordinates x/z, y/z of one pixel, or None if it belongs to no direction."""
        fx, fy, cx, cy = self.intrinsics.tolist()
        u, v = pixel.tolist()
        x, y, found = undistort_point((u - cx) / fx, (v - cy) / fy, self.distortion, self.fold)
        return (x, y) if found else None

    def ray_jacobian(self, ray: ArrayLike) -> FloatArray:
        """Change of the normalised coordinates with the pixel [1/px] at `ray`, shape (2, 2)."""
        x, y = np.asarray(ray, dtype=np.float64)
        xx, xy, yx, yy = distortion_jacobian(x, y, self.distortion)
        fx, fy = self.intrinsics[:2]
        determinant = (xx * yy - xy * yx) * fx * fy
        return np.array([[fy * yy, -fx * xy], [-fy * yx, fx * xx]]) / determinant

    def pixel_areas(self, rays: FloatArray) -> FloatArray:
        """Area of a pixel in normalised coordinates at `rays`, (n, 2) -> (n,)."""
        j = distort_with_derivatives(np.ascontiguousarray(rays), self.distortion)[1]
        determinants = j[:, 0, 0] * j[:, 1, 1] - j[:, 0, 1] * j[:, 1, 0]
        return np.asarray(1.0 / (determinants * np.prod(self.intrinsics[:2])))
