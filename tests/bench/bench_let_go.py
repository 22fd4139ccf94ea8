"""One tick of the speed governor, beside the fixed 0.25 m/s that stood in its place before.

Held still at random poses under a force, with a full window of readings; both in the same run, one
after the other at each pose. Then the largest force that either lets through, needle upright, tip
20 mm outside the skin, beside what the motors' torque alone gives; `acus study let_go` has more.

Run as `python -m tests.bench.bench_let_go`.
"""

from math import pi

import numpy as np

from app.core import state_vector as sv
from app.core.arrays import FloatArray
from app.device.control import stage_cost
from app.device.control.governor import SpeedGovernor
from app.mechanisms.pantograph import inverse, jacobian, needle_at
from app.mechanisms.profile import DeviceProfile, load_profile
from app.studies.releasing.before import fixed_speed
from app.studies.releasing.device import Rule, release, upright

POSES = 25
TICKS = 30
PROFILES = ("icube", "haply-2diy")


def pose(profile: DeviceProfile, rng: np.random.Generator) -> FloatArray:
    """State of a needle that is held at a random tilt, under torque."""
    geometry, state = profile.pantograph, sv.empty_state()
    tilt, azimuth = rng.uniform(0.0, profile.tilt_limit), rng.uniform(-np.pi, np.pi)
    reach = geometry.fulcrum[2] * np.tan(tilt) * np.array([np.cos(azimuth), np.sin(azimuth)])
    needle = needle_at(geometry, geometry.fulcrum[:2] + reach)
    q = inverse(geometry, needle.p3)
    state[[sv.Q_LEFT, sv.Q_RIGHT]], state[[sv.P3_X, sv.P3_Y]] = q, needle.p3
    state[[sv.J_XL, sv.J_XR, sv.J_YL, sv.J_YR]] = jacobian(geometry, q).ravel()
    state[sv.AXIS], state[sv.L_IN], state[sv.L_OUT] = needle.axis, needle.l_in, 0.15
    state[sv.DEPTH] = geometry.needle_length - 0.15
    state[[sv.DEPTH_LEAST, sv.DEPTH_MOST]] = state[sv.DEPTH] + np.array([-0.005, 0.005])
    state[[sv.ENABLED, sv.DEPTH_SOURCE]], state[sv.DT] = 1.0, 1e-3
    stage = profile.machine.stages().pose
    stage.function(state, stage.parameters)
    return state


def cost(stage: tuple[str, object, FloatArray], state: FloatArray, count: float) -> float:
    """Time of one call [s], with a window of readings that flicker by a count."""
    _, function, memory = stage
    state = state.copy()
    for k in range(TICKS):
        state[sv.TIME] = state[sv.Q_TIME] = 1.0 + 1e-3 * k
        state[[sv.TORQUE_LEFT, sv.TORQUE_RIGHT]] = 0.05, -0.03
        state[sv.Q_LEFT] += count * (-1) ** k
        function(state, memory)
        state[[sv.SENT_LEFT, sv.SENT_RIGHT]] = state[[sv.TORQUE_LEFT, sv.TORQUE_RIGHT]]
    state[[sv.TORQUE_LEFT, sv.TORQUE_RIGHT]] = 0.05, -0.03
    return stage_cost(function, memory, state)


def main() -> None:
    """Print cost and force of both governors, and their ratios."""
    rng = np.random.default_rng(0)
    for name in PROFILES:
        profile = load_profile(name)
        count = 2.0 * pi / profile.encoder.counts_per_turn
        pairs = np.array(
            [
                (
                    cost(fixed_speed(profile), at, count),
                    cost(SpeedGovernor.of(profile).stage(), at, count),
                )
                for at in (pose(profile, rng) for _ in range(POSES))
            ]
        )
        before, now = np.median(pairs, axis=0)
        ratio = np.median(pairs[:, 1] / pairs[:, 0])
        print(f"{name:12}tick {before * 1e9:6.0f} -> {now * 1e9:6.0f} ns{ratio:8.2f}x")
        felt = {
            rule: np.median([release(profile, at, rule, runs=1).felt for at in upright(-0.02, 24)])
            for rule in Rule
        }
        alone, old, new = (felt[rule] for rule in Rule)
        print(
            f"{'':12}force {old:.2f} -> {new:.2f} N{new / old:7.1f}x;"
            f" {new / alone:.0%} of the {alone:.2f} N of torque alone"
        )


if __name__ == "__main__":
    main()
