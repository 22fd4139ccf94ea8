"""Stations of a school in one process, with records that are made once and copied."""

import hashlib
import json
import shutil
import zipfile
from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cache
from pathlib import Path
from tempfile import mkdtemp

import pytest
from session_fakes import Bench

from app.session.course import Course, CourseItem
from app.session.people import People
from app.session.roster import RosterLine
from app.session.sidecar import fresh_kept, write_summary
from app.session.signature import _document, signature_file, signature_text
from app.session.station import StationKey
from app.session.stations import set_name

STUDENTS = ("Ada", "Bob", "Cleo")


@cache
def pool() -> tuple[Path, dict[str, list[Path]]]:
    """Return a home whose people and course a school begins with, and records of each student."""
    root = Path(mkdtemp(prefix="acus-school-"))
    with pytest.MonkeyPatch.context() as patch:
        patch.setenv("ACUS_DATA", str(root / "data"))
        people = People()
        for name in STUDENTS:
            people.add(RosterLine(name, f"{name} Lovelace", "1843", ("A",)))
        item = CourseItem(exercise="liver-01", version=1, attempts=2)
        Course(id="autumn", title="Autumn", groups=("A",), items=(item,)).save(people.folder)
        made = {}
        bench = Bench(root / "records")
        bench.run(0.1)
        for name in STUDENTS:
            key = people.find(name).key
            for _ in range(3):
                bench.trainer.begin(key)
                bench.run(2.0, 0.06)
                made.setdefault(key, []).append(Path(bench.trainer.end().record))
        for path in sorted(root.rglob("*.mcap")):
            fresh_kept(path)
    return root, made


@dataclass
class SchoolStation:
    """A station: data, records, and how many attempts it has made."""

    root: Path
    name: str
    patch: pytest.MonkeyPatch
    made: int = field(default=0)

    def __post_init__(self) -> None:
        self.folder.mkdir(parents=True)
        self.enter()
        StationKey.of()
        set_name(self.name)

    @property
    def folder(self) -> Path:
        return self.root / "records"

    def enter(self) -> People:
        """Make it the station of this process."""
        self.patch.setenv("ACUS_DATA", str(self.root / "data"))
        return People()

    def record(self, student: str) -> str:
        """Leave a finished, signed attempt of a student here; return its id."""
        self.enter()
        source = pool()[1][student][self.made % 3]
        self.made += 1
        path = self.folder / f"2026-{self.name}-{self.made:04d}.mcap"
        data = source.read_bytes()
        path.write_bytes(data)
        summary = fresh_of(source)
        digest = hashlib.sha256(data).hexdigest()
        document = _document(path, digest, summary, {}, StationKey.of().station)
        signature_file(path).write_text(signature_text(document, StationKey.of()))
        write_summary(path, summary)
        return path.stem


@cache
def fresh_of(path: Path):
    """Return the summary of a record of the pool."""
    return fresh_kept(path).summary


def headed(root: Path, patch: pytest.MonkeyPatch) -> SchoolStation:
    """Return a station with the people and the course of the pool, and no attempts."""
    shutil.copytree(pool()[0] / "data", root / "data")
    for name in ("station.key", "audit.jsonl"):  # those of another station
        (root / "data" / "people" / name).unlink()
    return SchoolStation(root, "head", patch)


def stored(station: SchoolStation) -> dict[str, object]:
    """Return what all stations must agree on."""
    people = station.enter()
    records = {
        path.stem: hashlib.sha256(path.read_bytes()).hexdigest()
        for path in station.folder.glob("*.mcap")
    }
    said = people.remarks()
    return {
        "attempts": records,
        "said": {
            (name, what): str(getattr(one, what))
            for name, one in said.items()
            for what in ("comment", "void", "released")
            if getattr(one, what)
        },
        "excess": {name for name, one in said.items() if one.excess},
        "people": {one.key for one in people.everybody()},
    }


def resigned(
    source: Path,
    to: Path,
    station: SchoolStation,
    change: Callable[[dict, dict[str, bytes]], object],
) -> Path:
    """Let a station sign a file of which a function has changed the manifest, or other members."""
    station.enter()
    key = StationKey.of()
    with zipfile.ZipFile(source) as old:
        members = {info.filename: old.read(info) for info in old.infolist()}
        packing = {info.filename: info.compress_type for info in old.infolist()}
    manifest = json.loads(members["manifest.json"])
    change(manifest, members)
    for name in manifest["files"]:
        manifest["files"][name] = hashlib.sha256(members[name]).hexdigest()
    text = members["manifest.json"] = json.dumps(manifest).encode()
    digest = hashlib.sha256(text).hexdigest()
    members["manifest.sig"] = key.sign("file", {"manifest": digest}).encode()
    with zipfile.ZipFile(to, "w") as new:
        for name, data in members.items():
            new.writestr(name, data, packing[name])
    return to


def document_of(path: Path) -> dict:
    """Return what stands in a record's signature."""
    return json.loads(signature_file(path).read_text())
