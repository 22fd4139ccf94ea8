"""The board of 100 000 attempts, in this tree and in another one, in turns, in one run.

`git worktree add ../before COMMIT`, then `python -m tests.bench.bench_board ../before`; without a
tree, this one alone. Two hundred students made fifty attempts at each of ten exercises, a fifth of
them with a dial of their own. Records, signatures and summaries are names of a few files, rows of
the index are sealed as `refresh` leaves them. Counted is the time of the processor from a program
that knows nothing to the whole board; 1 s to reach.
"""

import json
import os
import subprocess
import sys
import tempfile
from datetime import UTC, datetime, timedelta
from pathlib import Path
from shutil import copy2
from time import perf_counter, process_time

import numpy as np

from app.session import index as indexes
from app.session.board import board_of
from app.session.index import Index
from app.session.people import People
from app.session.roster import RosterLine
from app.session.sidecar import fresh_kept
from app.session.station import StationKey

STUDENTS, EXERCISES, EACH, ROUNDS, LIMIT_S = 200, 10, 50, 3, 1.0
LINKS = 5000
RECORDS = Path(__file__).resolve().parents[1] / "data" / "records"


def fill(folder: Path, keys: list[str]) -> None:
    """Write names of records and their rows, sealed; the rows are those of the one that is read."""
    source = min(RECORDS.glob("*.mcap"), key=lambda path: path.stat().st_size)
    copy2(source, folder / "first.mcap")
    index, key = Index(folder), StationKey.of()
    inodes = hasattr(indexes, "listing")
    if inodes:
        mark = indexes.mark_of(folder, "first", indexes.listing(folder), key.station)
    else:  # a tree before that
        mark = index._there(key)["first"]
    of = indexes.rows_of if inodes else indexes._rows
    (row,) = of(folder, "first", mark, fresh_kept, key)
    began, random, rows, made = datetime(2026, 1, 1, tzinfo=UTC), np.random.default_rng(1), [], 0
    conditions = json.loads(row["under"])
    for number in range(EACH):
        for student, person in enumerate(keys):
            for exercise in range(EXERCISES):
                name, made = f"a-{number:02d}-{student:04d}-{exercise:02d}", made + 1
                for end in (".mcap", ".sig", ".json"):
                    first = folder / f"source-{made // LINKS}{end}x"
                    if not first.exists():
                        copy2(folder / "first.mcap", first)
                    (folder / f"{name}{end}").hardlink_to(first)
                started = (began + timedelta(minutes=made)).isoformat()
                said = {"id": name, "student": person, "started": started, "version": 1}
                total = float(random.uniform(30.0, 100.0))
                dial = float(random.uniform(0.0, 1.0)) if random.random() < 0.2 else 0.5
                under = conditions | {
                    "exercise": f"e-{exercise}",
                    "version": 1,
                    "kind": "simulated",
                }
                under["assistance"] = {"start": dial, "least": dial, "most": dial, "mean": dial}
                said |= {"exercise": f"e-{exercise}", "under": json.dumps(under, sort_keys=True)}
                said |= {"total": total, "passed": total > 60.0, "counts": True}
                document = json.dumps(json.loads(row["document"]) | {"id": name})
                said |= {"verdict": "verified", "document": document, "modified_ns": mark[1]}
                stat = (folder / f"{name}.mcap").stat()
                beside = (folder / f"{name}.sig").stat()
                said |= {"size": stat.st_size, "modified_ns": stat.st_mtime_ns}
                said |= {"signed_ns": beside.st_mtime_ns}
                if inodes:
                    said |= {"inode": stat.st_ino, "signed_inode": beside.st_ino}
                rows.append(row | said)
    (folder / "first.mcap").unlink()
    index._put(rows, ())


def prepare(place: Path) -> None:
    """Fill a folder, and look at it once, as the day before would."""
    os.environ["ACUS_DATA"] = str(place)
    folder = place / "sessions"
    folder.mkdir(parents=True)
    people = People()
    people.take_roster([RosterLine(f"student-{k:04d}", pin="1843") for k in range(STUDENTS)])
    fill(folder, [person.key for person in people.everybody()])
    board_of(folder, people)


def look(place: Path) -> None:
    """Print the processor's time and the clock's of one look."""
    os.environ["ACUS_DATA"] = str(place)
    people = People()
    people.everybody()  # what a first time loads
    start, clock = process_time(), perf_counter()
    board, attempts = board_of(place / "sessions", people)
    taken = process_time() - start, perf_counter() - clock
    cells = sorted((key, cell.document()) for key, cell in board.cells.items())
    for _, cell in cells:
        del cell["since_s"]
    assert len(attempts) == STUDENTS * EXERCISES * EACH
    print(json.dumps([*taken, str(hash(json.dumps(cells)))]))


def in_tree(tree: Path, what: str, place: Path) -> list[float]:
    """Do something in a tree, and return what it printed."""
    script = f"""
import runpy, sys; sys.path.insert(0, '.')
from pathlib import Path
bench = runpy.run_path({str(Path(__file__).resolve())!r})
bench[{what!r}](Path({str(place)!r}))
"""
    environment = os.environ | {"PYTHONHASHSEED": "0"}
    done = subprocess.run(
        [sys.executable, "-c", script],
        cwd=tree, capture_output=True, text=True, check=True, env=environment,
    )  # fmt: skip
    return json.loads(done.stdout.splitlines()[-1]) if done.stdout.strip() else []


def main(trees: list[Path]) -> None:
    """Print the time of each tree, and their ratio."""
    with tempfile.TemporaryDirectory() as name:
        places = [Path(name) / str(k) for k in range(len(trees))]
        for tree, place in zip(trees, places, strict=True):
            in_tree(tree, "prepare", place)
        looks = [
            [in_tree(tree, "look", place) for tree, place in zip(trees, places, strict=True)]
            for _ in range(ROUNDS)
        ]
    times = np.array([[one[:2] for one in some] for some in looks])
    for k, tree in enumerate(trees):
        cpu, clock = np.median(times[:, k], axis=0)
        print(
            f"{tree.name:12} processor {cpu:6.2f} s, clock {clock:6.2f} s, {LIMIT_S:g} s to reach"
        )
    if len(trees) > 1:
        ratio = np.median(times[:, 1:, 0] / times[:, :1, 0])
        print(f"the other takes {ratio:.1f} times as much")


if __name__ == "__main__":
    main([Path.cwd(), *map(Path, sys.argv[1:])])
