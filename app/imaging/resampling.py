"""A series whose slices lie unevenly, or are tilted, on an even, right-angled grid.

Each value lies between its two neighbouring slices, each sampled where its own file puts it: linear
along the normal, bilinear in the slice. Where slices are missing nothing is invented: the gap stays
empty, and so does what lies nearer to padding than to anything measured: no value is mixed with it.
"""

from collections.abc import Callable
from dataclasses import dataclass
from functools import lru_cache
from typing import Any

import numpy as np
from numpy.typing import NDArray
from scipy import ndimage

from app.core.arrays import FloatArray, read_only
from app.core.messages import counted, sentence
from app.core.progress import Progress
from app.imaging import memory, stack
from app.imaging.errors import SeriesRefusedError, TooLargeError
from app.imaging.filling import padding_of
from app.imaging.reading import grid_of, read_pixels
from app.imaging.rescaling import EMPTY_HU, fresh_array
from app.imaging.series import Recipe, Series
from app.imaging.volume import Volume

FINEST_MM, COARSEST_MM = 0.1, 20.0
"""Slice spacings that can be asked for."""

_MEASURED = 0.5
"""Share of what a value is interpolated from that must have been measured."""

_WHOLE = 1e-4
"""A sampling place this near to a pixel (or slice) is that pixel, in pixels (or slices)."""


@dataclass(frozen=True, slots=True, eq=False)
class _Target:
    """The right-angled grid that is made.

    Attributes:
        affine_mm: (i, j, k) -> LPS [mm], shape (4, 4).
        size: columns, rows, slices.
        heights_mm: of its slices along the normal, from the first slice of the series, shape (K,).
        step_mm: between its slices.
    """

    affine_mm: FloatArray
    size: tuple[int, int, int]
    heights_mm: FloatArray
    step_mm: float


def resampled(series: Series, recipe: Recipe, progress: Progress) -> Volume:
    """Read a series onto a right-angled grid of even slices.

    Args:
        series: usable, or refused for the places of its slices only.
        recipe: the spacing of its slices; the usual distance of the series' own where None.
        progress: told how far it is; cancels.

    Raises:
        SeriesRefusedError: if slices of that spacing cannot be made.
        TooLargeError: if the memory does not suffice.
        FileDamagedError: if a file has changed since the scan or cannot be decoded; names it.
        Cancelled: if `progress` was cancelled.
    """
    grid = grid_of(series)
    target = _target(series, grid, recipe.spacing_mm)
    both = series.size[0] * series.size[1] * series.size[2] + int(np.prod(target.size))
    width = memory.voxel_bytes(series.slices)
    if memory.need_of((both, 1, 1), width).reason:
        raise TooLargeError(
            sentence(
                "series {series_key} and what would be made of it need "
                "{both:.1f} GB of memory; close other programs or read a shorter series",
                series_key=series.key,
                both=both * width / 1e9,
            )
        )
    stored = read_pixels(series, progress.part(0.0, 0.5))
    empty = EMPTY_HU if series.unit else 0.0
    hu = fresh_array(target.size[::-1], stored.dtype)
    memory.hold(hu)
    gaps = stack.holes(grid.gaps_mm)
    sampled = _sampler(series, stored, target)
    heights = (grid.positions_mm - grid.positions_mm[0]) @ grid.normal
    part = progress.part(0.5, 1.0)
    for k, height in enumerate(target.heights_mm):
        part.report(
            k / len(hu),
            sentence("slice {current} of {count} resampled", current=k + 1, count=len(hu)),
        )
        picture = _between(heights, float(height), gaps, sampled)
        picture = np.where(np.isnan(picture), np.float32(empty), picture)
        hu[k] = np.rint(picture) if stored.dtype.kind == "i" else picture
    made = _words(series, grid, target, len(gaps))
    recipe = Recipe(recipe.remedy, spacing_mm=target.step_mm)
    return Volume(read_only(hu), target.affine_mm, series, made, series.unit, recipe)


def _target(series: Series, grid: stack.Stack, spacing_mm: float | None) -> _Target:
    """Right-angled grid that holds every slice, from the first one to the last."""
    columns, rows, _ = series.size
    gaps = grid.gaps_mm
    step = float(np.median(gaps)) if spacing_mm is None else spacing_mm
    if not FINEST_MM <= step <= COARSEST_MM:
        raise SeriesRefusedError(
            sentence(
                "slices {step:g} mm apart cannot be made; ask for {finest_mm:g} to "
                "{coarsest_mm:g} mm",
                step=step,
                finest_mm=FINEST_MM,
                coarsest_mm=COARSEST_MM,
            )
        )
    across, normal = grid.affine_mm[:3, 0], grid.normal
    pixel = np.linalg.norm(grid.affine_mm[:3, :2], axis=0)
    u = across / pixel[0]
    axes = np.stack([u, np.cross(normal, u), normal])  # rows: right-handed
    offsets = (grid.positions_mm - grid.positions_mm[0]) @ axes.T
    low, high = offsets.min(axis=0), offsets.max(axis=0)
    more = np.ceil((high[:2] - low[:2]) / pixel - _WHOLE).astype(int)
    heights = step * np.arange(int(high[2] / step + _WHOLE) + 1, dtype=np.float64)
    affine = np.eye(4)
    affine[:3, :3] = axes.T * (*pixel, step)
    affine[:3, 3] = grid.positions_mm[0] + low[0] * axes[0] + low[1] * axes[1]
    size = (columns + int(more[0]), rows + int(more[1]), len(heights))
    return _Target(affine, size, heights, step)


def _sampler(
    series: Series, stored: NDArray[Any], target: _Target
) -> Callable[[int], NDArray[np.float32]]:
    """Slices of the series on the pixels of the target, seen along its normal.

    NaN beside them, and where they are padding.
    """
    columns, rows, _ = target.size

    @lru_cache(maxsize=2)
    def sampled(k: int) -> NDArray[np.float32]:
        plane = series.slices[k].plane
        if plane is None:
            raise SeriesRefusedError(
                sentence(
                    "{series_slices_path} says nothing of its place",
                    series_slices_path=series.slices[k].path,
                )
            )
        own = stack.plane_affine(plane, target.affine_mm[:3, 2])
        to_own = np.linalg.inv(own) @ target.affine_mm  # along the normal: k drops out
        matrix = to_own[1::-1, 1::-1]  # (row, column) of the target -> of the slice
        start = to_own[1::-1, 3]
        picture = stored[k].astype(np.float32)
        padding = padding_of(series.slices[k], stored[k])
        nearest = np.rint(start)
        if np.abs(matrix - np.eye(2)).max() * max(columns, rows) < _WHOLE and (
            np.abs(start - nearest).max() < _WHOLE
        ):
            if padding is not None:
                picture[padding] = np.nan
            return _placed(picture, -nearest.astype(int), (rows, columns))
        return _turned(picture, padding, matrix, start, (rows, columns))

    return sampled


def _turned(
    picture: NDArray[np.float32],
    padding: NDArray[np.bool_] | None,
    matrix: FloatArray,
    start: FloatArray,
    shape: tuple[int, int],
) -> NDArray[np.float32]:
    """Interpolate a picture between its pixels, of which padding is none."""

    def transformed(values: NDArray[np.float32], beside: float) -> NDArray[np.float32]:
        out = np.empty(shape, np.float32)
        ndimage.affine_transform(
            values, matrix, start, shape, out, order=1, mode="constant", cval=beside
        )
        return out

    if padding is None or not padding.any():
        return transformed(picture, np.nan)
    picture[padding] = 0.0
    values = transformed(picture, np.nan)
    measured = transformed((~padding).astype(np.float32), 0.0)
    near = measured >= _MEASURED
    np.divide(values, measured, out=values, where=near)
    values[~near] = np.nan
    return values


def _placed(
    picture: NDArray[np.float32], at: NDArray[Any], shape: tuple[int, int]
) -> NDArray[np.float32]:
    """Put a picture into a larger empty one, pixel on pixel."""
    out = np.full(shape, np.nan, np.float32)
    row, column = (int(v) for v in at)
    out[row : row + picture.shape[0], column : column + picture.shape[1]] = picture
    return out


def _between(
    heights: FloatArray,
    height: float,
    gaps: tuple[int, ...],
    sampled: Callable[[int], NDArray[np.float32]],
) -> NDArray[np.float32]:
    """Picture at a height: of the slice there, or between the two around it; NaN where none is."""
    k = int(np.clip(np.searchsorted(heights, height) - 1, 0, len(heights) - 2))
    share = (height - heights[k]) / (heights[k + 1] - heights[k])
    if share <= _WHOLE:
        return sampled(k)
    if share >= 1.0 - _WHOLE:
        return sampled(k + 1)
    below, above = sampled(k), sampled(k + 1)
    if k in gaps:
        return np.full_like(below, np.nan)
    return below + np.float32(share) * (above - below)


def _words(series: Series, grid: stack.Stack, target: _Target, empty: int) -> tuple[str, ...]:
    words = []
    if grid.tilt_deg:
        words.append(
            sentence(
                "straightened from a gantry tilt of {grid_tilt_deg:.1f}°",
                grid_tilt_deg=grid.tilt_deg,
            )
        )
    gaps, step = grid.gaps_mm, float(np.linalg.norm(target.affine_mm[:3, 2]))
    if not grid.tilt_deg or np.ptp(gaps) > stack.TOLERANCE_MM:
        words.append(
            sentence(
                "resampled from slices {narrowest_mm:.3g} to {widest_mm:.3g} mm apart to "
                "{step:.3g} mm",
                narrowest_mm=gaps.min(),
                widest_mm=gaps.max(),
                step=step,
            )
        )
    if empty:
        words.append(
            counted(
                "{n} gap of missing slices left empty",
                "{n} gaps of missing slices left empty",
                empty,
            )
        )
    return tuple(words)
