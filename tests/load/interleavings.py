"""The same packets of several stations, taken in by others in ten thousand orders.

Run as `python -m tests.load.interleavings [--orders N] [--seed S]`. Four stations make a history
once: attempts, remarks that answer each other, void marks, an erasure, a renewed key, a course. An
empty station takes the packets in at random: in any order, some twice, some together, some only
after others; after each order it must hold what the first one did.
"""

import argparse
import hashlib
import json
import os
import random
import shutil
import sys
import tempfile
import time
from concurrent.futures import ProcessPoolExecutor
from functools import cache
from pathlib import Path

import pytest

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "session"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))


def history(root: Path) -> None:
    """Make packets, and the home of a station that has taken in nothing yet."""
    from contextlib import closing

    from school_stations import SchoolStation, headed, pool

    from app.session.erasing import erase_person
    from app.session.people import People
    from app.session.school_store import SchoolStore, StorePlace, synchronise
    from app.session.stations import renew_key

    url = f"sqlite:///{root / 'school.sqlite'}"
    with closing(SchoolStore(url)) as store:
        store.open()
    with pytest.MonkeyPatch.context() as patch:
        head = headed(root / "head", patch)
        others = [SchoolStation(root / name, name, patch) for name in ("north", "south", "west")]
        empty = SchoolStation(root / "empty", "empty", patch)
        every = [head, *others, empty]

        def meet(station: SchoolStation) -> None:
            place = StorePlace(url, gives_course=station is head, pins=True)
            synchronise(place, station.folder, station.enter(), trust=True)

        for _ in range(2):
            for station in every:
                meet(station)
        empty.enter()
        shutil.copytree(empty.root, root / "begin")
        keys = sorted(pool()[1])
        for number in range(12):
            station = every[number % 4]
            attempt = station.record(keys[number % 3])
            if number % 2:
                meet(station)
                answer = every[(number + 1) % 4]
                meet(answer)
                answer.enter().remark(attempt, comment=f"note {number}")
            if number == 6:
                station.enter().remark(attempt, void="the door slammed")
            if number == 7:
                station.enter()
                renew_key(People())
        for station in every[:4]:
            meet(station)
        head.enter()
        erase_person("Cleo", head.folder, delete_records=True)
        (root / "unerased.sqlite").write_bytes((root / "school.sqlite").read_bytes())
        for station in every[:4]:
            meet(station)


@cache
def packets(root: str) -> tuple[tuple[int, bytes], ...]:
    """Return what lay in the store before the erasure, and what came by it."""
    from contextlib import closing

    from app.session.school_store import SchoolStore
    from app.session.school_store.store import ReadPlace

    data: dict[str, bytes] = {}
    for name in ("unerased", "school"):
        with closing(SchoolStore(f"sqlite:///{Path(root) / name}.sqlite")) as store:
            rows, _ = store.after(ReadPlace())
            found = store.data(rows)
            data |= {row.digest: found[row.seq] for row in rows}
    return tuple(enumerate(data.values()))


def one_order(job: tuple[str, int]) -> str:
    """Take the packets in by a random order; return the digest of what the station holds then."""
    root, seed = job
    from app.core.errors import AcusError
    from app.session.gathering import gather_opened
    from app.session.people import People
    from app.session.school_store.synchronising import _opened

    rng = random.Random(seed)
    home = Path(tempfile.mkdtemp(prefix="acus-order-", dir="/dev/shm"))
    try:
        shutil.copytree(Path(root) / "begin", home / "s")
        os.environ["ACUS_DATA"] = str(home / "s" / "data")
        os.sync = lambda: None  # it waits for the disks of everybody; nothing here is on any
        people, folder = People(), home / "s" / "records"
        order = list(packets(root)) + rng.choices(packets(root), k=rng.randrange(4))
        rng.shuffle(order)
        waiting = order
        while waiting:
            some, waiting = waiting[: (size := rng.choice((1, 1, 2, 5, 40)))], waiting[size:]
            files = [_opened(number, data) for number, data in some]
            try:
                gather_opened(files, folder, True, people=people)
            except AcusError:
                if len(some) > 1:
                    waiting = waiting + some  # one of them has to wait: another time
                else:
                    raise
        said = people.remarks()
        marks = ("comment", "void", "released")
        held = {
            "attempts": {
                path.stem: hashlib.sha256(path.read_bytes()).hexdigest()
                for path in folder.glob("*.mcap")
            },
            "said": {
                f"{name} {what}": str(getattr(one, what))
                for name, one in said.items()
                for what in marks
                if getattr(one, what)
            },
            "excess": sorted(name for name, one in said.items() if one.excess),
            "people": sorted(one.key for one in people.everybody()),
        }
        text = json.dumps(held, sort_keys=True)
        return f"{hashlib.sha256(text.encode()).hexdigest()} {text if seed == 0 else ''}"
    finally:
        shutil.rmtree(home, ignore_errors=True)


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--orders", type=int, default=10_000)
    parser.add_argument("--seed", type=int, default=0)
    parser.add_argument("--workers", type=int, default=2)
    asked = parser.parse_args()
    root = Path(tempfile.mkdtemp(prefix="acus-orders-"))
    history(root)
    first = one_order((str(root), 0))
    held = json.loads(first.partition(" ")[2])
    print({name: len(value) for name, value in held.items()}, len(packets(str(root))), "packets")
    begun, wrong = time.monotonic(), []
    jobs = [(str(root), asked.seed + number) for number in range(1, asked.orders)]
    with ProcessPoolExecutor(asked.workers) as pool:
        for number, digest in enumerate(pool.map(one_order, jobs, chunksize=8), 1):
            if digest.split()[0] != first.split()[0]:
                wrong.append(asked.seed + number)
            if number % 500 == 0:
                seconds = time.monotonic() - begun
                print(f"{number} orders, {len(wrong)} differ, {seconds:.0f} s", flush=True)
    shutil.rmtree(root, ignore_errors=True)
    print(f"{asked.orders} orders, {len(wrong)} differ: {wrong[:10]}")
    return 1 if wrong else 0


if __name__ == "__main__":
    sys.exit(main())
