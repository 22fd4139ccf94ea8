"""`python -m tests.fuzz [COUNT [SEED [NUMBER]]]`: mutated files through the readers (`make fuzz`).

With a number only that file is made and read again.
"""

import os
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from itertools import pairwise
from multiprocessing import get_context
from pathlib import Path

from tests.fuzz.campaign import MOST_CHILD_BYTES, MOST_SECONDS, Tally
from tests.fuzz.share import share

MOST_PROCESSES = 4


def main() -> None:
    """Run a campaign and end with an error if a file broke the rule."""
    count = int(sys.argv[1]) if len(sys.argv) > 1 else 10_000
    seed = int(sys.argv[2]) if len(sys.argv) > 2 else int(time.time())
    only = int(sys.argv[3]) if len(sys.argv) > 3 else None
    shares = _shares(count) if only is None else [range(only, only + 1)]
    print(f"{count} mutated files, seed {seed}, {len(shares)} processes", flush=True)
    begin, tally = time.monotonic(), Tally()
    with (
        tempfile.TemporaryDirectory(prefix="acus-fuzz-") as folder,
        ProcessPoolExecutor(len(shares), get_context("spawn")) as processes,
    ):
        jobs = [
            processes.submit(share, Path(folder, str(place)), count, seed, numbers, place == 0)
            for place, numbers in enumerate(shares)
        ]
        for job in jobs:
            tally.add(job.result())
    _print(tally, time.monotonic() - begin)
    sys.exit(bool(tally.wrong) or tally.child_bytes > MOST_CHILD_BYTES)


def _shares(count: int) -> list[range]:
    processes = max(1, min(MOST_PROCESSES, os.cpu_count() or 1, count // 100))
    ends = [count * place // processes for place in range(processes + 1)]
    return [range(*pair) for pair in pairwise(ends)]


def _print(tally: Tally, took: float) -> None:
    for outcome, times in tally.outcomes.most_common():
        print(f"  {outcome:24} {times}")
    print(f"  children lost            {len(tally.lost)}")
    for text in tally.lost:
        print(f"    {text}")
    print(f"  most processor time (each file: {MOST_SECONDS} s at most), time on the clock:")
    for processor, waited, name in tally.slow:
        print(f"    {processor:5.2f} s {waited:5.2f} s  {name}")
    print(f"  longest on the clock     {tally.waited_s:.2f} s, with load {os.getloadavg()[0]:.1f}")
    print(f"  most memory              {tally.child_bytes >> 20} MB a child, ", end="")
    print(f"{tally.own_bytes >> 20} MB the program")
    for text in tally.wrong:
        print(f"  WRONG {text}")
    print(f"  took {took:.0f} s")


if __name__ == "__main__":
    main()
