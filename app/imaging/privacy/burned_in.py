"""Writing in the picture itself: refused, or blackened where an instructor has drawn."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydicom.dataset import Dataset

from app.imaging.privacy.errors import BurnedInError

_SECONDARY_CAPTURE = "1.2.840.10008.5.1.4.1.1.7"
_SCREENS = ("SCREEN SAVE", "SCREEN", "SCREENSHOT", "DOSE_INFO", "DOSE", "PROT", "POSDISP")


@dataclass(frozen=True, slots=True)
class Box:
    """A rectangle of pixels to blacken, in every picture of the series."""

    column: int
    row: int
    columns: int
    rows: int

    def __post_init__(self) -> None:
        if min(self.column, self.row) < 0 or min(self.columns, self.rows) < 1:
            raise BurnedInError(
                f"box {self.column},{self.row},{self.columns},{self.rows}: column and row must be "
                "0 or more, width and height 1 or more"
            )


def check(dataset: Dataset, boxes: Sequence[Box]) -> None:
    """Refuse a picture that carries writing, unless somebody has drawn over it.

    Raises:
        BurnedInError: saying what was found; without boxes only.
    """
    if str(dataset.get("SOPClassUID", "")).startswith(_SECONDARY_CAPTURE):
        raise BurnedInError("it is a secondary capture: such pictures often carry a name")
    words = {str(word).strip().upper() for word in dataset.get("ImageType", None) or ()}
    if found := words.intersection(_SCREENS):
        raise BurnedInError(f"it is a picture of a screen (ImageType {sorted(found)[0]})")
    annotated = str(dataset.get("BurnedInAnnotation", "") or "").strip().upper()
    if annotated == "YES" and not boxes:
        raise BurnedInError(
            "its pictures carry writing (BurnedInAnnotation YES), which may be a name; draw boxes "
            "over the writing (--mask COL,ROW,WIDTH,HEIGHT) or choose another series"
        )


def blackened(
    stored: NDArray[Any], boxes: Sequence[Box], slope: float, inverted: bool
) -> NDArray[Any]:
    """Picture with the boxes set to its own lowest value (of HU), a copy.

    Raises:
        BurnedInError: if a box does not touch the picture.
    """
    rows, columns = stored.shape
    result = stored.copy()
    lowest = stored.max() if (slope < 0.0) != inverted else stored.min()
    for box in boxes:
        if box.row >= rows or box.column >= columns:
            raise BurnedInError(
                f"box at column {box.column}, row {box.row} lies outside the picture of "
                f"{columns} × {rows} pixels"
            )
        area = np.s_[box.row : box.row + box.rows, box.column : box.column + box.columns]
        result[area] = lowest
    return result
