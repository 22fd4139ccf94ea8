"""Services, trainers and plans for tests of the whole window."""

import threading
from dataclasses import replace
from functools import cache
from time import monotonic
from types import MappingProxyType, SimpleNamespace

import numpy as np
from PySide6.QtCore import Qt
from PySide6.QtTest import QTest
from views_robot_fakes import FakeBench

from app.compose.desktop import Desktop
from app.compose.effect_models import with_model
from app.compose.explaining import quick_explanation
from app.core import paths
from app.core.errors import AcusError
from app.core.events import EventQueue
from app.core.state_vector import empty_state
from app.exercises.library import library
from app.exercises.locks import Lock
from app.exercises.scene import device_of
from app.session.curves import offset
from app.session.errors import ControlLockedError
from app.session.machine import State
from app.session.needle import DepthSource, NeedlePose
from app.session.shown_views import Shown
from app.session.snapshot import Snapshot
from app.simulation.effects import declaration
from app.tracking.cameras.camera import CameraFrame
from app.tracking.cameras.watch import CameraHealth, CameraState
from app.tracking.pen.webcam import guessed_webcam
from app.tracking.statistics import TrackerMeter
from app.views.exercise.run import ExerciseRun
from app.views.reading.lock_words import why_locked
from app.views.shell.services import RobotPort
from app.views.slices.viewing import Tool


class FakeTrainer:
    def __init__(self, placed):
        self.placed, self.events, self.result, self.state = placed, EventQueue(), None, State.READY
        self.dial, self.hands, self.begun, self.taken_over = 1.0, [], None, ""

    def snapshot(self):
        placed = self.placed
        axis, tip = placed.axis, placed.p_entry + 0.01 * placed.axis
        pose = NeedlePose(tip, axis, 0.01, 1.0, 0.0, 0.0, DepthSource.TRACKED, True,
                          1e-9 * np.eye(3))  # fmt: skip
        device = SimpleNamespace(tick=9, q=np.array([3.0, 0.1]), hub=tip - 0.2 * axis,
                                 felt=np.zeros(3), fault=0, row=empty_state(),
                                 qd=np.zeros(2), torque=np.zeros(2))  # fmt: skip
        timing = SimpleNamespace(
            median=8e-5, p99=2e-4, missed=0, ticks=9, cost=8e-5, rate_hz=1000.0
        )

        away = offset(pose, placed.p_target, placed)
        return Snapshot(1.0, self.state, "", 0.0, MappingProxyType({}), pose, away,
                        placed.p_target, device, timing, None, "valid", 0, self.dial, False, None,
                        ())  # fmt: skip

    def begin(self, student="", hand=""):
        self.state, self.begun = State.ALIGNING, (student, hand)
        return "session-1"

    def abort(self, reason=""):
        self.state = State.ABORTED

    def mark_entry(self, mark):
        self.marked = mark

    def heartbeat(self): ...
    def assistance(self, value): ...
    def take_over(self, hand):
        self.taken_over = hand

    def hand(self, *pose):
        self.hands.append(pose)

    def lead(self, within):  # its time goes on by itself
        return None

    @property
    def time(self):
        return monotonic()

    def arm(self): ...
    def disarm(self): ...


class FakeOpen:
    def __init__(self, setup):
        self.closed, self.setup = threading.Event(), setup
        self.run = ExerciseRun(
            FakeTrainer(setup.placed), setup.placed, device_of(setup.exercise), interactive=True,
            held_arming=setup.robot.held_arming, port=setup.robot.port,
            shown=Shown.of_exercise(setup.exercise), demonstrates=setup.demonstrates,
        )  # fmt: skip
        self.run.trainer.dial = setup.exercise.assistance

    @property
    def exercise(self):
        return self.setup.exercise

    def compute_by(self, effect, model):
        why = why_locked(self.exercise, Lock.MODELS)
        if why:
            raise ControlLockedError(why)
        self.setup = replace(self.setup, exercise=with_model(self.exercise, effect, model))
        return self.exercise

    def place(self, placed):
        self.run.trainer.placed = placed
        self.run = replace(self.run, placed=placed)
        return self.run

    def close(self):
        self.closed.set()


class FakeLive:
    """A camera whose picture turns bright with the patch of the screen, 40 ms later."""

    def __init__(self, side):
        self.side, self.closed = side, threading.Event()
        self.state, self.patch, self.taken = CameraState.LIVE, None, None
        rng = np.random.default_rng(1)
        self.frame = CameraFrame(rng.integers(60, 90, (480, 640, 3)).astype(np.uint8), 1.0)

    def newest(self):
        return self.frame

    def health(self):
        return CameraHealth(self.side, self.state, 0.5)

    def settings(self):
        return ("focus: the driver did not accept holding it (it is at 30)",)

    def measure_light(self, wanted):
        self.taken = wanted

    def light(self):
        shown = np.array(self.patch.shown)
        times = np.arange(shown[0] - 0.3, shown[-1] + 0.3, 1.0 / 30.0)
        bright = np.searchsorted(shown, times) % 2
        return times + 0.04, np.column_stack([80.0 + 0.0 * times, 60.0 + 100.0 * bright])

    def close(self):
        self.closed.set()


class FakePen(FakeLive):
    """A pen before a webcam that sees what a test says."""

    def __init__(self, settings, seen=None):
        super().__init__("webcam")
        self.opened_with, self.seen, self.fault, self.collect = settings, seen, "", None
        self.moves = 0.0

    def observed(self):
        return self.seen

    def statistics(self):
        return TrackerMeter().statistics(1.0, None, (self.health(),), self.fault)

    def webcam(self):
        return guessed_webcam((640, 480))

    def speed(self):
        return self.moves

    def listen(self, collect):
        self.collect = collect


@cache
def _shipped():
    """The program's own exercises, which every window of every test asks for twice."""
    return library().exercises


class FakeServices:
    watchers = ()

    def __init__(self, folder):
        self.folder, self.opened, self.refuses = folder, [], ""
        self.prepared, self.missing, self.unusable = threading.Event(), "", ()
        self.sources, self.lives = (RobotPort("usb:1-1", "Webcam (usb:1-1)"),), []
        self.pens, self.seen = [], None
        self.served, self.served_asked, self.may_answer = (), [], threading.Event()
        self.may_answer.set()
        self.ports, self.benches = (RobotPort("/dev/ttyACM0", "icube A17 on /dev/ttyACM0"),), []

    def robots(self):
        return self.ports

    def served_robots(self):
        self.served_asked.append(threading.current_thread())
        assert self.may_answer.wait(30.0)
        return self.served

    def open_robot(self, port, profile, progress):
        if self.refuses:
            raise AcusError(self.refuses)
        self.benches.append(FakeBench())
        return self.benches[-1]

    def camera_sources(self):
        return self.sources

    def open_camera(self, settings, side, progress):
        if self.refuses:
            raise AcusError(self.refuses)
        self.lives.append(FakeLive(side))
        return self.lives[-1]

    def open_source(self, name, settings, progress):
        if self.refuses:
            raise AcusError(self.refuses)
        self.pens.append(FakePen(settings, self.seen))
        return self.pens[-1]

    def aim(self, settings, device, progress):
        outlines = (np.array([[10.0, 10.0], [600.0, 10.0], [300.0, 400.0]]), np.empty((0, 2)))
        cone = SimpleNamespace(
            share=0.51,
            shares=(1.0, 0.51),
            outlines=outlines,
            losses=lambda: ("right loses everything at -30 to 25 mm depth",),
        )
        return SimpleNamespace(
            cone=cone, basis="calibration c1", assumed=False, image_size=(640, 480)
        )

    def exercises(self):
        return _shipped() if not (paths.data() / "exercises").exists() else library().exercises

    def check_exercise(self, exercise):
        return quick_explanation(exercise)

    def explain_exercise(self, exercise):
        kept = ("lateral_tissue", "shaft_friction")
        effects = [
            {
                "effect": name, "title": declaration(name).title, "model": part.model or first,
                "model_descriptions": dict(models), "why": "simulated: it is felt",
                "warnings": [], "cost_ns": 100.0, "picture_ns": None,
                "model_costs_ns": {model: 100.0 / k for k, model in enumerate(models, 1)},
            }
            for name, part in exercise.effects.items() if name in kept
            for models in [declaration(name).models] for first in [next(iter(models))]
        ]  # fmt: skip
        dropped = [{"effect": n, "why": "dropped"} for n in exercise.effects if n not in kept]
        laws = [{"law": "fixture", "cost_ns": 150.0}]
        return {"simulated": effects, "dropped": dropped, "laws": laws}

    def sessions(self):
        return self.folder

    def portrait(self, exercise, volume, progress):
        return None

    def prepare(self, progress):
        self.prepared.set()
        if self.missing:
            raise ImportError(self.missing)
        return self.unusable

    def open_run(self, setup, progress):
        if self.refuses:
            raise AcusError(self.refuses)
        self.opened.append(FakeOpen(setup))
        return self.opened[-1]


class RealRuns(FakeServices):
    """Runs with the real trainer, loop and simulated cameras."""

    def __init__(self, folder):
        super().__init__(folder)
        self.desktop = Desktop(sessions=folder)

    def open_run(self, setup, progress):
        return self.desktop.open_run(setup, progress)


def plan(window):
    window.editor.place(Tool.ENTRY, (5.0, -18.0, 140.0), True)
    window.editor.place(Tool.TARGET, (5.0, 5.0, 140.0), True)


def state(window):
    """State of the attempt, None without a run."""
    run = window.conductor.controller.run
    return None if run is None else run.trainer.state


def press(window, key, modifier=Qt.KeyboardModifier.NoModifier):
    """Press a key on the page that is shown."""
    QTest.keyClick(window.pages.currentWidget(), key, modifier)


def choose(window, name):
    """Stand on an exercise of the start page and press Enter."""
    place = window.start_page.map.places[name]
    place.setFocus()
    QTest.keyClick(place, Qt.Key.Key_Return)
