"""One plane through a volume in millimetres: x to the right and y down on the screen."""

from __future__ import annotations

from abc import ABC, abstractmethod
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from app.core.arrays import FloatArray
from app.imaging.reformat import Frame
from app.views.slices.panes import PaneId
from app.views.slices.slab import PlanePoint

HALF_SLAB_MM = 2.0
"""Half thickness of the slab [mm] within which needle and plan count as in the slice."""

Rect = tuple[float, float, float, float]
"""Left, top, width and height [mm]."""


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
