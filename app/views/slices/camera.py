"""Pan and zoom of a slice: which part of the plane [mm] fills the pane [px]."""

from __future__ import annotations

from dataclasses import dataclass, replace
from math import isfinite

from app.core.errors import NumericalError

SMALLEST, LARGEST = 0.05, 200.0
"""Limits of the zoom [px/mm]: a whole body in a thumbnail, a single voxel in a pane."""


@dataclass(frozen=True, slots=True)
class SliceCamera:
    """The plane point [mm] in the middle of the pane and the zoom [px/mm], same in x and y.

    Raises:
        NumericalError: if a value is not finite or the zoom is not positive.
    """

    x: float
    y: float
    scale: float

    def __post_init__(self) -> None:
        if not (isfinite(self.x) and isfinite(self.y) and isfinite(self.scale) and self.scale > 0):
            raise NumericalError(f"camera ({self.x}, {self.y}) at {self.scale} px/mm is not usable")

    @classmethod
    def fit(
        cls, bounds_mm: tuple[float, float, float, float], pane_px: tuple[int, int]
    ) -> SliceCamera:
        """Show a whole rectangle (left, top, width, height) [mm], centred in the pane."""
        left, top, across, down = bounds_mm
        width, height = (max(1.0, float(size)) for size in pane_px)
        scale = min(width / max(across, 1e-3), height / max(down, 1e-3))
        return cls(left + across / 2, top + down / 2, min(max(scale, SMALLEST), LARGEST))

    def panned(self, right_px: float, down_px: float) -> SliceCamera:
        """Move the image by so many pixels."""
        return replace(self, x=self.x - right_px / self.scale, y=self.y - down_px / self.scale)

    def zoomed(self, factor: float, x: float, y: float) -> SliceCamera:
        """Zoom by `factor` (within the limits); the plane point (x, y) [mm] stays where it is."""
        scale = min(max(self.scale * factor, SMALLEST), LARGEST)
        kept = self.scale / scale
        return SliceCamera(x + (self.x - x) * kept, y + (self.y - y) * kept, scale)

    def visible(self, pane_px: tuple[int, int]) -> tuple[float, float, float, float]:
        """Left, top, width and height [mm] of what a pane of this size shows."""
        width, height = (max(1, size) / self.scale for size in pane_px)
        return self.x - width / 2, self.y - height / 2, width, height


def ruler(scale: float, longest_px: float) -> float:
    """Length [mm] of the longest ruler of 1, 2 or 5 times a power of ten that fits."""
    length = 1000.0
    while length > 0.01:
        for step in (1.0, 0.5, 0.2):
            if length * step * scale <= longest_px:
                return length * step
        length /= 10.0
    return 0.01
