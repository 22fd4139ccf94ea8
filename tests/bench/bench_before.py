"""The whole tick of this tree against that of another one, in turns, in one run.

`git worktree add ../before COMMIT`, then `python -m tests.bench.bench_before ../before`: both run
`whole_tick` (velocity, kinematics, impedance, compensation, tissue, governor, guard, safety and
record) and a lighter one with the fixture alone, each in a process of its own, one after the other,
so that a busy machine is busy for both; counted is the time of the processor.
"""

import subprocess
import sys
from pathlib import Path

import numpy as np

ROUNDS = 5
SCRIPT = """
import re, sys
from time import thread_time
import numpy as np
from app.mechanisms.profile import load_profile
from tests.bench import whole_tick
if {light}:
    whole_tick.requests = lambda: {{"fixture": {{}}}}
profile = load_profile("icube")
loop, costs, limits = whole_tick.build(profile), [], profile.limits
loop.inbox.write(assistance=1.0, path_z=-1.0, homed=1.0, force_cap=limits.hand_force)
with loop:
    loop.inbox.write(enabled=1.0)
    for _ in range(400):
        now = loop.clock.now()
        loop.inbox.write(heartbeat=now, tracked_depth=0.06, tracked_time=now)
        start = thread_time()
        loop.step(300)
        costs.append((thread_time() - start) / 300 * 1e6)
print(float(np.median(costs[20:])))
"""


def tick_us(tree: Path, light: bool) -> float:
    """Median time of a tick in a tree [µs]."""
    command = [sys.executable, "-c", SCRIPT.format(light=light)]
    done = subprocess.run(command, cwd=tree, capture_output=True, text=True, check=True)
    return float(done.stdout.splitlines()[-1])


def main(before: Path) -> None:
    """Print both and their ratio."""
    for name, light in (("impedance, compensation", False), ("fixture alone", True)):
        pairs = [(tick_us(before, light), tick_us(Path.cwd(), light)) for _ in range(ROUNDS)]
        old, new = np.array(pairs).T
        ratio = new / old
        print(
            f"{name:26} before {np.median(old):.3f} µs, now {np.median(new):.3f} µs,"
            f" ratio {np.median(ratio):.3f} (quartiles {np.percentile(ratio, 25):.3f} to"
            f" {np.percentile(ratio, 75):.3f}, least {old.min():.3f} and {new.min():.3f} µs)"
        )


if __name__ == "__main__":
    main(Path(sys.argv[1]))
