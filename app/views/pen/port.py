"""What the page of the pen needs of one that is before its webcam."""

from __future__ import annotations

from collections.abc import Callable
from typing import TYPE_CHECKING, Protocol

from app.views.cameras.live import ShownCamera

if TYPE_CHECKING:
    from app.tracking.pen.step import PenObservation
    from app.tracking.pen.webcam import Webcam
    from app.tracking.statistics import TrackerStatistics


class PenPort(ShownCamera, Protocol):
    """A pen that is looked at; its picture has everything found drawn into it."""

    def observed(self) -> PenObservation | None:
        """Return what the newest picture says; None before the first."""
        ...

    def statistics(self) -> TrackerStatistics:
        """Return figures of the last seconds, and what is wrong."""
        ...

    def webcam(self) -> Webcam | None:
        """Return the lens that is used; None before it is known."""
        ...

    def speed(self) -> float:
        """Return the speed of the pen [m/s]; 0 while it is not seen."""
        ...

    def listen(self, collect: Callable[[PenObservation], object] | None) -> None:
        """Hand what every picture says to `collect`, in another thread; None stops it."""
        ...
