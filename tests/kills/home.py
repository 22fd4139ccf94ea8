"""A home folder with everything that is kept, copied for each program, and what stands in it."""

from __future__ import annotations

import hashlib
import json
import os
import shutil
import sqlite3
import tempfile
import zipfile
from contextlib import closing
from dataclasses import dataclass
from pathlib import Path

from session_fakes import Bench

from app.core import paths
from app.session.archive import backup
from app.session.course import Course
from app.session.header import new_id
from app.session.interrupted import is_cut_off
from app.session.people import People
from app.session.roster import RosterLine
from app.session.signature import Signed, judge_whole, signature_file
from app.session.station import this_station
from app.session.store import TRASH, delete, records

PASSWORD = "correct horse"


@dataclass(frozen=True)
class Home:
    """One user's folders, all below one."""

    root: Path

    @property
    def folder(self) -> Path:
        """Of the records."""
        return self.root / "sessions"

    @property
    def out(self) -> Path:
        """Where backups are written."""
        return self.root / "out"

    def enter(self) -> Home:
        """Let this process live in it."""
        os.environ |= {
            "HOME": str(self.root),
            "XDG_DATA_HOME": str(self.root / "share"),
            "XDG_CACHE_HOME": str(self.root / "cache"),
            "XDG_CONFIG_HOME": str(self.root / "config"),
            "ACUS_SESSIONS": str(self.folder),
            "TMPDIR": str(self.root / "tmp"),
            "ACUS_INSTRUCTOR_PASSWORD": PASSWORD,
        }
        for name in ("ACUS_DATA", "ACUS_CACHE", "ACUS_SETTINGS"):
            os.environ.pop(name, None)
        tempfile.tempdir = None
        for place in (self.folder, self.out, self.root / "tmp"):
            place.mkdir(parents=True, exist_ok=True)
        return self

    def copied(self, to: Path) -> Home:
        """Copy it, times of change included."""
        shutil.copytree(self.root, to, symlinks=True)
        return Home(to)


def attempt(home: Home, student: str, bench: Bench | None = None) -> str:
    """Record an attempt; return its id."""
    bench = bench or Bench(home.folder)
    object.__setattr__(bench.context, "identify", new_id)
    bench.run(0.05)
    bench.trainer.begin(student)
    bench.run(0.3, 0.03)
    return bench.trainer.end().summary.id


def furnished(root: Path) -> tuple[Home, str]:
    """Make a home with attempts, people, a course, an exercise and a backup of all that.

    Since the backup an attempt was deleted, one was added and a student came; returns the recovery
    key too.
    """
    home = Home(root).enter()
    people = People()
    recovery = people.set_instructor(PASSWORD)
    people.take_roster([RosterLine("Ada", "Lovelace", "1843"), RosterLine("Bob", "Bernoulli")])
    ada, bob = people.find("Ada").key, people.find("Bob").key
    names = [attempt(home, student) for student in (ada, bob, ada)]
    delete(home.folder, names[1])
    people.remark(names[0], comment="well done")
    Course(id="autumn", title="Autumn").save(people.folder)
    for name in ("exercises/own.yaml", "structures/own/1.seg.nrrd"):
        path = paths.data() / name
        path.parent.mkdir(parents=True, exist_ok=True)
        path.write_text(f"of {name}\n")
    backup(home.out / "first.acusbackup", home.folder)
    attempt(home, ada)
    delete(home.folder, names[0])
    people.take_roster([RosterLine("Cleo", "Clairaut", "4711")])
    return home, recovery


def state() -> dict[str, object]:
    """Return what is kept in this process's home, without what differs from run to run."""
    people, folder = People(), paths.sessions()
    everybody = people.everybody(names=True)
    shown = {person.key: person.pseudonym for person in everybody}
    data = paths.data()
    own = [path for room in ("exercises", "structures") for path in (data / room).rglob("*")]
    return {
        "records": sorted(path.stem for path in records(folder)),
        "deleted": sorted(path.stem for path in records(folder / TRASH)),
        "signed": sorted(p.stem for p in _all(folder) if signature_file(p).exists()),
        "people": sorted((person.pseudonym, person.name) for person in everybody),
        "said": sorted((name, said.comment) for name, said in people.remarks().items()),
        "erased": sorted(people.erased_attempts()),
        "password": people.has_instructor(),
        "own": sorted(path.name for path in own if path.is_file()),
        "courses": sorted(path.name for path in (people.folder / "courses").glob("*")),
        "unknown names": sorted(set(_names(people)) - set(shown)),
        "station": getattr(this_station(), "station", ""),
    }


def faults(home: Home) -> list[str]:
    """Say what is wrong in this process's home: lost signatures, leftovers, broken files."""
    found = []
    for path in _all(home.folder):
        verdict = judge_whole(path, this_station()).verdict
        if not is_cut_off(path) and verdict is not Signed.VERIFIED:
            found.append(f"{path.name} is finished and {verdict.value}")
    known = {path.with_suffix("") for path in _all(home.folder)}
    for path in home.root.rglob("*"):
        name, inside = path.name, path.relative_to(home.root)
        if name.startswith(".") and name != TRASH:
            found.append(f"{inside} is left over")
        if path.suffix in (".sig", ".json") and path.parent.name in ("sessions", TRASH):
            found += [] if path.with_suffix("") in known else [f"{inside} is without its record"]
        if path.suffix == ".acusbackup":
            found += _broken(path)
        if path.name == "people.sqlite":
            with closing(sqlite3.connect(path)) as connection:
                said = connection.execute("PRAGMA integrity_check").fetchone()[0]
            found += [] if said == "ok" else [f"{inside} is damaged: {said}"]
    found += [f"{path.name} in the temporary folder" for path in (home.root / "tmp").iterdir()]
    return found


def _all(folder: Path) -> list[Path]:
    return [*records(folder), *records(folder / TRASH)]


def _names(people: People) -> dict[str, str]:
    path = people.folder / "names.json"
    return dict(json.loads(path.read_text())) if path.exists() else {}


def _broken(path: Path) -> list[str]:
    """Look whether every file in a backup is what its list says."""
    with zipfile.ZipFile(path) as archive:
        files = json.loads(archive.read("manifest.json"))["files"]
        sums = {name: hashlib.sha256(archive.read(name)).hexdigest() for name in files}
    return [] if sums == files else [f"{path.name} is damaged"]
