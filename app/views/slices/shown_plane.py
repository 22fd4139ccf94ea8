"""A plane as a pane looks at it: turned, mirrored, thick. Letters and places follow."""

from __future__ import annotations

from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray
from app.imaging.reformat import Frame
from app.views.slices.looks import Look, Slab, Turn
from app.views.slices.orthogonal_plane import OrthogonalPlane
from app.views.slices.plane import SlicePlane
from app.views.slices.reformat_plane import ReformatPlane
from app.views.slices.slab import PlanePoint


def shown(plane: SlicePlane, look: Look) -> SlicePlane:
    """Return a plane as a pane with this look shows it."""
    if not look.turn and not look.slab:
        return plane
    if isinstance(plane, ReformatPlane):
        return plane.looked_at(look.turn.quarters, look.turn.mirrored, look.slab or None)
    if isinstance(plane, OrthogonalPlane):
        return ShownPlane(plane, look.turn, look.slab)
    return plane


class ShownPlane(SlicePlane):
    """The volume's own slices, several together, turned by quarters."""

    def __init__(self, plane: OrthogonalPlane, turn: Turn, slab: Slab) -> None:
        self._plane, self._turn, self._slab = plane, turn, slab
        self.pane, self.count, self.step_mm = plane.pane, plane.count, plane.step_mm
        self.ahead = plane.ahead
        self._slices = max(1, round(slab.thickness_mm / plane.step_mm)) if slab else 1
        self.thickness_mm = self._slices * plane.step_mm
        self.half_slab_mm = max(plane.half_slab_mm, self.thickness_mm / 2)
        width, height = plane.extent_mm
        self._size = (width, height)
        across = turn.quarters % 2
        self.bounds_mm = (0.0, 0.0, *((height, width) if across else (width, height)))
        corner, right, down = (
            self.lps_mm(x, y, 0.0) for x, y in ((0.0, 0.0), (1.0, 0.0), (0.0, 1.0))
        )
        self._directions = Frame.of(corner, right - corner, down - corner)

    def image(self, index: float) -> NDArray[Any]:
        """Hounsfield units, in screen orientation; without a slab no copy."""
        picture = self._thick(round(index))
        if self._turn.mirrored:
            picture = picture[:, ::-1]
        return np.rot90(picture, -self._turn.quarters)  # its turns are counter-clockwise

    def _thick(self, middle: int) -> NDArray[Any]:
        if self._slices == 1:
            return self._plane.image(middle)
        from app.imaging.slab import slices_image  # compiled: loaded since there is a volume

        first = max(0, middle - (self._slices - 1) // 2)
        last = min(self.count, middle + self._slices // 2 + 1)
        return slices_image(self._plane.block(first, last), self._slab.projection)

    def point(self, lps_mm: ArrayLike, index: float) -> PlanePoint:
        """Where an LPS point [mm] appears in slice `index`, and how far ahead of it it is."""
        at = self._plane.point(lps_mm, index)
        return PlanePoint(*self._onto_screen(at.x, at.y), at.distance)

    def lps_mm(self, x: float, y: float, index: float) -> FloatArray:
        """LPS point [mm] of a place in slice `index`, shape (3,)."""
        width, height = self._size
        for size in ((width, height) if n % 2 == 0 else (height, width)
                     for n in reversed(range(self._turn.quarters))):  # fmt: skip
            x, y = y, size[1] - x
        if self._turn.mirrored:
            x = width - x
        return self._plane.lps_mm(x, y, index)

    def _onto_screen(self, x: float, y: float) -> tuple[float, float]:
        width, height = self._size
        if self._turn.mirrored:
            x = width - x
        for n in range(self._turn.quarters):
            x, y = (height if n % 2 == 0 else width) - y, x
        return x, y

    def index_at(self, lps_mm: ArrayLike) -> float:
        """Slice nearest to an LPS point [mm]; whole."""
        return self._plane.index_at(lps_mm)

    def kept(self, index: float, lps_mm: ArrayLike) -> float:
        """Slice nearest to `index`; whole."""
        return self._plane.kept(index, lps_mm)

    def frame(self, index: float) -> Frame:
        """Place and screen directions of slice `index`, in the coordinates of `point`."""
        return self._directions.at(self.lps_mm(0.0, 0.0, index))
