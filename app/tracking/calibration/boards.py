"""Calibration boards: what is printed on them, and how it is written in one line.

`checkerboard:COLSxROWS:SQUARE` counts *inner corners* (as OpenCV's chessboard finder does),
`charuco:COLSxROWS:SQUARE:MARKER:DICTIONARY` counts *squares* (as OpenCV's `CharucoBoard` does).
Lengths carry their unit: mm, cm or m. Board frame: origin at the first inner corner, x along the
columns, y along the rows, z away from whoever looks at the print; points lie in z = 0.
"""

import re
from dataclasses import dataclass
from enum import StrEnum
from functools import cached_property
from typing import Any

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, frozen
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.tracking.errors import CalibrationError

UNITS = {"mm": MILLIMETRE, "cm": 0.01, "m": 1.0}
DEFAULT_BOARD = "charuco:9x6:20mm:15mm:DICT_5X5_100"
_FORMS = sentence(
    "checkerboard:COLSxROWS:SQUARE (inner corners, e.g. checkerboard:9x6:25mm) or "
    "charuco:COLSxROWS:SQUARE:MARKER:DICTIONARY (squares, e.g. {example})",
    example=DEFAULT_BOARD,
)


class BoardKind(StrEnum):
    """What is printed."""

    CHECKERBOARD = "checkerboard"
    CHARUCO = "charuco"


@dataclass(frozen=True)
class Board:
    """A flat board with a grid of corners, numbered row by row.

    Attributes:
        kind: checkerboard or ChArUco.
        columns, rows: inner corners.
        square: side of a square [m].
        marker: side of a marker [m]; 0 for a checkerboard.
        dictionary: OpenCV's name of the markers' dictionary; "" for a checkerboard.

    Raises:
        CalibrationError: for counts or lengths that no board has.
    """

    kind: BoardKind
    columns: int
    rows: int
    square: float
    marker: float = 0.0
    dictionary: str = ""

    def __post_init__(self) -> None:
        if min(self.columns, self.rows) < 2 or max(self.columns, self.rows) > 100:
            raise CalibrationError(
                sentence(
                    "a board with {columns}x{rows} inner corners cannot be used; at least "
                    "2x2 and at most 100x100 are needed",
                    columns=self.columns,
                    rows=self.rows,
                )
            )
        if not 1e-4 <= self.square <= 1.0:
            raise CalibrationError(
                sentence(
                    "a square of {square:g} mm cannot be used; 0.1 mm to 1 m are possible",
                    square=self.square * 1e3,
                )
            )
        if self.kind is BoardKind.CHARUCO:
            _check_markers(self)

    @property
    def count(self) -> int:
        """Number of inner corners."""
        return self.columns * self.rows

    @cached_property
    def points(self) -> FloatArray:
        """Inner corners in the board's frame [m], shape (count, 3), row by row."""
        grid = np.mgrid[0 : self.rows, 0 : self.columns].reshape(2, -1)[::-1].T * self.square
        return frozen(np.column_stack([grid, np.zeros(self.count)]))

    @property
    def size(self) -> tuple[float, float]:
        """Width and height of the printed pattern, all squares [m]."""
        return (self.columns + 1) * self.square, (self.rows + 1) * self.square

    @cached_property
    def orders(self) -> tuple[NDArray[np.int64], ...]:
        """Ways to number the corners that no picture can tell apart; the first is the usual one.

        A checkerboard whose corner counts are both odd or both even looks the same after half a
        turn, colours included; one with as many columns as rows, both even, after a quarter too
        (with both odd a quarter turn exchanges the colours). ChArUco corners carry their number.
        """
        ids = np.arange(self.count).reshape(self.rows, self.columns)
        if self.kind is BoardKind.CHARUCO or (self.columns + self.rows) % 2:
            return (ids.ravel(),)
        quarter = self.columns == self.rows and self.columns % 2 == 0
        turns = (0, 1, 2, 3) if quarter else (0, 2)
        return tuple(np.rot90(ids, turn).ravel() for turn in turns)

    @property
    def ambiguous(self) -> bool:
        """Return whether one picture cannot tell which way round the board lies."""
        return len(self.orders) > 1

    @property
    def spec(self) -> str:
        """The line that `parse_board` reads."""
        square = f"{self.square / MILLIMETRE:.10g}mm"
        if self.kind is BoardKind.CHECKERBOARD:
            return f"checkerboard:{self.columns}x{self.rows}:{square}"
        marker = f"{self.marker / MILLIMETRE:.10g}mm"
        return f"charuco:{self.columns + 1}x{self.rows + 1}:{square}:{marker}:{self.dictionary}"

    def charuco(self, legacy: bool = False) -> Any:
        """OpenCV's board, in metres; `legacy` for prints made by OpenCV before 4.6."""
        found = cv2.aruco.CharucoBoard(
            (self.columns + 1, self.rows + 1), self.square, self.marker, _dictionary(self)
        )
        found.setLegacyPattern(legacy)
        return found


def parse_board(spec: str) -> Board:
    """Read a board's line.

    Raises:
        CalibrationError: naming what cannot be read and the form that is valid.
    """
    parts = spec.strip().split(":")
    wanted = {BoardKind.CHECKERBOARD: 3, BoardKind.CHARUCO: 5}
    kind = parts[0].lower()
    if kind not in set(BoardKind) or len(parts) != wanted[BoardKind(kind)]:
        raise CalibrationError(sentence("board {spec!r} is not {forms}", spec=spec, forms=_FORMS))
    columns, rows = _counts(parts[1], spec)
    square = _length(parts[2], spec)
    if kind == BoardKind.CHECKERBOARD:
        return Board(BoardKind.CHECKERBOARD, columns, rows, square)
    name = parts[4].upper()
    name = name if name.startswith("DICT_") else f"DICT_{name}"
    marker = _length(parts[3], spec)
    return Board(BoardKind.CHARUCO, columns - 1, rows - 1, square, marker, name)


def dictionary_names() -> list[str]:
    """Names of OpenCV's marker dictionaries."""
    return sorted(name for name in dir(cv2.aruco) if name.startswith("DICT_"))


def _dictionary(board: Board) -> Any:
    return cv2.aruco.getPredefinedDictionary(getattr(cv2.aruco, board.dictionary))


def _check_markers(board: Board) -> None:
    names = dictionary_names()
    if board.dictionary not in names:
        raise CalibrationError(
            sentence(
                "no marker dictionary is called {board_dictionary!r}; there are {names}",
                board_dictionary=board.dictionary,
                names=", ".join(names),
            )
        )
    if not 0.0 < board.marker < board.square:
        raise CalibrationError(
            sentence(
                "a marker of {board_marker:g} mm does not fit into a square of "
                "{board_square:g} mm; it must be smaller",
                board_marker=board.marker * 1e3,
                board_square=board.square * 1e3,
            )
        )
    needed = (board.columns + 1) * (board.rows + 1) // 2
    if needed > len(_dictionary(board).bytesList):
        raise CalibrationError(
            sentence(
                "board {board_spec} needs {needed} markers; {board_dictionary} has "
                "{dictionary_size}; take a larger dictionary",
                board_spec=board.spec,
                needed=needed,
                board_dictionary=board.dictionary,
                dictionary_size=len(_dictionary(board).bytesList),
            )
        )


def _counts(text: str, spec: str) -> tuple[int, int]:
    found = re.fullmatch(r"(\d{1,3})[xX×](\d{1,3})", text.strip())
    if not found:
        raise CalibrationError(
            sentence("board {spec!r}: {size!r} is not COLSxROWS, e.g. 9x6", spec=spec, size=text)
        )
    return int(found[1]), int(found[2])


def _length(text: str, spec: str) -> float:
    found = re.fullmatch(r"(\d+(?:\.\d*)?|\.\d+)\s*(mm|cm|m)", text.strip())
    if not found:
        raise CalibrationError(
            sentence(
                "board {spec!r}: {length!r} is not a length with its unit; write e.g. 25mm, 2.5cm "
                "or 0.025m",
                spec=spec,
                length=text,
            )
        )
    return float(found[1]) * UNITS[found[2]]


def dark_rectangles(board: Board) -> FloatArray:
    """Black rectangles of a board's print: x, y, width, height [m], shape (n, 4).

    The origin is the pattern's upper left corner, x to the right, y down; the first inner corner
    lies at (square, square). The square in the upper left corner is black.
    """
    rows, columns = board.rows + 1, board.columns + 1
    side = board.square
    squares = [
        (i * side, j * side, side, side)
        for j in range(rows)
        for i in range(columns)
        if (i + j) % 2 == 0
    ]
    if board.kind is BoardKind.CHECKERBOARD:
        return np.array(squares)
    return np.array(squares + _markers(board))


def _markers(board: Board) -> list[tuple[float, float, float, float]]:
    """Black runs of every marker's cells, row by row."""
    charuco = board.charuco()
    dictionary = charuco.getDictionary()
    bits = int(dictionary.markerSize) + 2  # with the black border
    cell = board.marker / bits
    found = []
    for number, corners in zip(charuco.getIds().ravel(), charuco.getObjPoints(), strict=True):
        left, top = np.asarray(corners, dtype=np.float64)[0, :2]
        picture = cv2.aruco.generateImageMarker(dictionary, int(number), bits, borderBits=1)
        for j, row in enumerate(picture == 0):
            edges = np.flatnonzero(np.diff(np.concatenate([[False], row, [False]]).astype(int)))
            for start, end in edges.reshape(-1, 2).tolist():
                x, y = left + start * cell, top + j * cell
                found.append((float(x), float(y), (end - start) * cell, cell))
    return found
