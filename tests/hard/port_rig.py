"""A hand that turns the joints however it likes, and the energy that leaves them, both compiled."""

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import VirtualClock
from app.core.compiled import njit, stage
from app.device.control import Loop, Table, laws, machine_stages
from app.device.links import Link
from app.mechanisms.pantograph import inverse
from app.mechanisms.profile import load_profile
from app.simulation.consumers import DevicePort
from app.simulation.plan import compile
from app.simulation.scene import EffectRequest, Scene

PROFILE = load_profile("icube")
FASTEST = 20.0  # rad/s, what the guard is told
LONGEST = 16  # ticks of one motion

# Parameters: generator; kind and rest of the motion; angles; home; largest way from it; amount of
# the motion; work; its least; largest rise of it in any window while armed; motions; whether armed.
SEED, KIND, LEFT_OVER, Q1, Q2, HOME1, HOME2, WAY, A, B, C = range(11)
WORK, LEAST, RISE, MOTIONS, ARMED, COUNT, COULOMB, VISCOUS = range(11, 19)
READ1, READ2, SIZE = range(19, 22)


@njit
def draw(p: FloatArray) -> float:
    """Next number in [0, 1)."""
    p[SEED] = (p[SEED] * 16807.0) % 2147483647.0
    return p[SEED] / 2147483647.0


@njit
def _begin(p: FloatArray) -> None:
    p[KIND] = np.floor(7.0 * draw(p))
    p[LEFT_OVER] = 1.0 + np.floor(LONGEST * draw(p))
    scale = FASTEST * 10.0 ** (-3.0 * draw(p))
    p[A], p[B] = scale * (2.0 * draw(p) - 1.0), scale * (2.0 * draw(p) - 1.0)
    p[C] = 0.2 + draw(p)
    p[MOTIONS] += 1.0


@njit
def _speeds(p: FloatArray, t1: float, t2: float) -> tuple[float, float]:
    kind = p[KIND]
    if kind == 0.0:  # rest
        return 0.0, 0.0
    if kind == 1.0:  # steady
        return p[A], p[B]
    if kind == 2.0:  # smooth
        swing = np.sin(p[C] * p[LEFT_OVER])
        return p[A] * swing, p[B] * swing
    if kind == 3.0:  # jerks
        return p[A] * (2.0 * draw(p) - 1.0), p[B] * (2.0 * draw(p) - 1.0)
    size = abs(p[A]) if kind < 6.0 else FASTEST
    sign = -1.0 if kind == 4.0 else 1.0  # 4 loads the springs, 5 and 6 take all there is
    return sign * size * np.sign(t1), sign * size * np.sign(t2)


@stage
def any_hand(state: FloatArray, p: FloatArray) -> None:
    """Turn the encoders, and measure what the torques held since the last tick have let out."""
    if p[LEFT_OVER] <= 0.0:
        _begin(p)
    p[LEFT_OVER] -= 1.0
    t1, t2 = state[sv.TORQUE_LEFT], state[sv.TORQUE_RIGHT]
    v1, v2 = _speeds(p, t1, t2)
    dt = state[sv.DT]
    q1 = min(max(p[Q1] + v1 * dt, p[HOME1] - p[WAY]), p[HOME1] + p[WAY])
    q2 = min(max(p[Q2] + v2 * dt, p[HOME2] - p[WAY]), p[HOME2] + p[WAY])
    p[Q1], p[Q2] = q1, q2
    if p[COUNT] > 0.0:
        q1, q2 = np.floor(q1 / p[COUNT]) * p[COUNT], np.floor(q2 / p[COUNT]) * p[COUNT]
    if state[sv.TICK] > 1.0 and p[ARMED] > 0.5:
        left, right = q1 - p[READ1], q2 - p[READ2]
        taken = p[COULOMB] * (abs(left) + abs(right))
        taken += p[VISCOUS] * (left * left + right * right) / max(dt, 1e-3)
        work = t1 * left + t2 * right
        p[WORK] += work - min(max(work, 0.0), taken)
        p[LEAST] = min(p[LEAST], p[WORK])
        p[RISE] = max(p[RISE], p[WORK] - p[LEAST])
    if state[sv.ENABLED] > 0.5 and p[ARMED] < 0.5:  # armed anew: a new account
        p[WORK] = p[LEAST] = 0.0
    p[ARMED] = state[sv.ENABLED]
    p[READ1], p[READ2] = q1, q2
    state[sv.Q_LEFT], state[sv.Q_RIGHT], state[sv.Q_TIME] = q1, q2, state[sv.TIME]


@stage
def a_tick_late(state: FloatArray, p: FloatArray) -> None:
    """Readings as a wire brings them: those of the tick before."""
    q1, q2, time = state[sv.Q_LEFT], state[sv.Q_RIGHT], state[sv.Q_TIME]
    if p[2] > 0.0:
        state[sv.Q_LEFT], state[sv.Q_RIGHT], state[sv.Q_TIME] = p[0], p[1], p[2]
    p[0], p[1], p[2] = q1, q2, time


class PortRig:
    """The real tick, guard and all, between a wild hand and motors that cannot be seen.

    The speed governor is left out: it ends the force at the first wild motion.

    Args:
        seed: of the hand.
        requests: force laws.
        guarded: with the guard.
        bound: the declared energy [J]; by default what laws and tissue declare.
        counts: with whole encoder counts.
        late: with readings that come a tick late, as over a wire.
    """

    def __init__(
        self,
        seed: int = 1,
        requests: laws.Requests | None = None,
        guarded: bool = True,
        bound: float | None = None,
        counts: bool = True,
        extra: list | None = None,
        late: bool = False,
    ) -> None:
        requests = {"fixture": {}} if requests is None else requests
        port = DevicePort(PROFILE.name, frozenset(a.value for a in PROFILE.renders), True)
        plan = compile(Scene(effects=(EffectRequest("lateral_tissue"),)), port)
        if bound is None:
            bound = laws.energy_bound(requests, PROFILE) + plan.energy_bound()
        self.bound = bound
        self.hand = np.zeros(SIZE)
        home = inverse(PROFILE.pantograph, PROFILE.fulcrum[:2])
        self.hand[[SEED, WAY]] = 12345.0 + seed, 0.35
        self.hand[[Q1, Q2]] = self.hand[[HOME1, HOME2]] = home
        if "compensation" in requests:  # what the joints' own friction takes is no energy let out
            self.hand[[COULOMB, VISCOUS]] = PROFILE.friction.coulomb, PROFILE.friction.viscous
        if counts:
            self.hand[COUNT] = 2.0 * np.pi / PROFILE.encoder.counts_per_turn
        wire = [("wire", a_tick_late, np.zeros(3))] if late else []
        table = machine_stages(
            PROFILE,
            laws.stages_of(requests, PROFILE),
            [*plan.stages(), *(extra or [])],
            Link.of([("hand", any_hand, self.hand), *wire], []),
            energy_bound=bound if guarded else None,
        )
        stages = [s for s in table.compute if s.name != "governor"]
        self.clock = VirtualClock(10.0)
        self.loop = Loop(Table.of(stages), PROFILE.rate_hz, self.clock)
        self.loop.inbox.write(
            homed=1.0, force_cap=PROFILE.limits.hand_force, assistance=1.0, path_z=-1.0
        )

    def step(self, ticks: int, depth: float) -> None:
        """Tick, with window and cameras alive."""
        now = self.clock.now()
        self.loop.inbox.write(heartbeat=now, tracked_depth=depth, tracked_time=now)
        self.loop.step(ticks)
