"""`python -m tests.soak [--minutes 60] [--seed 1]`: an hour of random motion, accelerated.

Prints what it found. Exit code 0: nothing was broken, no force beyond 5 N, no memory grown, ten
idle minutes within 1.5 times the first second; 3: something was not so.
"""

from __future__ import annotations

import argparse
import sys
import time

from tests.soak.soak import soak

MOST_FORCE, MOST_GROWN, MOST_IDLE = 5.0, 8 << 20, 1.5


def main() -> int:
    """Soak, and tell."""
    parser = argparse.ArgumentParser(prog="python -m tests.soak", description=__doc__)
    parser.add_argument("--minutes", type=float, default=60.0)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    start = time.monotonic()
    found = soak(60.0 * options.minutes, options.seed)
    taken = time.monotonic() - start
    print(f"{found.seconds / 60.0:g} minutes in {found.scenes} scenes, {taken:.0f} s of real time")
    print(f"effects with their models: {', '.join(sorted(found.effects))}")
    print(f"a tick: {1e6 * found.cost:.2f} µs; the hand feels something in {found.under_force:.0%}")
    print(f"largest torque {found.most_torque:.3f} N·m; along the needle {found.most_axial:.2f} N")
    verdicts = {
        f"largest force {found.most_force:.6f} N": found.most_force <= MOST_FORCE + 1e-9,
        f"ticks with what is no number {found.broken}": found.broken == 0,
        f"ticks with a fault {found.faults}": True,
        f"memory grown by {found.grown / 2**20:.1f} MiB": found.grown <= MOST_GROWN,
        f"ten idle minutes: {found.idle:.2f} of the first second": found.idle <= MOST_IDLE,
        f"subnormal numbers {found.subnormal}": found.subnormal == 0,
    }
    for words, holds in verdicts.items():
        print(f"{'ok' if holds else 'NO'}  {words}")
    return 0 if all(verdicts.values()) else 3


if __name__ == "__main__":
    sys.exit(main())
