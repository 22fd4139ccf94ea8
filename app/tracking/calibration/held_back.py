"""Which views to hold back for validation: those whose absence leaves the coverage as it was."""

from collections.abc import Sequence

import numpy as np

from app.core.arrays import FloatArray
from app.tracking.calibration.views import BoardView


def default_count(views: int) -> int:
    """Return how many of so many views to hold back: one in five, from eight on, at least two."""
    return max(2, views // 5) if views >= 8 else 0


def choose(views: Sequence[BoardView], count: int) -> list[int]:
    """Numbers of the views to hold back, ascending.

    One after the other the view is taken whose nearest neighbour, of those kept, is nearest in
    place, size and shape in the picture: what it covers stays covered.
    """
    if not 0 < count < len(views):
        return []
    features = np.array([_feature(view) for view in views])
    kept = list(range(len(views)))
    held: list[int] = []
    while len(held) < count:
        chosen = features[kept]
        apart = np.linalg.norm(chosen[:, None] - chosen[None], axis=2)
        np.fill_diagonal(apart, np.inf)
        held.append(kept.pop(int(np.argmin(apart.min(axis=1)))))
    return sorted(held)


def _feature(view: BoardView) -> FloatArray:
    """Centre, and half axes of the corners' spread, in parts of the picture's width."""
    pixels = view.pixels / view.image_size[0]
    spread = np.cov(pixels.T)
    result: FloatArray = np.concatenate(
        [
            pixels.mean(axis=0),
            np.sqrt(np.diag(spread)),
            [np.sqrt(abs(spread[0, 1])) * np.sign(spread[0, 1])],
        ]
    )
    return result
