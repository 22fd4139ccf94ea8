"""One tick of each velocity estimator, compiled, at rest on an edge between two counts.

Rest is the adaptive window's dearest case: its window is at its longest. The peer in the same run
is the backward difference, the thesis' own.

Run as `python -m tests.bench.bench_velocity`.
"""

from math import pi

import numpy as np

from app.core import state_vector as sv
from app.device.control import stage_cost
from app.device.control.velocity import VelocityMethod, velocity_stage
from app.mechanisms.profile import load_profile

TICKS = 200


def main() -> None:
    """Print the cost of each estimator and its ratio to the backward difference."""
    profile = load_profile("icube")
    count = 2.0 * pi / profile.encoder.counts_per_turn
    costs = {}
    for method in VelocityMethod:
        _, function, memory = velocity_stage(profile, method)
        state = sv.empty_state()
        for k in range(TICKS):
            state[sv.TIME] = state[sv.Q_TIME] = 1.0 + 1e-3 * k
            state[sv.DT], state[sv.Q_LEFT], state[sv.Q_RIGHT] = 1e-3, count * (k % 2), 0.0
            function(state, memory)
        state[sv.Q_TIME] = 0.0  # without stamps every call counts as a new reading
        costs[method] = stage_cost(function, np.array(memory), state)
    least = costs[VelocityMethod.BACKWARD_DIFFERENCE]
    for method, cost in costs.items():
        print(f"{method:22}{cost * 1e9:8.0f} ns{cost / least:8.1f}x")


if __name__ == "__main__":
    main()
