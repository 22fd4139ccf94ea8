"""How long calls take that are too short to be timed each by itself."""

import time
from collections.abc import Callable

import numpy as np


def seconds(*ways: tuple[Callable[[], object], int], rounds: int = 15) -> list[float]:
    """Processor's time of one call [s] of each way: what makes its calls, and how many they are.

    The ways take turns, so that what slows the machine slows them all; medians of the rounds.
    """
    taken: list[list[float]] = [[] for _ in ways]
    for number in range(rounds + 1):
        for (run, calls), times in zip(ways, taken, strict=True):
            start = time.thread_time()
            run()
            if number > 0:  # the first is the warm-up
                times.append((time.thread_time() - start) / calls)
    return [float(np.median(times)) for times in taken]
