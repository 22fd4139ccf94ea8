"""Sampling printed markers: rays of all samples, where they meet a print, its grey values."""

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.tracking.optics.camera_model import CameraModel
from app.tracking.pen.board import Marker, marker_cells

SUPERSAMPLING = 3
TEXELS = 8
"""Texels per cell of a marker."""

PAD = 2
"""White round a marker in its texture, in cells."""

BLACK, WHITE = 32.0, 215.0

Plain = NDArray[np.float32]


def places(rays: Plain, corners: FloatArray, normal: FloatArray) -> tuple[Plain, Plain]:
    """Where rays meet a print: 0 to 1 from its first corner to the right and downwards."""
    origin, x, y = corners[0], corners[1] - corners[0], corners[3] - corners[0]
    away = rays @ normal[:2].astype(np.float32) + np.float32(normal[2])
    scale = np.float32(normal @ origin) / away
    points = np.concatenate([rays, np.ones_like(rays[..., :1])], axis=-1) * scale[..., None]
    points -= origin.astype(np.float32)
    return points @ (x / (x @ x)).astype(np.float32), points @ (y / (y @ y)).astype(np.float32)


def printed(marker: Marker, dictionary: str) -> Plain:
    """Grey values of a printed marker with white round it; edges fall between texels."""
    cells = np.pad(marker_cells(dictionary, marker.id), PAD, constant_values=True)
    texels = np.kron(cells, np.ones((TEXELS, TEXELS)))
    return np.where(texels > 0.5, WHITE, BLACK).astype(np.float32)


def fine_rays(model: CameraModel) -> Plain:
    """Normalised coordinates of all samples, float32 (3 height, 3 width, 2).

    Undistorted on the pixels' centres and interpolated between: the map is smooth.
    """
    width, height = model.image_size
    v, u = np.mgrid[-1 : height + 1, -1 : width + 1]
    pixels = np.column_stack([u.ravel(), v.ravel()]).astype(np.float64)
    rays, found = model.undistort(pixels)
    rays[~found] = 1e3
    coarse = rays.reshape(height + 2, width + 2, 2).astype(np.float32)
    places = (np.arange(SUPERSAMPLING) - 0.5 * (SUPERSAMPLING - 1)) / SUPERSAMPLING
    x = (np.arange(width)[:, None] + places).ravel() + 1.0
    y = (np.arange(height)[:, None] + places).ravel() + 1.0
    grid = np.meshgrid(x.astype(np.float32), y.astype(np.float32))
    return np.asarray(cv2.remap(coarse, grid[0], grid[1], cv2.INTER_LINEAR))
