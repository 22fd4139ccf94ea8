"""The whole tick of the needle holder, tensions included, pulling and holding: at most 5 µs.

Velocity, pose, watch, kinematics, laws, transmission, governor, guard, safety, tensions and the row
of the record. The simulated machine runs until it holds or is led, then the tick is timed without
it, as on a wire. Counted is the time of the processor. Run as `python -m tests.bench.bench_holder`.
"""

from time import thread_time

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.core.clock import VirtualClock
from app.core.compiled import stage
from app.core.parameters import Stage
from app.device.control import Loop, Table, laws, machine_stages, stage_cost
from app.device.links.simulated import simulated_link
from app.mechanisms.profile import load_profile
from app.simulation.plant import initial_plant, plant_stage

LIMIT_US = 5.0
CALLS, CHUNKS = 100, 600


@stage
def read_now(state: FloatArray, p: FloatArray) -> None:
    """Encoders that are read in every tick and stand."""
    state[sv.Q_TIME] = state[sv.TIME]


def run(loop: Loop, chunks: int, enabled: float = 1.0) -> float:
    """Run some ticks; time of one [µs], of the last chunk."""
    for _ in range(chunks):
        now = loop.clock.now()
        loop.inbox.write(heartbeat=now, tracked_depth=0.02, tracked_time=now, enabled=enabled)
        start = thread_time()
        loop.step(CALLS)
    return (thread_time() - start) / CALLS * 1e6


def main() -> None:
    """Print both ways."""
    profile = load_profile("tensegrity")
    for requests in ({"fixture": {}}, {"fixture": {}, "compensation": {}}, {"hold_direction": {}}):
        plant = plant_stage(profile)
        table = machine_stages(
            profile,
            laws.stages_of(requests, profile),
            [],
            simulated_link(profile, [plant]),
            energy_bound=laws.energy_bound(requests, profile),
        )
        initial = initial_plant(profile, (0.0, 0.0, -1.0), 0.02)
        loop, costs = Loop(table, profile.rate_hz, VirtualClock(10.0), initial=initial), []
        loop.inbox.write(
            assistance=1.0, path_x=0.2, path_z=-0.98, homed=1.0, hand_depth=0.02, hand_holds=1.0,
            force_cap=profile.limits.hand_force,
        )  # fmt: skip
        with loop:
            run(loop, 40)
        kept = [item for item in table if item.name not in ("plant", "encoders", "gauges")]
        loop.swap(Table.of([Stage("encoders", read_now, np.zeros(1)), *kept]))
        with loop:
            for k in range(CHUNKS):
                costs.append(run(loop, 1, enabled=float(k > 3)))
            row = loop.latest().row
            known = {
                item.name: stage_cost(item.function, item.parameters, row) * 1e6 for item in table
            }
        median, p99 = np.percentile(costs[20:], (50, 99))
        verdict = "reached" if p99 <= LIMIT_US else "NOT reached"
        print(f"{', '.join(requests):24} median {median:.2f} µs, p99 {p99:.2f} µs ({verdict}),")
        print("   " + ", ".join(f"{name} {cost:.2f}" for name, cost in known.items()))
        print(f"   fault {row[sv.FAULT]:.0f}, holding {row[sv.HOLDING]:.0f}")


if __name__ == "__main__":
    main()
