"""Writing in the picture itself: refused, or blackened where an instructor has drawn."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydicom.dataset import Dataset

from app.imaging.privacy.errors import AnnotatedError, BurnedInError

_SECONDARY_CAPTURE = "1.2.840.10008.5.1.4.1.1.7"
_SCREENS = ("SCREEN SAVE", "SCREEN", "SCREENSHOT", "DOSE_INFO", "DOSE", "PROT", "POSDISP")


@dataclass(frozen=True, slots=True)
class Box:
    """A rectangle of pixels to blacken, in every picture of the series or in one.

    Attributes:
        column: of its first pixel, from 0.
        row: of its first pixel, from 0.
        columns: how wide it is.
        rows: how high it is.
        picture: number of the one picture, from 1 in the order of the series; None for every one.
    """

    column: int
    row: int
    columns: int
    rows: int
    picture: int | None = None

    def __post_init__(self) -> None:
        if self.picture is not None and self.picture < 1:
            raise BurnedInError(f"picture {self.picture}: pictures are counted from 1")
        if min(self.column, self.row) < 0 or min(self.columns, self.rows) < 1:
            raise BurnedInError(
                f"box {self.column},{self.row},{self.columns},{self.rows}: column and row must be "
                "0 or more, width and height 1 or more"
            )


def of_picture(boxes: Sequence[Box], number: int) -> tuple[Box, ...]:
    """Boxes of one picture, counted from 1 in the order of the series."""
    return tuple(box for box in boxes if box.picture in (None, number))


def check_numbers(boxes: Sequence[Box], count: int) -> None:
    """Refuse a box on a picture that the series has not got.

    Raises:
        BurnedInError: naming the number.
    """
    for box in boxes:
        if box.picture is not None and box.picture > count:
            raise BurnedInError(f"there is no picture {box.picture}: the series has {count}")


def check(dataset: Dataset, boxes: Sequence[Box]) -> None:
    """Refuse a picture that carries writing, unless somebody has drawn over it.

    Raises:
        AnnotatedError: if it says so itself and has no box.
        BurnedInError: if it is a picture of a screen or a secondary capture, boxes or not.
    """
    if str(dataset.get("SOPClassUID", "")).startswith(_SECONDARY_CAPTURE):
        raise BurnedInError("it is a secondary capture: such pictures often carry a name")
    words = {str(word).strip().upper() for word in dataset.get("ImageType", None) or ()}
    if found := words.intersection(_SCREENS):
        raise BurnedInError(f"it is a picture of a screen (ImageType {sorted(found)[0]})")
    annotated = str(dataset.get("BurnedInAnnotation", "") or "").strip().upper()
    if annotated == "YES" and not boxes:
        raise AnnotatedError(
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
