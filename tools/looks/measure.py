"""How much two pictures differ to the eye: the share of small areas that are no longer alike.

Alike is by the structural similarity index (Wang, Bovik, Sheikh, Simoncelli: Image quality
assessment: from error visibility to structural similarity, IEEE Trans. Image Processing 13(4),
2004), as OpenCV computes it (`cv2.quality`), on areas of `AREA_PX`.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final

import cv2
import numpy as np

AREA_PX: Final = 16
ALIKE: Final = 0.8
"""Least mean similarity of an area that counts as alike."""

TOLERANCE: Final = 0.02
"""Share of areas that may differ: a date, a time and a figure do; another place of a panel more."""


def difference(kept: Path, now: Path) -> float:
    """Return the share of areas in [0, 1] that differ; 1 for pictures of another size.

    Raises:
        OSError: if one of them cannot be read.
    """
    first, second = (_grey(path) for path in (kept, now))
    if first.shape != second.shape:
        return 1.0
    _, likeness = cv2.quality.QualitySSIM_compute(first, second)  # type: ignore[attr-defined]
    rows, columns = (size // AREA_PX for size in first.shape)
    whole = np.asarray(likeness)[: rows * AREA_PX, : columns * AREA_PX]
    areas = whole.reshape(rows, AREA_PX, columns, AREA_PX).mean(axis=(1, 3))
    return float((areas < ALIKE).mean())


def _grey(path: Path) -> np.ndarray:
    image = cv2.imread(str(path), cv2.IMREAD_GRAYSCALE)
    if image is None:
        raise OSError(f"cannot read {path}: not a picture")
    return np.asarray(image)
