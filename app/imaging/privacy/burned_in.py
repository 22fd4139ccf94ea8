"""Writing in the picture itself: refused, or blackened where an instructor has drawn."""

import re
from collections.abc import Sequence
from dataclasses import dataclass
from typing import Any

import numpy as np
from numpy.typing import NDArray
from pydicom.dataset import Dataset

from app.core.messages import sentence
from app.imaging.privacy.errors import AnnotatedError, BurnedInError
from app.imaging.privacy.forms import values

_SECONDARY_CAPTURE = "1.2.840.10008.5.1.4.1.1.7"
_SCREENS = {
    "SCREEN",
    "SCREENSHOT",
    "SCREENSAVE",
    "SNAPSHOT",
    "CAPTURE",  # GE and others: SCREEN SAVE
    "DOSE",
    "DOSEREPORT",
    "REPORT",  # DOSE_INFO, CSA REPORT
    "PROT",
    "POSDISP",  # Siemens: CT_SOM5 PROT, the patient protocol
}
"""Words of ImageType, taken apart at blanks and underscores."""

_CONVERTED = {"DV", "DI", "DF", "SD", "SI", "SV", "DRW"}
"""ConversionType (PS3.3 C.8.6.1): from video, films, paper and drawings; not workstations' MPRs."""

_DESCRIBED = re.compile(
    r"screen\s*(save|shot|capture)|snap\s*shot|dose\s*(report|info|record|sheet)|patient\s*protocol"
)


@dataclass(frozen=True, slots=True)
class MaskBox:
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
            raise BurnedInError(
                sentence("picture {picture}: pictures are counted from 1", picture=self.picture)
            )
        if min(self.column, self.row) < 0 or min(self.columns, self.rows) < 1:
            raise BurnedInError(
                sentence(
                    "box {column},{row},{columns},{rows}: column and row must be "
                    "0 or more, width and height 1 or more",
                    column=self.column,
                    row=self.row,
                    columns=self.columns,
                    rows=self.rows,
                )
            )


def of_picture(boxes: Sequence[MaskBox], number: int) -> tuple[MaskBox, ...]:
    """Boxes of one picture, counted from 1 in the order of the series."""
    return tuple(box for box in boxes if box.picture in (None, number))


def check_numbers(boxes: Sequence[MaskBox], count: int) -> None:
    """Refuse a box on a picture that the series has not got.

    Raises:
        BurnedInError: naming the number.
    """
    for box in boxes:
        if box.picture is not None and box.picture > count:
            raise BurnedInError(
                sentence(
                    "there is no picture {box_picture}: the series has {count}",
                    box_picture=box.picture,
                    count=count,
                )
            )


def check(dataset: Dataset, boxes: Sequence[MaskBox]) -> None:
    """Refuse a picture that carries writing, unless somebody has drawn over it.

    Raises:
        AnnotatedError: if it says so itself and has no box.
        BurnedInError: if it is a picture of a screen or a secondary capture, boxes or not.
    """
    if str(dataset.get("SOPClassUID", "")).startswith(_SECONDARY_CAPTURE):
        raise BurnedInError(sentence("it is a secondary capture: such pictures often carry a name"))
    kinds = " ".join(map(str, values(dataset.get("ImageType", None)))).upper()
    if found := _SCREENS.intersection(re.split(r"[\s_]+", kinds)):
        raise BurnedInError(
            sentence("it is a picture of a screen (ImageType {first})", first=sorted(found)[0])
        )
    if str(dataset.get("ConversionType", "") or "").strip().upper() in _CONVERTED:
        raise BurnedInError(
            sentence("it was converted from a film, a video or paper (ConversionType)")
        )
    described = str(dataset.get("SeriesDescription", "") or "").lower()
    if _DESCRIBED.search(described.replace("_", " ")):
        raise BurnedInError(
            sentence("its series is described as pictures of a screen or a dose report")
        )
    annotated = str(dataset.get("BurnedInAnnotation", "") or "").strip().upper()
    if annotated == "YES" and not boxes:
        raise AnnotatedError(
            sentence(
                "its pictures carry writing (BurnedInAnnotation YES), which may be a name; draw "
                "boxes over the writing (--mask COL,ROW,WIDTH,HEIGHT) or choose another series"
            )
        )


def blackened(
    stored: NDArray[Any], boxes: Sequence[MaskBox], slope: float, inverted: bool
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
                sentence(
                    "box at column {box_column}, row {box_row} lies outside the picture of "
                    "{columns} × {rows} pixels",
                    box_column=box.column,
                    box_row=box.row,
                    columns=columns,
                    rows=rows,
                )
            )
        area = np.s_[box.row : box.row + box.rows, box.column : box.column + box.columns]
        result[area] = lowest
    return result
