"""A pen for the window's page: what the webcam sees of it, drawn into its picture."""

from __future__ import annotations

from collections.abc import Callable

from app.compose.live_cameras import driver_settings
from app.compose.pen_webcam import attached_camera, simulated_lens, simulated_webcam
from app.core.clock import Clock, SystemClock
from app.mechanisms.profile import load_profile
from app.tracking.cameras.camera import Camera, Frame
from app.tracking.cameras.watch import CameraHealth
from app.tracking.pen.drawing import draw_observation
from app.tracking.pen.needle import PenTip
from app.tracking.pen.settings import PenSettings
from app.tracking.pen.step import PenObservation
from app.tracking.pen.tracker import Motion, PenPicture, PenTracker
from app.tracking.pen.webcam import Webcam
from app.tracking.simulated.pen_scene import rocked
from app.tracking.statistics import TrackerStatistics

DEVICE = "icube"
"""Device whose fulcrum the sheet's cross stands for; the page only measures against the sheet."""


class LivePen:
    """A pen's tracker that runs without a loop (`views.pen.port.LivePen`).

    Args:
        tracker: of the pen; opened and closed here.
        camera: of the tracker, for what its driver accepted.
        clock: of ages.
    """

    def __init__(self, tracker: PenTracker, camera: Camera, clock: Clock) -> None:
        self._tracker, self._camera, self._clock = tracker, camera, clock
        self._drawn: tuple[PenPicture, Frame] | None = None
        self._motion = Motion()
        self._collect: Callable[[PenObservation], object] | None = None
        tracker.listen(lambda _: self._seen())

    def open(self) -> None:
        """Open the webcam and begin to look.

        Raises:
            CameraError: if the webcam cannot be opened.
        """
        self._tracker.open()

    def close(self) -> None:
        """Let go of the webcam; idempotent; waits for threads."""
        self._tracker.close()

    def newest(self) -> Frame | None:
        """Return the newest picture with markers, axes and the tip's error drawn into it."""
        pictures = self._tracker.pictures()
        if not pictures:
            return None
        picture = pictures[0]
        if self._drawn is None or self._drawn[0] is not picture:
            image = draw_observation(picture.image, picture.observation)
            self._drawn = (picture, Frame(image, picture.time))
        return self._drawn[1]

    def health(self) -> CameraHealth:
        """Return how the webcam does."""
        return self._tracker.health()

    def settings(self) -> tuple[str, ...]:
        """Return what became of what was asked of the driver, a line each."""
        return driver_settings(self._camera)

    def observed(self) -> PenObservation | None:
        """Return what the newest picture says; None before the first."""
        stamped = self._tracker.observed.read()
        return stamped.value if stamped else None

    def statistics(self) -> TrackerStatistics:
        """Return figures of the last seconds, and what is wrong."""
        return self._tracker.statistics()

    def webcam(self) -> Webcam | None:
        """Return the lens that is used; None before a first picture if it has to be guessed."""
        return self._tracker.webcam

    def speed(self) -> float:
        """Return the speed of the cube [m/s], 0 while it is not seen."""
        return self._motion.speed(self._clock.now())

    def listen(self, collect: Callable[[PenObservation], object] | None) -> None:
        """Hand what every picture says to `collect`, in the tracker's thread; None stops it."""
        self._collect = collect

    def _seen(self) -> None:
        seen, collect = self.observed(), self._collect
        if seen is None:
            return
        if seen.needle is not None:
            self._motion.add(seen.fix.time, seen.needle.T_world_body.translation)
        if collect is not None:
            collect(seen)


def open_live_pen(settings: PenSettings, clock: Clock | None = None) -> LivePen:
    """Open webcam and tracker; a simulated pen is rocked with its tip on the sheet's cross.

    Raises:
        AcusError: if webcam, pen or lens cannot be used; says why.
    """
    time, profile = clock or SystemClock(), load_profile(DEVICE)
    pen, fulcrum = settings.profile(), profile.pantograph.fulcrum
    if settings.simulated:
        scene = rocked(fulcrum, PenTip.of(pen.tip))
        camera: Camera = simulated_webcam(settings, scene, profile, time, seed=1)
        lens: Webcam | None = simulated_lens()
    else:
        camera, lens = attached_camera(settings, time), settings.webcam()
    live = LivePen(PenTracker(camera, pen, time, fulcrum, lens), camera, time)
    live.open()
    return live
