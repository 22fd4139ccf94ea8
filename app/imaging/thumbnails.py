"""A small grey picture of a series, for choosing among several; of refused ones too."""

from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from app.core.messages import sentence
from app.imaging.errors import ImagingError, SeriesRefusedError
from app.imaging.filling import filled
from app.imaging.header import Rescale, SliceHeader
from app.imaging.series import Series
from app.imaging.window import PRESETS, WindowLevel, to_grey

_MOST_PIXELS = 1 << 26


def thumbnail(series: Series, size_px: int = 112) -> NDArray[np.uint8]:
    """Middle slice of a series in its own window, to scale, as large as fits a square.

    Args:
        series: usable or not.
        size_px: side of the square.

    Returns:
        Grey levels, shape (rows, columns), the longer side `size_px`.

    Raises:
        SeriesRefusedError: if there is nothing to show: no pixels, colours, a file of its own kind.
        FileDamagedError: if the slice cannot be decoded.
    """
    if not series.slices:
        raise SeriesRefusedError(
            sentence("series {series_key} has no slices to show", series_key=series.key)
        )
    header = series.slices[len(series.slices) // 2]
    form = header.format
    if form.samples != 1 or form.bits_allocated not in (8, 16) or header.damage:
        raise SeriesRefusedError(
            sentence(
                "the pixels of {header_path_name} are no grey picture",
                header_path_name=header.path.name,
            )
        )
    if not 0 < form.rows * form.columns <= _MOST_PIXELS:
        raise SeriesRefusedError(
            sentence(
                "{header_path_name} is {form_columns} × {form_rows} pixels",
                header_path_name=header.path.name,
                form_columns=form.columns,
                form_rows=form.rows,
            )
        )
    shown = header if header.rescale else replace(header, rescale=Rescale(1.0, 0.0))
    picture = filled((shown,), np.dtype(np.float32))[0]
    grey = to_grey(_fitted(picture, _aspect(header), size_px), _window(series, header, picture))
    return 255 - grey if form.photometric == "MONOCHROME1" else grey


def try_thumbnail(series: Series, size_px: int = 112) -> NDArray[np.uint8] | None:
    """Return the thumbnail, or None where there is none to be had."""
    try:
        return thumbnail(series, size_px)
    except ImagingError:
        return None


def _aspect(header: SliceHeader) -> float:
    """Height of a pixel in widths of it."""
    if header.plane is None:
        return 1.0
    height, width = header.plane.pixel_spacing_mm
    return min(max(height / width, 0.1), 10.0)


def _fitted(picture: NDArray[np.float32], aspect: float, size_px: int) -> NDArray[np.float32]:
    """Mean of the pixels that fall on each pixel of the small picture (nearest if enlarged)."""
    rows, columns = picture.shape
    scale = size_px / max(rows * aspect, columns)
    small = max(1, round(rows * aspect * scale)), max(1, round(columns * scale))
    edges = [
        np.unique(np.floor(np.arange(n) * whole / n).astype(int))
        for n, whole in zip(small, (rows, columns), strict=True)
    ]
    sums = np.add.reduceat(np.add.reduceat(picture, edges[0], axis=0), edges[1], axis=1)
    counts = [np.diff(np.append(e, n)) for e, n in zip(edges, (rows, columns), strict=True)]
    mean = sums / np.outer(*counts)
    places = [
        np.searchsorted(e, np.floor(np.arange(n) * whole / n), side="right") - 1
        for e, n, whole in zip(edges, small, (rows, columns), strict=True)
    ]
    result: NDArray[np.float32] = mean[np.ix_(*places)].astype(np.float32)
    return result


def _window(series: Series, header: SliceHeader, picture: NDArray[np.float32]) -> WindowLevel:
    if header.rescale is not None and series.unit == "HU" and not series.windows:
        return next(iter(PRESETS.values()))
    if series.windows and header.rescale is not None and series.windows[0][0] <= 1e6:
        return WindowLevel(*series.windows[0])
    low, high = np.percentile(picture, (1.0, 99.0)).tolist()
    return WindowLevel(max(high - low, 1.0), (low + high) / 2.0)
