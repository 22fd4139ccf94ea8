"""The volume's own slices as planes: pictures without resampling."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray, frozen
from app.imaging.orthogonal import OrthogonalSlicer, View
from app.imaging.reformat import Frame
from app.views.slices.panes import PaneId
from app.views.slices.plane import HALF_SLAB_MM, SlicePlane
from app.views.slices.reformat_plane import ReformatPlane
from app.views.slices.slab import PlanePoint


class OrthogonalPlane(SlicePlane):
    """Axial, sagittal or coronal along the volume's own axes: pictures without resampling."""

    def __init__(self, slicer: OrthogonalSlicer, view: View) -> None:
        self._slicer, self._view = slicer, View(view)
        self.pane = PaneId(view)
        self.count = slicer.count(view)
        self._pixel = np.asarray(slicer.pixel_size_mm(view), dtype=np.float64)  # width, height
        rows, columns = slicer.shape(view)
        self.bounds_mm = (0.0, 0.0, float(columns * self._pixel[0]), float(rows * self._pixel[1]))
        origin, ahead = (slicer.to_lps_mm(view, index, 0.0, 0.0) for index in (0.0, 1.0))
        self.step_mm = slicer.slice_spacing_mm(view)
        self.half_slab_mm = max(HALF_SLAB_MM, self.step_mm / 2)
        self.ahead = frozen((ahead - origin) / np.linalg.norm(ahead - origin))
        corner, right, down = (
            self.lps_mm(x, y, 0.0) for x, y in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))
        )
        self._directions = Frame.of(corner, right - corner, down - corner)
        self._corner = self._place(np.zeros(3))
        self._places = np.column_stack([self._place(axis) - self._corner for axis in np.eye(3)])
        self._is_sheared = slicer.volume.is_sheared
        if self._is_sheared:  # the way to the next slice is not the way out of this one
            normal = self.frame(0.0).normal
            self.ahead = frozen(normal * np.sign(normal @ self.ahead))

    def image(self, index: float) -> NDArray[Any]:
        """Hounsfield units of the nearest slice; no copy."""
        return self._slicer.image(self._view, round(index))

    def block(self, first: int, last: int) -> NDArray[Any]:
        """Hounsfield units of the slices `first` up to `last`, which is left out; no copy."""
        return self._slicer.images(self._view, first, last)

    def point(self, lps_mm: ArrayLike, index: float) -> PlanePoint:
        """Where an LPS point [mm] appears in slice `index`, and how far ahead of it it is."""
        if self._is_sheared:
            place = self.frame(index)
            x, y, distance = place.point(lps_mm)
            return PlanePoint(x, y, distance * float(np.sign(place.normal @ self.ahead)))
        x, y, at = (self._places @ np.asarray(lps_mm, np.float64) + self._corner).tolist()
        return PlanePoint(x, y, (at - index) * self.step_mm)

    def _place(self, lps_mm: FloatArray) -> FloatArray:
        """Place x, y [mm] and slice of a point by the slicer, which maps evenly."""
        at, column, row = self._slicer.from_lps_mm(self._view, lps_mm)
        return np.array([*((np.array([column, row]) + 0.5) * self._pixel), at])

    def lps_mm(self, x: float, y: float, index: float) -> FloatArray:
        """LPS point [mm] of a place in slice `index`, shape (3,)."""
        column, row = np.array([x, y]) / self._pixel - 0.5
        return self._slicer.to_lps_mm(self._view, index, column, row)

    def index_at(self, lps_mm: ArrayLike) -> float:
        """Slice nearest to an LPS point [mm], the outermost one beyond the volume; whole."""
        return float(self._slicer.nearest_index(self._view, lps_mm))

    def kept(self, index: float, lps_mm: ArrayLike) -> float:
        """Slice nearest to `index`; whole."""
        return float(round(min(max(index, 0.0), self.count - 1.0)))

    def frame(self, index: float) -> Frame:
        """Place and screen directions; exact where the volume's axes are perpendicular."""
        return self._directions.at(self.lps_mm(0.0, 0.0, index))

    def letters(self) -> tuple[str, str, str, str]:
        """Patient letters at the left, right, top and bottom edge."""
        letters = self._slicer.letters(self._view)
        return letters.left, letters.right, letters.top, letters.bottom


def own_plane(slicer: OrthogonalSlicer, view: View) -> SlicePlane:
    """Axial, sagittal or coronal plane of a volume, right-angled and to scale in any case.

    Where a gantry tilt shears the volume's own pictures of the view, they are interpolated.
    """
    if slicer.is_right_angled(view):
        return OrthogonalPlane(slicer, view)
    frame = Frame(slicer.to_lps_mm(view, 0.0, 0.0, 0.0), *slicer.straight_axes(view))
    ahead = slicer.to_lps_mm(view, 1.0, 0.0, 0.0) - slicer.to_lps_mm(view, 0.0, 0.0, 0.0)
    return ReformatPlane(slicer.volume, frame, PaneId(view), ahead)
