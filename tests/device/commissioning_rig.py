"""A simulated robot on the bench that can be wired wrongly, on a virtual clock, with a person."""

from datetime import UTC, datetime

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import VirtualClock
from app.core.compiled import stage
from app.device.commissioning.bench import Bench
from app.device.commissioning.results import RoutineName
from app.device.links import BoardInfo, DeviceLink, Link
from app.device.links.simulated import SimulatedEncoders
from app.mechanisms.pantograph import inverse
from app.mechanisms.profile import load_profile
from app.simulation.plant import initial_plant, plant_stage

PROFILE = load_profile("icube")
GEOMETRY = PROFILE.pantograph
UPRIGHT = inverse(GEOMETRY, GEOMETRY.fulcrum[:2])
HOME = np.array(PROFILE.encoder.home_offsets)
INFO = BoardInfo("icube", "A-001", "1.0", "acus 1", boot=7)

# Encoders: matrix (4), offset (2), frozen, last (3). Motors: matrix (4), kept torque (2),
# hold, held joint angles (2), blocked left, blocked right.
FROZEN, LAST = 6, 7
HOLD, HELD, BLOCKED = 6, 7, 9


@stage
def misread(state: FloatArray, p: FloatArray) -> None:
    """Encoders swapped, reversed, offset or frozen."""
    if p[6] != 0.0:
        state[sv.Q_LEFT], state[sv.Q_RIGHT], state[sv.Q_TIME] = p[7], p[8], p[9]
        return
    left, right = state[sv.Q_LEFT], state[sv.Q_RIGHT]
    state[sv.Q_LEFT] = p[0] * left + p[1] * right + p[4]
    state[sv.Q_RIGHT] = p[2] * left + p[3] * right + p[5]
    p[7], p[8], p[9] = state[sv.Q_LEFT], state[sv.Q_RIGHT], state[sv.Q_TIME]


@stage
def read_gauge(state: FloatArray, p: FloatArray) -> None:
    """Whether there is a gauge, and what it reads, in each tick as the links do it."""
    state[sv.GAUGE], state[sv.GAUGE_FORCE] = p[0], p[1]


@stage
def miswire(state: FloatArray, p: FloatArray) -> None:
    """Torques as they reach the motors; `straighten` puts the sent ones back."""
    left, right = state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT]
    p[4], p[5] = left, right
    state[sv.TORQUE_LEFT] = p[0] * left + p[1] * right
    state[sv.TORQUE_RIGHT] = p[2] * left + p[3] * right
    if p[9] != 0.0:
        p[7] = state[sv.PLANT_Q_LEFT]
    if p[10] != 0.0:
        p[8] = state[sv.PLANT_Q_RIGHT]


@stage
def straighten(state: FloatArray, p: FloatArray) -> None:
    """Sent torques back into their slots; joints that are held or blocked stay."""
    state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT] = p[4], p[5]
    if p[6] != 0.0 or p[9] != 0.0:
        state[sv.PLANT_Q_LEFT], state[sv.PLANT_QD_LEFT] = p[7], 0.0
    if p[6] != 0.0 or p[10] != 0.0:
        state[sv.PLANT_Q_RIGHT], state[sv.PLANT_QD_RIGHT] = p[8], 0.0


class WiredLink(DeviceLink):
    """Link to the simulated plant with wrong wiring, which says that it is a real board."""

    def __init__(self, info: BoardInfo = INFO) -> None:
        self.who = info
        self.encoders = np.array([1.0, 0, 0, 1, 0, 0, 0, 0, 0, 0])
        self.gauge = np.zeros(2)
        self.motors = np.array([1.0, 0, 0, 1, 0, 0, 0, 0, 0, 0, 0])
        plant = plant_stage(PROFILE)
        encoders = SimulatedEncoders(PROFILE.encoder.counts_per_turn, PROFILE.encoder.home_offsets)
        self.link = Link.of(
            [
                encoders.stage(),
                ("misread", misread, self.encoders),
                ("gauge", read_gauge, self.gauge),
            ],
            [("miswire", miswire, self.motors), plant, ("straighten", straighten, self.motors)],
        )
        self.opened = 0

    def open(self) -> None:
        self.opened += 1

    def close(self) -> None:
        self.opened = 0

    def stages(self) -> Link:
        return self.link

    def info(self) -> BoardInfo:
        return self.who

    def hold(self, q) -> None:
        """Hold the links at joint angles by hand; None lets go."""
        self.motors[HOLD] = 0.0 if q is None else 1.0
        if q is not None:
            self.motors[HELD : HELD + 2] = q


class Person:
    """Does what the routines ask for."""

    def __init__(self, link: WiredLink, bench: Bench, readings=(), right=True) -> None:
        self.link, self.bench, self.readings = link, bench, list(readings)
        self.asked: list[str] = []

    def __call__(self, report):
        text = report.needs
        self.asked.append(text)
        if "against their stops" in text:
            self.link.hold(HOME)
        elif "upright by eye" in text or "jig that holds" in text or "against the scale" in text:
            self.link.hold(UPRIGHT)
        elif "lean the needle" in text:
            self.link.hold(UPRIGHT + [0.2, 0.1])
        elif "turn the left" in text:
            self.link.hold(UPRIGHT + [0.2, 0.0])
        elif "turn the right" in text:
            self.link.hold(UPRIGHT + [0.2, -0.2])
        elif "let go" in text:
            self.link.hold(UPRIGHT)
            self.bench.advance(0.01)
            self.link.hold(None)
        elif report.unit:
            return self.weigh() if not self.readings else self.readings.pop(0)
        return 0.0

    def weigh(self) -> float:
        """What a scale shows that the hub pushes against [g]: torques at the motors, not sent."""
        state, p = self.bench.loop.latest(), self.link.motors
        sent = np.array(p[:4]).reshape(2, 2) @ state.torque
        share = float(sent @ state.torque / max(state.torque @ state.torque, 1e-300))
        return 1000.0 * share * float(np.linalg.norm(state.felt)) / 9.80665


def make(folder, info=INFO, record=True):
    """Bench with its link and person; homed and checked in this power cycle unless told."""
    link = WiredLink(info)
    bench = Bench(
        link,
        PROFILE,
        VirtualClock(10.0),
        folder,
        today=lambda: datetime(2026, 11, 21, 12, 0, tzinfo=UTC),
        initial=initial_plant(PROFILE, (0.0, 0.0, -1.0), -0.015),
    )
    return link, bench, Person(link, bench)


def run(bench, person, step, **options):
    """Run one routine; checks that it ends at zero torque."""
    report = bench.run(bench.routine(step, **options), person)
    assert_quiet(bench)
    return report


def assert_quiet(bench):
    """No test input is left, the forces are disarmed, and nothing is sent any more."""
    inputs = bench.loop.inbox.read()
    for name in ("test_x", "test_y", "test_z", "test_left", "test_right", "enabled", "homed"):
        assert inputs[name] == 0.0
    bench.advance(0.01)
    assert not bench.loop.latest().torque.any()


def commission(bench, person):
    """Home and check the signs, and keep both."""
    for step in (RoutineName.HOMING, RoutineName.SIGNS):
        report = run(bench, person, step)
        assert not report.failure, report.failure
        bench.keep(report.result)
