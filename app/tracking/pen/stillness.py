"""Whether the webcam stands still, told from a few patches of the picture in a fraction of the
time that measuring its sheet takes.

Round corners of the sheet's markers the picture is kept. Where it moved by d, a patch changes by
d · gradient; the median over the patches of the d that fits best, brightness left free, says how
far the picture has moved. A hand before some of them does not matter.
"""

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.pen.edges import Grey

STILL_PX = 0.05
"""Movement of the picture [px] below which the webcam stands still."""

_HALF = 4
"""A patch reaches so many pixels to either side."""

_FEWEST = 4
_LEAST_SLOPE = 1e3
"""Sum of squared gradients of a patch that tells both directions [grey²/px²]."""


class Stillness:
    """Patches of one picture, against which others are held.

    Args:
        grey: picture, shape (height, width).
        corners: of black squares [px], shape (n, 2).
    """

    def __init__(self, grey: Grey, corners: FloatArray) -> None:
        height, width = grey.shape
        middle = np.rint(corners).astype(int).reshape(-1, 2)
        reach = _HALF + 1
        limit = np.array([width, height]) - reach
        middle = middle[((middle >= reach) & (middle < limit)).all(axis=1)]
        steps = np.arange(-reach, reach + 1)
        wide = _taken(grey, middle, steps)
        along = 0.5 * (wide[:, 1:-1, 2:] - wide[:, 1:-1, :-2])
        down = 0.5 * (wide[:, 2:, 1:-1] - wide[:, :-2, 1:-1])
        slopes = np.stack([along, down], axis=-1).reshape(len(middle), (2 * _HALF + 1) ** 2, 2)
        slopes -= slopes.mean(axis=1, keepdims=True)  # a change of brightness is no movement
        normal = slopes.transpose(0, 2, 1) @ slopes
        told = np.linalg.eigvalsh(normal)[:, 0] > _LEAST_SLOPE
        self._middle, self._kept = middle[told], wide[told, 1:-1, 1:-1]
        self._solve = np.linalg.inv(normal[told]) @ slopes[told].transpose(0, 2, 1)

    def moved(self, grey: Grey) -> float:
        """How far a picture has moved since [px]; infinite if there are too few patches to tell."""
        if len(self._middle) < _FEWEST:
            return float("inf")
        change = _taken(grey, self._middle, np.arange(-_HALF, _HALF + 1)) - self._kept
        shifts = (self._solve @ change.reshape(len(change), -1, 1))[..., 0]
        return float(np.linalg.norm(np.median(shifts, axis=0)))


def _taken(grey: Grey, middle: np.ndarray, steps: np.ndarray) -> FloatArray:
    """Square patches of a picture, shape (n, steps, steps)."""
    rows = middle[:, 1, None, None] + steps[:, None]
    columns = middle[:, 0, None, None] + steps
    return grey[rows, columns].astype(np.float64)
