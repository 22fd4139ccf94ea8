"""Effects on simulated pictures: `(image, parameters, rng) -> image`, applied in order.

An effect may change the image in place and hands back the one to go on with. Randomness comes from
the generator it is given and from tiles made beforehand, so that a run repeats itself.
"""

from collections.abc import Callable
from dataclasses import dataclass
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from app.tracking.cameras.camera import Image

PictureEffect = Callable[[Image, Any, np.random.Generator], Image]
"""Signature of an effect on a picture."""

_SPARE = 64
"""By how many pixels the noise tile exceeds the picture: 64 × 64 places to cut it out."""


@dataclass(frozen=True, eq=False)
class NoiseTile:
    """Gaussian noise made beforehand, int16 (height + spare, width + spare, 3)."""

    values: NDArray[np.int16]

    @classmethod
    def make(cls, size: tuple[int, int], sd_grey: float, seed: int) -> "NoiseTile":
        """Tile for pictures of `size` (width, height) with standard deviation `sd_grey`."""
        rng = np.random.default_rng(seed)
        shape = (size[1] + _SPARE, size[0] + _SPARE, 3)
        return cls(np.rint(rng.normal(0.0, sd_grey, shape)).astype(np.int16))


def noise(image: Image, parameters: NoiseTile, rng: np.random.Generator) -> Image:
    """Add sensor noise, saturating at 0 and 255."""
    row, column = rng.integers(0, _SPARE, 2)
    height, width = image.shape[:2]
    tile = parameters.values[row : row + height, column : column + width]
    return np.asarray(cv2.add(image, tile, dtype=cv2.CV_8U))


def blur(image: Image, parameters: float, rng: np.random.Generator) -> Image:
    """Blur further by a Gaussian of standard deviation `parameters` [px] (out of focus)."""
    return np.asarray(cv2.GaussianBlur(image, (0, 0), parameters)) if parameters > 0.0 else image


def lighting(image: Image, parameters: float, rng: np.random.Generator) -> Image:
    """Scale the brightness by `parameters` (dimmer below 1), saturating at 255."""
    return np.asarray(cv2.convertScaleAbs(image, alpha=parameters))
