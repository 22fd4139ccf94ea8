"""The least errors that an unbiased extractor can have in a picture: two Cramér-Rao bounds.

Both are for independent noise of equal standard deviation in every grey value and take the
covariance from the inverse of the Fisher information, F = Jᵀ J / noise², J the derivatives of the
noise-free picture.

`position_bound` is for the position alone: light, colours, width, length and background count as
known, which no extractor can know. It takes the pixels in which the band has a share (the shaft's
edges beyond it are not the marker's).

`joint_bound` counts as unknown what the fit of the band's picture has to find too: the paint's
shading, the colours of the shaft beyond both ends and of the background beside it, width and
length; these are eliminated by the Schur complement

    bound = (F_pp - F_pn F_nn⁻¹ F_np)⁻¹,   p: position, n: all else.

What the fit knows beforehand (see `band_fit`) counts as measured with its standard deviation.
"""

from collections.abc import Callable

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.cameras.camera import Image
from app.tracking.markers.band_unknowns import band_unknowns
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import NeedleShape

_STEP_PX = 0.3
"""Of the central differences: small beside the point spread, large beside a grey level."""


def schur_bound(position: FloatArray, nuisance: FloatArray, prior: FloatArray) -> FloatArray:
    """Least covariance of a position beside unknowns that are not of interest, (2, 2).

    Args:
        position: derivatives of the measurements by the position, over their noise, (m, 2).
        nuisance: the same by the other unknowns, (m, n).
        prior: information on these beforehand, (n, n); zeros for none.

    Raises:
        numpy.linalg.LinAlgError: if the measurements do not determine all unknowns.
    """
    cross = nuisance.T @ position
    known = np.linalg.solve(nuisance.T @ nuisance + prior, cross)
    return np.asarray(np.linalg.inv(position.T @ position - cross.T @ known))


def position_derivatives(
    render: Callable[[FloatArray], Image], model: CameraModel, p_world: FloatArray
) -> FloatArray:
    """Differentiate a noise-free picture by the band's (u, v), float (height, width, 3, 2).

    Args:
        render: noise-free picture with the band's centre at a point in world.
        model: the camera.
        p_world: the band's centre [m], shape (3,).
    """
    p_camera = model.T_camera_world @ p_world
    gradients = []
    for k in range(2):
        step = np.zeros(3)
        step[k] = _STEP_PX * p_camera[2] / model.intrinsics[k]
        ahead, behind = (
            render(model.T_world_camera @ (p_camera + sign * step)).astype(np.float64)
            for sign in (1.0, -1.0)
        )
        gradients.append((ahead - behind) / (2.0 * _STEP_PX))
    return np.stack(gradients, axis=-1)


def position_bound(
    render: Callable[[FloatArray], Image],
    band: Image,
    model: CameraModel,
    p_world: FloatArray,
    noise_grey: float,
) -> FloatArray:
    """Least covariance of the band's pixel with all else known [px²], shape (2, 2).

    Args:
        render: see `position_derivatives`.
        band: not zero where the band has a share of the pixel, shape (height, width).
        model: the camera.
        p_world: the band's centre [m], shape (3,).
        noise_grey: standard deviation of the noise.
    """
    stacked = position_derivatives(render, model, p_world)[band > 0].reshape(-1, 2) / noise_grey
    return np.asarray(np.linalg.inv(stacked.T @ stacked))


def joint_bound(
    render: Callable[[FloatArray], Image],
    model: CameraModel,
    shape: NeedleShape,
    blur_px: float,
    p_world: FloatArray,
    axis_world: FloatArray,
    noise_grey: float,
) -> FloatArray:
    """Least covariance of the band's pixel beside the unknowns of the fit [px²], shape (2, 2).

    It takes the pixels that the fit looks at, the shaft's edges beyond the band included.

    Args:
        render: see `position_derivatives`.
        model: the camera.
        shape: of the needle.
        blur_px: standard deviation of the point spread.
        p_world: the band's centre [m], shape (3,).
        axis_world: unit vector from hub to tip, shape (3,).
        noise_grey: standard deviation of the noise.

    Raises:
        TrackingError: if the band has no picture there.
    """
    unknowns = band_unknowns(
        render(p_world), model, shape, blur_px, noise_grey,
        model.T_camera_world @ p_world, model.T_camera_world.rotate(axis_world),
    )  # fmt: skip
    u, v = np.rint(unknowns.pixels).astype(int).T
    by_pixel = position_derivatives(render, model, p_world)[v, u] / noise_grey  # (m, 3, 2)
    position = by_pixel.transpose(1, 0, 2).reshape(-1, 2)
    return schur_bound(position, unknowns.columns, unknowns.prior)
