"""Closed contours on parallel planes become voxels.

Contours of one plane: one inside another is a hole, one inside that an island; a contour that is
there twice counts once, and contours that cross are joined. Between two planes the shape is
interpolated by distance from the lines (Raya, Udupa 1990); at its ends a region reaches half of the
planes' distance further.
"""

from __future__ import annotations

from collections.abc import Sequence
from dataclasses import dataclass

import numpy as np
from numpy.typing import NDArray
from scipy.spatial import cKDTree

from app.core.arrays import FloatArray

Picture = NDArray[np.bool_]

SAME_LINE_MM = 0.15
"""Lines that keep this near to each other are one line, drawn twice: two roundings to 0.1 mm."""

ONE_PLANE_MM = 0.1
"""Contours whose heights differ by no more lie on one plane."""

JOINED_MM = 10.0
"""Two planes further apart are never joined where nothing says how far apart planes usually are."""

_NESTED = 0.95
_WIDER = 1.5
_SAMPLES = 200


def even_odd(lines: Sequence[FloatArray], shape: tuple[int, int]) -> Picture:
    """Return which pixel centres lie inside an odd number of lines.

    A keyhole (one line that runs in to a hole through a channel and back again) gives the same as
    two lines, since the channel has no width.

    Args:
        lines: closed lines of points (column, row) as floats, each of shape (n, 2); the last point
            is joined to the first.
        shape: rows and columns of the picture.

    Returns:
        Shape (rows, columns).
    """
    rows, columns = shape
    toggles = np.zeros((rows, columns + 1), np.uint8)
    for line in lines:
        start, end = line, np.roll(line, -1, axis=0)
        low, high = np.minimum(start[:, 1], end[:, 1]), np.maximum(start[:, 1], end[:, 1])
        # rows whose centre lies in [low, high): a corner on a row counts once
        first = np.clip(np.ceil(low), 0, rows).astype(np.intp)
        last = np.clip(np.ceil(high), 0, rows).astype(np.intp)
        count = last - first
        edge = np.repeat(np.arange(len(line)), count)
        row = np.arange(count.sum()) - np.repeat(np.cumsum(count) - count, count) + first[edge]
        share = (row - start[edge, 1]) / (end[edge, 1] - start[edge, 1])
        crossing = start[edge, 0] + share * (end[edge, 0] - start[edge, 0])
        column = np.clip(np.ceil(crossing), 0, columns).astype(np.intp)
        np.bitwise_xor.at(toggles, (row, column), 1)
    inside: Picture = np.bitwise_xor.accumulate(toggles, axis=1)[:, :-1].astype(bool)
    return inside


@dataclass(frozen=True, slots=True, eq=False)
class ContourPlane:
    """The contours of one plane.

    Attributes:
        height: of the plane, in slices of the grid.
        lines: points (column, row), each of shape (n, 2); none twice.
        picture: which pixel centres they hold.
        crossed: whether some of them cross, so that they were joined.
        repeated: how many were there before, and count once.
    """

    height: float
    lines: tuple[FloatArray, ...]
    picture: Picture
    crossed: bool
    repeated: int

    @classmethod
    def of(
        cls,
        height: float,
        lines: Sequence[FloatArray],
        shape: tuple[int, int],
        pixel_mm: FloatArray,
        odd: bool = False,
    ) -> ContourPlane:
        """Fill the contours of a plane.

        Args:
            height: of the plane.
            lines: as in `even_odd`.
            shape: rows and columns.
            pixel_mm: distance of columns, and of rows, shape (2,).
            odd: take what lies inside an odd number of them (CLOSEDPLANAR_XOR), crossing or not.
        """
        single: list[FloatArray] = []
        for line in lines:
            if not any(_same(line * pixel_mm, other * pixel_mm) for other in single):
                single.append(line)
        if odd or len(single) == 1:
            picture, crossed = even_odd(single, shape), False
        else:
            picture, crossed = _nested(single, shape, pixel_mm)
        return cls(height, tuple(single), picture, crossed, len(lines) - len(single))


def _nested(
    lines: Sequence[FloatArray], shape: tuple[int, int], pixel_mm: FloatArray
) -> tuple[Picture, bool]:
    """Fill lines by how deep each lies in others, and tell whether any cross."""
    lines = sorted(lines, key=lambda line: -_area(line))
    depths: list[int] = []
    crossed = False
    for number, line in enumerate(lines):
        depth = 0
        for other in range(number):
            share = _share_inside(line * pixel_mm, lines[other] * pixel_mm)
            if share >= _NESTED:
                depth = max(depth, depths[other] + 1)
            crossed |= 0.0 < share < _NESTED
        depths.append(depth)
    picture = np.zeros(shape, bool)
    for depth in range(max(depths) + 1):
        for line, own in zip(lines, depths, strict=True):
            if own == depth:
                inside = even_odd([line], shape)
                picture = picture & ~inside if depth % 2 else picture | inside
    return picture, crossed


def _area(line: FloatArray) -> float:
    x, y = line.T
    return abs(float(x @ np.roll(y, -1) - y @ np.roll(x, -1))) / 2.0


def _same(item: FloatArray, other: FloatArray) -> bool:
    """Return whether two lines run in one place: every corner of each lies near the other."""
    ends = (item.min(axis=0) - other.min(axis=0), item.max(axis=0) - other.max(axis=0))
    if np.abs(ends).max() > SAME_LINE_MM:
        return False
    return bool(
        _from_line(item, other).max() <= SAME_LINE_MM
        and _from_line(other, item).max() <= SAME_LINE_MM
    )


def _from_line(points: FloatArray, line: FloatArray) -> FloatArray:
    """Distances of points from a closed line, shape (n,)."""
    along = np.roll(line, -1, axis=0) - line
    length2 = np.maximum((along * along).sum(axis=1), 1e-24)
    nearest = np.full(len(points), np.inf)
    for begin in range(0, len(points), 512):
        away = points[begin : begin + 512, None] - line
        share = np.clip((away * along).sum(axis=2) / length2, 0.0, 1.0)
        off = away - share[..., None] * along
        nearest[begin : begin + 512] = np.sqrt((off * off).sum(axis=2).min(axis=1))
    return nearest


def _share_inside(line: FloatArray, other: FloatArray) -> float:
    """Share of a line that runs inside another one; what runs along it counts as inside."""
    halves = (line + np.roll(line, -1, axis=0)) / 2.0
    points = np.concatenate([line, halves])
    points = points[:: max(1, len(points) // _SAMPLES)]
    if (points.max(axis=0) < other.min(axis=0)).any() or (
        points.min(axis=0) > other.max(axis=0)
    ).any():
        return 0.0
    start, end = other, np.roll(other, -1, axis=0)
    x, y = points[:, :1], points[:, 1:]
    spans = (start[:, 1] <= y) != (end[:, 1] <= y)
    rise = np.where(end[:, 1] == start[:, 1], 1.0, end[:, 1] - start[:, 1])
    at = start[:, 0] + (y - start[:, 1]) / rise * (end[:, 0] - start[:, 0])
    inside = (spans & (at > x)).sum(axis=1) % 2 == 1
    if not inside.any():
        return 0.0
    inside |= _from_line(points, other) <= SAME_LINE_MM
    return float(inside.mean())


def gathered(heights: FloatArray, tolerance: float) -> list[NDArray[np.intp]]:
    """Return which contours share a plane, ascending; a plane is no thicker than the tolerance."""
    groups: list[list[int]] = []
    lowest = -np.inf
    for number in np.argsort(heights, kind="stable").tolist():
        if heights[number] - lowest > tolerance:
            groups.append([])
            lowest = heights[number]
        groups[-1].append(number)
    return [np.array(group, np.intp) for group in groups]


def stacked(
    planes: Sequence[ContourPlane], pixel_mm: FloatArray, step_mm: float, usual: float | None
) -> tuple[NDArray[np.bool_], int]:
    """Fill the slices of the grid between and beside planes.

    A slice belongs to a region from the first plane to the last and half of the planes' distance
    beyond: at the upper end without its bound, so that n planes half-way between slices make n
    slices. A region thinner than the slices' distance is given its nearest one.

    Args:
        planes: ascending.
        pixel_mm: distance of columns, and of rows, shape (2,).
        step_mm: distance of slices.
        usual: distance of planes in slices, where the rest of the file tells it.

    Returns:
        Mask of shape (slices, rows, columns), and number of its first slice.
    """
    slices: dict[int, Picture] = {}
    margin = ONE_PLANE_MM / 2.0 / step_mm
    for run in _runs(planes, step_mm, usual):
        heights = np.array([plane.height for plane in run])
        thick = float(np.median(np.diff(heights))) if len(run) > 1 else _alone(planes, usual)
        first = int(np.ceil(heights[0] - thick / 2.0 - margin))
        last = int(np.ceil(heights[-1] + thick / 2.0 - margin)) - 1
        if last < first:  # thinner than the distance of slices
            first = last = int(np.rint((heights[0] + heights[-1]) / 2.0))
        for number in range(first, last + 1):
            picture = _at(run, heights, float(number), pixel_mm)
            before = slices.get(number)
            slices[number] = picture if before is None else before | picture
    low, high = min(slices), max(slices)
    mask = np.zeros((high - low + 1, *planes[0].picture.shape), bool)
    for number, picture in slices.items():
        mask[number - low] = picture
    return mask, low


def _alone(planes: Sequence[ContourPlane], usual: float | None) -> float:
    """Thickness of a plane that no other one is joined to [slices]."""
    gaps = np.diff([plane.height for plane in planes])
    least = float(gaps.min()) if len(gaps) else np.inf
    return max(1.0, min(usual, least)) if usual is not None else 1.0


def _runs(
    planes: Sequence[ContourPlane], step_mm: float, usual: float | None
) -> list[list[ContourPlane]]:
    """Part the planes where they are further apart than they usually are."""
    gaps = np.diff([plane.height for plane in planes])
    runs = [[planes[0]]]
    for number, plane in enumerate(planes[1:]):
        beside = np.concatenate([gaps[max(0, number - 1) : number], gaps[number + 1 : number + 2]])
        known = [float(beside.max())] if len(gaps) > 2 else []
        known += [] if usual is None else [usual]
        near = gaps[number] <= 1.0 + ONE_PLANE_MM / step_mm
        if not near and known:
            near = gaps[number] <= _WIDER * max(known)
        elif not near:
            near = gaps[number] * step_mm <= JOINED_MM
        if not near or (gaps[number] > _WIDER and not _overlap(runs[-1][-1], plane)):
            runs.append([])
        runs[-1].append(plane)
    return runs


def _overlap(item: ContourPlane, other: ContourPlane) -> bool:
    return bool((item.picture & other.picture).any())


def _at(
    run: Sequence[ContourPlane], heights: FloatArray, height: float, pixel_mm: FloatArray
) -> Picture:
    """Return the picture of a region at a height."""
    above = int(np.searchsorted(heights, height))
    if above in (0, len(run)):
        return run[min(above, len(run) - 1)].picture
    low, high = run[above - 1], run[above]
    share = (height - low.height) / (high.height - low.height)
    nearest = high if share > 0.5 else low
    if min(share, 1.0 - share) < 1e-3 or not _overlap(low, high):
        return nearest.picture
    picture = low.picture & high.picture
    unlike = np.argwhere(low.picture != high.picture)
    if len(unlike):
        points = unlike[:, ::-1] * pixel_mm
        away = (1.0 - share) * _signed(low, points, unlike, pixel_mm)
        away += share * _signed(high, points, unlike, pixel_mm)
        picture[tuple(unlike[away > 0.0].T)] = True
    return picture


def _signed(
    plane: ContourPlane, points: FloatArray, pixels: NDArray[np.intp], pixel_mm: FloatArray
) -> FloatArray:
    """Distances of pixel centres from the lines of a plane [mm], positive inside."""
    finest = 0.05 * float(pixel_mm.min())
    dense = [_resampled(line * pixel_mm, finest) for line in plane.lines]
    away = np.asarray(cKDTree(np.concatenate(dense)).query(points)[0], np.float64)
    return np.where(plane.picture[tuple(pixels.T)], away, -away)


def _resampled(line: FloatArray, step: float) -> FloatArray:
    """Return points along a closed line, no further apart than `step`."""
    along = np.roll(line, -1, axis=0) - line
    counts = np.maximum(1, np.ceil(np.linalg.norm(along, axis=1) / step).astype(int))
    edge = np.repeat(np.arange(len(line)), counts)
    place = np.arange(counts.sum()) - np.repeat(np.cumsum(counts) - counts, counts)
    result: FloatArray = line[edge] + (place / counts[edge])[:, None] * along[edge]
    return result
