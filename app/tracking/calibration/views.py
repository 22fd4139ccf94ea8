"""What one picture shows of a board, or why it is of no use."""

from collections.abc import Sequence
from dataclasses import dataclass, field, replace
from enum import StrEnum

import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, read_only
from app.core.messages import sentence
from app.tracking.calibration.boards import Board
from app.tracking.errors import CalibrationError


class RejectionReason(StrEnum):
    """Why a picture is not used."""

    NO_BOARD = "no_board"
    PARTLY = "partly"
    TOO_SMALL = "too_small"
    BLURRED = "blurred"
    EDGE_ON = "edge_on"
    MIRRORED = "mirrored"
    OTHER_BOARD = "other_board"
    UNREADABLE = "unreadable"
    OTHER_SIZE = "other_size"


@dataclass(frozen=True)
class Rejection:
    """A picture of no use, and why, in one line for people.

    Attributes:
        reason: for programs.
        text: for people; says what to do.
        name: of the picture.
    """

    reason: RejectionReason
    text: str
    name: str = ""


@dataclass(frozen=True, eq=False)
class BoardView:
    """Corners of a board found in one picture.

    Attributes:
        board: which board.
        ids: numbers of the corners found, shape (n,), ascending.
        pixels: their places, shape (n, 2); pixel (0, 0) is the centre of the upper left pixel.
        image_size: width, height [px].
        sharpness: width of the squares' edges, 10 to 90 % of the step, median [px]; about 1 to 2
            in a sharp picture, more in a blurred one.
        square_px: shortest distance across a square in the picture [px].
        window: half width of the window in which the corners were refined [px]; 0 if they were
            not.
        unrefined: the places as the finder gave them, shape (n, 2); None if they are not known, or
            are `pixels` themselves.
        name: of the picture.

    Raises:
        CalibrationError: for pixels that are not finite or do not match the ids.
    """

    board: Board
    ids: NDArray[np.int64]
    pixels: FloatArray
    image_size: tuple[int, int]
    sharpness: float = field(default=0.0, kw_only=True)
    square_px: float = field(default=0.0, kw_only=True)
    window: int = field(default=0, kw_only=True)
    unrefined: FloatArray | None = field(default=None, kw_only=True)
    name: str = field(default="", kw_only=True)

    def __post_init__(self) -> None:
        ids = np.array(self.ids, dtype=np.int64)
        pixels = np.array(self.pixels, dtype=np.float64)
        if ids.ndim != 1 or pixels.shape != (ids.size, 2) or not np.isfinite(pixels).all():
            raise CalibrationError(
                sentence(
                    "view {name!r}: {ids_size} corner numbers and pixels of shape "
                    "{pixels_shape}; one finite pixel is needed for every corner",
                    name=self.name,
                    ids_size=ids.size,
                    pixels_shape=pixels.shape,
                )
            )
        if ids.size and (ids.min() < 0 or ids.max() >= self.board.count):
            raise CalibrationError(
                sentence(
                    "view {name!r}: corner {corner_number} is not on the board "
                    "{board_spec}, which has {corners}",
                    name=self.name,
                    corner_number=int(ids.max()),
                    board_spec=self.board.spec,
                    corners=self.board.count,
                )
            )
        rough = None if self.unrefined is None else np.array(self.unrefined, dtype=np.float64)
        if rough is not None and (rough.shape != pixels.shape or not np.isfinite(rough).all()):
            raise CalibrationError(
                sentence(
                    "view {name!r}: unrefined pixels of shape {rough_shape}; one finite pixel is "
                    "needed for every corner",
                    name=self.name,
                    rough_shape=rough.shape,
                )
            )
        order = np.argsort(ids, kind="stable")
        object.__setattr__(self, "ids", read_only(ids[order]))
        object.__setattr__(self, "pixels", read_only(pixels[order]))
        if rough is not None:
            object.__setattr__(self, "unrefined", read_only(rough[order]))

    @property
    def points(self) -> FloatArray:
        """The corners in the board's frame [m], shape (n, 3)."""
        return self.board.points[self.ids]

    def reordered(self, order: NDArray[np.int64]) -> "BoardView":
        """Return the same picture with corner i called `order[i]`."""
        return replace(self, ids=order[self.ids], pixels=self.pixels)

    def without_refinement(self) -> "BoardView":
        """Return the same picture with its corners as the finder gave them, if they are known."""
        if self.unrefined is None:
            return self
        return replace(self, pixels=self.unrefined, unrefined=None, window=0)

    def called(self, name: str) -> "BoardView":
        """Return the same view under a name."""
        return replace(self, name=name)


def named(views: Sequence[BoardView], word: str = "view") -> list[BoardView]:
    """Return views that all have a name; those without one are numbered."""
    return [view if view.name else view.called(f"{word} {i + 1}") for i, view in enumerate(views)]
