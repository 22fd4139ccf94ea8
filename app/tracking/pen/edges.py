"""Corners of printed squares to a few hundredths of a pixel: a line along each edge, intersected.

Along the normal of an edge the picture rises from black to white. With its levels known, the area
under the rise gives the place of the edge whatever the blur (the first moment of a symmetric blur
is zero). A line is fitted to these places; the scatter round it, and that of the levels, gives its
covariance. All edges of a picture are measured together.
"""

from dataclasses import dataclass

import cv2
import numpy as np
from numpy.typing import NDArray

from app.core.arrays import FloatArray, read_only

Grey = NDArray[np.uint8]

NARROWEST = 14.0
"""Width [px] across an edge below which a square is too small, or seen too much from its side."""

_SAMPLES = 26
_ENDS = 0.14
"""Share of an edge that is left out at each end: the other edges round it off."""
_REACHES = (3.0, 3.0, 1.6)
"""How far each pass looks on either side of the edge [px]; the second takes the levels."""
_LEVELS = 1
_ACROSS = 9
_PLATEAU = 2
"""Samples at either end of a profile that give its levels."""
_CELL = 0.11
"""Part of the width across an edge that a profile may reach: less than a cell of the marker."""
_CORRELATION = 1.5
"""Samples a pixel apart share pixels: variance of their mean over that of independent ones."""
_LEAST_CONTRAST = 15.0
_FLOOR = 0.01
"""Least scatter of an edge [px]: grey values are whole numbers."""
_PARALLEL = 0.1


@dataclass(frozen=True, slots=True, eq=False)
class Square:
    """A measured square: corners [px], shape (4, 2), and covariance [px²], shape (8, 8)."""

    corners: FloatArray
    covariance: FloatArray


@dataclass(slots=True, eq=False)
class _Lines:
    """Lines of all edges, first axis: the edge; offsets count along the outward normal."""

    start: FloatArray
    along: FloatArray
    normal: FloatArray
    length: FloatArray
    width: FloatArray  # of the square across the edge [px]
    places: FloatArray  # along the edge [px], (n, samples)
    good: NDArray[np.bool_]
    offset: FloatArray  # at the middle of the edge
    slope: FloatArray
    scatter: FloatArray  # variance of one sample [px²]
    used: FloatArray
    spread: FloatArray  # sum of the squared places about the middle
    levels: FloatArray  # black, white, (n, 2)
    level_share: FloatArray  # variance of the offset that the levels bring [px²]

    @property
    def reduced(self) -> FloatArray:
        """Places about the middle of the edge."""
        return self.places - 0.5 * self.length[:, None]

    def middle(self) -> FloatArray:
        """Offsets of the fitted lines at the samples, (n, samples)."""
        return self.offset[:, None] + self.slope[:, None] * self.reduced


def measure_squares(grey: Grey, corners: FloatArray) -> list[Square | None]:
    """Measure black squares on white whose corners are known to about a pixel and a half.

    Args:
        grey: picture, shape (height, width).
        corners: about where they are [px], clockwise in the picture, shape (n, 4, 2).

    Returns:
        For each None if an edge is too short, leaves the picture, or is no clean step.
    """
    if not len(corners):
        return []
    lines = _lines(corners)
    for number, reach in enumerate(_REACHES):
        _fit(grey, lines, np.minimum(reach, np.maximum(_CELL * lines.width, 1.0)), number)
    return _squares(lines)


def _lines(corners: FloatArray) -> _Lines:
    start = corners.reshape(-1, 2)
    way = np.roll(corners, -1, axis=1).reshape(-1, 2) - start
    length = np.linalg.norm(way, axis=1)
    along = way / np.maximum(length, 1e-9)[:, None]
    places = length[:, None] * np.linspace(_ENDS, 1.0 - _ENDS, _SAMPLES)
    diagonals = corners[:, 2:] - corners[:, :2]
    (x0, y0), (x1, y1) = diagonals[:, 0].T, diagonals[:, 1].T
    area = 0.5 * np.abs(x0 * y1 - y0 * x1)
    width = np.repeat(area, 4) / np.maximum(length, 1e-9)
    n = len(start)
    return _Lines(
        start,
        along,
        np.column_stack([along[:, 1], -along[:, 0]]),  # clockwise, y down: outside is to the left
        length,
        width,
        places,
        (width >= NARROWEST) & (length >= NARROWEST),
        np.zeros(n),
        np.zeros(n),
        np.zeros(n),
        np.zeros(n),
        np.zeros(n),
        np.zeros((n, 2)),
        np.zeros(n),
    )


def _fit(grey: Grey, lines: _Lines, reach: FloatArray, number: int) -> None:
    """Fit all lines anew to where the picture steps within `reach` [px] of them."""
    across = reach[:, None] * np.linspace(-1.0, 1.0, _ACROSS)
    values = _profiles(grey, lines, across)
    if number <= _LEVELS:
        _take_levels(lines, values, reach)
    contrast = lines.levels[:, 1] - lines.levels[:, 0]
    lines.good &= contrast > _LEAST_CONTRAST
    contrast = np.where(lines.good, contrast, 1.0)
    # A step at s: the integral over (v - black) is contrast·(reach - s). Trapezoids.
    weights = np.full(_ACROSS, 2.0 / (_ACROSS - 1))
    weights[[0, -1]] *= 0.5
    share = ((values - lines.levels[:, :1, None]) @ weights) / contrast[:, None]
    _regress(lines, lines.middle() + reach[:, None] * (1.0 - share))
    if number > _LEVELS:  # the levels' error was kept for the reach with which they were taken
        lines.level_share *= reach**2


def _profiles(grey: Grey, lines: _Lines, across: FloatArray) -> FloatArray:
    """Grey values, (n, samples, across); edges that leave the picture are no longer good."""
    off = lines.middle()[:, :, None] + across[:, None, :]
    points = (
        lines.start[:, None, None]
        + lines.places[:, :, None, None] * lines.along[:, None, None]
        + off[..., None] * lines.normal[:, None, None]
    )
    limit = np.array([grey.shape[1], grey.shape[0]]) - 1.0
    lines.good &= ((points >= 0.0) & (points <= limit)).all(axis=(1, 2, 3))
    flat = points.reshape(len(points), -1, 2).astype(np.float32)
    values = cv2.remap(grey, flat, None, cv2.INTER_LINEAR, borderMode=cv2.BORDER_REPLICATE)
    return np.asarray(values, dtype=np.float64).reshape(off.shape)


def _take_levels(lines: _Lines, values: FloatArray, reach: FloatArray) -> None:
    """Black and white of each edge from the ends of its profiles, and what they are worth."""
    ends = (values[:, :, :_PLATEAU], values[:, :, -_PLATEAU:])
    lines.levels = np.column_stack([end.mean(axis=(1, 2)) for end in ends])
    contrast = np.maximum(lines.levels[:, 1] - lines.levels[:, 0], 1.0)
    pixels = np.minimum(_SAMPLES, lines.length * (1.0 - 2.0 * _ENDS))
    # Grey of single samples varies along the edge; of the mean of independent pixels much less.
    variance = sum(end.mean(axis=2).var(axis=1) for end in ends)
    lines.level_share = _CORRELATION * variance / np.maximum(pixels, 1.0) / contrast**2


def _regress(lines: _Lines, steps: FloatArray) -> None:
    """Fit lines to the steps, without the samples that lie far from them."""
    x = lines.reduced
    keep = np.ones(steps.shape)
    for _ in range(2):
        count = np.maximum(keep.sum(axis=1), 1.0)
        mean_x, mean = (keep * x).sum(axis=1) / count, (keep * steps).sum(axis=1) / count
        about = x - mean_x[:, None]
        spread = np.maximum((keep * about**2).sum(axis=1), 1e-9)
        slope = (keep * about * (steps - mean[:, None])).sum(axis=1) / spread
        rest = steps - mean[:, None] - slope[:, None] * about
        scale = 1.4826 * np.median(np.abs(rest), axis=1)
        used, squares = count, (keep * rest**2).sum(axis=1)
        keep = (np.abs(rest) <= 4.0 * np.maximum(scale, _FLOOR)[:, None]).astype(np.float64)
    lines.offset, lines.slope = mean - slope * mean_x, slope
    lines.scatter, lines.used, lines.spread = squares / np.maximum(used - 2.0, 1.0), used, spread
    lines.good &= (used >= 0.6 * _SAMPLES) & (np.abs(lines.offset) < 3.0) & (np.abs(slope) < 0.2)


def _squares(lines: _Lines) -> list[Square | None]:
    """Intersect neighbouring lines; J carries offset and slope of all four to the corners."""
    direction = lines.along + lines.slope[:, None] * lines.normal
    direction /= np.linalg.norm(direction, axis=1)[:, None]
    normals = np.column_stack([direction[:, 1], -direction[:, 0]])
    middle = lines.start + 0.5 * lines.length[:, None] * lines.along
    middle += lines.offset[:, None] * lines.normal
    offsets = (normals * middle).sum(axis=1)
    # Corner i of a square lies where edge i - 1 meets edge i.
    before = np.arange(len(offsets)).reshape(-1, 4)[:, [3, 0, 1, 2]].ravel()
    (a, b), (c, d) = normals[before].T, normals.T
    determinant = a * d - b * c
    good = (lines.good & (np.abs(determinant) >= _PARALLEL)).reshape(-1, 4).all(axis=1)
    scale = 1.0 / np.where(np.abs(determinant) >= _PARALLEL, determinant, 1.0)
    by_before, by_own = np.column_stack([d, -c]), np.column_stack([-b, a])
    by_before, by_own = by_before * scale[:, None], by_own * scale[:, None]
    corners = by_before * offsets[before, None] + by_own * offsets[:, None]
    place_before = ((corners - middle[before]) * lines.along[before]).sum(axis=1)
    place_own = ((corners - middle) * lines.along).sum(axis=1)
    jacobian = np.zeros((len(good), 4, 2, 4, 2))  # square, corner, xy, edge, offset or slope
    for i in range(4):
        own = slice(i, None, 4)
        jacobian[:, i, :, i - 1, 0] = by_before[own]
        jacobian[:, i, :, i - 1, 1] = by_before[own] * place_before[own, None]
        jacobian[:, i, :, i, 0] = by_own[own]
        jacobian[:, i, :, i, 1] = by_own[own] * place_own[own, None]
    by_lines = jacobian.reshape(-1, 8, 8)
    covariances = (by_lines * _line_variances(lines)[:, None, :]) @ by_lines.transpose(0, 2, 1)
    return [
        Square(read_only(square), read_only(covariance)) if fine else None
        for square, covariance, fine in zip(
            corners.reshape(-1, 4, 2), covariances, good, strict=True
        )
    ]


def _line_variances(lines: _Lines) -> FloatArray:
    """Variances of offset and slope of four edges, their scatter pooled, shape (squares, 8)."""
    pooled = np.maximum(lines.scatter.reshape(-1, 4).mean(axis=1), _FLOOR**2)
    scatter = np.repeat(pooled, 4)
    pixels = lines.length * (1.0 - 2.0 * _ENDS)
    shared = np.maximum(1.0, _CORRELATION * lines.used / np.maximum(pixels, 1.0))
    offset = scatter * shared / np.maximum(lines.used, 1.0) + lines.level_share
    slope = scatter * shared / lines.spread
    return np.stack([offset, slope], axis=-1).reshape(-1, 8)
