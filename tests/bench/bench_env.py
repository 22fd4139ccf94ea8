"""How many steps of 20 ms `acus.env` does in a second, beside the same loop without it.

Run as `python -m tests.bench.bench_env`. The figure to keep is 3000 in a second; the peer is the
loop itself, stepped with nothing round it.
"""

from time import process_time

import numpy as np

from acus.env import Insertion
from tests.layered import layered

CHUNK, CHUNKS, LEAST = 250, 16, 3000.0
ACTION = np.array([0.02, -0.02, 0.3, -1.0], np.float32)


def rate(step, again) -> tuple[float, float]:
    """Median and best steps in a second of the processor's time."""
    found = []
    for _ in range(CHUNKS):
        again()
        begin = process_time()
        for _ in range(CHUNK):
            step()
        found.append(CHUNK / (process_time() - begin))
    return float(np.median(found)), float(max(found))


def main() -> None:
    """Print both rates, for the exercise in layers and in the field."""
    for name, exercise in (("layers", layered("first-insertion")), ("field", "first-insertion")):
        env = Insertion(exercise)
        again = lambda env=env: env.reset(seed=1)  # noqa: E731
        again()
        for _ in range(CHUNK):
            env.step(ACTION)
        plain, plain_best = rate(lambda env=env: env._loop.step(), again)
        steps, best = rate(lambda env=env: env.step(ACTION), again)
        verdict = "kept" if best >= LEAST else "missed"
        print(f"{name:7} env {steps:6.0f} (best {best:6.0f}) steps/s, the loop alone {plain:6.0f} "
              f"(best {plain_best:6.0f}); {LEAST:.0f} {verdict}")  # fmt: skip
        env.close()


if __name__ == "__main__":
    main()
