"""Start of the program on a machine already set up: the window, then an exercise that runs in it.

Each start is a process of its own; kernels and the phantom are cached by a first one that does not
count. The clock starts before the interpreter does.
"""

import os
import statistics
import subprocess
import sys
import time

WINDOW_S, EXERCISE_S = 3.0, 5.0
RUNS = 5


def child() -> None:
    """One start; prints the two times [s]."""
    from tests.bench.window_load import Session

    began = float(os.environ["ACUS_BENCH_BEGAN"])
    session = Session()
    window = time.monotonic() - began
    session.open_exercise()
    print(f"RESULT {window} {time.monotonic() - began - window}", flush=True)
    session.close()


def one_start() -> tuple[float, float]:
    """Start a process and read its times."""
    environment = os.environ | {"ACUS_BENCH_BEGAN": str(time.monotonic())}
    command = [sys.executable, "-m", "tests.bench.bench_start", "child"]
    out = subprocess.run(command, env=environment, capture_output=True, text=True, check=True)
    line = next(line for line in out.stdout.splitlines() if line.startswith("RESULT"))
    _, window, exercise = line.split()
    return float(window), float(exercise)


def main() -> None:
    """Print the median of several starts beside the figures to reach."""
    if sys.argv[1:] == ["child"]:
        child()
        return
    one_start()
    runs = [one_start() for _ in range(RUNS)]
    for name, index, limit in (("window", 0, WINDOW_S), ("exercise running", 1, EXERCISE_S)):
        times = [run[index] for run in runs]
        median = statistics.median(times)
        verdict = "reached" if median <= limit else "NOT reached"
        print(
            f"{name:18} median {median:5.2f} s  (min {min(times):.2f}, max {max(times):.2f});"
            f" to reach {limit:g} s: {verdict}"
        )


if __name__ == "__main__":
    main()
