"""One view of a volume in millimetres: x to the right and y down from the image's upper left."""

from __future__ import annotations

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray
from app.imaging.orthogonal import OrthogonalSlicer, View
from app.views.slices.slab import PlanePoint

HALF_SLAB_MM = 2.0
"""Half thickness of the slab [mm] within which needle and plan count as in the slice."""


class SlicePlane:
    """Maps between LPS [mm] and the plane of one view.

    Attributes:
        view: axial, sagittal or coronal.
        count: number of slices.
        extent_mm: width and height of the image [mm].
        step_mm: distance between slices [mm].
        half_slab_mm: half thickness of what counts as in the slice [mm].
    """

    def __init__(self, slicer: OrthogonalSlicer, view: View) -> None:
        self._slicer = slicer
        self.view = view
        self.count = slicer.count(view)
        self._pixel = np.asarray(slicer.pixel_size_mm(view), dtype=np.float64)  # width, height
        rows, columns = slicer.shape(view)
        self.extent_mm = (float(columns * self._pixel[0]), float(rows * self._pixel[1]))
        origin, ahead = (slicer.to_lps_mm(view, index, 0.0, 0.0) for index in (0.0, 1.0))
        self.step_mm = slicer.slice_spacing_mm(view)
        self.half_slab_mm = max(HALF_SLAB_MM, self.step_mm / 2)
        self._normal = np.asarray(ahead) - origin

    def image(self, index: int) -> NDArray[np.generic]:
        """Hounsfield units of a slice, shape (rows, columns), in screen orientation."""
        return self._slicer.image(self.view, index)

    def point(self, lps_mm: ArrayLike, index: float) -> PlanePoint:
        """Where an LPS point [mm] appears in slice `index`, and how far off it is."""
        at, column, row = self._slicer.from_lps_mm(self.view, np.asarray(lps_mm, dtype=np.float64))
        x, y = (np.array([column, row]) + 0.5) * self._pixel
        return PlanePoint(float(x), float(y), float(at - index) * self.step_mm)

    def lps_mm(self, x: float, y: float, index: float) -> FloatArray:
        """LPS point [mm] of a place in slice `index`, shape (3,)."""
        column, row = np.array([x, y]) / self._pixel - 0.5
        return np.asarray(self._slicer.to_lps_mm(self.view, index, column, row), dtype=np.float64)

    @property
    def normal_axis(self) -> int:
        """Patient axis (0 left, 1 posterior, 2 superior) that the slices' normal follows most."""
        return int(np.argmax(np.abs(self._normal)))

    def towards(self, distance: float) -> str:
        """Patient letter of the side of the slice on which this signed distance lies."""
        axis = self.normal_axis
        positive = (self._normal[axis] > 0) == (distance > 0)
        return "RLAPIS"[2 * axis + positive]

    def letters(self) -> tuple[str, str, str, str]:
        """Patient letters at the left, right, top and bottom edge."""
        letters = self._slicer.letters(self.view)
        return letters.left, letters.right, letters.top, letters.bottom
