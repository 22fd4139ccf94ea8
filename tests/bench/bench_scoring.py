"""How long a verdict takes: the score at the end of an attempt, and reach while a point is dragged.

Run as `python -m tests.bench.bench_scoring`. There is no peer; the figures to keep are those of a
window that does not freeze: 100 ms for a debrief, 16 ms for each move of a dragged point.
"""

from collections.abc import Callable
from time import perf_counter

import numpy as np

from app.mechanisms.profile import load_profile
from app.planning.placement import PlacedPlan, Placement
from app.planning.plan import Plan
from app.planning.reach import reach
from app.scoring.score import score
from app.scoring.trajectory import Trajectory


def attempt(n: int, rate_hz: float) -> Trajectory:
    """A noisy straight insertion of n samples."""
    rng = np.random.default_rng(1)
    profile = load_profile("icube")
    plan = Plan((0.0, -95.0, 300.0), (20.0, -20.0, 310.0))
    placed = PlacedPlan.of(plan, Placement(), profile.fulcrum)
    depth = np.linspace(0.0, placed.length, n)
    tip = placed.p_entry + np.outer(depth, placed.axis) + rng.normal(0.0, 1e-4, (n, 3))
    force = rng.normal(0.0, 1.0, (n, 3))
    return Trajectory(
        placed=placed,
        time=np.arange(n) / rate_hz,
        tip=tip,
        axis=np.tile(placed.axis, (n, 1)),
        depth=depth,
        felt=force,
        phase=np.full(n, 2),  # type: ignore[arg-type]
        depth_valid=np.ones(n, dtype=bool),
        hub=tip - 0.2 * placed.axis,
        guide=force,
    )


def report(title: str, run: Callable[[], object], limit_ms: float, repeats: int = 50) -> None:
    """Print median and p99 of `run` beside the figure to keep."""
    run()
    times = []
    for _ in range(repeats):
        start = perf_counter()
        run()
        times.append(1e3 * (perf_counter() - start))
    median, p99 = np.percentile(times, [50.0, 99.0])
    print(
        f"{title:<42} median {median:8.2f} ms   p99 {p99:8.2f} ms   "
        f"of {limit_ms:g} ms: {median / limit_ms:.2f}"
    )


def main() -> None:
    """Measure score and reach."""
    profile = load_profile("icube")
    five_minutes = attempt(30_000, 100.0)
    report("score, 5 minutes at 100 Hz", lambda: score(five_minutes), 100.0)
    million = attempt(1_000_000, 1000.0)
    report("score, 1e6 samples", lambda: score(million), 1000.0, repeats=7)
    entry = (0.0, -90.0, 300.0)
    for title, target in (
        ("reach, within the limits", (0.0, -20.0, 300.0)),
        ("reach, too tilted, with remedy", (90.0, -40.0, 300.0)),
        ("reach, upwards, with remedy", (0.0, -200.0, 300.0)),
    ):
        plan = Plan(entry, target)  # type: ignore[arg-type]
        report(title, lambda plan=plan: reach(plan, Placement(), profile), 16.0)


if __name__ == "__main__":
    main()
