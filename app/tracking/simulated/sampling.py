"""How the rays of a pixel are spread: as the lens spreads a point."""

import numpy as np
from scipy.special import ndtri

from app.core.arrays import FloatArray

FINE = 55
COARSE = 13
"""Rays of a pixel at the band and elsewhere; Fibonacci numbers."""

_STEPS = {13: 8, 34: 21, 55: 34, 89: 55, 610: 377}
"""Fibonacci numbers and those before them: lattices without gaps."""


def sample_pattern(blur_px: float, samples: int = FINE) -> FloatArray:
    """Offsets of the rays of one pixel [px], shape (samples, 2), of mean 0 and SD `blur_px`.

    Points of a Fibonacci lattice, of which no two share a row or a column, through the inverse of
    the Gaussian. `samples` is one of 13, 34, 55, 89, 610.
    """
    i = np.arange(samples)
    levels = ndtri((i + 0.5) / samples)
    pattern = np.column_stack([levels, levels[(i * _STEPS[samples] + samples // 3) % samples]])
    scaled: FloatArray = blur_px * pattern / pattern.std(axis=0)
    return scaled
