"""Ways of doing the same thing, timed in turn in one run: a busy machine slows all alike."""

import statistics
import time
from collections.abc import Callable, Mapping


def compare(ways: Mapping[str, Callable[[], object]], runs: int, limit_s: float) -> None:
    """Print median and range of each way, and whether the first one's median is within the limit.

    Each way is done once before, for what a first time loads.
    """
    for work in ways.values():
        work()
    times: dict[str, list[float]] = {name: [] for name in ways}
    for _ in range(runs):
        for name, work in ways.items():
            began = time.perf_counter()
            work()
            times[name].append(time.perf_counter() - began)
    for name, taken in times.items():
        print(
            f"{name:24} median {statistics.median(taken):.3f} s "
            f"(min {min(taken):.3f}, max {max(taken):.3f})"
        )
    first = next(iter(times))
    reached = "reached" if statistics.median(times[first]) <= limit_s else "NOT reached"
    print(f"{first}, to reach {limit_s:g} s: {reached}")
