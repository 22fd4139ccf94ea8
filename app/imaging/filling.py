"""Slices into one array of Hounsfield values."""

from collections.abc import Sequence
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.progress import Progress
from app.imaging.decoding import stored_type
from app.imaging.header import SliceHeader
from app.imaging.rescaling import fill_slice, fresh_array


def filled(
    headers: Sequence[SliceHeader], dtype: np.dtype[Any], progress: Progress | None = None
) -> NDArray[Any]:
    """Read slices of one size, in the order given.

    Args:
        headers: usable ones, of the same rows and columns.
        dtype: int16 or float32.
        progress: told how far it is; cancels.

    Returns:
        Hounsfield values, shape (slices, rows, columns).

    Raises:
        NotExactError: if a value does not fit 16 bits and int16 was asked for.
        FileDamagedError: if a file has changed since the scan or cannot be decoded; names it.
        SeriesRefusedError: if the machine has not enough memory.
        Cancelled: if `progress` was cancelled.
    """
    progress = progress or Progress()
    rows, columns = headers[0].format.rows, headers[0].format.columns
    hu = fresh_array((len(headers), rows, columns), dtype)
    stored: dict[np.dtype[Any], NDArray[Any]] = {}
    for k, header in enumerate(headers):
        progress.report(k / len(headers), f"slice {k + 1} of {len(headers)}")
        wanted = stored_type(header.format)
        fill_slice(header, hu[k], stored.setdefault(wanted, np.empty((rows, columns), wanted)))
    progress.report(1.0, f"{len(headers)} slices read")
    return hu
