"""A plane of any direction through a volume: pictures are interpolated."""

from __future__ import annotations

from itertools import product

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray, frozen
from app.imaging.reformat import Frame
from app.imaging.volume import Volume
from app.views.slices.looks import Slab
from app.views.slices.panes import PaneId
from app.views.slices.plane import HALF_SLAB_MM, Rect, SlicePlane
from app.views.slices.slab import PlanePoint

FIELD_MM = 180.0
"""Width and height that a needle's pane shows at first."""

MOST_PIXELS = 1024
"""Columns or rows that a whole reformatted picture has at most."""


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
        axes = np.column_stack([frame.right, frame.down, normal])
        places = (_corners(volume) - frame.origin_mm) @ axes
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
