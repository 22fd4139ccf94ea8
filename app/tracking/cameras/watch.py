"""Noticing that a camera has stopped, repeats itself or has failed."""

import threading
from collections.abc import Callable
from dataclasses import dataclass, field
from enum import StrEnum

from app.core.clock import Clock
from app.core.messages import sentence
from app.tracking.cameras.camera import Camera, CameraFrame
from app.tracking.cameras.intake import Intake, IntakeVerdict, StreamFigures, plain
from app.tracking.errors import CameraError

STALL = 0.4
"""Time [s] without a new picture after which a camera counts as stopped."""

_PAUSE = 0.2
"""Time [s] between two tries of a camera that fails."""


class CameraState(StrEnum):
    """How a camera is."""

    WAITING = "waiting"  # no picture yet
    LIVE = "live"
    STALLED = "stalled"  # no picture for `STALL` seconds
    FROZEN = "frozen"  # pictures, but always the same
    FAILED = "failed"  # an error; it is tried again


@dataclass(frozen=True, slots=True)
class CameraHealth:
    """How one camera does.

    Attributes:
        name: in the rig.
        state: now.
        age: of its newest picture [s].
        message: of its last error; empty without.
        figures: rate, jitter and refused pictures.
        reopened: how often it was opened again.
        plain: `black` or `white` if the newest picture is nothing else.
        simulated: see `Camera`.
    """

    name: str
    state: CameraState
    age: float
    message: str = ""
    figures: StreamFigures = field(default_factory=StreamFigures)
    reopened: int = 0
    plain: str = ""
    simulated: bool = False

    @property
    def text(self) -> str:
        """One line for people about what is wrong."""
        if self.message:
            return self.message
        if self.plain:
            return sentence(
                "the picture is {plain}; look at the lens cap, the light, the exposure",
                plain=self.plain,
            )
        if self.state is CameraState.FROZEN:
            return sentence("the picture does not change any more; plug the camera in again")
        refused = (
            f" ({self.figures.text})" if self.figures.backwards + self.figures.impossible else ""
        )
        if self.simulated:
            return sentence(
                "no picture for {age:.1f} s{refused}: this computer is too busy to draw "
                "them; close other programs",
                age=self.age,
                refused=refused,
            )
        return sentence(
            "no picture for {age:.1f} s{refused}; check its cable", age=self.age, refused=refused
        )

    @property
    def named(self) -> str:
        """`text` with the camera's name before it, once."""
        prefix = f"camera {self.name}"
        return self.text if self.text.startswith(prefix) else f"{prefix}: {self.text}"


class CameraReader:
    """Reads one camera in its own thread and keeps the newest picture.

    A camera that hangs or fails so neither stops the other one nor the tracker. After a failure it
    is read again after a pause, after a second one it is closed and opened anew: so it comes back
    when it is plugged in again. `noise_expected` says that two pictures are never the same to the
    last bit, so that a repetition means a frozen driver. `on_frame` gets every picture whose time
    can be, repeated ones too, and the time of its delivery [s], in the camera's thread.
    """

    def __init__(
        self,
        camera: Camera,
        name: str,
        clock: Clock,
        arrived: threading.Condition,
        noise_expected: bool,
        on_frame: Callable[[CameraFrame, float], None] | None = None,
    ) -> None:
        self.name = name
        self._on_frame = on_frame
        self.lost = self.reopened = 0
        self._camera = camera
        self._clock = clock
        self._arrived = arrived
        self._intake = Intake(noise_expected and not camera.may_repeat)
        self._failures = 0  # in a row
        self._thread: threading.Thread | None = None
        self._stop = threading.Event()
        self._late: threading.Event | None = None
        self._frame: CameraFrame | None = None
        self._changed = 0.0  # when a picture counted last
        self._received = 0.0  # when one came last, be it the same
        self._error = ""

    def open(self) -> None:
        """Open the camera and start reading.

        Raises:
            CameraError: if the camera cannot be opened.
        """
        self._camera.open()
        self._stop = stop = threading.Event()  # of this thread: one left behind stays stopped
        self._intake.restart()
        self._failures, self._error = 0, ""
        self._received = self._changed = self._clock.now()
        self._thread = threading.Thread(
            target=self._run, args=(stop,), name=f"camera {self.name}", daemon=True
        )
        self._thread.start()

    def close(self) -> None:
        """Stop reading and close the camera; closing twice is fine; never waits long."""
        self._stop.set()
        thread, self._thread = self._thread, None
        if thread is not None:
            thread.join(timeout=1.0)
            self._late = self._stop if thread.is_alive() else None
        self._camera.close()

    def newest(self) -> CameraFrame | None:
        """Newest picture, or None before the first."""
        return self._frame

    def health(self, now: float) -> CameraHealth:
        """State at `now` [s]; needs no cooperation of the camera, so a hanging one is noticed."""
        age = now - (self._frame.time if self._frame is not None else self._received)
        state, frame = self._state(now), self._frame
        return CameraHealth(
            self.name,
            state,
            max(0.0, age),
            self._error,
            self._intake.figures(),
            self.reopened,
            plain(frame) if frame is not None and state is CameraState.FROZEN else "",
            self._camera.simulated,
        )

    def _state(self, now: float) -> CameraState:
        if self._error:
            return CameraState.FAILED
        if now - self._received > STALL:
            return CameraState.STALLED
        if self._frame is None:
            return CameraState.WAITING
        return CameraState.FROZEN if now - self._changed > STALL else CameraState.LIVE

    def _run(self, stop: threading.Event) -> None:
        while not stop.is_set():
            try:
                if self._failures > 1:
                    self._reopen()
                self._take(self._camera.read())
            except CameraError as error:
                self._fail(str(error))
            except Exception as error:  # a driver may raise anything
                self._fail(f"{type(error).__name__}: {error}")
        if self._late is stop:  # it was opening the camera anew when `close` went on
            self._camera.close()

    def _reopen(self) -> None:
        self._camera.close()
        self._camera.open()
        self._intake.restart()
        self.reopened += 1
        self._received = self._changed = self._clock.now()

    def _take(self, frame: CameraFrame) -> None:
        now = self._clock.now()
        verdict = self._intake.judge(frame, now)
        if self._on_frame is not None and verdict in (IntakeVerdict.NEW, IntakeVerdict.REPEATED):
            self._on_frame(frame, now)
        if verdict is IntakeVerdict.REPEATED:
            self._received = now  # it lives, but shows nothing new
        elif verdict is IntakeVerdict.NEW:
            self._received = self._changed = now
            self._publish(frame)
        elif now - self._received > STALL:
            raise CameraError(
                sentence(
                    "its capture times cannot be used: {intake_figures_text}",
                    intake_figures_text=self._intake.figures().text,
                )
            )
        self._failures, self._error = 0, ""

    def _publish(self, frame: CameraFrame) -> None:
        with self._arrived:
            self._frame = frame
            self._arrived.notify_all()

    def _fail(self, message: str) -> None:
        self._error = message
        self.lost += 1
        self._failures += 1
        with self._arrived:
            self._arrived.notify_all()
        self._stop.wait(_PAUSE)
