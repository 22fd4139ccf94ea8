"""Simulated cameras and tracker in a process of their own: the way `bench_cameras_process` tries.

Run as a module this is the child: `python -m tests.bench.cameras_apart FD`, FD being its end of a
socket pair. It builds the same cameras and the same `Tracker` as the trainer does. What it asks of
the loop (`row_at`) it reads in the loop's own history, which lies in memory that both processes
map: the loop pays nothing for it. A fix goes back as one message, pictures as copies in a ring of
shared memory, to which the message says the place. The child ends when the other end is closed.

`ApartTracker` stands for `Tracker` in the program, `CheapTracker` too: that one invents a fix from
the loop's true depth, with no camera, no picture and no child, and shows what there is to gain.
"""

import os
import socket
import subprocess
import sys
import threading
import time
from dataclasses import dataclass
from mmap import mmap
from multiprocessing.connection import Connection
from pathlib import Path
from typing import Any, Final

import numpy as np

from app.compose.needle import felt_force, measured_axis, needle_scene
from app.core import state_vector as sv
from app.core.clock import SystemClock
from app.core.events import Event, EventQueue
from app.core.latest import Latest
from app.device.control.kernel import COUNTERS
from app.device.control.shared import TickHistory
from app.device.state import DeviceState
from app.mechanisms.profile import DeviceProfile
from app.tracking.cameras.feed import Skew
from app.tracking.cameras.watch import CameraHealth
from app.tracking.fix import FixStatus, NeedleFix
from app.tracking.markers.choice import extractors
from app.tracking.markers.extractor import MarkerFix, Miss
from app.tracking.optics.rig import RigProfile
from app.tracking.simulated.cameras import simulated_cameras
from app.tracking.statistics import TrackerMeter, TrackerStatistics
from app.tracking.tracked_picture import TrackedPicture
from app.tracking.tracker import Tracker

ROOT = Path(__file__).resolve().parents[2]
CAPACITY: Final = 16_384
PLACES: Final = 4
"""Pictures of each camera in the shared ring."""


def memory(size: int) -> tuple[int, mmap]:
    """Shared memory that only its descriptor names: it goes with the last who holds it."""
    descriptor = os.memfd_create("acus-cameras")
    os.ftruncate(descriptor, size)
    return descriptor, mmap(descriptor, size)


class SharedHistory(TickHistory):
    """The loop's history in memory that another process can map."""

    def __init__(self, descriptor: int | None = None) -> None:
        size = 8 * (CAPACITY * sv.SLOTS + COUNTERS)
        if descriptor is None:
            self.descriptor, there = memory(size)
        else:
            self.descriptor, there = descriptor, mmap(descriptor, size)
        ring = np.frombuffer(there, dtype=np.float64, count=CAPACITY * sv.SLOTS)
        self.ring = ring.reshape(CAPACITY, sv.SLOTS)
        self.counters = np.frombuffer(there, dtype=np.int64, offset=ring.nbytes)


class LoopSeen:
    """What the cameras' scene and the tracker ask of a loop, from its history alone."""

    def __init__(self, history: TickHistory, rate_hz: float) -> None:
        self._history, self.rate_hz = history, rate_hz

    def latest(self) -> DeviceState:
        """Return the newest tick."""
        return DeviceState.from_row(self._history.last())

    def rows(self, since_tick: int = 0) -> np.ndarray:
        """Return the ticks after this one, (n, SLOTS)."""
        return self._history.rows(since_tick)


@dataclass(frozen=True)
class Wanted:
    """What the child builds: what `build_rig` would give the trainer's own tracker."""

    profile: DeviceProfile
    rig: RigProfile
    seed: int
    history: int
    pictures: int


@dataclass(frozen=True)
class Told:
    """One step of the child: the fix, its health, and where its pictures lie."""

    fix: NeedleFix
    cameras: tuple[CameraHealth, ...]
    skew: Skew | None
    fault: str
    events: tuple[Event, ...]
    place: int
    seen: tuple[tuple[str, float, MarkerFix | Miss | None], ...]


def picture_ring(rig: RigProfile, descriptor: int | None = None) -> tuple[int, np.ndarray]:
    """Return shared pictures, (PLACES, 2, height, width, 3), and their descriptor."""
    width, height = rig.models[0].image_size
    shape = (PLACES, 2, height, width, 3)
    size = int(np.prod(shape))
    if descriptor is None:
        descriptor, there = memory(size)
    else:
        there = mmap(descriptor, size)
    return descriptor, np.frombuffer(there, dtype=np.uint8).reshape(shape)


class ApartTracker:
    """In place of `Tracker`: the cameras and it are in a child.

    Args:
        wanted: profile, rig, seed and the loop's history.
        pictures: shared ring.
        on_fix: called with every fix, in the thread that listens.
    """

    def __init__(self, wanted: Wanted, pictures: np.ndarray, on_fix: Any) -> None:
        self.latest: Latest[NeedleFix] = Latest()
        self.events = EventQueue()
        self.rig = wanted.rig
        self.extractors = extractors(wanted.rig)
        self._wanted, self._ring, self._on_fix = wanted, pictures, on_fix
        self._meter = TrackerMeter()
        self._told: Told | None = None
        self._child: subprocess.Popen[bytes] | None = None
        self._channel: Connection | None = None

    def open(self) -> None:
        """Start the child."""
        if self._child is not None:
            return
        ours, theirs = socket.socketpair()
        descriptors = (theirs.fileno(), self._wanted.history, self._wanted.pictures)
        with theirs:
            self._child = subprocess.Popen(
                [sys.executable, "-m", "tests.bench.cameras_apart", str(theirs.fileno())],
                stdin=subprocess.DEVNULL,
                env=os.environ | {"OPENBLAS_NUM_THREADS": "1", "OMP_NUM_THREADS": "1"},
                cwd=ROOT,
                pass_fds=descriptors,
                start_new_session=True,
            )
        self._channel = Connection(ours.detach())
        self._channel.send(self._wanted)
        threading.Thread(target=self._listen, args=(self._channel,), daemon=True).start()

    def close(self) -> None:
        """End the child."""
        child, self._child = self._child, None
        if child is not None:
            child.terminate()
            child.wait()

    inspect = Tracker.inspect
    stereo = Tracker.stereo

    def touched(self, measured: float, known: float) -> None:
        """Nothing is touched while it is measured."""

    def learn_colour(self, camera: str, pixel: np.ndarray) -> None:
        """Nobody teaches a colour while it is measured."""

    def processor_seconds(self) -> float:
        """Processor time that the child has used so far [s]."""
        if self._child is None:
            return 0.0
        fields = Path(f"/proc/{self._child.pid}/stat").read_text().rpartition(")")[2].split()
        return (int(fields[11]) + int(fields[12])) / os.sysconf("SC_CLK_TCK")

    def statistics(self) -> TrackerStatistics:
        """Figures: those of what has come here, with what the child told of its cameras."""
        stamped, told = self.latest.read(), self._told
        newest = stamped.value if stamped else None
        if told is None:
            return self._meter.statistics(time.monotonic(), newest, (), "", None)
        return self._meter.statistics(time.monotonic(), newest, told.cameras, told.fault, told.skew)

    def pictures(self) -> tuple[TrackedPicture, ...]:
        """Copy the newest pictures."""
        told = self._told
        if told is None:
            return ()
        return tuple(
            TrackedPicture(name, self._ring[told.place, side].copy(), captured, found)
            for side, (name, captured, found) in enumerate(told.seen)
        )

    def _listen(self, channel: Connection) -> None:
        try:
            while True:
                told: Told = channel.recv()
                self._told = told
                for event in told.events:
                    self.events.put(event)
                self.latest.publish(told.fix, told.fix.time)
                self._meter.count(told.fix, time.monotonic())
                self._on_fix(told.fix)
        except (EOFError, OSError):
            channel.close()


class CheapTracker:
    """In place of `Tracker`: thirty fixes a second of the true depth, for next to no work."""

    def __init__(self, rig: RigProfile, loop: LoopSeen, fulcrum: np.ndarray, on_fix: Any) -> None:
        self.latest: Latest[NeedleFix] = Latest()
        self.events = EventQueue()
        self.rig, self.extractors = rig, extractors(rig)
        self._loop, self._fulcrum, self._on_fix = loop, fulcrum, on_fix
        self._meter, self._stop = TrackerMeter(), threading.Event()
        self._thread: threading.Thread | None = None

    def open(self) -> None:
        """Start."""
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, daemon=True)
            self._thread.start()

    def close(self) -> None:
        """End."""
        self._stop.set()

    inspect = Tracker.inspect
    stereo = Tracker.stereo

    def touched(self, measured: float, known: float) -> None:
        """Nothing is touched while it is measured."""

    def learn_colour(self, camera: str, pixel: np.ndarray) -> None:
        """Nobody teaches a colour while it is measured."""

    def processor_seconds(self) -> float:
        """Nothing runs elsewhere."""
        return 0.0

    def statistics(self) -> TrackerStatistics:
        """Figures of what has been invented."""
        stamped = self.latest.read()
        return self._meter.statistics(time.monotonic(), stamped.value if stamped else None, (), "")

    def pictures(self) -> tuple[TrackedPicture, ...]:
        """There are none."""
        return ()

    def _run(self) -> None:
        while not self._stop.wait(1.0 / self.rig.rate_hz):
            state = self._loop.latest()
            if state.tick == 0:
                continue
            tip = self._fulcrum + state.row[sv.PLANT_DEPTH] * state.axis
            fix = NeedleFix(
                tip, 1e-8 * np.eye(3), state.time, FixStatus.VALID, (None, None), 0.1,
                depth=float(state.row[sv.PLANT_DEPTH]), depth_variance=1e-8, has_point=True,
                axis=state.axis,
            )  # fmt: skip
            self.latest.publish(fix, fix.time)
            self._meter.count(fix, time.monotonic())
            self._on_fix(fix)


def child(descriptor: int) -> None:
    """Look until the other end is closed."""
    channel = Connection(descriptor)
    wanted: Wanted = channel.recv()
    profile, rig = wanted.profile, wanted.rig
    loop: Any = LoopSeen(SharedHistory(wanted.history), profile.rate_hz)
    _, ring = picture_ring(rig, wanted.pictures)
    clock, names = SystemClock(), [model.name for model in rig.models]
    scene = needle_scene(loop, profile, rig.needle.marker_offset)
    place = 0

    def tell(fix: NeedleFix) -> None:
        nonlocal place
        place = (place + 1) % PLACES
        pictures = tracker.pictures()
        for picture in pictures:
            ring[place, names.index(picture.name)] = picture.image
        seen = tuple((picture.name, picture.time, picture.found) for picture in pictures)
        figures = tracker.statistics()
        events = tuple(tracker.events.drain())
        try:
            channel.send(
                Told(fix, figures.cameras, figures.skew, figures.fault, events, place, seen)
            )
        except OSError:
            os._exit(0)

    tracker = Tracker(
        simulated_cameras(rig, scene, clock, wanted.seed),
        rig,
        clock,
        axis=measured_axis(loop),
        fulcrum=profile.fulcrum,
        on_fix=tell,
        force=felt_force(loop),
    )
    tracker.open()
    try:
        channel.recv()
    except (EOFError, OSError):
        tracker.close()


if __name__ == "__main__":
    from tests.bench import cameras_apart  # under this name what it sends can be read

    cameras_apart.child(int(sys.argv[1]))
