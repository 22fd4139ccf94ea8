"""Backup, restore on another computer, erasing for good, and the trash."""

import json
import os
import sqlite3
import stat
import subprocess
import sys
import time
import zipfile
from pathlib import Path

import pytest
from session_fakes import Bench

from app.core.progress import Cancelled, Progress
from app.session.archive import (
    ArchiveError,
    backup,
    empty_trash,
    erase_person,
    finish_erasing,
    restore_backup,
)
from app.session.course import Course, courses
from app.session.index import Index
from app.session.people import PEOPLE, People
from app.session.roster import RosterLine
from app.session.signature import signature_file
from app.session.station import SignatureError, StationKey, key_file
from app.session.store import TRASH, delete, list_sessions, records, restore


class Place:
    """A station: a folder of records, its people and their folder."""

    def __init__(self, root: Path, monkeypatch: pytest.MonkeyPatch) -> None:
        self.folder, self.data = root / "records", root / "data"
        self._monkeypatch = monkeypatch
        self.here()

    def here(self) -> "Place":
        self._monkeypatch.setenv("ACUS_DATA", str(self.data))
        self.folder.mkdir(parents=True, exist_ok=True)
        self.people = People()
        return self

    def attempts(self, *students: str) -> None:
        bench = Bench(self.folder)
        bench.run(0.1)
        for student in students:
            bench.trainer.begin(student)
            bench.run(0.4, 0.03)
            bench.trainer.end()


@pytest.fixture
def one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Place:
    place = Place(tmp_path / "one", monkeypatch)
    place.people.add(RosterLine("Ada", "Lovelace", "1843", ("A",)))
    ada = place.people.find("Ada").key
    place.attempts("typed ada", ada, ada)
    Course(id="autumn", title="Autumn").save(place.people.folder)
    return place


@pytest.mark.long("journey")
def test_a_backup_moves_everything_to_another_computer(
    one: Place, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    recovery = one.people.set_instructor("correct horse")
    delete(one.folder, list_sessions(one.folder)[0].id)
    out = tmp_path / "all.acusbackup"
    assert backup(out, one.folder) == 3
    assert stat.S_IMODE(out.stat().st_mode) == 0o600
    key = StationKey.of().secret.hex().encode()
    assert key not in out.read_bytes()
    two = Place(tmp_path / "two", monkeypatch)
    done = restore_backup(out, two.folder, recovery)
    assert (done.records, done.people, done.key) == (3, "restored", "restored")
    assert [s.signature for s in list_sessions(two.folder)] == ["verified"] * 2
    assert [p.name for p in two.people.everybody(names=True)] == ["Lovelace"]
    assert [c.id for c in courses()[0]] == ["autumn"]
    assert len(records(two.folder / TRASH)) == 1
    two.people.check_instructor("correct horse")
    again = restore_backup(out, two.folder, recovery)
    assert (again.records, again.kept, again.people, again.key) == (0, 3, "kept", "same")


@pytest.mark.long("journey")
def test_without_the_recovery_key_records_of_another_station_are_unsigned(
    one: Place, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    one.people.set_instructor("correct horse")
    backup(tmp_path / "b", one.folder)
    two = Place(tmp_path / "two", monkeypatch)
    with pytest.raises(SignatureError, match="not the recovery key"):
        restore_backup(tmp_path / "b", two.folder, "AAAA-" * 7 + "AAAA")
    assert records(two.folder) == []
    assert restore_backup(tmp_path / "b", two.folder).key == "not asked"
    assert {s.signature for s in list_sessions(two.folder)} == {"unsigned"}
    assert not key_file().exists()


@pytest.mark.long("journey")
def test_a_key_that_was_here_is_set_aside(
    one: Place, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    recovery = one.people.set_instructor("correct horse")
    backup(tmp_path / "b", one.folder)
    two = Place(tmp_path / "two", monkeypatch)
    mine = StationKey.of()
    restore_backup(tmp_path / "b", two.folder, recovery)
    assert StationKey.of() != mine
    assert key_file().with_name(f"station-{mine.station}.key").exists()


def test_a_record_that_is_another_one_here_is_kept_and_said(one: Place, tmp_path: Path) -> None:
    backup(tmp_path / "b", one.folder)
    path = records(one.folder)[0]
    path.write_bytes(path.read_bytes() + b"x")
    done = restore_backup(tmp_path / "b", one.folder)
    assert (done.different, done.kept) == ((path.stem,), 2)
    assert path.read_bytes().endswith(b"x")


@pytest.mark.long("journey")
def test_erasing_leaves_the_record_anonymous_or_takes_it_too(one: Place) -> None:
    key = one.people.find("Ada").key
    assert erase_person("Ada", one.folder, delete_records=False) == (0, 2)
    assert len(records(one.folder)) == 3
    assert {s.signature for s in list_sessions(one.folder)} == {"verified"}
    assert key in {s.student for s in list_sessions(one.folder)}
    assert one.people.everybody(names=True) == []


@pytest.mark.long("journey")
@pytest.mark.promise(
    "docs/people.md: A backup that is restored later brings back neither the person nor "
    "these records"
)
def test_a_backup_brings_nobody_back_who_was_erased(one: Place, tmp_path: Path) -> None:
    one.people.add(RosterLine("Bob"))
    delete(one.folder, list_sessions(one.folder)[0].id)
    backup(tmp_path / "b", one.folder)
    assert erase_person("Ada", one.folder, delete_records=True) == (2, 0)
    assert [left.student for left in list_sessions(one.folder)] == ["typed ada"]
    assert list((one.folder / TRASH).iterdir()) == []
    done = restore_backup(tmp_path / "b", one.folder, replace_people=True)
    assert (done.records, done.erased, done.people) == (0, 2, "restored")
    assert [p.pseudonym for p in one.people.everybody(names=True)] == ["Bob"]
    assert b"Lovelace" not in b"".join(
        p.read_bytes() for p in one.people.folder.iterdir() if p.is_file()
    )


def test_a_kill_while_erasing_is_finished_later(one: Place) -> None:
    key = one.people.find("Ada").key
    own = next(s.id for s in list_sessions(one.folder) if s.student == key)
    one.people.forget_keys([key], [own], [own])  # and then the program was killed
    assert finish_erasing(one.folder, one.people) == 1
    assert own not in [s.id for s in list_sessions(one.folder)]


@pytest.mark.promise(
    "docs/people.md: for at least 30 days: `acus store empty-trash` deletes for good what "
    "was deleted earlier, and nothing else does"
)
def test_what_was_deleted_can_be_undone_for_thirty_days(one: Place) -> None:
    name = list_sessions(one.folder)[0].id
    path = delete(one.folder, name)
    assert empty_trash(one.folder) == []
    assert empty_trash(one.folder, now=time.time() + 29 * 86400) == []
    restore(one.folder, name)
    assert len(list_sessions(one.folder)) == 3
    delete(one.folder, name)
    old = time.time() - 40 * 86400
    os.utime(path, (old, old))  # an old attempt that was deleted just now
    assert empty_trash(one.folder) == []
    assert empty_trash(one.folder, now=time.time() + 31 * 86400) == [name]
    assert not path.exists()
    assert not signature_file(path).exists()


def test_a_cancelled_backup_leaves_nothing(one: Place, tmp_path: Path) -> None:
    progress = Progress(lambda fraction, _: progress.cancel() if fraction > 0.3 else None)
    with pytest.raises(Cancelled):
        backup(tmp_path / "out" / "b", one.folder, progress=progress)
    assert list((tmp_path / "out").iterdir()) == []


def test_what_is_no_backup_is_one_line(one: Place, tmp_path: Path) -> None:
    (tmp_path / "text").write_text("no archive")
    with zipfile.ZipFile(tmp_path / "zip", "w") as archive:
        archive.writestr("a", "b")
    for name in ("text", "zip", "nothing"):
        with pytest.raises(ArchiveError) as error:
            restore_backup(tmp_path / name, one.folder)
        assert "\n" not in str(error.value)


@pytest.mark.parametrize("name", ["records/../../x.mcap", "/etc/x", "people/x", "records/a.json"])
def test_an_archive_that_would_write_elsewhere_is_refused(
    one: Place, tmp_path: Path, name: str
) -> None:
    manifest = {"format": "acus-backup", "version": 1, "files": {name: "0"}, "key": {}}
    with zipfile.ZipFile(tmp_path / "b", "w") as archive:
        archive.writestr(name, "x")
        archive.writestr("manifest.json", json.dumps(manifest))
    with pytest.raises(ArchiveError, match="no name of Acus"):
        restore_backup(tmp_path / "b", one.folder)


@pytest.mark.promise(
    "docs/people.md: a backup that is damaged, empty, of a newer version or of another "
    "program changes nothing"
)
def test_a_damaged_or_newer_backup_is_refused(one: Place, tmp_path: Path) -> None:
    for version, match in ((1, "is not what was packed"), (2, "newer version of Acus")):
        manifest = {
            "format": "acus-backup",
            "version": version,
            "files": {"records/new.mcap": "0"},
            "key": {},
        }
        with zipfile.ZipFile(tmp_path / "b", "w") as archive:
            archive.writestr("records/new.mcap", "x")
            archive.writestr("manifest.json", json.dumps(manifest))
        with pytest.raises(ArchiveError, match=match):
            restore_backup(tmp_path / "b", one.folder)
        assert not (one.folder / "new.mcap").exists()


@pytest.mark.long("journey")
def test_two_programs_read_and_write_one_index_and_lose_nothing(one: Place) -> None:
    code = (
        "import sys; from pathlib import Path; from app.session.index import Index\n"
        "for k in range(15):\n"
        "    index = Index(Path(sys.argv[1]))\n"
        "    index.rebuild() if k % 5 == 0 else index.refresh()\n"
        "    assert len(index.attempts()) == 3\n"
    )
    children = [subprocess.Popen([sys.executable, "-c", code, str(one.folder)]) for _ in range(2)]
    assert [child.wait(timeout=120) for child in children] == [0, 0]
    index = Index(one.folder)
    index.refresh()
    content = index.content()
    index.rebuild()
    assert index.content() == content


def test_a_backup_is_taken_while_another_program_writes(one: Place, tmp_path: Path) -> None:
    other = sqlite3.connect(one.people.folder / PEOPLE, isolation_level=None)
    other.execute("BEGIN IMMEDIATE")
    assert backup(tmp_path / "b", one.folder) == 3
    other.execute("ROLLBACK")
    other.close()
