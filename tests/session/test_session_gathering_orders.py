"""Stations that exchange files in any order, twice, half of them now: one store in the end.

What must come out is told by a model of plain sets and dicts that shares no code with the program:
attempts are a set, a remark is stamped with one more than the highest stamp its station has seen,
erasures are a set, and limits take the first attempts of each station before the second ones.
"""

import hashlib
import os
import random
import tempfile
from collections import defaultdict
from pathlib import Path

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st
from school_stations import SchoolStation, headed, pool, stored

from app.session.archive import erase_person
from app.session.gathering import gather_file
from app.session.results_file import write_course, write_results

NAMES = ("A", "B", "C")
FIELDS = ("comment", "void", "released")
LIMIT = 2

WEIGHTS = {"attempt": 5, "remark": 10, "write": 4, "gather": 6, "erase": 0.4}
"""How often each thing is done, beside the others."""


class ModelStation:
    """What a station knows, as sets and dicts."""

    def __init__(self, name: str) -> None:
        self.name = name
        self.attempts: dict[str, tuple[str, str, str]] = {}  # id: student, station, digest
        self.shown: dict[tuple[str, str], str] = {}
        self.signed: dict[tuple[str, str], tuple[int, str, str]] = {}
        self.erased_keys: set[tuple[str, bool]] = set()

    def gone(self) -> set[str]:
        return {student for student, _ in self.erased_keys}

    def lost(self) -> set[str]:
        return {student for student, anonymous in self.erased_keys if not anonymous}

    def forget(self, students: set[str], records: set[str]) -> None:
        dead = {name for name, one in self.attempts.items() if one[0] in students}
        for place in [place for place in {*self.shown, *self.signed} if place[0] in dead]:
            self.shown.pop(place, None)
            self.signed.pop(place, None)
        for name in [name for name in dead if self.attempts[name][0] in records]:
            del self.attempts[name]

    def sign(self, stations: dict[str, str]) -> None:
        stamp = 1 + max((one[0] for one in self.signed.values()), default=0)
        stamp = max(stamp, 1 + self.seen)
        fresh = {
            place: (stamp, stations[self.name], value)
            for place, value in self.shown.items()
            if value != self.signed.get(place, (0, "", ""))[2]
        }
        self.signed |= fresh
        self.seen = max(self.seen, stamp) if fresh else self.seen

    seen = 0

    def file(self, stations: dict[str, str]) -> tuple:
        self.sign(stations)
        own = {name: one for name, one in self.attempts.items() if one[1] == self.name}
        mine = {p: v for p, v in self.signed.items() if v[1] == stations[self.name]}
        whose = {p: self.attempts[p[0]][0] for p in mine if p[0] in self.attempts}
        whose |= {p: self.whose[p] for p in mine if p in self.whose}
        return own, mine, whose, set(self.erased_keys)

    def take(self, file: tuple, stations: dict[str, str]) -> None:
        self.sign(stations)
        own, mine, whose, erased_keys = file
        self.erased_keys |= erased_keys
        self.attempts |= {n: one for n, one in own.items() if one[0] not in self.lost()}
        for place, value in mine.items():
            self.seen = max(self.seen, value[0])
            if whose[place] not in self.gone() and value > self.signed.get(place, (0, "", "")):
                self.signed[place], self.shown[place] = value, value[2]
                self.whose[place] = whose[place]
        dead = {place for place, student in self.whose.items() if student in self.gone()}
        for place in dead:
            self.shown.pop(place, None)
            self.signed.pop(place, None)
        self.forget(self.gone(), self.lost())

    @property
    def whose(self) -> dict:
        return self.__dict__.setdefault("_whose", {})

    def excess(self, students: set[str]) -> set[str]:
        beyond = set()
        for student in students - self.gone():
            stations = defaultdict(list)
            for name in sorted(self.attempts):
                void = self.shown.get((name, "void"))
                if self.attempts[name][0] == student and not void:
                    stations[self.attempts[name][1]].append(name)
            order = sorted(
                (place, self.attempts[name][2], name)
                for some in stations.values()
                for place, name in enumerate(some)
            )
            beyond |= {name for _, _, name in order[LIMIT:]}
        return beyond


@pytest.mark.long("journey")
@settings(
    max_examples=int(os.environ.get("ACUS_INTERLEAVINGS", "6")),
    suppress_health_check=list(HealthCheck),
)
@given(st.integers(0, 2**32))
def test_all_stations_end_with_the_same_store(seed: int) -> None:
    rng = random.Random(seed)
    with pytest.MonkeyPatch.context() as patch, tempfile.TemporaryDirectory() as name:
        _play(moves(rng), rng, Path(name), patch)


def moves(rng: random.Random) -> list[tuple]:
    """Return what happens: all have attempts of all, then whatever comes in whatever order."""
    begin = [("attempt", station, student) for station in range(3) for student in (0, 0, 1)]
    begin += [("write", station) for station in range(3)]
    begin += [("gather", station, file) for station in range(3) for file in range(3)]
    kinds = rng.choices(list(WEIGHTS), list(WEIGHTS.values()), k=30)
    some = {
        "attempt": lambda: (rng.choice((0, 0, 1, 2)),),
        "remark": lambda: (rng.randrange(2), rng.choice((0, 0, 1, 2)), rng.randrange(3)),
        "write": lambda: (),
        "gather": lambda: (rng.randrange(100),),
        "erase": lambda: (rng.randrange(3), rng.random() < 0.5),
    }
    return begin + [(kind, rng.randrange(3), *some[kind]()) for kind in kinds]


def _play(plan: list, rng: random.Random, root: Path, patch: pytest.MonkeyPatch) -> None:
    students = sorted(pool()[1])
    head = headed(root / "head", patch)
    write_course(root / "course", head.folder)
    real = [SchoolStation(root / name, name, patch) for name in NAMES]
    model = [ModelStation(name) for name in NAMES]
    for one in real:
        one.enter()
        gather_file(root / "course", one.folder, trust=True)
    stations = {one.name: station_id(one) for one in real}
    files: list[tuple[Path, tuple]] = []

    def write(number: int) -> None:
        real[number].enter()
        path = root / f"file-{len(files)}"
        write_results(path, real[number].folder)
        files.append((path, model[number].file(stations)))

    def gather(number: int, place: int) -> None:
        path, told = files[place]
        real[number].enter()
        done = gather_file(path, real[number].folder, trust=True)
        assert done.different == ()
        model[number].take(told, stations)

    for kind, number, *more in plan:
        station, plain = real[number], model[number]
        if kind == "attempt" and students[more[0]] not in plain.gone():
            name = station.record(students[more[0]])
            digest = hashlib.sha256((station.folder / f"{name}.mcap").read_bytes()).hexdigest()
            plain.attempts[name] = (students[more[0]], plain.name, digest)
        elif kind == "remark" and plain.attempts:
            name = sorted(plain.attempts)[more[0] % len(plain.attempts)]
            what, value = FIELDS[more[1]], ("", "yes", "no")[more[2]]
            station.enter().remark(name, **{what: bool(value) if what == "released" else value})
            plain.shown[name, what] = ("1" if value else "") if what == "released" else value
        elif kind == "write":
            write(number)
        elif kind == "gather" and files:
            gather(number, more[0] % len(files))
        elif kind == "erase" and students[more[0]] not in plain.gone():
            student, anonymous = students[more[0]], more[1]
            station.enter()
            erase_person(student, station.folder, not anonymous)
            plain.erased_keys.add((student, anonymous))
            plain.forget({student}, set() if anonymous else {student})
    for number in range(3):
        write(number)
    last = len(files) - 3
    for number in range(3):
        order = [*range(last, last + 3), *rng.sample(range(len(files)), min(3, len(files)))]
        rng.shuffle(order)
        for place in order:
            gather(number, place)
    ends = [stored(one) for one in real]
    assert ends[0] == ends[1] == ends[2]
    for end, plain in zip(ends, model, strict=True):
        _same(end, plain, students)


def _same(end: dict, plain: ModelStation, students: list[str]) -> None:
    assert end["attempts"] == {name: one[2] for name, one in plain.attempts.items()}
    said = {place: value for place, value in plain.shown.items() if value}
    released = {place: "True" for place, value in said.items() if value == "1"}
    assert end["said"] == said | released
    assert end["people"] == set(students) - plain.gone()
    assert end["excess"] == plain.excess(set(students))


def station_id(station: SchoolStation) -> str:
    from app.session.station import StationKey

    station.enter()
    return StationKey.of().station
