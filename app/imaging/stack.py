"""Geometry of a stack of slices, from IPP, IOP and PixelSpacing alone (PS3.3 C.7.6.2.1.1)."""

from collections.abc import Sequence
from dataclasses import dataclass
from typing import Final

import numpy as np

from app.core.arrays import FloatArray, frozen
from app.imaging.header import Plane

ABSOLUTE_MM: Final = 0.01
"""Slice positions may deviate from even spacing by this much [mm] ..."""

RELATIVE: Final = 0.01
"""... or by this share of the spacing, whichever is more."""

TILT_DEG: Final = 0.1
"""Angle between slice normal and stacking direction above which a series counts as tilted."""

_SAME_DIRECTION: Final = 1e-4


@dataclass(frozen=True, slots=True, eq=False)
class Stack:
    """Slices in the order of their projection on the slice normal.

    Attributes:
        order: index of the slice in the input, for each place in the stack, shape (K,).
        positions_mm: IPP in that order, shape (K, 3).
        affine_mm: (i, j, k) -> LPS, shape (4, 4), read-only.
    """

    order: tuple[int, ...]
    positions_mm: FloatArray
    affine_mm: FloatArray


def plane_affine(plane: Plane, step: FloatArray) -> FloatArray:
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


def normal(plane: Plane) -> FloatArray:
    """Slice normal: cross product of the row and column directions, unit vector, shape (3,)."""
    cross = np.cross(plane.orientation[:3], plane.orientation[3:])
    result: FloatArray = cross / np.linalg.norm(cross)
    return result


def stack(planes: Sequence[Plane]) -> Stack:
    """Sort planes along the normal of the first; all must share orientation and spacing."""
    positions = np.array([plane.position_mm for plane in planes])
    order = np.argsort(positions @ normal(planes[0]), kind="stable")
    positions = positions[order]
    step = normal(planes[0])
    if len(planes) > 1 and (extent := positions[-1] - positions[0]).any():
        step = extent / (len(planes) - 1)
    first = planes[int(order[0])]
    return Stack(tuple(int(i) for i in order), positions, plane_affine(first, step))


def mixed(planes: Sequence[Plane]) -> str:
    """Why planes cannot share one stack: another orientation or pixel spacing; "" if they can."""
    first = planes[0]
    for plane in planes:
        if plane.orientation == first.orientation and (
            plane.pixel_spacing_mm == first.pixel_spacing_mm
        ):
            continue
        turn = np.abs(np.subtract(plane.orientation, first.orientation)).max()
        if turn > _SAME_DIRECTION:
            return f"mixed orientations: {first.orientation} and {plane.orientation}"
        scale = np.divide(plane.pixel_spacing_mm, first.pixel_spacing_mm)
        if np.abs(scale - 1.0).max() > _SAME_DIRECTION:
            return f"mixed pixel spacings: {first.pixel_spacing_mm} and {plane.pixel_spacing_mm} mm"
    return ""


def irregular(slices: Stack, names: Sequence[str]) -> str:
    """Why the stack is no regular grid: doubled, tilted, gap, uneven; "" if it is one.

    Args:
        slices: the sorted stack, of two slices at least.
        names: file names in the order of the stack, for the message.
    """
    plane_normal = _unit(np.cross(slices.affine_mm[:3, 0], slices.affine_mm[:3, 1]))
    gaps = np.diff(slices.positions_mm @ plane_normal)
    return (
        _doubled(gaps, names)
        or _tilted(slices, plane_normal)
        or _missing(gaps, names)
        or _uneven(slices, gaps, names)
    )


def tolerance_mm(spacing_mm: float) -> float:
    """Deviation from even spacing that is still accepted [mm]."""
    return max(ABSOLUTE_MM, RELATIVE * spacing_mm)


def _unit(vector: FloatArray) -> FloatArray:
    return vector / np.linalg.norm(vector)


def _doubled(gaps: FloatArray, names: Sequence[str]) -> str:
    k = int(np.argmin(gaps))
    if gaps[k] >= ABSOLUTE_MM:
        return ""
    count = int((gaps < ABSOLUTE_MM).sum())
    more = f" (and {count - 1} more)" if count > 1 else ""
    return f"doubled slices: {names[k]} and {names[k + 1]} lie at the same position{more}"


def _tilted(slices: Stack, plane_normal: FloatArray) -> str:
    extent = slices.positions_mm[-1] - slices.positions_mm[0]
    along = float(extent @ plane_normal)
    drift = float(np.linalg.norm(extent - along * plane_normal))
    angle = float(np.degrees(np.arctan2(drift, along)))
    if angle <= TILT_DEG or drift <= 2.0 * ABSOLUTE_MM:
        return ""
    return (
        f"tilted: the slices stack up at {angle:.2f} deg to their normal (gantry tilt; limit "
        f"{TILT_DEG} deg), so that each lies {drift / (len(slices.order) - 1):.3f} mm "
        "beside the one before"
    )


def _missing(gaps: FloatArray, names: Sequence[str]) -> str:
    usual = float(np.sort(gaps)[(len(gaps) - 1) // 2])  # lower median: of two gaps the smaller
    for k, gap in enumerate(gaps):
        times = round(float(gap) / usual)
        if times >= 2 and abs(gap - times * usual) <= times * tolerance_mm(usual):
            plural = "slice is" if times == 2 else "slices are"
            return (
                f"gap: {times - 1} {plural} missing between {names[k]} and {names[k + 1]} "
                f"({gap:.3f} mm apart where {usual:.3f} mm is usual)"
            )
    return ""


def _uneven(slices: Stack, gaps: FloatArray, names: Sequence[str]) -> str:
    step = slices.affine_mm[:3, 2]
    spacing = float(np.linalg.norm(step))
    even = slices.positions_mm[0] + np.arange(len(slices.order))[:, None] * step
    off = np.linalg.norm(slices.positions_mm - even, axis=1)
    limit = tolerance_mm(spacing)
    if off.max() <= limit and np.abs(gaps - spacing).max() <= limit:
        return ""
    return (
        f"uneven spacing: slices {gaps.min():.3f} to {gaps.max():.3f} mm apart, up to "
        f"{off.max():.3f} mm off an even grid at {names[int(np.argmax(off))]} "
        f"(limit {limit:.3f} mm)"
    )
