"""Whether left and right are exchanged: both orders are tried on the marker's pixels.

With the cameras exchanged the two rays of a pixel pair no longer meet. On the plane of symmetry of
a symmetric rig, and on the plane of its two optical axes, they still do: one place of the marker
may decide nothing, several do.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass
from enum import StrEnum
from typing import Final

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.optics.camera_model import CameraModel
from app.tracking.stereo.rays import normalised
from app.tracking.stereo.triangulation import StereoStatus, triangulate

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
        figures = f"{self.as_set_px:.1f} px as set, {self.swapped_px:.1f} px exchanged"
        if self.order is Order.SWAPPED:
            return f"the cameras are swapped ({figures}): exchange left and right in the settings"
        if self.order is Order.AS_SET:
            return f"left and right are as calibrated ({figures})"
        if not self.pairs:
            return "left and right could not be checked: both must see the marker"
        if min(self.as_set_px, self.swapped_px) > _NOTICED:
            return (
                f"the pictures fit in neither order ({figures}): calibrate again, a camera was "
                "moved or another one plugged in"
            )
        return (
            f"left and right could not be told apart ({figures}): move the needle sideways, and "
            "deeper or further out"
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
