"""One tick of the force path, compiled, through the loop's table, at poses over the workspace.

Exactly: forward, Jacobian, needle (kinematics), fixture, force and torque (transmission), safety.
The peer in the same run is the same tick written with this project's numpy functions; the
laboratory's C++ takes 0.57 µs for forward, force and torque without fixture damping or safety.
Then the whole tick of a loop, with governor, guard, estimator and record (`whole_tick`).

Run as `python -m tests.bench.bench_tick`.
"""

from collections.abc import Callable
from time import perf_counter

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray, angle_between
from app.device.control import kernel, stage_cost
from app.device.control.kinematics import Kinematics
from app.device.control.safety import Safety
from app.device.control.transmission import Transmission
from app.mechanisms import pantograph
from app.mechanisms.profile import load_profile
from tests.bench import whole_tick
from tests.virtual_fixture import VirtualFixture

LIMIT_US = 1.0
POSES = 200
CALLS = 500  # a quarter of a millisecond: short beside the slices of a busy machine
CHUNKS = 20
PROFILE = load_profile("icube")
GEOMETRY = PROFILE.pantograph


def states() -> list[FloatArray]:
    """Armed states at random tilts up to the limit, moving, with a path 10° away."""
    rng = np.random.default_rng(1)
    rows = []
    for _ in range(POSES):
        tilt, azimuth = rng.uniform(0.0, PROFILE.tilt_limit), rng.uniform(-np.pi, np.pi)
        reach = GEOMETRY.fulcrum[2] * np.tan(tilt) * np.array([np.cos(azimuth), np.sin(azimuth)])
        state = sv.empty_state()
        state[sv.Q] = pantograph.inverse(GEOMETRY, GEOMETRY.fulcrum[:2] + reach)
        state[[sv.QD_LEFT, sv.QD_RIGHT]] = rng.uniform(-0.5, 0.5, 2)
        state[[sv.ENABLED, sv.ASSISTANCE, sv.ARMING, sv.HOMED]] = 1.0
        state[sv.FORCE_CAP] = PROFILE.limits.hand_force
        state[[sv.PATH_X, sv.PATH_Z]] = np.sin(0.17), -np.cos(0.17)
        state[[sv.TIME, sv.Q_TIME, sv.HEARTBEAT, sv.TRACKED_TIME]] = 5.0
        state[sv.TRACKED_DEPTH], state[sv.DT] = 0.06, 1e-3
        rows.append(state)
    return rows


def numpy_tick(q: FloatArray, path: FloatArray) -> FloatArray:
    """Compute the same tick with numpy arrays and Python floats."""
    needle = pantograph.system_forward(GEOMETRY, q, 0.14)
    jacobian = pantograph.jacobian(GEOMETRY, q)
    across = path - needle.axis * np.dot(path, needle.axis)
    force = -PROFILE.fixture.stiffness * angle_between(path, needle.axis) * across
    force *= min(1.0, PROFILE.limits.hand_force / max(float(np.linalg.norm(force)), 1e-12))
    torques = pantograph.joint_torques(jacobian, pantograph.force_map(needle, force))
    largest = float(np.abs(torques).max())
    torques *= min(1.0, PROFILE.limits.joint_torque / max(largest, 1e-12))
    return torques if np.isfinite(torques).all() else np.zeros(2)


def seconds(call: Callable[[], object]) -> float:
    """Time of one call."""
    start = perf_counter()
    call()
    return perf_counter() - start


def main() -> None:
    """Print the cost of a tick, of its stages, and of the numpy tick."""
    stages = [
        PROFILE.machine.stages().pose,
        Kinematics.of(PROFILE).stage(),
        VirtualFixture.of(PROFILE).stage(),
        Transmission.of(PROFILE).stage(),
        Safety.of(PROFILE).stage(),
    ]
    functions, parameters = kernel.no_stages(), kernel.no_parameters()
    for _, function, values in stages:
        kernel.append(functions, parameters, function, values)
    rows = states()
    kernel.repeat(rows[0].copy(), functions, parameters, CALLS)
    compiled = []
    for row in rows:
        state = row.copy()
        kernel.repeat(state, functions, parameters, CALLS)
        for _ in range(CHUNKS):
            start = perf_counter()
            kernel.repeat(state, functions, parameters, CALLS)
            compiled.append((perf_counter() - start) / CALLS)
    path = rows[0][sv.PATH]
    for row in rows[:20]:
        numpy_tick(row[sv.Q], path)
    peer = [seconds(lambda row=row: numpy_tick(row[sv.Q], path)) for row in rows]
    ours_us, p99_us = np.percentile(compiled, (50, 99)) * 1e6
    peer_us, peer_p99_us = np.percentile(peer, (50, 99)) * 1e6
    print(f"{'':28}{'median':>10}{'p99':>10}   [µs], {POSES} poses, {CHUNKS} x {CALLS} ticks each")
    print(f"{'tick, compiled table':28}{ours_us:10.3f}{p99_us:10.3f}")
    print(f"{'tick, numpy':28}{peer_us:10.1f}{peer_p99_us:10.1f}")
    for name, function, values in stages:
        print(f"  {name:26}{stage_cost(function, values, state) * 1e6:10.3f}")
    verdict = "reached" if ours_us <= LIMIT_US else "NOT reached"
    print(
        f"to reach: at most {LIMIT_US} µs compiled: {verdict};"
        f" numpy/compiled {peer_us / ours_us:.0f}x"
    )
    whole_tick.main(PROFILE)


if __name__ == "__main__":
    main()
