"""Everything that a tick does: inputs, velocity by FOAW, kinematics, force laws, tissue,
transmission, speed governor, passivity guard, safety, and the row of the record.
"""

from time import perf_counter

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import VirtualClock
from app.core.compiled import stage
from app.device.control import Loop, laws, machine_stages, stage_cost
from app.device.control.velocity import VelocityMethod
from app.device.links import Link
from app.mechanisms.pantograph import inverse
from app.mechanisms.profile import DeviceProfile
from app.simulation.consumers import DevicePort
from app.simulation.plan import compile
from app.simulation.scene import EffectRequest, Scene

LIMIT_US = 3.0
CALLS = 300
CHUNKS = 400


@stage
def slow_hand(state: FloatArray, p: FloatArray) -> None:
    """Encoders, in whole counts, of a hand that goes to and fro."""
    p[3] += 0.2 * state[sv.DT] * p[4]
    if abs(p[3]) > 0.1:
        p[4] = -p[4]
    state[sv.Q_LEFT] = p[0] + np.floor(p[3] / p[2]) * p[2]
    state[sv.Q_RIGHT] = p[1] + np.floor(0.7 * p[3] / p[2]) * p[2]
    state[sv.Q_TIME] = state[sv.TIME]


def requests() -> dict[str, dict[str, float]]:
    """Return impedance control on the dynamic model, with gravity and friction made up for."""
    return {"impedance": {}, "compensation": {}}


def build(profile: DeviceProfile) -> Loop:
    """Build the whole tick on a virtual clock."""
    q = inverse(profile.pantograph, profile.fulcrum[:2] + np.array([0.02, 0.015]))
    count = 2.0 * np.pi / profile.encoder.counts_per_turn
    link = Link.of([("hand", slow_hand, np.array([*q, count, 0.0, 1.0]))], [])
    port = DevicePort(profile.name, frozenset(a.value for a in profile.renders), True)
    plan = compile(Scene(effects=(EffectRequest("lateral_tissue"),)), port)
    bound = laws.energy_bound(requests(), profile) + plan.energy_bound()
    forces = laws.stages_of(requests(), profile)
    table = machine_stages(
        profile, forces, plan.stages(), link, velocity=VelocityMethod.FOAW, energy_bound=bound
    )
    return Loop(table, profile.rate_hz, VirtualClock(10.0))


def main(profile: DeviceProfile) -> None:
    """Print the cost of the whole tick with its record, and of each stage."""
    loop, costs = build(profile), []
    limits = profile.limits
    loop.inbox.write(assistance=1.0, path_z=-1.0, homed=1.0, force_cap=limits.hand_force)
    with loop:
        loop.inbox.write(enabled=1.0)
        for _ in range(CHUNKS):
            now = loop.clock.now()
            loop.inbox.write(heartbeat=now, tracked_depth=0.06, tracked_time=now)
            start = perf_counter()
            loop.step(CALLS)
            costs.append((perf_counter() - start) / CALLS * 1e6)
        row = loop.latest().row
        for item in loop.table:
            print(f"  {item.name:26}{stage_cost(item.function, item.parameters, row) * 1e6:10.3f}")
    median, p99 = np.percentile(costs[20:], (50, 99))
    felt = np.linalg.norm(row[sv.FELT])
    verdict = "reached" if median <= LIMIT_US else "NOT reached"
    print(f"{'whole tick, recorded':28}{median:10.3f}{p99:10.3f}   felt {felt:.2f} N")
    print(f"to reach: at most {LIMIT_US} µs with {', '.join(requests())}, guard, FOAW: {verdict}")
