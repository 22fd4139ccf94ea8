"""The live links: what runs, told to other programs by the protocols that were asked for.

A link asks the board in its own thread and gets the trainer's newest snapshot, as the exercise lets
it be shown. One thread of the board turns events into lines and control scans into pictures.
"""

from __future__ import annotations

import threading
import time
from collections import deque
from collections.abc import Callable, Mapping
from dataclasses import dataclass
from importlib import import_module
from secrets import token_urlsafe
from typing import TYPE_CHECKING, Any, Final

import numpy as np

from app.compose.live_surfaces import live_surfaces
from app.core.arrays import FloatArray
from app.core.errors import ConfigurationError
from app.core.events import Event, EventQueue
from app.core.identifiers import without_identifiers
from app.core.messages import sentence
from app.core.staleness import TRACKER_HOLD
from app.core.units import MILLIMETRE
from app.exchange.live.doors import LOOPBACK, Doors
from app.exchange.live.journal import LinkJournal, LinkReport
from app.exchange.moment import (
    LiveDevice,
    LiveEvent,
    LiveMoment,
    LivePlan,
    LivePose,
    LiveScan,
    LiveSurface,
    Validity,
)
from app.exercises.parts import ViewName
from app.session.control_scan import ControlScan
from app.session.machine import RUNNING
from app.session.needle import NeedlePose
from app.session.sample import JOINTS
from app.session.shown_views import Shown
from app.session.snapshot import Snapshot
from app.tracking.fix import FixStatus

if TYPE_CHECKING:
    from app.compose.watchers import WatchedRun
    from app.imaging.volume import Volume
    from app.planning.placement import PlacedPlan

PROTOCOLS: Final = ("igtl", "rosbridge", "foxglove")
"""Options that open a link, each with its port."""

_WITH_TOKEN: Final = ("rosbridge", "foxglove")


def watcher(options: Mapping[str, str]) -> Links | None:
    """Open the links that are asked for.

    Raises:
        AcusError: if a port or an address cannot be used, or a library is missing; nothing stays
            open then.
    """
    ports = {name: _port(name, options[name]) for name in PROTOCOLS if name in options}
    if not ports:
        if given := [name for name in ("links-host", "links-allow") if name in options]:
            raise ConfigurationError(
                sentence(
                    "--{option} is of no use without a link: {protocols}",
                    option=given[0],
                    protocols=", ".join(f"--{name}" for name in PROTOCOLS),
                )
            )
        return None
    doors = Doors.of(
        options.get("links-host", LOOPBACK),
        options.get("links-token", ""),
        options.get("links-allow", ""),
    )
    made = ""
    if not doors.only_here and not doors.token and set(ports) & set(_WITH_TOKEN):
        made = token_urlsafe(18)
        doors = Doors(doors.host, made, doors.allowed)
    links = Links(ports, doors, made)
    links.open()
    return links


def _port(name: str, text: str) -> int:
    try:
        return int(text)
    except ValueError as error:
        raise ConfigurationError(
            sentence("--{name} {port!r} is no port: 0 to 65535", name=name, port=text)
        ) from error


class Links:
    """Watches the run, and has the servers.

    Args:
        ports: of the protocols that are asked for.
        doors: where to listen, and whom to let in.
        made: the token, where it was made here and is to be told.
    """

    def __init__(self, ports: Mapping[str, int], doors: Doors, made: str = "") -> None:
        self.board = LiveBoard(surfaces="foxglove" in ports)
        self._made = made
        self.servers = tuple(_server(name, self.board, doors, port) for name, port in ports.items())

    def open(self) -> None:
        """Listen, and start all threads.

        Raises:
            AcusError: if a port cannot be had; nothing stays open then.
        """
        try:
            for server in self.servers:
                server.open()
        except BaseException:
            self.close()
            raise
        self.board.open()

    def close(self) -> None:
        """End the servers; idempotent."""
        for server in self.servers:
            server.close()
        self.board.close()

    def began(self, run: WatchedRun, volume: Volume | None) -> None:
        """Tell of this run from now on."""
        self.board.attach(run, volume)

    def ended(self, run: WatchedRun) -> None:
        """Tell of it no more."""
        self.board.detach(run)

    def lines(self) -> tuple[str, ...]:
        """Return where each link listens, and a token that was made."""
        lines = [
            sentence("{link} at {address}", link=one.title, address=one.address)
            for one in self.statuses()
        ]
        if self._made:
            lines.append(sentence("peers of the links need the token {token}", token=self._made))
        return tuple(lines)

    # --- for the window -------------------------------------------------------------------------
    def statuses(self) -> tuple[LinkReport, ...]:
        """Return how each link is."""
        return tuple(server.status() for server in self.servers)

    def take_plans(self, take: Callable[[FloatArray, FloatArray], str] | None) -> None:
        """Have plans of peers taken by whoever may: gets entry and target, LPS [m], in another
        thread, and returns why not, empty where it is done; None takes none.
        """
        self.board.on_plan = take


def _server(name: str, board: LiveBoard, doors: Doors, port: int) -> Any:
    """Build a server: a file of its name in `exchange.live`, imported only now."""
    return import_module(f"app.exchange.live.{name}").server(board, doors, port)


TOLD: Final = frozenset({"state", "scan", "touch", "task", "breath", "withdrawal"})
"""Kinds of events that leave the program, without paths, files and pseudonyms in their words."""

KEPT: Final = 256
"""Events that a link may still ask for."""

JUMP: Final = 0.5
"""From here on [s] the system's clock has been set, and did not merely drift."""

_LOOK: Final = 0.05
_HIDDEN: Final = frozenset({FixStatus.OUT_OF_VIEW.value, FixStatus.NOT_YET_VISIBLE.value})


class WallClock:
    """Time since 1970 that runs evenly: a clock that is set moves it once, and that is said."""

    def __init__(
        self,
        journal: LinkJournal,
        wall: Callable[[], float] = time.time,
        steady: Callable[[], float] = time.monotonic,
    ) -> None:
        self._journal, self._wall, self._steady = journal, wall, steady
        self._offset = wall() - steady()

    def now(self) -> float:
        """Return the time [s since 1970]."""
        steady, wall = self._steady(), self._wall()
        if abs(jump := wall - steady - self._offset) > JUMP:
            self._offset = wall - steady
            self._journal.say(f"the computer's clock was set by {jump:+.1f} s", "clock")
        return steady + self._offset


@dataclass(frozen=True, slots=True, eq=False)
class _WatchedRun:
    """The run that is told of."""

    run: WatchedRun
    events: EventQueue
    volume: Volume | None


class LiveBoard:
    """Implements `exchange.moment.LiveSource`.

    Args:
        surfaces: whether skin and structures are asked for; they are made in the board's thread.

    Attributes:
        journal: lines that are of no link alone.
        on_plan: takes plans of peers; None where nobody does.
    """

    def __init__(self, surfaces: bool = False) -> None:
        self.journal = LinkJournal()
        self.on_plan: Callable[[FloatArray, FloatArray], str] | None = None
        self._clock = WallClock(self.journal)
        self._watched: _WatchedRun | None = None
        self._plan: tuple[PlacedPlan, LivePlan] | None = None
        self._scan: LiveScan | None = None
        self._shapes, self._shaped = surfaces, False
        self._surfaces: tuple[LiveSurface, ...] = ()
        self._events: deque[LiveEvent] = deque(maxlen=KEPT)
        self._count = 0
        self._lock = threading.Lock()
        self._stop = threading.Event()
        self._thread: threading.Thread | None = None

    def open(self) -> None:
        """Start the thread; idempotent."""
        if self._thread is None:
            self._thread = threading.Thread(target=self._run, name="live-board", daemon=True)
            self._thread.start()

    def close(self) -> None:
        """Stop it; idempotent."""
        self._stop.set()
        thread, self._thread = self._thread, None
        if thread is not None:
            thread.join(timeout=2.0)

    def attach(self, run: WatchedRun, volume: Volume | None) -> None:
        """Tell of this run from now on."""
        watched = _WatchedRun(run, run.rig.trainer.events.follow(), volume)
        self._surfaces, self._shaped = (), not self._shapes
        self._watched, self._scan = watched, None

    def detach(self, run: WatchedRun) -> None:
        """Tell of it no more; nothing happens where another one is told of."""
        watched = self._watched
        if watched is not None and watched.run is run:
            self._watched, self._scan, self._surfaces = None, None, ()

    # --- what a link asks -----------------------------------------------------------------------
    def now(self) -> LiveMoment:
        """Return the newest of everything."""
        wall, watched = self._clock.now(), self._watched
        if watched is None:
            return LiveMoment(wall)
        rig = watched.run.rig
        placed, shown = rig.setup.placed, Shown.of_exercise(rig.setup.exercise)
        trainer = rig.trainer
        snapshot = shown.of(trainer.snapshot(), placed)
        since = wall - trainer.time  # a slowed run's time is behind the wall's
        length = float(rig.profile.needle_length)
        return LiveMoment(
            wall,
            True,
            snapshot.state.value,
            _needle(snapshot, length, since, wall) if shown.live else None,
            _device(snapshot, since) if shown.live else None,
            self._placed(placed, length),
            self._scan,
            self._surfaces if shown.shows(ViewName.THREE_D) else (),
        )

    def events_after(self, number: int) -> tuple[LiveEvent, ...]:
        """Return what happened after an event, as far as it is kept."""
        with self._lock:
            return tuple(event for event in self._events if event.number > number)

    def place(self, p_entry: FloatArray, p_target: FloatArray) -> str:
        """Hand a plan of a peer to the window: an instructor's, and only before an attempt."""
        watched, take = self._watched, self.on_plan
        if take is None:
            return "nobody takes a plan here: that needs an instructor's window"
        if watched is not None and watched.run.rig.trainer.snapshot().state in RUNNING:
            return "an attempt is running: its plan cannot change"
        return take(p_entry, p_target)

    def _placed(self, placed: PlacedPlan, length: float) -> LivePlan:
        if self._plan is None or self._plan[0] is not placed:
            plan = placed.plan
            told = LivePlan(
                plan.entry_mm * MILLIMETRE,
                plan.target_mm * MILLIMETRE,
                placed.T_world_patient,
                length,
            )
            self._plan = placed, told
        return self._plan[1]

    # --- its thread -----------------------------------------------------------------------------
    def _run(self) -> None:
        while not self._stop.wait(_LOOK):
            watched = self._watched
            if watched is None:
                continue
            if not self._shaped:
                self._shape(watched)
            try:
                for event in watched.events.drain():
                    self._take(event, watched)
            except Exception as error:  # one event is not told; the attempt knows nothing of it
                self.journal.say(f"an event is not told: {type(error).__name__}: {error}")

    def _shape(self, watched: _WatchedRun) -> None:
        """Make skin and structures of a run, once; the links have none until then."""
        self._shaped = True
        try:
            made = live_surfaces(watched.volume, watched.run.rig.setup.risks)
        except Exception as error:  # the scene is told without them
            self.journal.say(f"no surfaces are told: {type(error).__name__}: {error}")
            return
        if self._watched is watched:
            self._surfaces = made

    def _take(self, event: Event, watched: _WatchedRun) -> None:
        rig = watched.run.rig
        shown = Shown.of_exercise(rig.setup.exercise)
        if event.kind in TOLD and shown.tells(event.kind, event.data.get("state")):
            wall = self._clock.now() - rig.trainer.time + event.time
            words = without_identifiers(str(event.message))
            with self._lock:
                self._count += 1
                self._events.append(LiveEvent(self._count, wall, event.kind, words))
        scan = ControlScan.of(event)
        if scan is not None and watched.volume is not None:
            self._picture(scan, watched, watched.volume)

    def _picture(self, scan: ControlScan, watched: _WatchedRun, volume: Volume) -> None:
        wall = self._clock.now() - watched.run.rig.trainer.time + scan.time
        field = None if scan.inside is None else watched.run.rig.trainer.tissues
        picture = scan.picture(volume, field)
        told = LiveScan(scan.number, wall, picture.hu, picture.affine_mm)
        if self._watched is watched:
            self._scan = told


def _needle(snapshot: Snapshot, length: float, since: float, wall: float) -> LivePose | None:
    pose = snapshot.measured_pose or snapshot.pose
    moment = since + pose.time
    age = max(0.0, wall - moment)
    return LivePose(
        pose.p_tip,
        pose.p_straight,
        pose.p_straight - length * pose.axis,
        pose.axis,
        pose.tip_axis,
        pose.depth,
        pose.covariance,
        _validity(pose, snapshot.fix_status, age),
        moment,
        age,
    )


def _validity(pose: NeedlePose, fix_status: str, age: float) -> Validity:
    if not pose.valid:
        return Validity.INVALID
    if age > TRACKER_HOLD:
        return Validity.REQ_TIMEOUT
    if pose.measured:
        return Validity.OK
    return Validity.OUT_OF_VIEW if fix_status in _HIDDEN else Validity.MISSING


def _device(snapshot: Snapshot, since: float) -> LiveDevice | None:
    device = snapshot.device
    if device is None or not np.isfinite(device.q).all():
        return None
    return LiveDevice(
        JOINTS,
        device.q,
        device.qd,
        device.torque,
        device.felt,
        float(device.angle_error),
        since + device.time,
    )
