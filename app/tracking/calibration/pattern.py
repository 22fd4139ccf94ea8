"""What of a board is black: rectangles to print."""

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.tracking.calibration.boards import Board, BoardKind


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
