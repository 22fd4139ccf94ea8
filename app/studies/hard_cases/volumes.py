"""Small volumes for hard cases of pictures: any direction, values that are linear in space."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.imaging.series import Series
from app.imaging.volume import Volume


def volume_of(
    direction: FloatArray,
    shape: tuple[int, int, int] = (5, 7, 9),
    spacing_mm: tuple[float, float, float] = (0.5, 0.8, 2.0),
    origin_mm: tuple[float, float, float] = (10.0, -20.0, 30.0),
    hu: NDArray[Any] | None = None,
) -> Volume:
    """Return a volume of shape (k, j, i) whose axes run along the columns of `direction`."""
    affine = np.eye(4)
    affine[:3, :3] = direction * spacing_mm
    affine[:3, 3] = origin_mm
    values = np.arange(np.prod(shape), dtype=np.int16).reshape(shape) if hu is None else hu
    series = Series("u", "CT", "l", shape[::-1], None, None, None, True, "", (), "CT-0", "", ())
    return Volume(values, affine, series)
