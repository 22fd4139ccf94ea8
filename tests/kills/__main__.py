"""`python -m tests.kills [--kills 1000] [--seconds 60] [--seed 1]`: programs that are killed.

First one kill at every step that the file layer counts, of each work; then kills at any moment of
works in a row, until so many have been killed or the time is up. After each kill the program is
started again in that home. Exit code 0: no finished attempt was lost or unsigned, each work was
done whole or not at all, and nothing was left over; 3: something was not so.
"""

from __future__ import annotations

import argparse
import multiprocessing
import os
import random
import shutil
import sys
import tempfile
import time
from collections.abc import Sequence
from concurrent.futures import ProcessPoolExecutor
from pathlib import Path
from typing import Any

sys.path.append(str(Path(__file__).resolve().parents[1] / "session"))  # its fakes

from tests.kills.home import Home, furnished
from tests.kills.works import (
    WORKS,
    Trial,
    killed_after,
    killed_at,
    mixed,
    next_start,
    started,
)

State = dict[str, Any]

_trial: Trial | None = None
"""What the processes that kill inherit."""


def trial_in(scratch: Path) -> Trial:
    """Make the homes that the programs begin in."""
    home, recovery = furnished(scratch / "home")
    started()  # what it loads is loaded once for all
    empty = Home(scratch / "empty")
    empty.out.mkdir(parents=True)
    shutil.copy2(home.out / "first.acusbackup", empty.out)
    return Trial(home, empty, recovery, scratch / "copies")


def at_step(trial: Trial, work: str, at: int, before: State, after: State) -> list[str]:
    """Kill a work before one of its steps; return what was wrong at the next start."""
    home = trial.copy_for(work, f"{work.replace(' ', '-')}-{at}")
    killed = killed_at(home, work, trial.recovery, at)
    seen = next_start(home)
    wrong: list[str] = [*seen.pop("faults"), *([] if killed else ["was not killed"])]
    if work == "attempt":  # ids are drawn: as many as before, or one more
        whole = len(seen["records"]) - len(before["records"]) in (0, 1)
    else:
        whole = seen in (before, after)
    if not whole:
        other = [
            f"{name}: {seen[name]}, not {before[name]} or {after[name]}"
            for name in seen
            if seen[name] not in (before[name], after[name])
        ]
        wrong.append(f"neither as before nor as after: {'; '.join(other) or 'a mixture'}")
    shutil.rmtree(home.root)
    return [f"{work}, step {at}: {text}" for text in wrong]


def at_random(trial: Trial, seed: int) -> list[str]:
    """Kill works in a row at some moment; return what was wrong at the next start."""
    rng = random.Random(seed)
    works = mixed(rng)
    home = trial.copy_for("", f"random-{seed}")
    killed = killed_after(home, works, trial.recovery, rng.uniform(0.0, 1.0))
    seen = next_start(home)
    wrong = [*seen["faults"], *([] if killed else ["was not killed"])]
    if "erase" not in works and "empty the trash" not in works:
        there = {*seen["records"], *seen["deleted"]}
        lost = {path.stem for path in trial.home.folder.rglob("*.mcap")} - there
        wrong += [f"{name} is lost" for name in sorted(lost)]
    shutil.rmtree(home.root)
    return [f"{', '.join(works)} (seed {seed}): {text}" for text in wrong]


def _kill(task: tuple[str, int, State, State]) -> list[str]:
    assert _trial is not None
    work, at, before, after = task
    return at_step(_trial, work, at, before, after) if work else at_random(_trial, at)


def _tasks(
    trial: Trial, works: Sequence[str], each: int, kills: int, seed: int
) -> list[tuple[str, int, State, State]]:
    """Return every step, or every so many, of each work, then moments until there are so many."""
    tasks: list[tuple[str, int, State, State]] = []
    for work in works:
        steps, before, after = trial.steps(work)
        print(f"{work:20} {steps} steps", flush=True)
        tasks += [(work, at, before, after) for at in range(0, steps, each)]
    more = range(seed * 1_000_000, seed * 1_000_000 + max(0, kills - len(tasks)))
    return tasks + [("", number, {}, {}) for number in more]


def main() -> int:
    """Kill, and tell."""
    global _trial
    parser = argparse.ArgumentParser(prog="python -m tests.kills", description=__doc__)
    parser.add_argument("--kills", type=int, default=1000)
    parser.add_argument("--seconds", type=float, default=86_400.0)
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--only", default=",".join(WORKS), help="works whose steps are taken")
    parser.add_argument("--each", type=int, default=1, help="every so many steps")
    options = parser.parse_args()
    end, wrong, kills, moments = time.monotonic() + options.seconds, [], 0, 0
    with tempfile.TemporaryDirectory() as name:
        os.umask(0o077)
        _trial = trial_in(Path(name))
        works, cores = options.only.split(","), os.cpu_count() or 1
        tasks = _tasks(_trial, works, options.each, options.kills, options.seed)
        with ProcessPoolExecutor(cores, multiprocessing.get_context("fork")) as pool:
            while tasks and time.monotonic() < end:
                some, tasks = tasks[: 4 * cores], tasks[4 * cores :]
                for task, found in zip(some, pool.map(_kill, some), strict=True):
                    kills, moments, wrong = kills + 1, moments + (not task[0]), wrong + found
    left = sum(bool(task[0]) for task in tasks)
    print(
        f"{kills} programs killed, {moments} of them at any moment, the others at each step: "
        f"{len(wrong)} faults" + (f"; no time left for {left} steps" if left else "")
    )
    for text in wrong[:40]:
        print(f"NO  {text}")
    return 3 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
