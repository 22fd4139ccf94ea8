"""The tracker: two cameras in, needle fixes out."""

from collections.abc import Callable, Sequence

from app.core.arrays import FloatArray
from app.core.clock import Clock
from app.core.events import Event, EventQueue
from app.core.latest import Latest
from app.tracking.agreement import EpipolarGate
from app.tracking.cameras.camera import Camera, Frame
from app.tracking.cameras.feed import CameraFeed, Pair
from app.tracking.capture_times import CaptureTimes, without_picture
from app.tracking.continuity import Continuity
from app.tracking.discrepancy_words import SWAPPED
from app.tracking.errors import TrackingError
from app.tracking.fix import FixStatus, NeedleFix, without_point
from app.tracking.follower import MarkerFollower
from app.tracking.health import FixHealth
from app.tracking.hiding import Hiding
from app.tracking.markers.choice import extractors as default_extractors
from app.tracking.markers.colour import RED, ColourModel, learn
from app.tracking.markers.extractor import Centre, Extractor, MarkerFix
from app.tracking.optics.rig import RigProfile
from app.tracking.rehearsal import rehearse
from app.tracking.solver import FixSolver
from app.tracking.statistics import TrackerMeter, TrackerStatistics
from app.tracking.track import Markers
from app.tracking.tracked_picture import TrackedPicture
from app.tracking.two_bands import TwoBands
from app.tracking.worker import Stopped, Worker

Axis = Callable[[float], FloatArray | None]
"""Needle direction, hub to tip, at a time [s]; None while the robot does not know it."""


def _unknown(_time: float) -> FloatArray | None:
    return None


class Tracker:
    """Finds the needle's tip in the pictures of two cameras, in its own thread.

    Args:
        cameras: in the order of the rig.
        rig: profile of the cameras and the needle.
        clock: for ages and waiting.
        axis: the needle's direction by the robot.
        fulcrum: P_I in world [m], shape (3,).
        on_fix: called in the tracker's thread with every fix, e.g. to write the depth for the loop.
        events: takes an event of kind `camera` when a camera stops, freezes, fails or recovers,
            and of kind `fault` when the tracker itself fails.
        extractors: how the marker is found in each picture; by default `markers.choice.DEFAULT`.
        colour: of the marker, for the default extractors.
        force: of the robot on the needle at a time [N], shape (3,), to tell a needle that bends
            under it; None while it is not known.

    Attributes:
        rig, extractors: as given; for whoever looks at the pictures (`inspection`).
    """

    def __init__(
        self,
        cameras: Sequence[Camera],
        rig: RigProfile,
        clock: Clock,
        axis: Axis,
        fulcrum: FloatArray,
        on_fix: Callable[[NeedleFix], None] | None = None,
        events: EventQueue | None = None,
        extractors: tuple[Extractor, Extractor] | None = None,
        force: Axis = _unknown,
        colour: ColourModel = RED,
    ) -> None:
        if len(cameras) != 2:
            raise TrackingError(f"the tracker needs two cameras, got {len(cameras)}")
        self.latest: Latest[NeedleFix] = Latest()
        self.events = events if events is not None else EventQueue()
        self._clock = clock
        self._axis = axis
        self._on_fix = on_fix
        self._names = tuple(model.name for model in rig.models)
        self._fulcrum = fulcrum
        self._solver = FixSolver(rig, fulcrum)
        self._hiding = Hiding(rig.needle, self._put)
        self._continuity = Continuity()
        self._health = FixHealth(rig.needle.marker_offset, force, self._put)
        self._times = CaptureTimes(self._names, self._put)
        self.rig = rig
        self.extractors = extractors or default_extractors(rig, colour=colour)
        gate, distance = EpipolarGate(rig), rig.needle.band_distance
        self._follower = MarkerFollower(self.extractors, self._solver, gate, distance)
        self._bands = TwoBands(rig, fulcrum, self._solver, gate) if distance is not None else None
        self._feed = CameraFeed(cameras, self._names, clock, rig.noise_grey > 0.0, self._put)
        self._meter = TrackerMeter()
        self._pictures: dict[str, TrackedPicture] = {}
        if self._bands is not None:
            self._bands.use(colour)
        self._worker = Worker(self._step, self._put)

    def open(self) -> None:
        """Open both cameras and start; opening twice is fine.

        Raises:
            CameraError: if a camera cannot be opened; the other is closed again.
        """
        if self._worker.is_open:
            return
        for memory in (self._health, self._hiding, self._continuity):
            memory.clear()  # needle, cameras and robot may be others than before
        rehearse(self.rig, self._fulcrum, self.extractors, self._solver)
        self._feed.open()
        self._worker.open()

    def close(self) -> None:
        """Stop the thread and close the cameras; closing twice is fine.

        A thread that does not end in time is told of in an event; nothing that it still finds
        counts, and it does not touch the cameras again.
        """
        self._worker.stop()
        self._feed.close()
        self._worker.join()

    def process(self, left: Frame | None, right: Frame | None) -> NeedleFix:
        """Fix of one pair of pictures, of whatever capture times; None for a camera without one.

        This is the whole work of a step and needs no thread. The fix is of the earlier capture
        time; the other camera's pixel is interpolated to it between its last two pictures.

        Raises:
            TrackingError: if there is no picture at all.
        """
        if left is None and right is None:
            raise TrackingError("a step of the tracker needs at least one picture")
        frames = self._times.sound((left, right))
        times = [frame.time for frame in frames if frame is not None]
        if not times:
            reason = "the pictures' capture times run backwards"
            return without_point(
                FixStatus.NO_PICTURE, (None, None), self._times.newest, self._names, reason
            )
        time = min(times)
        axis = self._axis(time)
        fix, markers = self._measured(frames, axis, time)
        certain = all(isinstance(m, MarkerFix) and m.centre is Centre.BAND for m in markers)
        fix = self._health.look(fix, axis, certain, self._follower.exchanged)
        found = [one for one in markers if isinstance(one, MarkerFix)]
        fix = self._hiding.look(self._continuity.look(fix, found))
        if fix.status is FixStatus.INCONSISTENT:
            self._follower.doubt()
        self._follower.remember(self._solver.band(fix, axis))
        self._show(frames, markers)
        return without_picture(fix, frames, self._names)

    def _measured(
        self, frames: Pair, axis: FloatArray | None, time: float
    ) -> tuple[NeedleFix, Markers]:
        if axis is None and self._bands is not None:
            return self._bands.alone(frames, time, self.extractors)
        markers = self._follower.find(frames, axis, time)
        if self._follower.exchanged:
            inconsistent = FixStatus.INCONSISTENT
            return without_point(inconsistent, (None, None), time, reason=SWAPPED), markers
        left, right = self._follower.sightings(frames, markers, time)
        fix = self._solver.solve((left, right), axis, time)
        if self._bands is not None and left is not None and right is not None and fix.has_point:
            first = self._solver.triangulated((left, right), fix.axis)
            fix = self._bands.beside(fix, first, frames)
        return fix, markers

    def touched(self, measured: float, known: float) -> None:
        """Take in a touch of a known place: depth by the cameras and its true one [m].

        Two of them tell a marker that has slipped along the needle.
        """
        self._health.monitor.touch(measured, known)

    def learn_colour(self, camera: str, pixel: FloatArray) -> ColourModel:
        """Take what a camera's newest picture shows at a pixel as the marker's colour, in both.

        It holds until the tracker ends; whoever keeps it for the next one takes what is returned.

        Args:
            camera: name in the rig.
            pixel: shape (2,), as `TrackedPicture.found` counts.

        Raises:
            TrackingError: if there is no such picture, or nothing there has a marker's colour.
        """
        picture = self._pictures.get(camera)
        if picture is None:
            raise TrackingError(
                f"camera {camera!r} has given no picture; there are {', '.join(self._names)}"
            )
        colour = learn(picture.image, pixel)
        self.extractors = default_extractors(self.rig, colour=colour)
        self._follower.use(self.extractors)
        if self._bands is not None:
            self._bands.use(colour)
        return colour

    def statistics(self) -> TrackerStatistics:
        """Figures of the last seconds and the health of both cameras."""
        now = self._clock.now()
        stamped = self.latest.read()
        newest = stamped.value if stamped else None
        return self._meter.statistics(
            now, newest, self._feed.health(now), self._worker.fault, self._feed.skew()
        )

    def pictures(self) -> tuple[TrackedPicture, ...]:
        """Newest picture of each camera with the found marker, read-only; empty before one came."""
        pictures = dict(self._pictures)
        return tuple(pictures[name] for name in self._names if name in pictures)

    def _show(self, frames: Pair, markers: Markers) -> None:
        for name, frame, marker in zip(self._names, frames, markers, strict=True):
            if frame is not None:
                self._pictures[name] = TrackedPicture(name, frame.image, frame.time, marker)

    def _step(self, stopped: Stopped) -> None:
        frames = self._feed.wait()
        if stopped() or (frames[0] is None and frames[1] is None):
            return
        fix = self.process(*frames)
        if stopped():  # closed meanwhile
            return
        self.latest.publish(fix, fix.time)
        self._meter.count(fix, self._clock.now())
        if self._on_fix is not None:
            self._on_fix(fix)
        self._worker.fault = ""

    def _put(self, kind: str, message: str) -> None:
        self.events.put(Event(self._clock.now(), kind, message))
