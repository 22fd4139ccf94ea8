"""What gives needle fixes, whatever it looks with: two cameras on a marker, or a webcam on a pen.

Whoever runs, records or shows an attempt knows a tracker by this alone. What only some trackers can
do is an attribute that the others have as None.
"""

from typing import Protocol

from app.core.arrays import FloatArray
from app.core.events import EventQueue
from app.core.latest import Latest
from app.tracking.fix import NeedleFix
from app.tracking.inspection import Inspection
from app.tracking.markers.colour import ColourModel
from app.tracking.optics.rig import RigProfile
from app.tracking.statistics import TrackerStatistics


class StereoAbilities(Protocol):
    """What only two calibrated cameras on a coloured marker can do."""

    @property
    def rig(self) -> RigProfile:
        """Profile of the cameras and the needle."""

    def touched(self, measured: float, known: float) -> None:
        """Take in a touch of a known place: depth by the cameras and its true one [m]."""

    def learn_colour(self, camera: str, pixel: FloatArray) -> ColourModel:
        """Take what a camera's newest picture shows at a pixel, shape (2,), as the marker's colour.

        Raises:
            TrackingError: if there is no such picture, or nothing there has a marker's colour.
        """


class NeedleTracker(Protocol):
    """A source of needle fixes."""

    @property
    def latest(self) -> Latest[NeedleFix]:
        """The newest fix."""

    @property
    def events(self) -> EventQueue:
        """Return what people must know: `camera`, `pen` and `fault`."""

    @property
    def stereo(self) -> StereoAbilities | None:
        """Return what two cameras can do beyond this; None where there is one."""

    def open(self) -> None:
        """Open the cameras and start; idempotent.

        Raises:
            CameraError: if a camera cannot be opened.
        """

    def close(self) -> None:
        """Stop and close the cameras; idempotent."""

    def statistics(self) -> TrackerStatistics:
        """Return the figures of the last seconds and the health of the cameras."""

    def inspect(self, masks: bool = False, lines: bool = True) -> Inspection:
        """Return the newest pictures with what was seen in them; costs nothing until it is asked.

        Args:
            masks: whether to compute what counts as the marker's colour (1 ms a picture).
            lines: whether to compute, or draw, what belongs to a picture (0.1 ms each).
        """
