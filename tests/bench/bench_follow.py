"""Slices that follow the needle: this tree against the one before it, side by side in one run.

Figures to reach: processor time of the window's thread for each move of the needle ≤ 0.35 × that of
`BEFORE`; on a quiet machine ≥ 60 distinct states a second painted in every pane, ≤ 20 ms old
(median). Both trees run the same program (`needle_moves`) in processes of their own, in turns, at
the same number of moves a second; then each runs at its own pace. `BEFORE` is taken from git, or
from the folder that `ACUS_BENCH_BEFORE` names.
"""

import io
import json
import os
import subprocess
import sys
import tarfile
from pathlib import Path
from typing import Any

from app.core import paths

BEFORE = "43208b2"
"""The last commit whose panes were scenes of some twenty items each."""

ROOT = Path(__file__).resolve().parents[2]
GOAL, GOAL_HZ, GOAL_AGE_MS = 0.35, 60.0, 20.0
PERIOD_MS, ROUNDS = 40, 2
"""Both sides are moved so often: slow enough for either to keep up."""

SECONDS = float(os.environ.get("ACUS_BENCH_SECONDS", "10"))


def before() -> Path:
    """Folder of the tree before."""
    if given := os.environ.get("ACUS_BENCH_BEFORE"):
        return Path(given)
    folder = paths.cache() / "bench" / BEFORE
    if not (folder / "app").is_dir():
        packed = subprocess.run(
            ["git", "archive", BEFORE], cwd=ROOT, capture_output=True, check=True
        )
        with tarfile.open(fileobj=io.BytesIO(packed.stdout)) as files:
            files.extractall(folder, filter="data")
    return folder


def run(tree: Path, seconds: float, period_ms: int, parts: bool = False) -> dict[str, Any]:
    """What `needle_moves` finds in a tree."""
    environment = dict(os.environ, PYTHONPATH=str(tree), QT_QPA_PLATFORM="offscreen")
    if parts:
        environment["ACUS_BENCH_PARTS"] = "1"
    command = [
        sys.executable,
        str(ROOT / "tests/bench/needle_moves.py"),
        str(seconds),
        str(period_ms),
    ]
    done = subprocess.run(
        command, cwd=tree, env=environment, capture_output=True, text=True, check=False
    )
    for line in done.stdout.splitlines():
        if line.startswith("FOUND "):
            found: dict[str, Any] = json.loads(line.removeprefix("FOUND "))
            return found
    sys.exit(f"{tree} gave no figures:\n{done.stdout[-2000:]}\n{done.stderr[-4000:]}")


def show_parts(name: str, result: dict[str, Any]) -> None:
    """Print where the time of a move goes."""
    whole, parts = result["ms_per_move"], result["parts"]
    rest = whole - sum(parts.values())
    line = ", ".join(f"{part} {ms:.2f}" for part, ms in sorted(parts.items()))
    print(f"{name:<7} of {whole:6.2f} ms: {line}, rest {rest:.2f}")


def main() -> None:
    """Print both sides, their ratio, and this one at its own pace."""
    sides = {"before": before(), "now": ROOT}
    times: dict[str, list[float]] = {name: [] for name in sides}
    for _ in range(ROUNDS):
        for name, tree in sides.items():
            found = run(tree, SECONDS, PERIOD_MS)
            times[name].append(found["ms_per_move"])
            print(
                f"{name:<7}{found['ms_per_move']:7.2f} ms of the window's thread for each move "
                f"at {found['hz']:.1f} Hz",
                flush=True,
            )
    best = {name: min(found) for name, found in times.items()}
    ratio = best["now"] / best["before"]
    reached = "reached" if ratio <= GOAL else "NOT reached"
    print(f"ratio {ratio:.2f}; to reach {GOAL:g}: {reached}")
    for name, tree in sides.items():
        show_parts(name, run(tree, SECONDS, PERIOD_MS, parts=True))
    for name, tree in sides.items():
        found = run(tree, SECONDS, 0)
        moved, cost, late = found["hz"], found["ms_per_move"], found["late_p99_ms"]
        print(
            f"{name}: {moved:.1f} moves/s, {cost:.2f} ms each; loop late p99 {late:.3f} ms, "
            f"{found['missed']} ticks missed"
        )
        for pane, one in found["panes"].items():
            print(
                f"  {pane:<14}{one['hz']:6.1f} states/s painted; median (p99) of the age "
                f"{one['age_ms'][0]:5.1f} ({one['age_ms'][1]:.1f}) ms, "
                f"between two {one['gap_ms'][0]:5.1f} ({one['gap_ms'][1]:.1f}) ms"
            )
        if name == "now":
            slowest = min(one["hz"] for one in found["panes"].values())
            oldest = max(one["age_ms"][0] for one in found["panes"].values())
            good = slowest >= GOAL_HZ - 1.0 and oldest <= GOAL_AGE_MS
            print(
                f"to reach {GOAL_HZ:g} Hz and {GOAL_AGE_MS:g} ms: {'' if good else 'NOT '}reached"
            )


if __name__ == "__main__":
    main()
