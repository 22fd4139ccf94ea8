"""From a pixel and its covariance to normalised coordinates and theirs."""

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.optics.camera_model import CameraModel


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
