"""A pen for the window's page: what the webcam sees of it, drawn into its picture.

The webcam is a real one, or one whose pictures are drawn of the simulated pen.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

import numpy as np

from app.compose.live_cameras import driver_settings
from app.core.clock import Clock, SystemClock
from app.core.units import MILLIMETRE
from app.mechanisms.profile import DeviceProfile, load_profile
from app.tracking.cameras.camera import Camera, CameraFrame
from app.tracking.cameras.factory import make_camera
from app.tracking.cameras.settings import CameraSettings, OneCamera
from app.tracking.cameras.watch import CameraHealth
from app.tracking.optics.calibration import CameraCalibration
from app.tracking.optics.rig import CameraProfile
from app.tracking.pen.drawing import draw_observation
from app.tracking.pen.needle import PenTip
from app.tracking.pen.settings import PenSettings
from app.tracking.pen.step import PenObservation
from app.tracking.pen.tracker import Motion, PenPicture, PenTracker
from app.tracking.pen.webcam import Webcam
from app.tracking.simulated.cameras import SimulatedCamera
from app.tracking.simulated.pen import PenRenderer
from app.tracking.simulated.pen_scene import PenSceneAt, rocked
from app.tracking.simulated.picture_effects import NoiseTile, noise
from app.tracking.statistics import TrackerStatistics

SIMULATED_WEBCAM: Final = CameraProfile(
    name="webcam",
    image_size=(640, 480),
    focal_px=(620.0, 620.0),
    centre_px=(319.5, 239.5),
    distortion=(-0.05, 0.02, 0.0003, -0.0003, 0.0),
    position_mm=(60.0, 560.0, 380.0),
    looks_at_mm=(0.0, 160.0, 130.0),
)
"""A webcam on a small stand, 47 cm from the entry."""

_SIMULATED_RATE_HZ: Final = 15.0
_NOISE_GREY: Final = 4.0


def attached_camera(settings: PenSettings, clock: Clock) -> Camera:
    """Return the real webcam of the settings, not open yet.

    Raises:
        CameraError: for a simulated one.
    """
    one = OneCamera(source=settings.source)
    wanted = CameraSettings(size=settings.size, rate_hz=settings.rate_hz, left=one, right=one)
    return make_camera(wanted, one, clock)


def simulated_lens() -> Webcam:
    """Return the lens of the simulated webcam, exactly known."""
    camera = SIMULATED_WEBCAM
    return Webcam(
        CameraCalibration(
            name=camera.name,
            image_size=camera.image_size,
            focal_px=camera.focal_px,
            centre_px=camera.centre_px,
            lens=camera.lens,
            distortion=camera.distortion,
        )
    )


def simulated_webcam(
    settings: PenSettings, scene: PenSceneAt, profile: DeviceProfile, clock: Clock, seed: int
) -> SimulatedCamera:
    """Return a webcam whose pictures are drawn, with noise."""
    model, pen = SIMULATED_WEBCAM.model(), settings.profile()
    base = pen.base.pose(np.array(profile.fulcrum))
    edge = pen.body.edge_mm * MILLIMETRE
    renderer = PenRenderer(model, pen.body.board(), pen.base.board(), base, edge, seed=seed)
    tile = NoiseTile.make(model.image_size, _NOISE_GREY, seed + 100)
    return SimulatedCamera(
        renderer, scene, clock, _SIMULATED_RATE_HZ, effects=[(noise, tile)], seed=seed + 200
    )


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
        self._drawn: tuple[PenPicture, CameraFrame] | None = None
        self._motion = Motion()
        self._collect: Callable[[PenObservation], object] | None = None
        tracker.listen(lambda _: self._seen())

    def open(self) -> None:
        """Open the webcam and begin to seen.

        Raises:
            CameraError: if the webcam cannot be opened.
        """
        self._tracker.open()

    def close(self) -> None:
        """Let go of the webcam; idempotent; waits for threads."""
        self._tracker.close()

    def newest(self) -> CameraFrame | None:
        """Return the newest picture with markers, axes and the tip's error drawn into it."""
        pictures = self._tracker.pictures()
        if not pictures:
            return None
        picture = pictures[0]
        if self._drawn is None or self._drawn[0] is not picture:
            image = draw_observation(picture.image, picture.observation)
            self._drawn = (picture, CameraFrame(image, picture.time))
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
    pen, fulcrum = settings.profile(), profile.fulcrum
    if settings.simulated:
        scene = rocked(fulcrum, PenTip.of(pen.tip))
        camera: Camera = simulated_webcam(settings, scene, profile, time, seed=1)
        lens: Webcam | None = simulated_lens()
    else:
        camera, lens = attached_camera(settings, time), settings.webcam()
    live = LivePen(PenTracker(camera, pen, time, fulcrum, lens), camera, time)
    live.open()
    return live
