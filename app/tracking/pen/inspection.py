"""What people look at: the webcam's newest picture with markers, axes and the tip's error."""

import numpy as np

from app.tracking.inspection import InspectedPicture, Inspection
from app.tracking.pen.drawing import draw_observation
from app.tracking.pen.tracker import PenTracker
from app.tracking.tracked_picture import TrackedPicture


class PenInspector:
    """Looks at a pen's tracker; costs nothing while nobody asks.

    Args:
        tracker: that runs; only read.
    """

    def __init__(self, tracker: PenTracker) -> None:
        self._tracker = tracker

    def look(self, masks: bool = False, lines: bool = True) -> Inspection:
        """Return the newest picture.

        Args:
            masks: without meaning here: there is no colour.
            lines: whether to draw what was found into the picture.
        """
        stamped = self._tracker.latest.read()
        fix = stamped.value if stamped else None
        inspected = []
        for one in self._tracker.pictures():
            image = draw_observation(one.image, one.observation) if lines else one.image
            picture = TrackedPicture(one.name, image, one.time, None)
            seen = one.observation.fix
            inspected.append(
                InspectedPicture(picture, seen.reason, np.empty((0, 2)), None, None, seen.usable)
            )
        return Inspection(tuple(inspected), fix, cameras=1)
