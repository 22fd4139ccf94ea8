"""The tracker: two cameras in, needle fixes out.

Opening rehearses one step on drawn pictures: compiled functions are built, or loaded, when they are
first called: without a rehearsal the first fix of a new build would come half a minute late, and
the first of any run some tenths of a second.
"""

import threading
from collections.abc import Callable, Sequence
from dataclasses import replace
from typing import Final

import cv2
import numpy as np

from app.core.arrays import FloatArray
from app.core.clock import Clock
from app.core.events import Event, EventQueue
from app.core.latest import Latest
from app.core.messages import sentence
from app.core.units import MILLIMETRE
from app.tracking.agreement import Continuity, EpipolarGate
from app.tracking.cameras.camera import Camera, CameraFrame, Image
from app.tracking.cameras.feed import CameraFeed, CaptureTimes, Pair, without_picture
from app.tracking.discrepancy import SWAPPED
from app.tracking.errors import TrackingError
from app.tracking.fix import FixStatus, NeedleFix, without_point
from app.tracking.follower import MarkerFollower
from app.tracking.health import FixHealth, Hiding
from app.tracking.inspection import Inspection, inspected
from app.tracking.markers.choice import extractors as default_extractors
from app.tracking.markers.colour import RED, ColourModel, learn
from app.tracking.markers.extractor import Centre, Extractor, Hint, MarkerFix, Miss, MissReason
from app.tracking.optics.camera_model import CameraModel
from app.tracking.optics.rig import NeedleShape, RigProfile
from app.tracking.simulated.paced import PacedFixes
from app.tracking.solver import FixSolver, SeenMarker
from app.tracking.statistics import TrackerMeter, TrackerStatistics
from app.tracking.track import Markers
from app.tracking.tracked_picture import TrackedPicture
from app.tracking.two_bands import TwoBands

_PAUSE: Final = 0.1
"""Time [s] to wait after an error inside a step."""

_PATIENCE: Final = 2.0
"""Time [s] that closing waits for the thread."""

Stopped = Callable[[], bool]
"""Whether the thread that asks was told to stop."""


class Worker:
    """Runs a step again and again in a thread of its own.

    Args:
        step: the work; asks whether it was told to stop before it publishes anything.
        report: takes (kind, message) when steps begin to fail, and when the thread outlives its
            end.

    Attributes:
        fault: what the last step failed with; a step that succeeds empties it.
    """

    def __init__(self, step: Callable[[Stopped], None], report: Callable[[str, str], None]) -> None:
        self.fault = ""
        self._step = step
        self._report = report
        self._thread: threading.Thread | None = None
        self._stop = threading.Event()

    @property
    def is_open(self) -> bool:
        """Return whether the thread was started and not stopped."""
        return self._thread is not None

    def open(self) -> None:
        """Start; a thread that an earlier end has left behind stays stopped."""
        self._stop = threading.Event()
        self._thread = threading.Thread(
            target=self._run, args=(self._stop,), name="tracker", daemon=True
        )
        self._thread.start()

    def stop(self) -> None:
        """Tell the thread to stop, without waiting."""
        self._stop.set()

    def join(self, patience: float = _PATIENCE) -> None:
        """Wait for its end; one that does not come in time is told of.

        Args:
            patience: how long [s].
        """
        thread, self._thread = self._thread, None
        if thread is None:
            return
        thread.join(timeout=patience)
        if thread.is_alive():
            self._report(
                "tracker",
                f"the tracker has not ended within {patience:.1f} s of being closed: it is still "
                "at its last pictures; what it finds in them does not count",
            )

    def _run(self, stop: threading.Event) -> None:
        while not stop.is_set():
            try:
                self._step(stop.is_set)
            except Exception as error:  # shown as a fault; the next pictures are looked at
                if not stop.is_set():
                    self._fail(f"{type(error).__name__}: {error}")
                stop.wait(_PAUSE)

    def _fail(self, message: str) -> None:
        if message != self.fault:
            self._report("fault", f"the tracker failed: {message}")
        self.fault = message


_DOWN = np.array([0.0, 0.0, -1.0])
_GREY, _RED = 120, (40, 30, 205)


def rehearse(
    rig: RigProfile,
    fulcrum: FloatArray,
    extractors: tuple[Extractor, Extractor],
    solver: FixSolver,
) -> None:
    """Find a drawn band of a vertical needle in both pictures, and solve for it; the fix is lost.

    Args:
        rig: cameras and needle.
        fulcrum: P_I in world [m], shape (3,).
        extractors: of both cameras.
        solver: of the rig.
    """
    middle = 0.5 * (rig.range.depth_min_mm + rig.range.depth_max_mm) * MILLIMETRE
    centre = fulcrum + (middle - rig.needle.marker_offset) * _DOWN
    sightings = []
    for model, extractor in zip(rig.models, extractors, strict=True):
        picture, uv = _drawn(model, rig.needle.shape, centre)
        extractor.search(picture)
        found = extractor.find(picture, Hint(uv, centre, _DOWN))
        spread = found.covariance if isinstance(found, MarkerFix) else np.eye(2)
        sightings.append(SeenMarker(uv, spread))
    solver.solve((sightings[0], sightings[1]), _DOWN, 0.0)
    solver.solve((sightings[0], None), _DOWN, 0.0)


def _drawn(model: CameraModel, needle: NeedleShape, centre: FloatArray) -> tuple[Image, FloatArray]:
    """Picture with a red stroke for the band, and the pixel of its middle, shape (2,)."""
    width, height = model.image_size
    picture = np.full((height, width, 3), _GREY, dtype=np.uint8)
    ends = centre + np.outer([-needle.half, 0.0, needle.half], _DOWN)
    uv, seen = model.project(ends)
    if seen.all():
        distance = float(np.linalg.norm(centre - model.centre))
        thick = max(1, round(2.0 * needle.radius * float(model.intrinsics[0]) / distance))
        top, bottom = (tuple(np.clip(np.rint(p), -1e4, 1e4).astype(int).tolist()) for p in uv[::2])
        cv2.line(picture, top, bottom, _RED, thick, cv2.LINE_AA)
    return picture, uv[1]


def with_cause(fix: NeedleFix, markers: Markers, names: Sequence[str]) -> NeedleFix:
    """Say why a camera that shows something red does not measure it, instead of "out of view".

    Args:
        fix: by the solver.
        markers: what each camera's picture gave.
        names: of the cameras.
    """
    seen = {
        name: found.reason.words
        for name, found in zip(names, markers, strict=True)
        if isinstance(found, Miss) and found.reason is not MissReason.NOTHING_RED
    }
    if fix.status is FixStatus.OUT_OF_VIEW and seen:
        words = "; ".join(f"{name} camera: {word}" for name, word in seen.items())
        return replace(fix, reason=words)
    if fix.status is FixStatus.ONE_CAMERA:
        for name, word in seen.items():
            lost = sentence("the marker is out of view of the {name} camera", name=name)
            instead = sentence(
                "the {name} camera does not measure the marker ({reason})", name=name, reason=word
            )
            return replace(fix, reason=fix.reason.replace(lost, instead))
    return fix


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
        paced: by which fixes of simulated pictures are handed on in virtual time; None for real
            ones, as soon as they are there.
        force: of the robot on the needle at a time [N], shape (3,), to tell a needle that bends
            under it; None while it is not known.

    Attributes:
        rig, extractors: as given.
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
        paced: PacedFixes | None = None,
    ) -> None:
        if len(cameras) != 2:
            raise TrackingError(
                sentence("the tracker needs two cameras, got {cameras}", cameras=len(cameras))
            )
        self.latest: Latest[NeedleFix] = Latest()
        self.events = events if events is not None else EventQueue()
        self._clock = clock
        self._axis = axis
        self._on_fix = on_fix
        self._paced = paced
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

    @property
    def stereo(self) -> "Tracker":
        """It has two cameras on a marker (`needle_tracker`)."""
        return self

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
        if self._paced is not None:
            self._paced.begin()
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
        if self._paced is not None:
            self._paced.release()

    def process(self, left: CameraFrame | None, right: CameraFrame | None) -> NeedleFix:
        """Fix of one pair of pictures, of whatever capture times; None for a camera without one.

        This is the whole work of a step and needs no thread. The fix is of the earlier capture
        time; the other camera's pixel is interpolated to it between its last two pictures.

        Raises:
            TrackingError: if there is no picture at all.
        """
        if left is None and right is None:
            raise TrackingError(sentence("a step of the tracker needs at least one picture"))
        frames = self._times.sound((left, right))
        times = [frame.time for frame in frames if frame is not None]
        if not times:
            reason = sentence("the pictures' capture times run backwards")
            return without_point(
                FixStatus.NO_PICTURE, (None, None), self._times.newest, self._names, reason
            )
        time = min(times)
        axis = self._axis(time)
        fix, markers = self._measured(frames, axis, time)
        fix = with_cause(fix, markers, self._names)
        certain = all(
            isinstance(m, MarkerFix) and m.centre is Centre.BAND and not m.occluded for m in markers
        )
        fix = self._health.judge(fix, axis, certain, self._follower.exchanged)
        found = [one for one in markers if isinstance(one, MarkerFix)]
        fix = self._hiding.judge(self._continuity.judge(fix, found))
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
                sentence(
                    "camera {camera!r} has given no picture; there are {names}",
                    camera=camera,
                    names=", ".join(self._names),
                )
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

    def inspect(self, masks: bool = False, lines: bool = True) -> Inspection:
        """Return the newest pictures with everything that is made of them (`needle_tracker`)."""
        stamped = self.latest.read()
        newest = stamped.value if stamped else None
        return inspected(newest, self.pictures(), self.rig, self.extractors, masks, lines)

    def _show(self, frames: Pair, markers: Markers) -> None:
        for name, frame, marker in zip(self._names, frames, markers, strict=True):
            if frame is not None:
                self._pictures[name] = TrackedPicture(name, frame.image, frame.time, marker)

    def _step(self, stopped: Stopped) -> None:
        frames = self._feed.wait()
        if stopped() or (frames[0] is None and frames[1] is None):
            return
        began = self._clock.now()
        fix = self.process(*frames)
        now = self._clock.now()
        if self._paced is not None:
            self._paced.wait(fix)
        if stopped():  # closed meanwhile
            return
        self.latest.publish(fix, fix.time)
        self._meter.count(fix, now, now - began)
        if self._on_fix is not None:
            self._on_fix(fix)
        if self._paced is not None:
            self._paced.go_on(fix)
        self._worker.fault = ""

    def _put(self, kind: str, message: str) -> None:
        self.events.put(Event(self._clock.now(), kind, message))
