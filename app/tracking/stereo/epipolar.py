"""Epipolar curves: where a point that one camera shows can lie in the other camera's picture.

With lens distortion that is a curve, not a line. It is the picture of the ray of the pixel: points
C₁ + d / s, s from 0 (infinity) to 1 / near, which in the second camera's frame are, up to scale,
R d + s R (C₁ - C₂). No fundamental matrix is used, so that the curve holds for any lens model.

With left and right exchanged the two rays of a pixel pair no longer meet. On the plane of symmetry
of a symmetric rig, and on the plane of its two optical axes, they still do: one place of the marker
may decide nothing, several do.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Final

import numpy as np
from numpy.typing import ArrayLike

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.core.rotation import skew
from app.core.transform import RigidTransform
from app.tracking.optics.camera_model import CameraModel
from app.tracking.stereo.triangulation import StereoStatus, triangulate


def normalised(
    model: CameraModel, uv: FloatArray, covariance: FloatArray
) -> tuple[FloatArray, FloatArray] | None:
    """Normalised coordinates (2,) of a pixel and their covariance (2, 2).

    None if the pixel belongs to no direction: beyond the fold of the distortion.
    """
    ray, found = model.undistort(uv)
    if not found[0]:
        return None
    jacobian = model.ray_jacobian(ray[0])
    return ray[0], np.asarray(jacobian @ covariance @ jacobian.T)


NEAR = 0.02
"""Nearest point of a ray [m] that is drawn; nothing that is tracked comes closer to a lens."""
_COARSE, _FINE = 97, 65


def epipolar_curve(
    seen_by: CameraModel, pixel: ArrayLike, shown_in: CameraModel, near: float = NEAR
) -> FloatArray:
    """Pixels of `shown_in` where what `seen_by` shows at `pixel` may lie, as a line of points.

    Args:
        seen_by: camera that shows the point.
        pixel: of the point there [px], shape (2,).
        shown_in: the other camera.
        near: distance from the first camera [m] where the ray begins to be looked at.

    Returns:
        Points inside the picture of `shown_in` in order from far to near, shape (n, 2). Empty if
        the pixel has no ray, the cameras stand in one place, or the curve misses the picture.
    """
    rays, found = seen_by.undistort(pixel)
    baseline = shown_in.T_camera_world.rotate(seen_by.centre - shown_in.centre)
    length = float(np.linalg.norm(baseline))
    if not found[0] or length < 1e-9:
        return np.empty((0, 2))
    direction = shown_in.T_camera_world.rotate(seen_by.T_world_camera.rotate([*rays[0], 1.0]))
    # s = tan(t) / |baseline| spreads the points evenly over the picture.
    last = float(np.arctan(length / near))
    times = np.linspace(0.0, last, _COARSE)
    inside = np.flatnonzero(_picture(direction, baseline / length, times, shown_in)[1])
    if not len(inside):
        return np.empty((0, 2))
    # Once more, closely, over the part that the picture shows and one step to either side.
    first, final = times[max(0, inside[0] - 1)], times[min(_COARSE - 1, inside[-1] + 1)]
    pixels, ok = _picture(direction, baseline / length, np.linspace(first, final, _FINE), shown_in)
    return pixels[ok]


def essential_matrix(T_camera_world: tuple[RigidTransform, RigidTransform]) -> FloatArray:
    """E = [t]ₓ R of T_second_first, shape (3, 3): x₂ᵀ E x₁ = 0 for what both cameras show."""
    T_second_first = T_camera_world[1] @ T_camera_world[0].inverse()
    return np.asarray(skew(T_second_first.translation) @ T_second_first.rotation)


def _picture(
    direction: FloatArray, baseline: FloatArray, times: FloatArray, model: CameraModel
) -> tuple[FloatArray, np.ndarray[tuple[int, ...], np.dtype[np.bool_]]]:
    """Pixels of the ray's points and whether each lies in the picture, with its edge."""
    points = np.cos(times)[:, None] * direction + np.sin(times)[:, None] * baseline
    pixels, ok = model.project_camera(points)
    limit = np.array(model.image_size) - 0.5
    return pixels, ok & (pixels >= -0.5).all(axis=1) & (pixels <= limit).all(axis=1)


_FACTOR: Final = 3.0
_NOTICED: Final = 3.0
_NO_POINT: Final = 1e3


class Order(StrEnum):
    """How the two pictures belong to the two cameras."""

    AS_SET = "as set"
    SWAPPED = "swapped"
    UNDECIDED = "undecided"


@dataclass(frozen=True, slots=True)
class OrderCheck:
    """Result: median distance of the rays in both orders [px]; 1000 where they never meet."""

    order: Order
    as_set_px: float
    swapped_px: float
    pairs: int

    @property
    def text(self) -> str:
        """For people."""
        figures = sentence(
            "{as_set_px:.1f} px as set, {swapped_px:.1f} px exchanged",
            as_set_px=self.as_set_px,
            swapped_px=self.swapped_px,
        )
        if self.order is Order.SWAPPED:
            return sentence(
                "the cameras are swapped ({figures}): exchange left and right in the settings",
                figures=figures,
            )
        if self.order is Order.AS_SET:
            return sentence("left and right are as calibrated ({figures})", figures=figures)
        if not self.pairs:
            return sentence("left and right could not be checked: both must see the marker")
        if min(self.as_set_px, self.swapped_px) > _NOTICED:
            return sentence(
                "the pictures fit in neither order ({figures}): calibrate again, a camera "
                "was moved or another one plugged in",
                figures=figures,
            )
        return sentence(
            "left and right could not be told apart ({figures}): move the needle sideways, "
            "and deeper or further out",
            figures=figures,
        )


def check_order(
    models: tuple[CameraModel, CameraModel], pixels: Sequence[tuple[FloatArray, FloatArray]]
) -> OrderCheck:
    """Try both orders.

    Args:
        models: calibrated, left and right.
        pixels: the marker in pictures taken together, left and right, each of shape (2,).
    """
    if not pixels:
        return OrderCheck(Order.UNDECIDED, _NO_POINT, _NO_POINT, 0)
    straight = float(np.median([_residual(models, a, b) for a, b in pixels]))
    exchanged = float(np.median([_residual(models, b, a) for a, b in pixels]))
    order = Order.UNDECIDED
    if min(straight, exchanged) <= _NOTICED < max(straight, exchanged):
        if exchanged > _FACTOR * straight:
            order = Order.AS_SET
        elif straight > _FACTOR * exchanged:
            order = Order.SWAPPED
    return OrderCheck(order, straight, exchanged, len(pixels))


def _residual(
    models: tuple[CameraModel, CameraModel], left: FloatArray, right: FloatArray
) -> float:
    """Reprojection error of the best point [px]: the root of its sum of squares."""
    rays = [normalised(m, uv, np.eye(2)) for m, uv in zip(models, (left, right), strict=True)]
    if rays[0] is None or rays[1] is None:
        return _NO_POINT
    observations = np.stack([rays[0][0], rays[1][0]])
    covariances = np.stack([rays[0][1], rays[1][1]])
    poses = (models[0].T_camera_world, models[1].T_camera_world)
    found = triangulate(poses, observations, covariances)
    if found.status is not StereoStatus.FOUND:
        return _NO_POINT
    return min(float(np.sqrt(found.chi_square)), _NO_POINT)
