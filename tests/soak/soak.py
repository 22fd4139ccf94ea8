"""A simulated robot in virtual time, a hand that wanders, and scenes that change every 5 s.

All that a tick has runs compiled: the hand, the cameras that see the depth, the robot, laws and
effects, governor, guard, safety. A scene is a random choice of the effects that ship, each with one
of its models, and of force laws; it is exchanged between two ticks of the running loop. A stage at
the end of the tick notes the largest force and everything that is no finite number.
"""

from __future__ import annotations

import time
from dataclasses import dataclass, field
from pathlib import Path

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import VirtualClock
from app.core.compiled import njit, stage
from app.core.parameters import Stage
from app.device.control import Loop, Table, laws, machine_stages
from app.device.links import Link
from app.device.links.simulated import simulated_link
from app.mechanisms.profile import load_profile
from app.simulation.consumers import Consumer, DevicePort
from app.simulation.effects import declaration, effect_names
from app.simulation.plan import SimulationPlan, compile
from app.simulation.plant import initial_plant, plant_stage
from app.simulation.scene import EffectRequest
from tests.simulation.effect_rig import whole_scene

PROFILE = load_profile("icube")
EVERYTHING = Consumer("the soak reads it", tuple(sv.INDEX))
DEVICE = DevicePort("icube", frozenset({"lateral", "axial"}), simulated=True)
BONE = 0.09
"""Depth of the bone [m], within the needle's reach."""

SCENE_LASTS = 5.0
"""Time after which the scene is another [s]."""

SEED, LEFT_OVER, X, Y, DEPTH, DIAL, SEEN, STILL, SEEN_DEPTH, BREATH, OFF, PATH = range(12)
MOST_FORCE, BROKEN, MOST_TORQUE, TICKS, UNDER_FORCE, AXIAL, FAULTS = range(7)
_TINY = 1e-300


@njit
def _draw(p: FloatArray) -> float:
    p[SEED] = (p[SEED] * 16807.0) % 2147483647.0
    return p[SEED] / 2147483647.0


@stage
def wander(state: FloatArray, p: FloatArray) -> None:
    """Want the needle elsewhere after 20 to 2000 ticks; turn the dial; see the depth at 30 Hz.

    It writes all inputs in every tick: they are taken anew before it.
    """
    now = state[sv.TIME]
    if now - p[SEEN] > 0.033:
        p[SEEN], p[SEEN_DEPTH] = now, state[sv.PLANT_DEPTH] + 1e-4 * (_draw(p) - 0.5)
    p[LEFT_OVER] -= 1.0
    if p[LEFT_OVER] <= 0.0 and p[STILL] == 0.0:
        p[LEFT_OVER] = 20.0 * 100.0 ** _draw(p)
        tilt, turn = 0.6 * _draw(p), 6.2832 * _draw(p)
        p[X], p[Y] = np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn)
        p[DEPTH] = -0.03 + 0.15 * _draw(p)
        p[DIAL] = 2.0 * _draw(p) - 1.0
        p[BREATH] = np.floor(2.0 * _draw(p))
        tilt, turn = 0.5 * _draw(p), 6.2832 * _draw(p)
        p[PATH], p[PATH + 1] = np.sin(tilt) * np.cos(turn), np.sin(tilt) * np.sin(turn)
        p[PATH + 2] = -np.cos(tilt)
    if state[sv.LET_GO] > 0.0 and p[OFF] <= 0.0:  # taken for let go: off for a moment, on again
        p[OFF] = 100.0
    p[OFF] -= 1.0
    state[sv.HEARTBEAT], state[sv.HOMED], state[sv.FORCE_CAP] = now, 1.0, 5.0
    state[sv.ENABLED] = 0.0 if p[OFF] > 0.0 else 1.0
    state[sv.TRACKED_TIME], state[sv.TRACKED_VARIANCE] = p[SEEN], 1e-8
    state[sv.TRACKED_DEPTH], state[sv.HOLD_BREATH] = p[SEEN_DEPTH], p[BREATH]
    state[sv.HAND_X], state[sv.HAND_Y], state[sv.HAND_DEPTH] = p[X], p[Y], p[DEPTH]
    state[sv.HAND_HOLDS], state[sv.ASSISTANCE] = 1.0, p[DIAL] if p[STILL] == 0.0 else 0.0
    state[sv.PATH_X], state[sv.PATH_Y], state[sv.PATH_Z] = p[PATH], p[PATH + 1], p[PATH + 2]


@stage
def note(state: FloatArray, p: FloatArray) -> None:
    """Note the largest force and torque, ticks with anything that is no finite number, faults."""
    felt = np.sqrt(state[sv.FELT_X] ** 2 + state[sv.FELT_Y] ** 2 + state[sv.FELT_Z] ** 2)
    total = 0.0
    for value in state:
        total += value
    p[TICKS] += 1.0
    if not np.isfinite(total + felt):
        p[BROKEN] += 1.0
        return
    p[MOST_FORCE] = max(p[MOST_FORCE], felt, state[sv.FELT_MOST])
    p[MOST_TORQUE] = max(p[MOST_TORQUE], abs(state[sv.TORQUE_LEFT]), abs(state[sv.TORQUE_RIGHT]))
    p[UNDER_FORCE] += 1.0 if felt > 0.05 else 0.0
    p[AXIAL] = max(p[AXIAL], abs(state[sv.AXIAL_FORCE]))
    p[FAULTS] += 1.0 if state[sv.FAULT] != 0.0 else 0.0


def layered_effects() -> list[str]:
    """Return the effects that need no field of tissue: the soak's scenes have layers."""
    return [name for name in effect_names() if "field" not in declaration(name).needs]


@dataclass(frozen=True)
class Found:
    """What a soak found; times are simulated but for those that say so.

    Attributes:
        seconds: of motion; `scenes` that were played in it, and the `effects` with their models.
        most_force: felt, or that could be felt [N]; `most_torque` [N·m]; `most_axial` [N].
        broken: ticks in which anything was no finite number; `faults` with a fault.
        under_force: share of the ticks in which the hand felt more than 50 mN.
        grown: memory of the process from a tenth of the way to its end [bytes].
        idle: slowest of the last five of ten idle minutes over the first second, as processor time.
        subnormal: numbers in state and memories that are too small to be cheap.
        cost: real time of a tick in motion [s].
    """

    seconds: float
    scenes: int
    effects: frozenset[str]
    most_force: float
    most_torque: float
    most_axial: float
    broken: int
    faults: int
    under_force: float
    grown: int
    idle: float
    subnormal: int
    cost: float


@dataclass
class Soak:
    """The loop and what is played in it; one seed is one course of events."""

    seed: int = 1
    scenes: int = 0
    played: set[str] = field(default_factory=set)

    def __post_init__(self) -> None:
        self.rng = np.random.default_rng(self.seed)
        self.hand = np.zeros(PATH + 3)
        self.hand[SEED] = 12345.0 + self.seed
        self.noted = np.zeros(7)
        axis, depth = (0.0, 0.0, -1.0), -0.015
        plant = plant_stage(PROFILE, axis, depth)
        robot = simulated_link(PROFILE, [plant, Stage("note", note, self.noted)])
        # First of the tick, where the inputs have just been taken.
        self.link = Link((Stage("wander", wander, self.hand), *robot.read), robot.write)
        start = initial_plant(PROFILE, axis, depth)
        self.clock = VirtualClock(10.0)
        self.loop = Loop(self._scene(), PROFILE.rate_hz, self.clock, initial=start)
        self.loop.open()

    def close(self) -> None:
        """End the loop."""
        self.loop.close()

    def _plan(self) -> SimulationPlan:
        names = layered_effects()
        chosen = [name for name in names if self.rng.uniform() < 0.7] or [names[0]]
        requests = []
        for name in chosen:
            models = list(declaration(name).models)
            model = models[self.rng.integers(len(models))]
            requests.append(EffectRequest(name, model=model))
            self.played.add(f"{name} {model}")
        plan = compile(whole_scene(requests, BONE), DEVICE, (EVERYTHING,))
        assert plan.dropped == (), "the soak's scene must have what every effect needs"
        return plan

    def _scene(self) -> Table:
        self.scenes += 1
        plan = self._plan()
        wanted = {"fixture": {}} | ({"cone_wall": {}} if self.rng.uniform() < 0.5 else {})
        bound = laws.energy_bound(wanted, PROFILE) + plan.energy_bound()
        return machine_stages(
            PROFILE, laws.stages_of(wanted, PROFILE), plan.stages(), self.link, energy_bound=bound
        )

    def next_scene(self) -> None:
        """Go on with another scene from the next tick on; robot, hand and velocity go on."""
        fresh = self._scene()
        changed = {"guard", *laws.law_names(), *effect_names()}
        table, _ = self.loop.table.continued(fresh, changed)
        self.loop.exchange(table)

    def move(self, seconds: float) -> None:
        """Wander for a while, a scene every 5 s."""
        ticks = round(SCENE_LASTS * self.loop.rate_hz)
        for _ in range(round(seconds / SCENE_LASTS)):
            self.next_scene()
            self.loop.step(ticks)

    def rest(self, minutes: float = 10.0) -> float:
        """Let the hand rest; cost of a tick in the last seconds over that in the first second."""
        self.hand[STILL] = 1.0
        second = round(self.loop.rate_hz)

        def cost() -> float:
            start = time.thread_time()
            self.loop.step(second)
            return time.thread_time() - start

        first = min(cost() for _ in range(3))
        self.loop.step(round(60.0 * minutes * second) - 8 * second)
        last = min(cost() for _ in range(5))
        self.hand[STILL] = 0.0
        return last / first

    def subnormal(self) -> int:
        """Count the numbers in state and memories that are not zero and too small."""
        arrays = [stage.parameters for stage in self.loop.table]
        numbers = np.concatenate([self.loop.latest().row, *arrays])
        return int(((numbers != 0.0) & (np.abs(numbers) < _TINY)).sum())


def resident() -> int:
    """Memory that the process has [bytes]."""
    pages = int(Path("/proc/self/statm").read_text(encoding="ascii").split()[1])
    return pages * 4096


def soak(seconds: float, seed: int = 1, idle_minutes: float = 10.0) -> Found:
    """Wander for `seconds`, then rest; see the module."""
    run = Soak(seed)
    try:
        run.move(0.1 * seconds)
        before, start = resident(), time.thread_time()
        run.move(0.9 * seconds)
        cost, grown = time.thread_time() - start, resident() - before
        noted = run.noted.copy()
        idle, subnormal = run.rest(idle_minutes), run.subnormal()
    finally:
        run.close()
    noted[BROKEN] = run.noted[BROKEN]
    noted[MOST_FORCE] = run.noted[MOST_FORCE]
    return Found(
        seconds=seconds,
        scenes=run.scenes,
        effects=frozenset(run.played),
        most_force=float(noted[MOST_FORCE]),
        most_torque=float(noted[MOST_TORQUE]),
        most_axial=float(noted[AXIAL]),
        broken=int(noted[BROKEN]),
        faults=int(noted[FAULTS]),
        under_force=float(noted[UNDER_FORCE] / noted[TICKS]),
        grown=grown,
        idle=idle,
        subnormal=subnormal,
        cost=cost / (0.9 * seconds * PROFILE.rate_hz),
    )
