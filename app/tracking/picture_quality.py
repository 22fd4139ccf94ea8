"""Whether a picture is bright enough and sharp at the marker."""

from dataclasses import dataclass

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.tracking.cameras.camera import Image

_DARK, _BRIGHT = 10, 250
_REACH = 24
_LEAST_STEP = 20.0


@dataclass(frozen=True, slots=True)
class PictureQuality:
    """Figures of one picture.

    Attributes:
        level: mean brightness [grey levels of 255].
        dark: share of pixels that are nearly black, 0...1.
        bright: share of pixels with a colour at its end, 0...1.
        edge_width: of the marker's outline, from 10 to 90 % of the step [px]; None without a
            marker, or where it hardly stands out.
    """

    level: float
    dark: float
    bright: float
    edge_width: float | None


def picture_quality(image: Image, marker: FloatArray | None) -> PictureQuality:
    """Measure a picture.

    Args:
        image: blue, green, red, shape (height, width, 3).
        marker: where the marker is [px], shape (2,); None where there is none.
    """
    grey = cv2.cvtColor(image[::2, ::2], cv2.COLOR_BGR2GRAY)
    brightest = image[::2, ::2].max(axis=2)
    return PictureQuality(
        float(grey.mean()),
        float(np.mean(brightest <= _DARK)),
        float(np.mean(brightest >= _BRIGHT)),
        None if marker is None else _edge_width(image, marker),
    )


def _edge_width(image: Image, marker: FloatArray) -> float | None:
    """Step over steepest slope of the redness round the marker: its 10 to 90 % width (Gaussian).

    Slope by Sobel's operator, an eighth of its sum; noise makes the steepest slope a little
    steeper, so that a blurred picture is never called sharper than it is by more than a tenth.
    """
    column, row = np.rint(marker).astype(int)
    height, width = image.shape[:2]
    if not (0 <= column < width and 0 <= row < height):
        return None
    patch = image[
        max(0, row - _REACH) : row + _REACH + 1, max(0, column - _REACH) : column + _REACH + 1
    ].astype(np.float32)
    red = patch[..., 2] - 0.5 * (patch[..., 0] + patch[..., 1])
    step = float(np.percentile(red, 98.0) - np.percentile(red, 2.0))
    if step < _LEAST_STEP or min(red.shape) < 5:
        return None
    slope = np.hypot(cv2.Sobel(red, cv2.CV_32F, 1, 0), cv2.Sobel(red, cv2.CV_32F, 0, 1)) / 8.0
    steepest = float(np.percentile(slope, 99.5))
    return step / max(steepest, 1e-6)
