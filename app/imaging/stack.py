"""Geometry of a stack of slices, from IPP, IOP and PixelSpacing alone (PS3.3 C.7.6.2.1.1).

Where a file puts a pixel is what equation C.7.6.2.1-1 says with the file's own numbers as they
stand, rounding of the direction cosines included. A stack may be read as one grid only where the
grid puts every voxel of every slice within `TOLERANCE_MM` of that.
"""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, frozen
from app.core.messages import sentence
from app.imaging.header import ImagePlane

TOLERANCE_MM: Final = 0.01
"""How far a voxel of a grid may lie from where its own file puts it, anywhere in the picture."""

TILT_DEG: Final = 0.1
"""Angle between slice normal and stacking direction from which a series is said to be tilted."""

SAME_DIRECTION: Final = 1e-3
"""Orientations and pixel spacings that differ by more than this belong to different stacks."""

_STEADY: Final = 5.0
"""A drift is a tilt if it is so many times as large as what slices jump beside it."""

_GAP_SHARE: Final = 0.02
_HOLE: Final = 1.5


@dataclass(frozen=True, slots=True, eq=False)
class Stack:
    """Slices in the order of their projection on the slice normal, and the grid that fits them.

    Attributes:
        order: index of the slice in the input, for each place in the stack, shape (K,).
        positions_mm: IPP in that order, shape (K, 3).
        affine_mm: (i, j, k) -> LPS, shape (4, 4), read-only.
        off_mm: how far the grid is from each slice's own corners at most [mm], shape (K,).
        turned_mm: how far the corners of each slice are turned or scaled away from the usual
            direction and size [mm], shape (K,).
    """

    order: tuple[int, ...]
    positions_mm: FloatArray
    affine_mm: FloatArray
    off_mm: FloatArray
    turned_mm: FloatArray

    @property
    def normal(self) -> FloatArray:
        """Unit normal of the slices, shape (3,)."""
        return _unit(np.cross(self.affine_mm[:3, 0], self.affine_mm[:3, 1]))

    @property
    def gaps_mm(self) -> FloatArray:
        """Distance of each slice to the next along the normal, shape (K - 1,)."""
        gaps: FloatArray = np.diff(self.positions_mm @ self.normal)
        return gaps

    @property
    def tilt_deg(self) -> float:
        """Angle between the normal and the stacking direction [degrees]; 0 where negligible.

        0 too where slices jump sideways by as much as they would drift in all: that is no tilt.
        """
        along, drift = _drift(self)
        angle = float(np.degrees(np.arctan2(drift, along)))
        if angle <= TILT_DEG or drift <= 2.0 * TOLERANCE_MM:
            return 0.0
        return angle if drift >= _STEADY * _jumps(self) else 0.0


def plane_affine(plane: ImagePlane, step: FloatArray) -> FloatArray:
    """Affine (i, j, k) -> LPS [mm] of a plane and the vector from one slice to the next, (4, 4).

    Column index times PixelSpacing[1] runs along IOP[0:3], row index times PixelSpacing[0] along
    IOP[3:6].
    """
    affine = np.eye(4)
    affine[:3, 0] = np.array(plane.orientation[:3]) * plane.pixel_spacing_mm[1]
    affine[:3, 1] = np.array(plane.orientation[3:]) * plane.pixel_spacing_mm[0]
    affine[:3, 2] = step
    affine[:3, 3] = plane.position_mm
    return frozen(affine, (4, 4), "affine")


def normal(plane: ImagePlane) -> FloatArray:
    """Slice normal: cross product of the row and column directions, unit vector, shape (3,)."""
    return _unit(np.cross(plane.orientation[:3], plane.orientation[3:]))


def stack(planes: Sequence[ImagePlane], size: tuple[int, int] = (1, 1)) -> Stack:
    """Sort planes along the normal of the first, and fit one grid to them.

    Args:
        planes: of one direction and pixel spacing, see `mixed`.
        size: columns and rows of the pictures; the grid is held against their corners.
    """
    positions = np.array([plane.position_mm for plane in planes])
    order = np.argsort(positions @ normal(planes[0]), kind="stable")
    ordered = [planes[int(index)] for index in order]
    corners = _corners(ordered, size)
    best = _end_to_end(ordered)
    off = _off(best, corners, size)
    if len(planes) > 2 and off.max() > TOLERANCE_MM:
        fitted = _fitted(ordered)
        if (again := _off(fitted, corners, size)).max() <= TOLERANCE_MM:
            best, off = fitted, again
    in_picture = corners - corners[:, :1]
    turned_mm = np.linalg.norm(in_picture - np.median(in_picture, axis=0), axis=2).max(axis=1)
    return Stack(tuple(int(i) for i in order), positions[order], best, off, turned_mm)


def _end_to_end(ordered: Sequence[ImagePlane]) -> FloatArray:
    """Grid from the first slice with the mean step: exact for a stack that is even."""
    first, last = ordered[0], ordered[-1]
    step = normal(first)
    extent = np.subtract(last.position_mm, first.position_mm)
    if len(ordered) > 1 and extent.any():
        step = extent / (len(ordered) - 1)
    return plane_affine(first, step)


def _fitted(ordered: Sequence[ImagePlane]) -> FloatArray:
    """Grid that spreads the rounding of many slices: least squares, then centred."""
    each = _affines(ordered)
    number = np.arange(len(ordered), dtype=np.float64)
    slope, start = np.polyfit(number, each[:, :, 3], 1)
    residual = each[:, :, 3] - start - number[:, None] * slope
    affine = np.eye(4)
    affine[:3, :2] = (each[:, :, :2].max(axis=0) + each[:, :, :2].min(axis=0)) / 2.0
    affine[:3, 2] = slope
    affine[:3, 3] = start + (residual.max(axis=0) + residual.min(axis=0)) / 2.0
    return frozen(affine, (4, 4), "affine")


def _pixels(size: tuple[int, int]) -> FloatArray:
    columns, rows = max(size[0] - 1, 0), max(size[1] - 1, 0)
    return np.array([(i, j, 0.0, 1.0) for i in (0, columns) for j in (0, rows)], np.float64)


def _corners(ordered: Sequence[ImagePlane], size: tuple[int, int]) -> FloatArray:
    """Return where the files put the corners of their pictures, shape (K, 4, 3)."""
    corners: FloatArray = np.einsum("kab,cb->kca", _affines(ordered), _pixels(size))
    return corners


def _affines(ordered: Sequence[ImagePlane]) -> FloatArray:
    """Affine of each plane but for the step to the next, shape (K, 3, 4)."""
    axes = np.array([plane.orientation for plane in ordered]).reshape(-1, 2, 3)
    down_across = np.array([plane.pixel_spacing_mm for plane in ordered])
    affines = np.zeros((len(ordered), 3, 4))
    affines[:, :, :2] = (axes * down_across[:, ::-1, None]).transpose(0, 2, 1)
    affines[:, :, 3] = [plane.position_mm for plane in ordered]
    return affines


def _off(affine: FloatArray, corners: FloatArray, size: tuple[int, int]) -> FloatArray:
    """Largest distance from the grid over each picture (it is at a corner), shape (K,)."""
    slices = np.arange(len(corners))[:, None, None] * affine[:3, 2]
    grid = _pixels(size) @ affine[:3].T + slices
    distance: FloatArray = np.linalg.norm(corners - grid, axis=2).max(axis=1)
    return distance


def same_plane(a: ImagePlane, b: ImagePlane) -> bool:
    """Return whether two planes may belong to one stack: the same direction and pixel spacing."""
    if a.orientation == b.orientation and a.pixel_spacing_mm == b.pixel_spacing_mm:
        return True
    turn = np.abs(np.subtract(a.orientation, b.orientation)).max()
    scale = np.abs(np.divide(a.pixel_spacing_mm, b.pixel_spacing_mm) - 1.0).max()
    return bool(max(turn, scale) <= SAME_DIRECTION)


def mixed(planes: Sequence[ImagePlane]) -> str:
    """Return why planes cannot share one stack: another orientation or pixel spacing; "" if they
    can.
    """
    first = planes[0]
    for plane in planes:
        if same_plane(plane, first):
            continue
        if np.abs(np.subtract(plane.orientation, first.orientation)).max() > SAME_DIRECTION:
            return sentence(
                "mixed orientations: {first_orientation} and {plane_orientation}",
                first_orientation=first.orientation,
                plane_orientation=plane.orientation,
            )
        return sentence(
            "mixed pixel spacings: {first_pixel_spacing_mm} and {plane_pixel_spacing_mm} mm",
            first_pixel_spacing_mm=first.pixel_spacing_mm,
            plane_pixel_spacing_mm=plane.pixel_spacing_mm,
        )
    return ""


def doubled(slices: Stack, names: Sequence[str]) -> str:
    """Return which slices lie at the same place; "" if none do."""
    gaps = slices.gaps_mm
    k = int(np.argmin(gaps))
    if gaps[k] >= TOLERANCE_MM:
        return ""
    count = int((gaps < TOLERANCE_MM).sum())
    more = f" (and {count - 1} more)" if count > 1 else ""
    return sentence(
        "doubled slices: {lower_slice} and {upper_slice} lie at the same position and differ{more}",
        lower_slice=names[k],
        upper_slice=names[k + 1],
        more=more,
    )


def turned(slices: Stack, names: Sequence[str]) -> str:
    """Return why slices do not lie side by side: each turned or scaled a little; "" if they do.

    Nothing mends that: between slices that are not parallel there is no place to interpolate at.
    """
    if slices.off_mm.max() <= TOLERANCE_MM:
        return ""
    k = int(np.argmax(slices.turned_mm))
    if slices.turned_mm[k] <= TOLERANCE_MM:
        return ""
    return sentence(
        "slices turned against each other: the corners of {names} lie "
        "{slices_turned_mm:.3f} mm off (limit {tolerance_mm:g} mm)",
        names=names[k],
        slices_turned_mm=slices.turned_mm[k],
        tolerance_mm=TOLERANCE_MM,
    )


def irregular(slices: Stack, names: Sequence[str]) -> str:
    """Return why the stack is no even grid though it can be resampled to one; "" if it is one.

    Args:
        slices: the sorted stack, of two slices at least.
        names: file names in the order of the stack, for the message.
    """
    return _missing(slices.gaps_mm, names) or _uneven(slices, names)


def holes(gaps: FloatArray) -> tuple[int, ...]:
    """Gaps that are no spacing but missing slices: half as wide again as both their neighbours.

    Args:
        gaps: distance of each slice to the next [mm], shape (K - 1,).
    """
    found = []
    for k in range(len(gaps)):
        beside = [float(gaps[n]) for n in (k - 1, k + 1) if 0 <= n < len(gaps)]
        if beside and gaps[k] >= _HOLE * max(beside):
            found.append(k)
    return tuple(found)


def _unit(vector: FloatArray) -> FloatArray:
    return vector / np.linalg.norm(vector)


def _drift(slices: Stack) -> tuple[float, float]:
    """Way from the first slice to the last: along the normal, and beside it [mm].

    Of more than two slices the latter is that of the straight line that fits them all best.
    """
    heights, beside = _beside(slices)
    along = float(heights[-1])
    if len(heights) < 3 or along <= 0.0:
        return along, float(np.linalg.norm(beside[-1]))
    slope = np.polyfit(heights, beside, 1)[0]
    return along, float(np.linalg.norm(slope)) * along


def _jumps(slices: Stack) -> float:
    """Return how far slices lie at most from the straight line that fits them best, sideways
    [mm].
    """
    heights, beside = _beside(slices)
    if len(heights) < 3 or heights[-1] <= 0.0:
        return 0.0
    slope, start = np.polyfit(heights, beside, 1)
    return float(np.linalg.norm(beside - start - heights[:, None] * slope, axis=1).max())


def _beside(slices: Stack) -> tuple[FloatArray, FloatArray]:
    """Heights along the normal, shape (K,), and what lies beside it, shape (K, 3) [mm]."""
    ways = slices.positions_mm - slices.positions_mm[0]
    heights: FloatArray = ways @ slices.normal
    return heights, ways - heights[:, None] * slices.normal


def _missing(gaps: FloatArray, names: Sequence[str]) -> str:
    usual = float(np.sort(gaps)[(len(gaps) - 1) // 2])  # lower median: of two gaps the smaller
    for k, gap in enumerate(gaps):
        times = round(float(gap) / usual)
        if times >= 2 and abs(gap - times * usual) <= times * _GAP_SHARE * usual:
            plural = "slice is" if times == 2 else "slices are"
            return sentence(
                "gap: {times} {plural} missing between {slice_before} and {slice_after} "
                "({gap:.3f} mm apart where {usual:.3f} mm is usual)",
                times=times - 1,
                plural=plural,
                slice_before=names[k],
                slice_after=names[k + 1],
                gap=gap,
                usual=usual,
            )
    return ""


def _uneven(slices: Stack, names: Sequence[str]) -> str:
    if slices.off_mm.max() <= TOLERANCE_MM:
        return ""
    gaps = slices.gaps_mm
    if np.ptp(gaps) <= TOLERANCE_MM:
        return sentence(
            "slices shifted sideways against each other: up to {largest_mm:.3f} mm "
            "off a straight stack at {names} (limit {tolerance_mm:g} mm)",
            largest_mm=slices.off_mm.max(),
            names=names[int(np.argmax(slices.off_mm))],
            tolerance_mm=TOLERANCE_MM,
        )
    return sentence(
        "uneven spacing: slices {narrowest_mm:.3f} to {widest_mm:.3f} mm apart, up to "
        "{largest_mm:.3f} mm off an even grid at {names} "
        "(limit {tolerance_mm:g} mm)",
        narrowest_mm=gaps.min(),
        widest_mm=gaps.max(),
        largest_mm=slices.off_mm.max(),
        names=names[int(np.argmax(slices.off_mm))],
        tolerance_mm=TOLERANCE_MM,
    )
