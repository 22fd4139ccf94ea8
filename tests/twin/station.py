"""The trainer as a program: real loop, real links, real cameras' way in, and a scripted hand.

`python -m tests.twin.station FOLDER BOARD NODES SCENE IGTL ROSBRIDGE STUDENT SEED`. What happens it
tells as lines of JSON, each with its monotonic time; it obeys lines: `quiet T` (when did the
torques become zero after T), `done` (what was asked for at the board is done), `quit`.
"""

from __future__ import annotations

import json
import random
import re
import sys
import threading
import time
from collections import deque
from collections.abc import Callable
from contextlib import suppress
from functools import partial
from pathlib import Path
from queue import Empty, Queue

import numpy as np

from app.compose import cameras as composed_cameras
from app.compose.exercise_ct import read_ct
from app.compose.needle import needle_scene
from app.compose.robot import Robot
from app.compose.trainer import TrainerSetup, build_rig, device_of
from app.compose.watchers import open_watchers
from app.core import state_vector as sv
from app.core.errors import AcusError
from app.core.progress import Progress
from app.device.commissioning.bench import Bench
from app.device.commissioning.results import RoutineName
from app.device.links.serial_link import SerialLink
from app.exercises.scene import placed_plan_of, plan_of
from app.session.ct_facts import CtFacts
from app.session.errors import IllegalTransitionError, SessionError
from app.session.interrupted import interrupted, recover
from app.session.machine import IN_BODY, RUNNING, State
from app.simulation.plant import initial_plant
from app.tracking.cameras.factory import make_camera
from app.tracking.cameras.settings import parse_cameras
from app.tracking.optics.rig import load_rig
from tests.layered import layered
from tests.twin.camera import SceneFile, StreamCapture
from tests.twin.robot import HAND

OUT, SPEED, HELD, ALIGNED, PERIOD = -0.015, 0.010, 1.2, 0.03, 0.02
"""Depth outside [m], speed of the hand [m/s], time at the target [s], angle [rad], look [s]."""

TURN = 3.0
"""How far the hand leans the needle before an attempt [deg]."""

WAITS = 1.0
"""A hand stays outside for so long at first [s]: who is inside too soon had not been out."""

QUIET = 1.0
"""A message that was gone for so long [s] is told again."""

LONGEST = 45.0
"""An attempt that takes longer [s] is ended as it stands."""

_lock = threading.Lock()


def tell(kind: str, **facts: object) -> None:
    line = json.dumps({"t": time.monotonic(), "kind": kind} | facts)
    with _lock:
        print(line, flush=True)


class Station:
    """One start of the program."""

    def __init__(
        self, folder: Path, board: str, nodes: Path, scene: Path, student: str, seed: int
    ) -> None:
        self._student = student
        self._folder, self._board, self._rng = folder, board, random.Random(seed)
        self._exercise = layered("first-insertion")
        self._profile = device_of(self._exercise)
        self._settings = parse_cameras(f"left=usb:{nodes}/left,right=usb:{nodes}/right")
        self._scene = SceneFile(scene)
        self._lines: Queue[str] = Queue()
        self._torques: deque[tuple[float, float]] = deque(maxlen=40_000)
        self._tick, self._state = 0, ""
        self._said: dict[str, float] = {}
        self._depth, self._held, self._begun = OUT, 0.0, 0.0
        self._told_lines: dict[object, tuple[str, ...]] = {}
        self.rig = None

    # --- the robot --------------------------------------------------------------------------------
    def ask(self, order: str) -> None:
        """Have somebody do something at the board."""
        tell("ask", order=order)
        while (line := self._lines.get(timeout=30.0)) != "done":
            if line == "quit":
                raise SystemExit

    def commission(self) -> None:
        """Home the board against its stops and check the signs, unless that is done."""
        upright = initial_plant(self._profile, (0.0, 0.0, -1.0), OUT)
        q = np.array([upright["plant_q_left"], upright["plant_q_right"]])
        way = np.degrees(q - np.array(self._profile.encoder.home_offsets))

        def answer(report) -> float:
            if "upright by eye" in report.needs:
                self.ask(f"turn {way[0]:.3f} {way[1]:.3f}")
            return 0.0

        with Bench(SerialLink(self._board, self._profile), self._profile) as bench:
            end = time.monotonic() + 20.0
            while bench.loop.latest().row[sv.Q_TIME] == 0.0 and time.monotonic() < end:
                time.sleep(0.01)
            steps = [one for one in (RoutineName.HOMING, RoutineName.SIGNS) if not bench.done(one)]
            if steps:
                self.ask("hold 0")
            for step in steps:
                report = bench.run(bench.routine(step, by_hand=False), answer)
                if report.failure:
                    raise SessionError(report.failure)
                bench.keep(report.result)
                tell("commissioned", step=step.value)
        self.ask(HAND)

    def build(self, watchers: tuple, volume) -> None:
        """Greet, home where that is to be done, and build the trainer; again until it works."""
        said = ""
        while True:
            try:
                self.commission()
                placed = placed_plan_of(self._exercise, self._profile, plan_of(self._exercise))
                setup = TrainerSetup(
                    self._exercise, placed, ct=CtFacts.of_volume(volume), port=self._board,
                    sessions=self._folder / "sessions", cameras=self._settings,
                )  # fmt: skip
                self.rig = build_rig(setup)
                self.rig.trainer.open()
                break
            except AcusError as error:
                if str(error) != said:
                    tell("words", words=str(error), about="start")
                said = str(error)
                if self.rig is not None:
                    self.rig.close()
                    self.rig = None
                time.sleep(0.3)
        self._tick = 0
        offset = load_rig(self._settings.rig).needle.marker_offset
        self._look = needle_scene(self.rig.loop, self._profile, offset, real=True)
        for one in watchers:
            one.began(self, volume)
        tell("ready")

    # --- its life ---------------------------------------------------------------------------------
    def run(self, watchers: tuple) -> None:
        threading.Thread(target=self._listen, daemon=True).start()
        threading.Thread(target=self._recover, daemon=True).start()
        volume = read_ct(self._exercise, Progress())
        self.build(watchers, volume)
        threading.Thread(target=self._show, daemon=True).start()
        try:
            while True:
                time.sleep(PERIOD)
                self._look_at(watchers)
                self._obey()
                if self.rig.robot.clearance().homed < 0.5 and not self._running():
                    for one in watchers:
                        one.ended(self)
                    rig, self.rig = self.rig, None
                    rig.close()
                    self.build(watchers, volume)
                self._play()
        finally:
            if self.rig is not None:
                self.rig.close()
                with suppress(AcusError):
                    self._look_at(())  # what it says of an attempt that this ends
            for one in watchers:
                one.close()

    def _listen(self) -> None:
        for line in sys.stdin:
            words = line.split()
            if words[:1] == ["quiet"]:  # at once, also while a robot is being homed
                self._tell_quiet(float(words[1]))
            else:
                self._lines.put(line.strip())
        self._lines.put("quit")

    def _tell_quiet(self, after: float) -> None:
        some = [(at - after, size) for at, size in list(self._torques)]
        last = max((at for at, size in some if at > 0.0 and size > 0.0), default=0.0)
        before = max((size for at, size in some if -0.1 < at <= 0.0), default=0.0)
        tell("quiet", after=after, last=last, before=before)

    def _recover(self) -> None:
        """Close what an earlier start has left open, as the window does at its start."""
        folder, fresh = self._folder / "sessions", True
        while fresh:
            with suppress(AcusError):
                cut, fresh = interrupted(folder)
                for one in cut:
                    tell("recovered", id=recover(folder, one.id).stem)
            time.sleep(2.0)

    def _show(self) -> None:
        """Tell the cameras what stands before them, a hundred times a second."""
        while True:
            rig, look = self.rig, self._look
            if rig is not None:
                seen = look(time.monotonic())
                self._scene.write(seen.p_world, seen.axis_world)
            time.sleep(0.01)

    def _obey(self) -> None:
        with suppress(Empty):
            if self._lines.get_nowait() == "quit":
                raise SystemExit

    def _look_at(self, watchers: tuple) -> None:
        """Tell what is new."""
        trainer = self.rig.trainer
        rows = self.rig.loop.rows(self._tick)
        if len(rows):
            self._tick = int(rows[-1, sv.TICK])
            sizes = np.abs(rows[:, [sv.TORQUE_LEFT, sv.TORQUE_RIGHT]]).max(axis=1)
            self._torques.extend(zip(rows[:, sv.TIME].tolist(), sizes.tolist(), strict=True))
        for event in (*trainer.events.drain(), *self.rig.robot.link.events.drain()):
            tell("event", about=event.kind, words=str(event.message))
        snapshot = trainer.snapshot()
        for words in map(str, snapshot.messages):
            about, now = re.sub(r"[\d.]+", "#", words), time.monotonic()
            if now - self._said.get(about, 0.0) > QUIET:
                tell("words", about="message", words=words)
            self._said[about] = now
        if snapshot.state.value != self._state:
            self._state = snapshot.state.value
            tell("state", state=self._state)
        for server in (server for one in watchers for server in one.servers):
            before, lines = self._told_lines.get(server, ()), server.journal.lines
            if lines != before:  # the oldest go as new ones come
                gone = next(
                    k for k in range(len(before) + 1) if lines[: len(before) - k] == before[k:]
                )
                for line in lines[len(before) - gone :]:
                    tell("words", about="link", words=line)
            self._told_lines[server] = lines

    # --- the student ------------------------------------------------------------------------------
    def _running(self) -> bool:
        return self.rig.trainer.snapshot().state in RUNNING

    def _play(self) -> None:
        trainer, now = self.rig.trainer, time.monotonic()
        snapshot = trainer.snapshot()
        trainer.heartbeat()
        if snapshot.state not in RUNNING:
            self._begin(trainer, snapshot, now)
            return
        if snapshot.state is State.WITHDRAWING:
            if now - self._begun > WAITS:
                with suppress(IllegalTransitionError):
                    trainer.confirm_outside()
            return
        if snapshot.device is not None and snapshot.device.fault:
            trainer.disarm()  # as the messages say: let go of the switch, then hold it again
        else:
            trainer.arm()
        aligned = snapshot.device is not None and snapshot.device.angle_error < ALIGNED
        if snapshot.state is not State.PAUSED:
            self._held += PERIOD if self._depth >= self._target else 0.0
            if (aligned and now - self._begun > WAITS) or snapshot.state in IN_BODY:
                self._depth = min(self._depth + SPEED * PERIOD, self._target)
        self._move(trainer)
        if self._held > HELD or now - self._begun > LONGEST:
            with suppress(IllegalTransitionError):
                result = trainer.end()
                self._ended(result)

    def _begin(self, trainer, snapshot, now: float) -> None:
        """Draw the needle back, lean it off the path, and begin the next attempt."""
        if trainer.result is not None and trainer.result.summary.id != self._told:
            self._ended(trainer.result)  # which the program itself has aborted
        self._depth = max(self._depth - 4.0 * SPEED * PERIOD, OUT)
        self._move(trainer)
        row = self.rig.loop.latest().row
        fresh = now - row[sv.Q_TIME] < 0.05 and snapshot.device is not None
        seen = snapshot.pose.measured
        if self._depth > OUT or not fresh or not seen or self.rig.robot.clearance().homed < 0.5:
            return
        lean = [f"{self._rng.uniform(-TURN, TURN):.2f}" for _ in range(2)]
        self.ask(f"turn {lean[0]} {lean[1]}")
        try:
            number = trainer.begin(self._student)
            trainer.assistance(1.0)
        except AcusError as error:
            tell("words", about="begin", words=str(error))
            time.sleep(0.3)
            return
        self._begun, self._held = now, 0.0
        self._target = self.rig.setup.placed.length
        tell("began", id=number)

    _told = ""

    def _ended(self, result) -> None:
        self._told = result.summary.id
        score = None if result.score is None else result.score.total
        tell(
            "ended", id=self._told, state=result.state.value, score=score,
            record=str(result.record) if result.record else "",
        )  # fmt: skip

    def _move(self, trainer) -> None:
        axis = self.rig.setup.placed.axis
        trainer.hand(float(axis[0]), float(axis[1]), self._depth)


def as_if_real(own: Callable[[Robot], dict[str, str]]) -> Callable[[Robot], dict[str, str]]:
    """No university is told what an emulated robot did: here the board stands for a real one."""
    return lambda robot: own(robot) | {"kind": "real"}


def main(folder, board, nodes, scene, igtl, ros, student, seed) -> None:
    Robot.metadata = as_if_real(Robot.metadata)
    # The pictures' way in: a driver's capture, here that of the streams.
    composed_cameras.make_camera = partial(make_camera, opener=StreamCapture)
    watchers = open_watchers({"igtl": igtl, "rosbridge": ros})
    tell("links", lines=[str(line) for one in watchers for line in one.lines()])
    station = Station(Path(folder), board, Path(nodes), Path(scene), student, int(seed))
    with suppress(SystemExit):
        station.run(watchers)
    tell("closed")


if __name__ == "__main__":
    main(*sys.argv[1:])
