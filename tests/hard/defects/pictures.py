"""Defects of the hard cases of pictures and scores: axes taken for others, ends left out."""

from dataclasses import replace
from math import log
from typing import Any

import numpy as np

from app.core.arrays import FloatArray
from app.imaging.header import ImagePlane
from app.imaging.interpolation import Interpolation, interpolate
from app.imaging.oblique import Plane, oblique_image
from app.imaging.orthogonal import OrthogonalSlicer, View
from app.imaging.stack import plane_affine, stack
from app.imaging.volume import Volume
from app.scoring.paths import smooth_length
from app.scoring.score import score
from app.scoring.smoothness import log_dimensionless_jerk, spectral_arc_length
from app.scoring.tolerance import Bands, tolerance
from app.scoring.trajectory import Trajectory
from tests.hard.defects import Defect


def swapped(plane: ImagePlane, step: FloatArray) -> Any:
    """Row spacing along the rows, as the laboratory's viewer has it."""
    rows, columns = plane.pixel_spacing_mm
    return plane_affine(replace(plane, pixel_spacing_mm=(columns, rows)), step)


def as_they_come(planes: Any, size: Any) -> Any:
    found = stack(planes, size)
    affine = np.array(found.affine_mm)
    affine[:3, 2] = np.subtract(planes[1].position_mm, planes[0].position_mm)
    return replace(found, affine_mm=affine)


def from_the_first(planes: Any, size: Any) -> Any:
    found = stack(planes, size)
    return replace(found, off_mm=found.off_mm + 0.1)


def turned_slicer(volume: Volume) -> Any:
    slicer = OrthogonalSlicer(volume)

    class Turned:
        def to_lps_mm(self, view: View, *place: float) -> FloatArray:
            return slicer.to_lps_mm(view, *place)

        def from_lps_mm(self, view: View, lps_mm: FloatArray) -> Any:
            index, column, row = slicer.from_lps_mm(view, lps_mm)
            return index, row, column

    return Turned()


def half_a_pixel_off(volume: Volume, plane: Plane) -> Any:
    corner = plane.corner_mm + 0.5 * plane.across_mm
    return oblique_image(volume, replace(plane, corner_mm=corner))


def zero_outside(values: Any, ijk: FloatArray, way: Interpolation) -> Any:
    inside = (np.abs(ijk) < 100.0).all(axis=1)
    return np.where(inside, interpolate(values, ijk, way), 0.0)


def silent_score(trajectory: Trajectory) -> Any:
    result = score(trajectory)
    return replace(result, rows=tuple(replace(row, note="", value=None) for row in result.rows))


def without_ends(time: FloatArray, points: FloatArray) -> float:
    return smooth_length(time, points) - float(np.linalg.norm(points[20] - points[0]))


def point_by_point(a: FloatArray, b: FloatArray) -> float:
    n = min(len(a), len(b))
    return float(np.linalg.norm(a[:n] - b[:n], axis=1).mean())


def stepped(value: float, bands: Bands) -> float:
    return 1.0 if abs(value) < bands.expert else tolerance(value, bands)


DEFECTS = {
    "DICOM geometry": {
        "normal of a slice turned by 35° and tilted by 37°": Defect(
            "column × row direction",
            lambda plane: np.cross(plane.orientation[3:], plane.orientation[:3]),
        ),
        "last corner of an oblique slice 90 km from the origin": Defect(
            "PixelSpacing taken as columns, rows", swapped
        ),
        "slices in no order, oblique and sheared as by a tilted gantry": Defect(
            "the step of the first two files", as_they_come
        ),
        "positions rounded to 0.01 mm, cosines to six digits, 40 slices": Defect(
            "positions beyond their tolerance", from_the_first
        ),
        **dict.fromkeys(
            (
                f"places in the views of a volume turned by {angle}°"
                for angle in ("44.999999", "45", "45.000001", "180")
            ),
            Defect("an axis taken for another at 45°", turned_slicer),
        ),
    },
    "oblique planes": {
        **dict.fromkeys(
            (
                "a plane along two axes of the voxels",
                "a plane through an axis, turned by 1e-9 rad",
                "a plane through an axis, turned by 45°",
                "a plane through no axis",
            ),
            Defect("half a pixel off", half_a_pixel_off),
        ),
        **dict.fromkeys(
            (
                f"a volume of one slice and one column, read by {way}"
                for way in ("nearest", "trilinear")
            ),
            Defect("zero beyond the edge", zero_outside),
        ),
    },
    "metrics": {
        "an attempt of one sample has every value finite, or a reason": Defect(
            "rows without their reason", silent_score
        ),
        "smoothness by the spectral arc, of the published bell": Defect(
            "the mean taken off first", lambda v, r: spectral_arc_length(v - v.mean(), r)
        ),
        "jerk of a parabola of speed at 100 Hz": Defect(
            "T⁵ in place of T³", lambda v, r: log_dimensionless_jerk(v, r) - 2.0 * log(len(v) / r)
        ),
        "length of a minute along a half circle, in blocks": Defect(
            "without the first and last point", without_ends
        ),
        "length of a tip that rests 1 km from the origin": Defect(
            "differences of distances from the origin in single precision",
            lambda p: float(
                np.abs(np.diff(np.linalg.norm(np.float32(p * np.pi), axis=1))).sum() + 1e-9
            ),
        ),
        "Fréchet distance of a path 3 mm beside another": Defect(
            "distance of their ends' sum", lambda a, b: float(np.hypot(0.003, 1e-4))
        ),
        "mean distance of a path and the same walked with a long rest": Defect(
            "point by point", point_by_point
        ),
        "utility at its knots, from 5e-324 to 1e308": Defect(
            "a limit belongs to the worse band",
            lambda v, b: stepped(v, b) - (0.2 if abs(v) == b.good else 0.0),
        ),
    },
}
