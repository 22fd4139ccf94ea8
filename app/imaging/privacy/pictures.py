"""The pictures of a series as they are looked at before it is taken in, boxes blackened."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray

from app.core.messages import sentence
from app.core.progress import Progress
from app.imaging.privacy.burned_in import MaskBox, blackened, of_picture
from app.imaging.reading import read_pixels
from app.imaging.series import Series
from app.imaging.window import WindowLevel


@dataclass(frozen=True, slots=True, eq=False)
class Pictures:
    """Every picture of a series, in its order.

    Attributes:
        values: shape (pictures, rows, columns), read-only.
        brightest: of every pixel the highest value of all pictures, shape (rows, columns): writing
            in any picture is seen there.
        aspect: height of a pixel in widths of it.
        inverted: whether high values are shown dark (MONOCHROME1).
        one_per_file: whether boxes can be drawn: files of many pictures are not written anew.
    """

    values: NDArray[Any]
    brightest: NDArray[Any]
    aspect: float
    inverted: bool
    one_per_file: bool

    @property
    def count(self) -> int:
        """Return how many pictures there are."""
        return int(self.values.shape[0])

    @property
    def size(self) -> tuple[int, int]:
        """Columns and rows of a picture."""
        return int(self.values.shape[2]), int(self.values.shape[1])

    @property
    def window(self) -> WindowLevel:
        """Window of all values."""
        low, high = float(self.values.min()), float(self.values.max())
        return WindowLevel(min(max(high - low, 1.0), 1e6), (low + high) / 2.0)

    def seen(self, number: int, boxes: Sequence[MaskBox]) -> NDArray[Any]:
        """One picture, counted from 1, as an import with these boxes writes it."""
        drawn = of_picture(boxes, number)
        return blackened(self.values[number - 1], drawn, 1.0, self.inverted)

    def all_seen(self, boxes: Sequence[MaskBox]) -> NDArray[Any]:
        """Return the brightest of all pictures, blackened where a box lies on every picture."""
        drawn = [box for box in boxes if box.picture is None]
        return blackened(self.brightest, drawn, 1.0, self.inverted)


def read_pictures(series: Series, progress: Progress) -> Pictures:
    """Read the pictures of a usable DICOM series.

    Raises:
        SeriesRefusedError: if the series has no slices, or the memory does not suffice.
        FileDamagedError: if a file has changed or cannot be decoded.
        Cancelled: if `progress` was cancelled.
    """
    values = read_pixels(series, progress.part(0.0, 0.95))
    values.setflags(write=False)
    inverted = series.slices[0].format.photometric == "MONOCHROME1"
    brightest = values.min(axis=0) if inverted else values.max(axis=0)
    column, row = (series.spacing_mm or (1.0, 1.0, 1.0))[:2]
    paths = {header.path for header in series.slices}
    progress.report(1.0, sentence("{count} pictures read", count=len(values)))
    return Pictures(
        values,
        brightest,
        float(np.clip(row / column, 0.1, 10.0)),
        inverted,
        len(paths) == len(series.slices),
    )
