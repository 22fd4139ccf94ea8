"""`python -m tests.kills [--kills 1000] [--seconds 60] [--seed 1]`: programs that are killed.

First one kill at every step that the file layer counts, of each work; then kills at any moment of
works in a row, until so many have been killed or the time is up. After each kill the program is
started again in that home. Exit code 0: no finished attempt was lost or unsigned, each work was
done whole or not at all, and nothing was left over; 3: something was not so.
"""

from __future__ import annotations

import argparse
import os
import random
import shutil
import sys
import tempfile
import time
from pathlib import Path

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

_LOST = ("records", "deleted")


def trial_in(scratch: Path) -> Trial:
    """Make the homes that the programs begin in."""
    home, recovery = furnished(scratch / "home")
    started()  # what it loads is loaded once for all
    empty = Home(scratch / "empty")
    empty.out.mkdir(parents=True)
    shutil.copy2(home.out / "first.acusbackup", empty.out)
    return Trial(home, empty, recovery, scratch / "copies")


def every_step(trial: Trial, work: str, each: int = 1) -> tuple[int, list[str]]:
    """Kill a work at every step, or at every so many; return how many, and what was wrong."""
    steps, before, after = trial.steps(work)
    found, kills = [], 0
    for at in range(0, steps, each):
        home = trial.copy_for(work, at)
        if not killed_at(home, work, trial.recovery, at):
            found.append(f"{work}, step {at} of {steps}: was not killed")
        seen, kills = next_start(home), kills + 1
        wrong = seen.pop("faults")
        if work == "attempt":  # ids are drawn: as many as before, or one more
            whole = len(seen["records"]) - len(before["records"]) in (0, 1)
        else:
            whole = seen in (before, after)
        if not whole:
            kept = before | {"": "before"}, after | {"": "after"}
            other = [
                f"{name}: {seen[name]}, not {' or '.join(str(one[name]) for one in kept)}"
                for name in seen
                if seen[name] not in (before[name], after[name])
            ]
            wrong.append(f"neither as before nor as after: {'; '.join(other) or 'a mixture'}")
        found += [f"{work}, step {at} of {steps}: {text}" for text in wrong]
        shutil.rmtree(home.root)
    return kills, found


def at_random(trial: Trial, rng: random.Random, number: int) -> tuple[bool, list[str]]:
    """Kill works in a row at some moment; return whether it came to that, and what was wrong."""
    works = mixed(rng)
    home = trial.copy_for("", number)
    killed = killed_after(home, works, trial.recovery, rng.uniform(0.0, 1.5))
    seen = next_start(home)
    wrong = seen["faults"]
    if "erase" not in works and "empty the trash" not in works:
        there = {*seen["records"], *seen["deleted"]}
        lost = {path.stem for path in trial.home.folder.rglob("*.mcap")} - there
        wrong += [f"{name} is lost" for name in sorted(lost)]
    shutil.rmtree(home.root)
    return killed, [f"{', '.join(works)}: {text}" for text in wrong]


def main() -> int:
    """Kill, and tell."""
    parser = argparse.ArgumentParser(prog="python -m tests.kills", description=__doc__)
    parser.add_argument("--kills", type=int, default=1000)
    parser.add_argument("--seconds", type=float, default=86_400.0)
    parser.add_argument("--seed", type=int, default=1)
    options = parser.parse_args()
    end, rng = time.monotonic() + options.seconds, random.Random(options.seed)
    kills, wrong = 0, []
    with tempfile.TemporaryDirectory() as name:
        os.umask(0o077)
        trial = trial_in(Path(name))
        for work in WORKS:
            if time.monotonic() > end:
                print(f"no time left for the steps of: {work}")
                continue
            done, found = every_step(trial, work)
            kills, wrong = kills + done, wrong + found
            print(f"{work:20} killed at each of {done} steps: {len(found)} faults", flush=True)
        random_kills = 0
        while kills < options.kills and time.monotonic() < end:
            killed, found = at_random(trial, rng, kills + random_kills)
            kills, random_kills = kills + killed, random_kills + killed
            wrong += found
    print(f"{kills} programs killed, {random_kills} of them at any moment: {len(wrong)} faults")
    for text in wrong[:40]:
        print(f"NO  {text}")
    return 3 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
