"""Let many stations work at one store while everything breaks, and compare what they end with.

Run as `make load` or `python -m tests.load [--stations N] [--attempts N] [--seed S]
[--seconds N]`. Stations are programs of their own; they are killed at any moment, so is PostgreSQL;
the line between is cut and stalls; clocks are off by up to a day; the database is put back to an
older state once; students are erased. Then everybody meets the store in peace, and it is asked: is
every attempt there once and nowhere twice, is who was erased gone, hold the limits, and do all
stations say the same.
"""

import argparse
import json
import multiprocessing
import random
import shutil
import signal
import sys
import tempfile
import time
from concurrent.futures import ThreadPoolExecutor
from multiprocessing.connection import Connection
from multiprocessing.process import BaseProcess
from pathlib import Path

from tests.load.station import serve

sys.path.insert(0, str(Path(__file__).resolve().parents[1] / "session"))
sys.path.insert(0, str(Path(__file__).resolve().parents[1]))

COPIES = multiprocessing.get_context("forkserver")
COPIES.set_forkserver_preload(["tests.load.station"])


class StationProgram:
    """A station in a process of its own, begun again whenever it was killed.

    Processes are copies of one that has read the program already, so that fifty of them fit into a
    small computer.
    """

    def __init__(self, root: Path, pool: Path, url: str, offset: float, seconds: float) -> None:
        self.root = root
        self._given = (root, pool, url, offset, seconds)
        self._process: BaseProcess | None = None
        self._line: Connection | None = None

    def ask(self, line: str, killed_after: float = 0.0) -> dict | None:
        """Return its answer; None where it was killed."""
        if self._process is None:
            self._line, theirs = COPIES.Pipe()
            self._process = COPIES.Process(target=serve, args=(*self._given, theirs), daemon=True)
            self._process.start()
            theirs.close()
        self._line.send(line)
        if killed_after:
            time.sleep(killed_after)
            self.kill()
            return None
        try:
            return self._line.recv()
        except EOFError:
            raise SystemExit(f"{self.root.name} died of {line!r}") from None

    def kill(self) -> None:
        if self._process is not None:
            self._process.kill()
            self._process.join()
            self._line.close()
            self._process = None


def records_of(station: StationProgram) -> dict[str, str]:
    """Return the attempts that lie at a station whole, by student."""
    return {
        path.stem: json.loads(path.with_suffix(".sig").read_text())["shown"]["student"]
        for path in (station.root / "records").glob("*.mcap")
    }


def main() -> int:
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--stations", type=int, default=50)
    parser.add_argument("--attempts", type=int, default=20, help="of each station")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--seconds", type=float, default=5.0, help="to wait for the store")
    asked = parser.parse_args()
    rng = random.Random(asked.seed)
    root = Path(tempfile.mkdtemp(prefix="acus-load-"))
    from postgres_rig import Postgres
    from school_stations import pool
    from stalling_proxy import StallingProxy

    home, made = pool()
    (home / "records.json").write_text(
        json.dumps({key: [str(path) for path in some] for key, some in made.items()})
    )
    with Postgres() as server, StallingProxy(server.port) as proxy:
        url = server.url(proxy.port)
        try:
            return _run(asked, rng, root, home, made, server, proxy, url, StationProgram)
        finally:
            shutil.rmtree(root, ignore_errors=True)


def _run(asked, rng, root, home, made, server, proxy, url, program) -> int:
    shutil.copytree(home / "data", root / "head" / "data")
    (root / "head" / "data" / "people" / "station.key").unlink()
    from app.session.school_store import SchoolStore

    names = ["head", *(f"s{number:02d}" for number in range(1, asked.stations))]
    day = 86400.0
    stations = [
        program(root / name, home, url, rng.uniform(-day, day), asked.seconds) for name in names
    ]
    head = stations[0]
    store = SchoolStore(server.url())
    store.open()
    store.close()
    print("head", head.ask("sync"))
    begun = time.monotonic()
    with ThreadPoolExecutor(4) as beside:  # each is let in by the head's course
        print("first meetings", len(list(beside.map(lambda one: one.ask("sync trust"), stations))))
    print("head", {k: v for k, v in head.ask("sync trust").items() if k in ("sent", "unknown")})
    students = sorted(made)
    work = [one for one in stations for _ in range(asked.attempts)]
    rng.shuffle(work)
    kills = cuts = crashes = errors = 0
    backup, erased = root / "backup", False
    for place, station in enumerate(work):
        share = place / len(work)
        way = rng.choices(("pass", "cut", "stall"), (0.9, 0.07, 0.03))[0]
        cuts += way != "pass"
        proxy.behave(way, after=rng.randrange(200, 60_000))
        student = rng.choice(students)
        if rng.random() < 0.03:
            station.ask(f"record {student}", killed_after=rng.uniform(0.0, 0.3))
            kills += 1
        else:
            station.ask(f"record {student}")
        if rng.random() < 0.1:
            station.ask(f"say note-{place}")
        if rng.random() < 0.02:
            station.ask("void")
        if rng.random() < 0.4:
            if rng.random() < 0.1:
                station.ask("sync", killed_after=rng.uniform(0.0, 1.5))
                kills += 1
            else:
                answer = station.ask("sync")
                errors += "error" in answer
                if answer.get("refused") or answer.get("different"):
                    raise SystemExit(f"{station.root.name}: {answer}")
        if rng.random() < 3.0 / len(work) and server.is_running:
            server.stop(signal.SIGKILL)
            crashes += 1
            server.start()
        if share > 0.35 and not backup.exists():
            server.stop()
            shutil.copytree(server.data, backup)
            server.start()
        if share > 0.5 and not erased:
            proxy.behave("pass")
            print("erased", head.ask("sync") and head.ask("erase Cleo"), head.ask("sync"))
            erased = True
        if share > 0.7 and backup.exists() and not (root / "restored").exists():
            (root / "restored").touch()
            server.stop()
            server.put_back(backup)
            server.start()
        if place % 100 == 99:
            print(f"{place + 1} of {len(work)}, {time.monotonic() - begun:.0f} s", flush=True)
    proxy.behave("pass")
    whole = {}
    for one in stations:
        one.ask("settle")  # a kill in the middle of an erasure leaves a record without signature
        whole |= records_of(one)
    print(f"{len(whole)} attempts lie at the stations; all meet the store in peace", flush=True)
    own = {}
    for one in stations:
        own |= {
            name: student
            for name, student in records_of(one).items()
            if name.startswith(one.root.name + "-")
        }
    rounds = 0
    while True:
        rounds += 1
        with ThreadPoolExecutor(2) as beside:
            answers = list(beside.map(lambda one: one.ask("sync"), stations))
        wrong = [one for one in answers if "error" in one or one["refused"] or one["different"]]
        if wrong:
            raise SystemExit(str(wrong[0]))
        if not any(one["sent"] or one["came"] for one in answers):
            break
        if rounds > 10:
            raise SystemExit(f"it does not come to rest: {answers}")
    slowest = max(one["seconds"] for one in answers)
    with ThreadPoolExecutor(2) as beside:
        stored = list(beside.map(lambda one: one.ask("stored"), stations))
    for one in stations:
        one.kill()
    first = stored[0]
    gone = [key for key in students if key not in first["people"]]
    wanted = {name for name, student in own.items() if student not in gone}
    said = {"all stations say the same": all(one == first for one in stored)}
    for station, one in zip(stations, stored, strict=True):
        for name in (name for name in first if one[name] != first[name]):
            apart = [set(map(str, some)) for some in (first[name], one[name])]
            print(f"{station.root.name} differs from head in {name}: {sorted(apart[0] ^ apart[1])}")
    said["no attempt is lost or doubled"] = set(first["attempts"]) == wanted
    said["who is erased is gone"] = len(gone) == 1
    counted = {}
    excess, void = (
        set(first["excess"]),
        {n.split()[0] for n in first["said"] if n.endswith(" void")},
    )
    for name in first["attempts"]:
        if name not in excess and name not in void:
            counted[own[name]] = counted.get(own[name], 0) + 1
    said["the limit of two holds"] = all(number <= 2 for number in counted.values())
    print(
        f"{len(stations)} stations, {len(own)} attempts, {len(first['attempts'])} left after the"
        f" erasure, {len(first['said'])} remarks; {kills} stations and {crashes} servers killed,"
        f" {cuts} lines cut or stalled, {errors} meetings failed and were made up for, one restore"
        f" of an older database; at rest after {rounds} rounds, {time.monotonic() - begun:.0f} s;"
        f" a meeting with nothing new takes {slowest:.2f} s at most"
    )
    for words, right in said.items():
        print("yes" if right else "NO ", words)
    return 0 if all(said.values()) else 1


if __name__ == "__main__":
    sys.exit(main())
