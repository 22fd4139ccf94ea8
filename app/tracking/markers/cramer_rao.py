"""The least error that any unbiased extractor can have in a picture: the Cramér-Rao bound.

The bound here is for the position alone: light, colours, distance, lean and background count as
known, which no extractor can know, so that it is a little below what is possible. It takes the
pixels in which the band has a share (the shaft's edges beyond it are not the marker's), and
independent noise of equal standard deviation in every grey value:

    bound = noise² · (Σ ∇I ∇Iᵀ)⁻¹,   ∇I: derivative of the noise-free picture by the band's (u, v).
"""

from collections.abc import Callable

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.cameras.camera import Image
from app.tracking.optics.camera_model import CameraModel

_STEP_PX = 0.3
"""Of the central differences: small beside the point spread, large beside a grey level."""


def position_bound(
    render: Callable[[FloatArray], Image],
    band: Image,
    model: CameraModel,
    p_world: FloatArray,
    noise_grey: float,
) -> FloatArray:
    """Least covariance of the band's pixel [px²], shape (2, 2).

    Args:
        render: noise-free picture with the band's centre at a point in world.
        band: not zero where the band has a share of the pixel, shape (height, width).
        model: the camera.
        p_world: the band's centre [m], shape (3,).
        noise_grey: standard deviation of the noise.
    """
    p_camera = model.T_camera_world @ p_world
    gradients = []
    for k in range(2):
        step = np.zeros(3)
        step[k] = _STEP_PX * p_camera[2] / model.intrinsics[k]
        ahead, behind = (
            render(model.T_world_camera @ (p_camera + sign * step))[band > 0].astype(np.float64)
            for sign in (1.0, -1.0)
        )
        gradients.append((ahead - behind).ravel() / (2.0 * _STEP_PX))
    stacked = np.array(gradients)
    return np.asarray(noise_grey**2 * np.linalg.inv(stacked @ stacked.T))
