"""Blocks of voxels averaged to one, so that a volume fits the memory."""

from typing import Any

import numpy as np

from app.core.arrays import read_only
from app.core.progress import Progress
from app.imaging import memory
from app.imaging.errors import TooLargeError
from app.imaging.reading import grid_of, read_pixels, reduced_affine
from app.imaging.series import Recipe, Refusal, Series
from app.imaging.volume import Volume

DECLARATION: dict[str, Any] = {
    "title": "Open at half size",
    "help": "Averages neighbouring voxels until the volume fits the memory.",
    "against": "too large",
    "rank": 3,
}


def offers(series: Series) -> bool:
    """Return whether nothing but the memory keeps a series from being read."""
    return series.refusal is Refusal.TOO_LARGE


def read(series: Series, recipe: Recipe, progress: Progress) -> Volume:
    """Average as many voxels as the recipe says; as the memory needs, where it says none."""
    asked = recipe.factors != (1, 1, 1)
    factors = recipe.factors if asked else memory.need(series.slices).factors
    grid = grid_of(series)
    if factors == (1, 1, 1):
        _, pixel, between = np.linalg.norm(grid.affine_mm[:3, :3], axis=0)
        factors = (2, 2, 2 if between < 1.5 * pixel else 1)
    try:
        hu = read_pixels(series, progress, factors)
    except TooLargeError:  # its values need twice the memory that its headers promised
        if asked:
            raise
        factors = memory.need_of(series.size, 4).factors
        hu = read_pixels(series, progress, factors)
    i, j, k = factors
    made = f"reduced: {i} × {j} × {k} voxels averaged to one"
    affine = reduced_affine(grid.affine_mm, factors)
    recipe = Recipe(recipe.remedy, factors)
    return Volume(read_only(hu), affine, series, (made,), series.unit, recipe)
