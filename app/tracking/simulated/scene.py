"""What stands before the cameras: the needle with its red band."""

from __future__ import annotations

from collections.abc import Callable
from dataclasses import dataclass

from numpy.typing import ArrayLike

from app.core.arrays import FloatArray, frozen, unit


@dataclass(frozen=True, slots=True, eq=False)
class MarkerScene:
    """The needle at one moment.

    Attributes:
        p_world: centre of the marker band, on the needle's axis [m], shape (3,).
        axis_world: unit vector from hub to tip, shape (3,).
        visible: False while nothing of the needle is to be seen.
    """

    p_world: FloatArray
    axis_world: FloatArray
    visible: bool = True

    def __post_init__(self) -> None:
        object.__setattr__(self, "p_world", frozen(self.p_world, (3,), "marker centre"))
        object.__setattr__(self, "axis_world", frozen(unit(self.axis_world), (3,), "needle axis"))

    @classmethod
    def from_tip(cls, p_tip: ArrayLike, axis: ArrayLike, marker_offset: float) -> MarkerScene:
        """Scene of a needle with its tip at `p_tip`, the band `marker_offset` [m] behind it."""
        direction = unit(axis)
        return cls(frozen(p_tip, (3,), "tip") - marker_offset * direction, direction)


Scene = Callable[[float], MarkerScene]
"""What stands before the cameras at a monotonic time [s]."""
