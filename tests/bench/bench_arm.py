"""The arm's inverse on 10⁶ poses made of joint angles within the limits, in chunks.

All eight solutions with θ3 = 0, and the solution within limits over all arm angles: what they miss
at most, how many poses have none, and the time of each for a pose. The peer in the same run is
damped least squares from up to eight starts. Goals: 20 µs for all eight, 1e-10 m and rad, every
pose solved.

Run as `python -m tests.bench.bench_arm [POSES]`.
"""

import sys
from time import process_time

import numpy as np

from app.arm.mechanics import load_arm, starts
from app.arm.mechanics.kernels import Three, eight_kernel, forward_kernel
from app.arm.studies.arm_ik import Poses, at_random, iterate_often, posed, solve_often
from app.core.arrays import FloatArray
from app.core.compiled import njit

POSES = 1_000_000
CHUNK = 50_000
GOAL_US = 20.0
GOAL_CLOSURE = 1e-10
ARM = load_arm()


@njit(cache=False)
def eight(rotation: FloatArray, position: FloatArray, lengths: Three, out: FloatArray) -> None:
    """All eight solutions of each pose, (n, 8, 7)."""
    flags = np.empty(8, np.int64)
    for k in range(len(position)):
        if eight_kernel(rotation[k], position[k], lengths, (0.0, 0.0), out[k], flags) != 0:
            out[k] = np.nan


@njit(cache=False)
def missed(
    rotation: FloatArray, position: FloatArray, lengths: Three, q: FloatArray
) -> tuple[float, float]:
    """Largest miss of joint angles (n, m, 7) by forward kinematics [m, entry of the rotation]."""
    turn, place = np.empty((3, 3)), np.empty(3)
    shift, twist = 0.0, 0.0
    for k in range(len(position)):
        for row in q[k]:
            forward_kernel(row, lengths, turn, place)
            shift = max(shift, np.abs(place - position[k]).max())
            twist = max(twist, np.abs(turn - rotation[k]).max())
    return shift, twist


class Tally:
    """Time and misses of one way over all chunks."""

    def __init__(self) -> None:
        self.seconds = self.shift = self.twist = 0.0
        self.unsolved = 0

    def add(self, seconds: float, poses: Poses, q: FloatArray) -> None:
        """Count a chunk's answers (n, m, 7), NaN where there are none."""
        solved = np.isfinite(q).all(axis=(1, 2))
        self.seconds += seconds
        self.unsolved += int((~solved).sum())
        shift, twist = missed(
            poses.rotation[solved], poses.position[solved], ARM.lengths, q[solved]
        )
        self.shift, self.twist = max(self.shift, shift), max(self.twist, twist)

    def line(self, name: str, count: int) -> str:
        """Say it."""
        return (
            f"{name:40} {1e6 * self.seconds / count:6.2f} µs a pose, {self.unsolved} unsolved,"
            f" misses {self.shift:.1e} m, {self.twist:.1e} in the rotation"
        )


def main() -> None:
    """Print the figures of each way and whether the goals are reached."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else POSES
    limits = ARM.lengths, np.array(ARM.lower), np.array(ARM.upper)
    decoupled, redundant, peer = Tally(), Tally(), Tally()
    begin = np.resize(starts(ARM, 8), (CHUNK, 8, 7))
    warm = posed(ARM, at_random(ARM, 2))
    out = np.empty((2, 8, 7))
    eight(warm.rotation, warm.position, ARM.lengths, out)
    solve_often(warm.rotation, warm.position, *limits, out[:, 0].copy())
    iterate_often(warm.rotation, warm.position, *limits, begin[:2], out[:, 0].copy())
    done = 0
    while done < count:
        size = min(CHUNK, count - done)
        poses = posed(ARM, at_random(ARM, size, seed=100 + done))
        all_eight, one = np.empty((size, 8, 7)), np.empty((size, 7))
        start = process_time()
        eight(poses.rotation, poses.position, ARM.lengths, all_eight)
        decoupled.add(process_time() - start, poses, all_eight)
        start = process_time()
        solve_often(poses.rotation, poses.position, *limits, one)
        redundant.add(process_time() - start, poses, one[:, None])
        if done == 0:
            start = process_time()
            iterate_often(poses.rotation, poses.position, *limits, begin[:size], one)
            peer.add(process_time() - start, poses, one[:, None])
            first = size
        done += size
    print(decoupled.line("all eight with θ3 = 0", count))
    print(redundant.line("within limits, over the arm angle", count))
    print(peer.line(f"least squares, eight starts ({first} poses)", first))
    worst = max(decoupled.shift, decoupled.twist, redundant.shift, redundant.twist)
    reached = (
        1e6 * decoupled.seconds / count <= GOAL_US
        and worst <= GOAL_CLOSURE
        and decoupled.unsolved == redundant.unsolved == 0
    )
    print(
        f"goals {GOAL_US:.0f} µs, {GOAL_CLOSURE:g}, every pose solved:"
        f" {'reached' if reached else 'NOT reached'}"
    )


if __name__ == "__main__":
    main()
