"""Where the corners are, roughly: OpenCV's finders, from the quick one to the patient ones.
Beside them, how sharp the squares' edges are.
"""

from collections.abc import Callable, Iterator

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray
from app.tracking.calibration.boards import Board, BoardKind
from app.tracking.calibration.grid import local_axes, mapped

_REACH = 8.0
"""Profiles reach this far to both sides of an edge [px]."""

_SAMPLES = 33


def edge_width(
    grey: NDArray[np.uint8], board: Board, homography: FloatArray, seen: FloatArray
) -> float:
    """Width of the edges of the squares between the corners `seen` [px].

    The step's height over its steepest slope, median over all edges: for a step blurred by a
    Gaussian that is its width from 10 to 90 % (within 2 %). Profiles end where the next corner's
    square or a ChArUco marker begins.

    Args:
        grey: picture, shape (h, w).
        board: which board.
        homography: board [squares] to pixels.
        seen: board points of the corners found [squares], shape (n, 2).
    """
    columns = _edges(grey, board, homography, seen, 0)
    rows = _edges(grey, board, homography, seen, 1)
    widths = np.concatenate([columns, rows])
    return float(np.median(widths)) if widths.size else 0.0


def _edges(
    grey: NDArray[np.uint8], board: Board, homography: FloatArray, seen: FloatArray, along: int
) -> FloatArray:
    """Widths of the edges that run along x (0) or y (1)."""
    step = np.eye(2)[along]
    known = {tuple(point) for point in np.rint(seen).astype(int)}
    starts = [p for p in known if (p[0] + int(step[0]), p[1] + int(step[1])) in known]
    if not starts:
        return np.zeros(0)
    middle = np.array(sorted(starts)) + 0.5 * step
    axes = local_axes(homography, middle)
    height = np.abs(np.linalg.det(axes)) / np.linalg.norm(axes[:, :, along], axis=1)
    margin = (
        0.4 if board.kind is BoardKind.CHECKERBOARD else 0.5 * (1 - board.marker / board.square)
    )
    reach = np.minimum(margin, _REACH / height)  # [squares]
    t = np.linspace(-1.0, 1.0, _SAMPLES)
    place = mapped(homography, middle)[:, None, :] + (
        (reach[:, None] * t)[..., None] * axes[:, None, :, 1 - along]
    )
    values = cv2.remap(
        grey,
        place[..., 0].astype(np.float32),
        place[..., 1].astype(np.float32),
        cv2.INTER_LINEAR,
        borderMode=cv2.BORDER_REPLICATE,
    ).astype(np.float64)
    return _widths(values, 2.0 * reach * height / (_SAMPLES - 1))


def _widths(values: FloatArray, spacing: FloatArray) -> FloatArray:
    """Step over slope of profiles (n, samples) sampled at `spacing` [px], (n,)."""
    step = np.ptp(values, axis=1)
    apart = np.clip(np.rint(1.0 / np.maximum(spacing, 1e-9)), 1, _SAMPLES // 4).astype(int)
    slope = np.empty(len(values))
    for count in np.unique(apart):
        rows = apart == count
        change = np.abs(values[rows, count:] - values[rows, :-count]).max(axis=1)
        slope[rows] = change / (count * spacing[rows])
    clear = (step > 8.0) & (slope > 0.0)
    result: FloatArray = step[clear] / slope[clear]
    return result


Grey = NDArray[np.uint8]
Found = tuple[NDArray[np.int64], FloatArray]
"""Numbers (n,) and pixels (n, 2) of corners."""

_QUICK = cv2.CALIB_CB_ADAPTIVE_THRESH | cv2.CALIB_CB_NORMALIZE_IMAGE | cv2.CALIB_CB_FAST_CHECK
_PATIENT = cv2.CALIB_CB_ADAPTIVE_THRESH | cv2.CALIB_CB_NORMALIZE_IMAGE
_SECTORS = cv2.CALIB_CB_NORMALIZE_IMAGE
_EXHAUSTIVE = _SECTORS | cv2.CALIB_CB_EXHAUSTIVE


def checkerboard(grey: Grey, board: Board, thorough: bool) -> FloatArray | None:
    """Corners of a checkerboard, all of them, shape (count, 2), or None.

    First the plain finder (quick where it succeeds), then the sector-based one (Duda and Frese
    2018), which finds what the plain one misses; `thorough` adds local contrast, an exhaustive
    search and other scales.
    """
    size = (board.columns, board.rows)
    for attempt in _attempts(grey, thorough):
        found, corners = attempt(size)
        if found and corners is not None:
            pixels: FloatArray = np.asarray(corners, dtype=np.float64).reshape(-1, 2)
            if np.isfinite(pixels).all() and len(pixels) == board.count:
                return pixels
    return None


Attempt = Callable[[tuple[int, int]], tuple[bool, FloatArray | None]]


def _attempts(grey: Grey, thorough: bool) -> Iterator[Attempt]:
    yield lambda size: cv2.findChessboardCorners(grey, size, flags=_QUICK)
    yield lambda size: cv2.findChessboardCornersSB(grey, size, flags=_SECTORS)
    if not thorough:
        return
    even = cv2.createCLAHE(3.0, (8, 8)).apply(grey)
    yield lambda size: cv2.findChessboardCornersSB(even, size, flags=_EXHAUSTIVE)
    yield lambda size: cv2.findChessboardCorners(even, size, flags=_PATIENT)
    for scale in scales(grey):
        yield lambda size, scale=scale: _scaled(even, size, scale)  # type: ignore[misc]


def scales(grey: Grey) -> tuple[float, ...]:
    """Scales worth trying besides 1: up for small pictures, down for large ones."""
    longest = max(grey.shape)
    if longest < 500:
        return (2.0, 3.0)
    return (2.0,) if longest <= 1000 else (0.5,)


def resized(grey: Grey, scale: float) -> Grey:
    """Return the picture at another scale."""
    way = cv2.INTER_CUBIC if scale > 1.0 else cv2.INTER_AREA
    result: Grey = cv2.resize(grey, None, fx=scale, fy=scale, interpolation=way)
    return result


def unscaled(pixels: FloatArray, scale: float) -> FloatArray:
    """Pixels of a resized picture in the original; (0, 0) is the centre of the first pixel."""
    return (pixels + 0.5) / scale - 0.5


def _scaled(grey: Grey, size: tuple[int, int], scale: float) -> tuple[bool, FloatArray | None]:
    found, corners = cv2.findChessboardCornersSB(resized(grey, scale), size, flags=_SECTORS)
    if not found or corners is None:
        return False, None
    return True, unscaled(np.asarray(corners, dtype=np.float64).reshape(-1, 2), scale)


def charuco(grey: Grey, board: Board, thorough: bool) -> tuple[Found | None, int]:
    """Corners of a ChArUco board with their numbers, and how many of its markers were seen.

    Where markers are seen but no corner fits, the pattern of OpenCV before 4.6 is tried (there the
    first square of a board with an even number of rows is white). `thorough` adds local contrast
    and another scale.
    """
    best: Found | None = None
    seen = 0
    for picture, scale in _pictures(grey, thorough):
        for legacy in (False, True):
            found, markers = _charuco_once(picture, board, legacy)
            seen = max(seen, markers)
            if found is not None and (best is None or found[0].size > best[0].size):
                best = (found[0], unscaled(found[1], scale))
            if best is not None or not markers:
                break
        if best is not None and best[0].size >= 0.5 * board.count:
            break
    return best, seen


def _pictures(grey: Grey, thorough: bool) -> Iterator[tuple[Grey, float]]:
    yield grey, 1.0
    if thorough:
        yield cv2.createCLAHE(3.0, (8, 8)).apply(grey), 1.0
        scale = scales(grey)[0]
        yield resized(grey, scale), scale


def _charuco_once(grey: Grey, board: Board, legacy: bool) -> tuple[Found | None, int]:
    parameters = cv2.aruco.CharucoParameters()
    detector = cv2.aruco.CharucoDetector(board.charuco(legacy), parameters)
    corners, ids, _, marker_ids = detector.detectBoard(grey)
    markers = 0 if marker_ids is None else len(marker_ids)
    if ids is None or corners is None or len(ids) == 0:
        return None, markers
    pixels: FloatArray = np.asarray(corners, dtype=np.float64).reshape(-1, 2)
    return (np.asarray(ids, dtype=np.int64).ravel(), pixels), markers
