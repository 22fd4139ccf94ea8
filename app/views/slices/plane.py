"""One plane through a volume in millimetres: x to the right and y down on the screen."""

from __future__ import annotations

from abc import ABC, abstractmethod
from itertools import product
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray, frozen
from app.imaging.orthogonal import OrthogonalSlicer, View
from app.imaging.reformat import Frame
from app.imaging.volume import Volume
from app.views.slices.looks import Slab
from app.views.slices.panes import PaneId
from app.views.slices.slab import PlanePoint

HALF_SLAB_MM = 2.0
"""Half thickness of the slab [mm] within which needle and plan count as in the slice."""

FIELD_MM = 180.0
"""Width and height that a needle's pane shows at first."""

Rect = tuple[float, float, float, float]
"""Left, top, width and height [mm]."""

MOST_PIXELS = 1024
"""Columns or rows that a whole reformatted picture has at most."""


class SlicePlane(ABC):
    """Maps between LPS [mm] and a stack of parallel planes, told apart by a float `index`.

    This is all that layers, read-outs and gestures may ask, whatever the plane's direction.

    Attributes:
        pane: where it is shown.
        count: number of slices from one end of the volume to the other.
        step_mm: distance between slices of neighbouring indices [mm].
        half_slab_mm: half thickness of what counts as in the slice [mm].
        bounds_mm: rectangle that the volume fills in the plane.
        ahead: unit direction in which indices go up, LPS, shape (3,).
    """

    pane: PaneId
    count: int
    step_mm: float
    half_slab_mm: float
    bounds_mm: Rect
    ahead: FloatArray

    @property
    def home_mm(self) -> Rect:
        """Rectangle that a pane shows at first: all of the volume."""
        return self.bounds_mm

    @property
    def extent_mm(self) -> tuple[float, float]:
        """Width and height of the image [mm]."""
        return self.bounds_mm[2:]

    @property
    def normal_axis(self) -> int:
        """Patient axis (0 left, 1 posterior, 2 superior) that the slices' normal follows most."""
        return int(np.argmax(np.abs(self.ahead)))

    @property
    def tilt_deg(self) -> float:
        """Angle between the slices' normal and the patient axis that it follows most [°]."""
        return float(np.degrees(np.arccos(min(1.0, np.abs(self.ahead).max()))))

    def towards(self, distance: float) -> str:
        """Patient letter of the side of the slice on which this signed distance lies."""
        axis = self.normal_axis
        positive = (self.ahead[axis] > 0) == (distance > 0)
        return "RLAPIS"[2 * axis + positive]

    @abstractmethod
    def image(self, index: float) -> NDArray[Any]:
        """Hounsfield units on `bounds_mm`, shape (rows, columns), in screen orientation."""

    @abstractmethod
    def point(self, lps_mm: ArrayLike, index: float) -> PlanePoint:
        """Where an LPS point [mm] appears in slice `index`, and how far ahead of it it is."""

    @abstractmethod
    def lps_mm(self, x: float, y: float, index: float) -> FloatArray:
        """LPS point [mm] of a place in slice `index`, shape (3,)."""

    @abstractmethod
    def index_at(self, lps_mm: ArrayLike) -> float:
        """Slice that shows an LPS point [mm]."""

    @abstractmethod
    def kept(self, index: float, lps_mm: ArrayLike) -> float:
        """Slice nearest to `index` that there is straight ahead or behind of an LPS point [mm]."""

    @abstractmethod
    def frame(self, index: float) -> Frame:
        """Place and screen directions of slice `index`, in the coordinates of `point`."""

    def letters(self) -> tuple[str, str, str, str]:
        """Patient letters at the left, right, top and bottom edge."""
        letters = self.frame(0.0).letters()
        return letters.left, letters.right, letters.top, letters.bottom


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
        at, column, row = self._slicer.from_lps_mm(self._view, np.asarray(lps_mm, np.float64))
        x, y = (np.array([column, row]) + 0.5) * self._pixel
        return PlanePoint(float(x), float(y), float(at - index) * self.step_mm)

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
        origin, right, down = (
            self.lps_mm(x, y, index) for x, y in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))
        )
        return Frame.of(origin, right - origin, down - origin)

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


class ReformatPlane(SlicePlane):
    """A plane of any direction: pictures are interpolated.

    Places (x, y) are those of the frame, so they stay while the frame turns about a point.
    """

    def __init__(
        self,
        volume: Volume,
        frame: Frame,
        pane: PaneId,
        ahead: ArrayLike | None = None,
        from_origin: bool = False,
    ) -> None:
        """Lay planes parallel to a frame through a volume.

        Args:
            volume: the CT.
            frame: of the plane.
            pane: where it is shown.
            ahead: the side of the frame towards which indices go up; into the screen if None.
            from_origin: index 0 is the frame's own plane, not the first one in the volume.
        """
        self._volume, self._frame, self.pane = volume, frame, pane
        self._from_origin = from_origin
        self._slab: Slab | None = None
        normal = frame.normal
        self._sign = 1.0 if ahead is None or float(np.asarray(ahead) @ normal) >= 0.0 else -1.0
        self.ahead = frozen(self._sign * normal)
        along = volume.direction.T @ self.ahead  # share of each voxel axis
        self.step_mm = float(np.linalg.norm(along * volume.spacing_mm))
        self.half_slab_mm = HALF_SLAB_MM
        self._pixel = float(volume.spacing_mm.min())
        places = np.array([frame.point(corner) for corner in _corners(volume)])
        low, high = places[:, :2].min(axis=0), places[:, :2].max(axis=0)
        width, height = (high - low).tolist()
        self.bounds_mm = (float(low[0]), float(low[1]), width, height)
        offsets = np.sort(self._sign * places[:, 2])
        self._zero = 0.0 if from_origin else float(offsets[0])
        self._ends = tuple((offsets[[0, -1]] - self._zero) / self.step_mm)
        self.count = int((offsets[-1] - offsets[0]) / self.step_mm) + 1

    def looked_at(self, quarters: int, mirrored: bool, slab: Slab | None) -> ReformatPlane:
        """Return the same plane turned clockwise by quarters, mirrored before that, and thick."""
        frame = self._frame.quarter(quarters, mirrored)
        made = ReformatPlane(self._volume, frame, self.pane, self.ahead, self._from_origin)
        if slab:
            made._slab = slab
            made.half_slab_mm = max(HALF_SLAB_MM, slab.thickness_mm / 2)
        return made

    def image(self, index: float) -> NDArray[np.float32]:
        """Hounsfield units, trilinear, at the volume's finest spacing."""
        left, top, width, height = self.bounds_mm
        pixel = max(self._pixel, width / MOST_PIXELS, height / MOST_PIXELS)
        columns, rows = max(1, round(width / pixel)), max(1, round(height / pixel))
        return self.pixels(index, (left, top), pixel, columns, rows)

    @property
    def finest_mm(self) -> float:
        """The volume's finest spacing [mm]."""
        return self._pixel

    @property
    def home_mm(self) -> Rect:
        """Rectangle that a pane shows at first; round the needle, so that millimetres show."""
        if not self._from_origin:
            return self.bounds_mm
        return -FIELD_MM / 2, -FIELD_MM / 2, FIELD_MM, FIELD_MM

    def pixels(
        self, index: float, corner: tuple[float, float], pixel_mm: float, columns: int, rows: int
    ) -> NDArray[np.float32]:
        """Hounsfield units of any rectangle, trilinear, float32, shape (rows, columns).

        Args:
            index: of the slice.
            corner: left and top edge [mm].
            pixel_mm: size of a pixel.
            columns: width of the picture.
            rows: height of the picture.
        """
        from app.imaging.oblique import oblique_image  # compiled: loaded since there is a volume

        offset = self._sign * self._offset(index)
        plane = self._frame.pixels(*corner, pixel_mm, columns, rows, offset)
        if self._slab is not None:
            from app.imaging.slab import slab_image

            return slab_image(self._volume, plane, self._slab.thickness_mm, self._slab.projection)
        return oblique_image(self._volume, plane)

    def point(self, lps_mm: ArrayLike, index: float) -> PlanePoint:
        """Where an LPS point [mm] appears in slice `index`, and how far ahead of it it is."""
        x, y, distance = self._frame.point(lps_mm)
        return PlanePoint(x, y, self._sign * distance - self._offset(index))

    def lps_mm(self, x: float, y: float, index: float) -> FloatArray:
        """LPS point [mm] of a place in slice `index`, shape (3,)."""
        return self._frame.lps_mm(x, y, self._sign * self._offset(index))

    def index_at(self, lps_mm: ArrayLike) -> float:
        """Index of the plane through an LPS point [mm], exactly; any number."""
        return (self._sign * self._frame.point(lps_mm)[2] - self._zero) / self.step_mm

    def kept(self, index: float, lps_mm: ArrayLike) -> float:
        """Index nearest to `index` at which the line ahead from an LPS point is in the volume."""
        first, last = _inside(self._volume, np.asarray(lps_mm, np.float64), self.ahead)
        here = self.index_at(lps_mm)
        if not first <= last:  # the line passes by the volume
            first, last = ((end - here) * self.step_mm for end in self._ends)
        return min(max(index, here + first / self.step_mm), here + last / self.step_mm)

    def frame(self, index: float) -> Frame:
        """Place and screen directions of slice `index`."""
        return self._frame.moved(self._sign * self._offset(index))

    def _offset(self, index: float) -> float:
        """Distance ahead of the frame [mm]."""
        return self._zero + index * self.step_mm


def _corners(volume: Volume) -> FloatArray:
    """Outer corners of the outermost voxels in LPS [mm], shape (8, 3)."""
    ends = [(-0.5, size - 0.5) for size in volume.size]
    return volume.lps_mm(list(product(*ends)))


def _inside(volume: Volume, start: FloatArray, direction: FloatArray) -> tuple[float, float]:
    """Distances [mm] from a point along a unit direction between which voxel centres enclose it."""
    at = volume.voxel(start)
    step = volume.inverse_mm[:3, :3] @ direction
    first, last = -np.inf, np.inf
    for position, rate, size in zip(at, step, volume.size, strict=True):
        if abs(rate) < 1e-12:
            if not -1e-6 <= position <= size - 1 + 1e-6:
                return np.inf, -np.inf
            continue
        one, other = sorted((-position / rate, (size - 1 - position) / rate))
        first, last = max(first, one), min(last, other)
    return float(first), float(last)
