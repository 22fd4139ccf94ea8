"""`acus --help`, in turn with an empty interpreter and with the help drawn by rich, as before.

Each run is a process of its own.
"""

import os
import statistics
import subprocess
import sys
import time

LIMIT_S = 0.25
RUNS = 20
WAYS = {
    "interpreter alone": ["-c", "pass"],
    "acus --help": ["-m", "app", "--help"],
    "the same drawn by rich": [
        "-c",
        "from app.commands import build; root = build(); root.rich_markup_mode = 'markdown';"
        "root(['--help'], prog_name='acus')",
    ],
}


def one_run(arguments: list[str]) -> float:
    """Time from the start of a process to its end [s]."""
    began = time.perf_counter()
    subprocess.run(
        [sys.executable, *arguments], env=os.environ, stdout=subprocess.DEVNULL, check=True
    )
    return time.perf_counter() - began


def main() -> None:
    """Print median and range of each way, all taken in turn."""
    for arguments in WAYS.values():
        one_run(arguments)
    times = {name: [] for name in WAYS}
    for _ in range(RUNS):
        for name, arguments in WAYS.items():
            times[name].append(one_run(arguments))
    for name, taken in times.items():
        print(
            f"{name:24} median {statistics.median(taken):.3f} s "
            f"(min {min(taken):.3f}, max {max(taken):.3f})"
        )
    median = statistics.median(times["acus --help"])
    print(f"to reach {LIMIT_S:g} s: {'reached' if median <= LIMIT_S else 'NOT reached'}")


if __name__ == "__main__":
    main()
