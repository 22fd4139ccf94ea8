"""Whether a picture is bright enough and sharp at the marker."""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.tracking.cameras.camera import Image

_DARK, _BRIGHT = 10, 250
_REACH, _MARGIN = 24, 8
_LEAST_STEP = 20.0
_STEEPEST = 97.0
_BEYOND_SLOPES = np.array([[1.0, -2.0, 1.0], [-2.0, 4.0, -2.0], [1.0, -2.0, 1.0]], np.float32)
_NORMAL_MEDIAN = 1.4826


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


def noise_level(image: Image) -> float:
    """Return the standard deviation of a picture's noise, as it is delivered [grey levels].

    From what differs between neighbours beyond any slope (Immerkær 1996, Comput. Vis. Image
    Underst. 64:300), by the median, so that edges do not count. JPEG takes most of a little noise
    out (2 grey levels become 0.5 at quality 90), and of much noise little.
    """
    green = image[..., 1].astype(np.float32)
    if min(green.shape) < 3:
        return 0.0
    rest = cv2.filter2D(green, -1, _BEYOND_SLOPES)[1:-1, 1:-1]
    return float(_NORMAL_MEDIAN * np.median(np.abs(rest)) / 6.0)


def _edge_width(image: Image, marker: FloatArray) -> float | None:
    """Return the 10 to 90 % width of the marker's clearest edges; None where none is clear.

    Along the steepest slope through each of the steepest pixels the brightness rises between two
    turns; that step over the slope is the width of a Gaussian edge (to 2 %). By brightness, not by
    redness: cameras deliver colour at half the resolution, so that red edges are twice as wide.
    """
    column, row = np.rint(marker).astype(int)
    height, width = image.shape[:2]
    if not (0 <= column < width and 0 <= row < height):
        return None
    reach = _REACH + _MARGIN
    rows = slice(max(0, row - reach), row + reach + 1)
    columns = slice(max(0, column - reach), column + reach + 1)
    patch = cv2.cvtColor(image[rows, columns], cv2.COLOR_BGR2GRAY).astype(np.float32)
    if min(patch.shape) <= 2 * _MARGIN:
        return None
    slope_u = cv2.Sobel(patch, cv2.CV_32F, 1, 0) / 8.0
    slope_v = cv2.Sobel(patch, cv2.CV_32F, 0, 1) / 8.0
    slope = np.hypot(slope_u, slope_v)
    inner = slope[_MARGIN:-_MARGIN, _MARGIN:-_MARGIN]
    v, u = np.nonzero(inner >= max(float(np.percentile(inner, _STEEPEST)), 1e-3))
    v, u = v + _MARGIN, u + _MARGIN
    along = np.column_stack([slope_u[v, u], slope_v[v, u]]) / slope[v, u][:, None]
    steps = _steps(patch, np.column_stack([u, v]), along)
    if not steps.size or steps.max() < _LEAST_STEP:
        return None
    clear = steps >= 0.5 * steps.max()
    return float(np.median(steps[clear] / slope[v, u][clear]))


def _steps(grey: NDArray[np.float32], places: FloatArray, along: FloatArray) -> FloatArray:
    """Return how far the brightness rises through each place along a way before it turns, (n,)."""
    if not len(places):
        return np.zeros(0)
    ways = np.arange(-_MARGIN, _MARGIN + 1)
    u, v = ((places[:, k, None] + ways * along[:, k, None]).astype(np.float32) for k in range(2))
    rise = np.diff(cv2.remap(grey, u, v, cv2.INTER_LINEAR), axis=1)
    after = np.cumprod(rise[:, _MARGIN:] > 0.0, axis=1) * rise[:, _MARGIN:]
    before = rise[:, :_MARGIN][:, ::-1]
    before = np.cumprod(before > 0.0, axis=1) * before
    return np.asarray(after.sum(axis=1) + before.sum(axis=1), dtype=np.float64)
