"""The pen's tracker: one webcam in, needle fixes out, as `tracking.tracker` gives them.

How fast the pen moves, to say `hold still` in time.
"""

import threading
from collections import deque
from collections.abc import Callable
from dataclasses import dataclass

import numpy as np

from app.core.arrays import FloatArray
from app.core.clock import Clock
from app.core.events import Event, EventQueue
from app.core.latest import Latest
from app.core.units import MILLIMETRE
from app.tracking.cameras.camera import Camera, CameraFrame, Image
from app.tracking.cameras.watch import CameraHealth, CameraReader, CameraState
from app.tracking.fix import NeedleFix
from app.tracking.inspection import InspectedPicture, Inspection
from app.tracking.pen.body import PenProfile
from app.tracking.pen.drawing import draw_observation
from app.tracking.pen.step import PenObservation, PenStep
from app.tracking.pen.webcam import Webcam
from app.tracking.statistics import TrackerMeter, TrackerStatistics
from app.tracking.tracked_picture import TrackedPicture

OVER = 0.3
"""Time [s] over which a speed is taken."""

_OLD = 0.6
"""Age [s] from which the newest place says nothing about now."""


class Motion:
    """Speed of a point from its places in the last pictures."""

    def __init__(self) -> None:
        self._places: deque[tuple[float, FloatArray]] = deque(maxlen=64)

    def add(self, time: float, p_world: FloatArray) -> None:
        """Take a place [m], shape (3,), at a time [s]; an older time begins anew."""
        if self._places and time <= self._places[-1][0]:
            self._places.clear()
        self._places.append((time, np.array(p_world)))

    def speed(self, now: float) -> float:
        """Return the mean speed [m/s] over the last `OVER` seconds of places; 0 without any now.

        The mean over the span is taken, so that the noise of single pictures counts little.
        """
        places = list(self._places)
        if not places or now - places[-1][0] > _OLD:
            return 0.0
        recent = [place for place in places if places[-1][0] - place[0] <= OVER]
        if len(recent) < 2:
            return 0.0
        (first, start), (last, end) = recent[0], recent[-1]
        return float(np.linalg.norm(end - start)) / (last - first)


NAME = "webcam"
BESIDE = 3.0e-3
"""Distance [m] beside the entry from which the pen's line is said to miss it."""

_WAIT = 0.1
_PAUSE = 0.1
_TROUBLE = frozenset({CameraState.STALLED, CameraState.FROZEN, CameraState.FAILED})


@dataclass(frozen=True, slots=True, eq=False)
class PenPicture:
    """Newest picture, for the views: as `tracker.TrackedPicture`, and what was seen in it."""

    name: str
    image: Image
    time: float
    pixel: FloatArray | None
    observation: PenObservation


class PenTracker:
    """Follows the pen in the pictures of one webcam, in its own thread.

    Args:
        camera: the webcam.
        pen: profile of cube, sheet and tip.
        clock: for ages and waiting.
        fulcrum: P_I in world [m], shape (3,).
        webcam: its lens; None guesses it.
        on_fix: called in the tracker's thread with every fix.
        on_needle: called before it with every observation that has a needle: it moves the loop.
        events: takes `camera` (trouble of the webcam), `pen` (said once: a guessed lens, an
            uncalibrated tip, a pen that misses the entry) and `fault`.
    """

    def __init__(
        self,
        camera: Camera,
        pen: PenProfile,
        clock: Clock,
        fulcrum: FloatArray,
        webcam: Webcam | None = None,
        on_fix: Callable[[NeedleFix], None] | None = None,
        on_needle: Callable[[PenObservation], None] | None = None,
        events: EventQueue | None = None,
    ) -> None:
        self.latest: Latest[NeedleFix] = Latest()
        self.observed: Latest[PenObservation] = Latest()
        self.events = events if events is not None else EventQueue()
        self.pen = pen
        self._clock = clock
        self._step = PenStep(pen, webcam, fulcrum)
        self._on_fix, self._on_needle = on_fix, on_needle
        self._arrived = threading.Condition()
        self._reader = CameraReader(camera, NAME, clock, self._arrived, noise_expected=True)
        self._state = CameraState.WAITING
        self._meter = TrackerMeter(looks_for="pen")
        self._picture: PenPicture | None = None
        self._seen: CameraFrame | None = None
        self._thread: threading.Thread | None = None
        self._stop = threading.Event()
        self._fault = ""
        self._misses = False
        self._said: set[str] = set()

    @property
    def webcam(self) -> Webcam | None:
        """The lens that is used; None before the first picture if it has to be guessed."""
        return self._step.webcam

    @property
    def stereo(self) -> None:
        """It has one webcam, and no coloured marker (`needle_tracker`)."""
        return None

    def listen(self, on_fix: Callable[[NeedleFix], None]) -> None:
        """Call `on_fix` with every fix from now on."""
        self._on_fix = on_fix

    def open(self) -> None:
        """Open the webcam and start; opening twice is fine.

        Raises:
            CameraError: if the webcam cannot be opened.
        """
        if self._thread is not None:
            return
        self._stop.clear()
        self._reader.open()
        self._thread = threading.Thread(target=self._run, name="pen tracker", daemon=True)
        self._thread.start()

    def close(self) -> None:
        """Stop the thread and close the webcam; closing twice is fine."""
        self._stop.set()
        with self._arrived:
            self._arrived.notify_all()
        self._reader.close()
        thread, self._thread = self._thread, None
        if thread is not None:
            thread.join(timeout=2.0)

    def process(self, frame: CameraFrame) -> NeedleFix:
        """Fix of one picture; the whole work of a step, and needs no thread.

        Raises:
            PenError: if the picture has another size than the calibration.
        """
        observation = self._step.observe(frame)
        pixel = observation.fix.pixels[0]
        self._picture = PenPicture(NAME, frame.image, frame.time, pixel, observation)
        self._tell(observation)
        if observation.needle is not None and self._on_needle is not None:
            self._on_needle(observation)
        fix = observation.fix
        self.latest.publish(fix, fix.time)
        self.observed.publish(observation, fix.time)
        self._meter.count(fix, self._clock.now())
        if self._on_fix is not None:
            self._on_fix(fix)
        return fix

    def health(self) -> CameraHealth:
        """Return how the webcam does now."""
        return self._health(self._clock.now())

    def statistics(self) -> TrackerStatistics:
        """Figures of the last seconds and the health of the webcam."""
        now = self._clock.now()
        stamped = self.latest.read()
        newest = stamped.value if stamped else None
        return self._meter.statistics(now, newest, (self._health(now),), self._fault)

    def pictures(self) -> tuple[PenPicture, ...]:
        """Newest picture with what was seen in it; empty before one came."""
        return () if self._picture is None else (self._picture,)

    def inspect(self, masks: bool = False, lines: bool = True) -> Inspection:
        """Return the newest picture (`needle_tracker`); there is no colour for `masks` to show."""
        stamped = self.latest.read()
        shown = []
        for one in self.pictures():
            image = draw_observation(one.image, one.observation) if lines else one.image
            picture = TrackedPicture(one.name, image, one.time, None)
            seen = one.observation.fix
            shown.append(
                InspectedPicture(picture, seen.reason, np.empty((0, 2)), None, None, seen.usable)
            )
        return Inspection(tuple(shown), stamped.value if stamped else None, cameras=1)

    def _health(self, now: float) -> CameraHealth:
        return self._reader.health(now)

    def _tell(self, observation: PenObservation) -> None:
        """Say what a person must know, once each; that the pen misses the entry, each time anew."""
        webcam = self._step.webcam
        if webcam is not None and webcam.guessed:
            self._once(webcam.words)
        if not self.pen.tip.calibrated:
            self._once(
                "the pen's tip is where the drawing has it, not measured: `acus pen calibrate`"
            )
        distance = float(observation.beside @ observation.beside) ** 0.5
        limit = max(BESIDE, 2.0 * observation.beside_sd)
        limit *= 0.7 if self._misses else 1.0  # at the limit it is said once, not at every turn
        misses = observation.needle is not None and distance > limit
        if misses and not self._misses:
            self._put("pen", f"the pen passes {distance / MILLIMETRE:.0f} mm beside the entry")
        if observation.needle is not None:
            self._misses = misses

    def _once(self, message: str) -> None:
        if message not in self._said:
            self._said.add(message)
            self._put("pen", message)

    def _run(self) -> None:
        while not self._stop.is_set():
            try:
                self._take()
            except Exception as error:  # shown as a fault; the tracker goes on with the next one
                self._fail(f"{type(error).__name__}: {error}")
                self._stop.wait(_PAUSE)

    def _take(self) -> None:
        with self._arrived:
            self._arrived.wait_for(
                lambda: self._stop.is_set() or self._reader.newest() is not self._seen, _WAIT
            )
        frame = self._reader.newest()
        self._watch()
        if self._stop.is_set() or frame is None or frame is self._seen:
            return
        self._seen = frame
        self.process(frame)
        self._fault = ""

    def _watch(self) -> None:
        health = self._health(self._clock.now())
        before, self._state = self._state, health.state
        if health.state is before:
            return
        if health.state in _TROUBLE:
            self._put("camera", f"camera {NAME}: {health.text}")
        elif before in _TROUBLE:
            self._put("camera", f"camera {NAME} delivers pictures again")

    def _fail(self, message: str) -> None:
        if message != self._fault:
            self._put("fault", f"the tracker failed: {message}")
        self._fault = message

    def _put(self, kind: str, message: str) -> None:
        self.events.put(Event(self._clock.now(), kind, message))
