"""A board's corners in one picture, to a fraction of a pixel, or why the picture is of no use."""

from dataclasses import replace
from typing import Any, Final

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.core.messages import sentence
from app.tracking.calibration import finders
from app.tracking.calibration.boards import Board, BoardKind
from app.tracking.calibration.finders import Found, Grey, edge_width
from app.tracking.calibration.grid import (
    extents,
    first_square_is_dark,
    goes_on,
    is_mirrored,
    local_axes,
    mapped,
    plane_map,
)
from app.tracking.calibration.views import BoardView, Rejection, RejectionReason
from app.tracking.errors import CalibrationError

WINDOW_SHARE = 1.0 / 3.0
"""Half the sub-pixel window over the shortest way across a square, where edges are sharp.

At 0.4 corners of oblique squares are drawn to the next edge, at 0.2 noise is averaged less.
"""

EDGE_FACTOR = 1.5
"""Half the window over the width of the edges, where that asks for more (`acus study corners`).

In a window narrower than the blurred edges nearly all gradients vanish: what is left is noise.
"""

WIDEST_SHARE = 0.5
"""The window of a blurred picture grows no further than this: beyond lie the next corners."""

MARKER_SHARE = 1.15
"""The same over the white between a square's edge and its marker.

Wider windows hold the marker's corner, which draws: on rendered boards with noise of 2 levels the
root mean square error rises from 0.03 px to 0.14 px at a third of the square.
"""

WINDOW_MAX = 11
"""Half the largest window [px]."""

SMALLEST_SQUARE = 5.0
"""Shortest way across a square [px] from which corners can be refined."""

MOST_BLUR = 0.35
"""Width of the edges over the shortest way across a square beyond which a picture is blurred.

Edges up to 4 px, which is what a good camera has, are taken in smaller squares as well, up to 0.55.
"""

LEAST_COSINE = 0.15
"""Foreshortening beyond which a board is seen on edge: 81 degrees."""

LEAST_CORNERS = 6
_STOP = (cv2.TERM_CRITERIA_EPS | cv2.TERM_CRITERIA_MAX_ITER, 60, 1e-4)


def find_corners(
    image: NDArray[Any], board: Board, thorough: bool = True, window: int | None = None
) -> BoardView | Rejection:
    """Find a board in a picture.

    Args:
        image: 8 or 16 bit, grey (h, w) or BGR (h, w, 3).
        board: which board.
        thorough: also try local contrast, an exhaustive search and other scales: for pictures on
            disk. Without it a picture takes some tens of milliseconds: for live pictures.
        window: half the sub-pixel window [px]; chosen from the squares' size in the picture if
            None. A fixed one is for comparison with other programs.

    Returns:
        The view, or a rejection with its reason.

    Raises:
        CalibrationError: if `image` is no picture.
    """
    grey = to_grey(image)
    if board.kind is BoardKind.CHARUCO:
        found: Found | Rejection = _charuco(grey, board, thorough)
    else:
        found = _checkerboard(grey, board, thorough)
    return found if isinstance(found, Rejection) else _measured(grey, board, found, window)


def to_grey(image: NDArray[Any]) -> Grey:
    """Grey levels of a picture, uint8 (h, w).

    Raises:
        CalibrationError: if it is not 8 or 16 bit, or has another shape.
    """
    shape = np.shape(image)
    usable = image.dtype in (np.uint8, np.uint16) and min(shape[:2], default=0) >= 16
    if not usable or not (len(shape) == 2 or (len(shape) == 3 and shape[2] == 3)):
        raise CalibrationError(
            sentence(
                "an array of {image_dtype} and shape {shape} is no picture; 8 or 16 bit, grey or "
                "BGR, at least 16x16 pixels is needed",
                image_dtype=image.dtype,
                shape=shape,
            )
        )
    if image.dtype == np.uint16:
        image = cv2.convertScaleAbs(image, alpha=255.0 / max(1, int(image.max())))
    grey = image if image.ndim == 2 else cv2.cvtColor(image, cv2.COLOR_BGR2GRAY)
    result: Grey = np.ascontiguousarray(grey, dtype=np.uint8)
    return result


def _checkerboard(grey: Grey, board: Board, thorough: bool) -> Found | Rejection:
    pixels = finders.checkerboard(grey, board, thorough)
    if pixels is None:
        return Rejection(
            RejectionReason.NO_BOARD,
            sentence(
                "no board with {board_columns}x{board_rows} inner corners is seen as a whole; "
                "show all of it with a white rim, or check the counts",
                board_columns=board.columns,
                board_rows=board.rows,
            ),
        )
    return np.arange(board.count), _usual_order(grey, board, pixels)


def _usual_order(grey: Grey, board: Board, pixels: FloatArray) -> FloatArray:
    """Order corners as on the print: not mirrored, the first square dark where that tells."""
    grid = pixels.reshape(board.rows, board.columns, 2)
    homography = plane_map(board, np.arange(board.count), pixels)
    if homography is not None and is_mirrored(homography, board):
        grid = grid[:, ::-1]
    pixels = grid.reshape(-1, 2)
    if first_square_is_dark(grey, board, pixels):
        return pixels
    if (board.columns + board.rows) % 2:
        return pixels[::-1]
    if board.columns == board.rows and board.columns % 2:
        turned: FloatArray = np.rot90(pixels.reshape(board.rows, board.columns, 2)).reshape(-1, 2)
        return turned
    return pixels


def _charuco(grey: Grey, board: Board, thorough: bool) -> Found | Rejection:
    found, markers = finders.charuco(grey, board, thorough)
    if found is not None and found[0].size >= LEAST_CORNERS:
        return found
    mirrored, _ = finders.charuco(np.ascontiguousarray(grey[:, ::-1]), board, False)
    if mirrored is not None and mirrored[0].size >= LEAST_CORNERS:
        return Rejection(
            RejectionReason.MIRRORED,
            sentence("the picture is mirrored; turn the camera's mirror mode off"),
        )
    if found is not None:
        return Rejection(
            RejectionReason.PARTLY,
            sentence(
                "only {first_size} corners are seen; {least_corners} are needed",
                first_size=found[0].size,
                least_corners=LEAST_CORNERS,
            ),
        )
    if markers >= 4:
        return Rejection(
            RejectionReason.OTHER_BOARD,
            sentence(
                "{markers} markers of {board_dictionary} are seen, but they do not lie as on "
                "{board_spec}; {counted}",
                markers=markers,
                board_dictionary=board.dictionary,
                board_spec=board.spec,
                counted=_counted(grey, board),
            ),
        )
    return Rejection(
        RejectionReason.NO_BOARD,
        sentence(
            "no ChArUco board with markers of {board_dictionary} is seen; check the dictionary",
            board_dictionary=board.dictionary,
        ),
    )


def _counted(grey: Grey, board: Board) -> str:
    """Say whether the board fits if its inner corners were counted in place of its squares."""
    try:
        larger = replace(board, columns=board.columns + 1, rows=board.rows + 1)
    except CalibrationError:  # more markers than the dictionary has
        return sentence("check the counts of squares")
    found, _ = finders.charuco(grey, larger, False)
    if found is not None and found[0].size >= LEAST_CORNERS:
        return sentence(
            "they fit {larger_spec}: squares are counted, not inner corners",
            larger_spec=larger.spec,
        )
    return sentence("check the counts of squares")


def _measured(grey: Grey, board: Board, result: Found, window: int | None) -> BoardView | Rejection:
    """Refine corners, and refuse what cannot be measured well."""
    ids, pixels = result
    homography = plane_map(board, ids, pixels)
    if homography is None:
        return Rejection(
            RejectionReason.PARTLY,
            sentence("the corners seen lie on one line; show more of the board"),
        )
    seen = board.points[ids, :2] / board.square
    short, cosine = extents(local_axes(homography, seen))
    square_px = float(short.min())
    if cosine.min() < LEAST_COSINE:
        return Rejection(
            RejectionReason.EDGE_ON,
            sentence(
                "the board is seen on edge ({tilt_deg:.0f}°); turn it to "
                "the camera, up to {largest_tilt_deg:.0f}° are possible",
                tilt_deg=np.degrees(np.arccos(cosine.min())),
                largest_tilt_deg=np.degrees(np.arccos(LEAST_COSINE)),
            ),
        )
    if square_px < SMALLEST_SQUARE:
        return Rejection(
            RejectionReason.TOO_SMALL,
            sentence(
                "a square is only {square_px:.1f} px across; {smallest_square:g} px are needed: "
                "bring the board nearer",
                square_px=square_px,
                smallest_square=SMALLEST_SQUARE,
            ),
        )
    if not _lies_flat(ids, pixels, board, square_px, (grey.shape[1], grey.shape[0])):
        return Rejection(
            RejectionReason.OTHER_BOARD,
            sentence("the corners found do not lie on a grid; check the board's counts"),
        )
    if board.kind is BoardKind.CHECKERBOARD and goes_on(grey, board, homography):
        return Rejection(
            RejectionReason.OTHER_BOARD,
            sentence(
                "the board has more than {board_columns}x{board_rows} inner corners; count them "
                "anew",
                board_columns=board.columns,
                board_rows=board.rows,
            ),
        )
    sharpness = edge_width(grey, board, homography, seen)
    if sharpness > max(MOST_BLUR * square_px, min(4.0, 0.55 * square_px)):
        return Rejection(
            RejectionReason.BLURRED,
            sentence(
                "the picture is blurred: edges are {sharpness:.1f} px wide, squares "
                "{square_px:.0f} px; hold the board still and focus",
                sharpness=sharpness,
                square_px=square_px,
            ),
        )
    half = window or half_window(board, square_px, sharpness)
    return BoardView(
        board,
        ids,
        refined(grey, pixels, half),
        (grey.shape[1], grey.shape[0]),
        sharpness=sharpness,
        square_px=square_px,
        window=half,
        unrefined=pixels,
    )


def half_window(board: Board, square_px: float, edge_px: float) -> int:
    """Half the sub-pixel window [px] for squares and edges of this size.

    A third of the shortest way across a square; where edges are wide, `EDGE_FACTOR` of their width,
    up to half the square. ChArUco corners have no more room than the white around the markers.

    Args:
        board: which board.
        square_px: shortest way across a square in the picture.
        edge_px: width of its edges.
    """
    if board.kind is BoardKind.CHECKERBOARD:
        room = WIDEST_SHARE * square_px
        half = min(max(WINDOW_SHARE * square_px, EDGE_FACTOR * edge_px), room)
    else:
        margin = 0.5 * (1.0 - board.marker / board.square)
        half = min(WINDOW_SHARE, MARKER_SHARE * margin) * square_px
    return int(np.clip(np.floor(half), 2, WINDOW_MAX))


def refined(grey: Grey, pixels: FloatArray, half: int) -> FloatArray:
    """Corners to a fraction of a pixel: where all gradients of the window point to (cornerSubPix).

    A corner that would leave its window stays where it was.
    """
    start = np.ascontiguousarray(pixels, dtype=np.float32).reshape(-1, 1, 2)
    found = cv2.cornerSubPix(grey, start.copy(), (half, half), (-1, -1), _STOP)
    result: FloatArray = np.asarray(found, dtype=np.float64).reshape(-1, 2)
    moved = np.linalg.norm(result - pixels, axis=1)
    keep = ~np.isfinite(moved) | (moved > half)
    result[keep] = pixels[keep]
    return result


STRAIGHTENED: Final = (0.0, -0.2, -0.4, -0.6, -0.8)
"""λ·R² of the division model r / (1 + λ·r²) (Fitzgibbon 2001), R half the picture's diagonal, by
which corners are straightened that a wide lens has bent."""


def _lies_flat(
    ids: NDArray[np.int64],
    pixels: FloatArray,
    board: Board,
    square_px: float,
    size: tuple[int, int],
) -> bool:
    """Return whether corners lie on a plane grid, by half a square, as they are or seen by a wide
    lens.
    """
    seen = board.points[ids, :2] / board.square
    middle = 0.5 * (np.array(size) - 1.0)
    out = (pixels - middle) / np.linalg.norm(middle)
    for bend in STRAIGHTENED:
        factor = 1.0 / (1.0 + bend * (out**2).sum(axis=1, keepdims=True))
        straight = middle + (pixels - middle) * factor
        homography = plane_map(board, ids, straight)
        if homography is None:
            continue
        away = np.linalg.norm((mapped(homography, seen) - straight) / factor, axis=1)
        if np.isfinite(away).all() and away.max() < 0.5 * square_px + 2.0:
            return True
    return False
