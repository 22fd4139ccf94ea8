"""Restoring a backup: checked whole before, moved as one step, and what is not taken is told."""

import json
import os
import sqlite3
import sys
import zipfile
from collections.abc import Callable
from contextlib import closing
from pathlib import Path

import pytest
from session_fakes import Bench
from test_session_archive import Place

from app.core import paths
from app.core.files import watched
from app.session.archive import ArchiveError, backup, erase_person, restore_backup
from app.session.backup_file import ArchiveError as NoBackupError
from app.session.course import Course
from app.session.header import new_id
from app.session.index import Index
from app.session.journal import FOLDER, Journal, move, settle
from app.session.people import NAMES_FILE, PEOPLE, People
from app.session.roster import RosterLine
from app.session.store import list_sessions, records

ROOT = Path(__file__).resolve().parents[2]


def elsewhere(place: Place, name: str) -> None:
    """Record an attempt with an id of its own, as another station draws one."""
    bench = Bench(place.folder)
    object.__setattr__(bench.context, "identify", new_id)
    bench.run(0.1)
    bench.trainer.begin(place.people.find(name).key)
    bench.run(0.4, 0.03)
    bench.trainer.end()


@pytest.fixture
def one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Place:
    place = Place(tmp_path / "one", monkeypatch)
    place.people.add(RosterLine("Ada", "Lovelace", "1843", ("A",)))
    place.people.set_instructor("correct horse")
    place.attempts(place.people.find("Ada").key, place.people.find("Ada").key)
    Course(id="autumn", title="Autumn").save(place.people.folder)
    return place


def with_people(source: Path, out: Path, change: Callable[[Path], None]) -> Path:
    """Copy a backup whose list of people was changed, with a digest that is right."""
    import hashlib

    with zipfile.ZipFile(source) as old, zipfile.ZipFile(out, "w") as new:
        manifest = json.loads(old.read("manifest.json"))
        for name in manifest["files"]:
            data = old.read(name)
            if name == f"people/{PEOPLE}":
                file = out.with_name("changed.sqlite")
                file.write_bytes(data)
                change(file)
                data = file.read_bytes()
                manifest["files"][name] = hashlib.sha256(data).hexdigest()
            new.writestr(name, data)
        new.writestr("manifest.json", json.dumps(manifest))
    return out


def does(*lines: str) -> Callable[[Path], None]:
    def change(file: Path) -> None:
        with closing(sqlite3.connect(file)) as connection:
            for line in lines:
                connection.execute(line)
            connection.commit()

    return change


def foreign(file: Path) -> None:
    file.unlink()
    does("CREATE TABLE moz_places (id INTEGER)", "PRAGMA user_version = 1")(file)


BAD = {
    "empty": lambda file: file.write_bytes(b""),
    "no database": lambda file: file.write_bytes(b"not a database at all" * 500),
    "cut off": lambda file: file.write_bytes(file.read_bytes()[: file.stat().st_size // 2]),
    "foreign": foreign,
    "newer": does("PRAGMA user_version = 99"),
    "without a version": does("PRAGMA user_version = 0"),
    "without persons": does("DROP TABLE persons"),
    "a view for persons": does("ALTER TABLE persons RENAME TO p",
                               "CREATE VIEW persons AS SELECT * FROM p"),
    "a blob for a pseudonym": does("UPDATE persons SET pseudonym = x'00ff'"),
    "null for a key": does("CREATE TABLE t AS SELECT * FROM persons", "DROP TABLE persons",
                           "ALTER TABLE t RENAME TO persons", "UPDATE persons SET key = NULL"),
}  # fmt: skip


WORDS = {"newer": "newer version"}


def kept(place: Place) -> tuple[object, ...]:
    people = People()
    hidden = [path for path in place.folder.parent.rglob("*") if path.name.startswith(".")]
    return (
        people.everybody(names=True),
        people.has_instructor(),
        people.remarks(),
        [path.name for path in records(place.folder)],
        [path.name for path in hidden if path.name != ".trash"],
    )


@pytest.mark.long("journey")
@pytest.mark.parametrize("kind", BAD)
def test_people_that_cannot_be_taken_change_nothing(one: Place, tmp_path: Path, kind: str) -> None:
    backup(tmp_path / "b", one.folder)
    bad = with_people(tmp_path / "b", tmp_path / "bad", BAD[kind])
    records(one.folder)[0].unlink()  # it would come back
    before = kept(one)
    with pytest.raises(ArchiveError, match=WORDS.get(kind, "cannot be rest")):
        restore_backup(bad, one.folder, replace_people=True)
    assert kept(one) == before
    People().check_instructor("correct horse")


@pytest.mark.promise("docs/people.md: a password is never taken away")
def test_triggers_and_settings_of_a_foreign_list_are_not_taken_over(
    one: Place, tmp_path: Path
) -> None:
    backup(tmp_path / "b", one.folder)
    bad = with_people(
        tmp_path / "b",
        tmp_path / "bad",
        does(
            "CREATE TRIGGER open AFTER INSERT ON failures BEGIN DELETE FROM failures; END",
            "CREATE TABLE more (a TEXT)",
            "DELETE FROM settings WHERE name = 'password'",
            "INSERT INTO settings VALUES ('stamp:x', 'y')",
        ),
    )
    assert restore_backup(bad, one.folder, replace_people=True).people == "restored"
    with closing(sqlite3.connect(one.people.folder / PEOPLE)) as connection:
        names = {row[0] for row in connection.execute("SELECT name FROM sqlite_master")}
        settings = {row[0] for row in connection.execute("SELECT name FROM settings")}
    assert not names & {"open", "more"}
    assert "stamp:x" not in settings
    People().check_instructor("correct horse")  # a password is never taken away


@pytest.mark.parametrize(
    ("line", "words"),
    [
        ("UPDATE persons SET pseudonym = '../../etc'", "cannot be a pseudonym"),
        ("UPDATE persons SET pseudonym = 'p-3fa9c0d1e2b7'", "looks like a key"),
        ("UPDATE persons SET key = '/etc'", "persons.key holds '/etc'"),
        ("INSERT INTO persons SELECT 'p-000000000000', 'aDA', pin, created FROM persons", "twice"),
    ],
)
def test_a_backup_brings_no_student_whom_a_roster_could_not(
    one: Place, tmp_path: Path, line: str, words: str
) -> None:
    backup(tmp_path / "b", one.folder)
    bad = with_people(tmp_path / "b", tmp_path / "bad", does(line))
    with pytest.raises(ArchiveError, match=f"{words}.*nothing was changed"):
        restore_backup(bad, one.folder, replace_people=True)
    assert [person.pseudonym for person in People().everybody()] == ["Ada"]


@pytest.mark.long("journey")
def test_a_backup_of_another_station_says_exactly_what_is_not_taken(
    one: Place, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    first, second = (path.stem for path in records(one.folder))
    one.people.remark_all([first, second], comment="good")
    one.people.remark(first, void="camera fell")
    backup(tmp_path / "b", one.folder)
    two = Place(tmp_path / "two", monkeypatch)
    two.people.add(RosterLine("Eve", pin="1234"))
    elsewhere(two, "Eve")
    done = restore_backup(tmp_path / "b", two.folder)
    assert (done.records, done.people, done.key) == (2, "kept", "not asked")
    told = "\n".join(done.not_taken)
    for words in (
        "1 student of the backup (Ada): their attempts are nobody's here",
        "2 comments of the backup",
        "1 void mark of the backup",
        "1 membership of the backup",
        "the course autumn of the backup",
        "the signatures of 2 attempts restored: another station",
    ):
        assert words in told
    assert [one.stands for one in Index(two.folder).attempts()] == []
    index = Index(two.folder)
    index.refresh()
    assert sorted(one.stands for one in index.attempts()) == [False, False, True]
    again = restore_backup(tmp_path / "b", two.folder, replace_people=True)
    assert "1 student that were here (Eve)" in "\n".join(again.not_taken)


def test_a_backup_of_this_station_that_is_restored_at_once_lacks_nothing(
    one: Place, tmp_path: Path
) -> None:
    backup(tmp_path / "b", one.folder)
    done = restore_backup(tmp_path / "b", one.folder)
    assert (done.kept, done.not_taken, done.different) == (2, (), ())


@pytest.mark.long("journey")
def test_an_erased_person_comes_back_through_no_stations_backup(
    one: Place, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    backup(tmp_path / "b", one.folder)
    two = Place(tmp_path / "two", monkeypatch)
    restore_backup(tmp_path / "b", two.folder)
    elsewhere(two, "Ada")  # the first station does not know of this one
    backup(tmp_path / "c", two.folder)
    one.here()
    erase_person("Ada", one.folder, delete_records=True)
    for with_them in (False, True):
        done = restore_backup(tmp_path / "c", one.folder, replace_people=with_them)
        assert (done.records, done.erased) == (0, 3)
        assert [person.pseudonym for person in People().everybody(names=True)] == []
        assert records(one.folder) == []
    text = b"".join(path.read_bytes() for path in one.data.rglob("*") if path.is_file())
    assert b"Lovelace" not in text


def test_structures_profiles_and_earlier_versions_travel_and_cts_are_named(
    one: Place, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    from app.session.archive import left_out

    text = (paths.resources() / "exercises" / "first-insertion.yaml").read_text()
    own = {
        "exercises/first-insertion@1.yaml": text,
        "exercises/mine.yaml": text.replace("id: first-insertion", "id: mine"),
        "exercises/profiles/mine-device.yaml": "a: 1\n",
        "structures/mine/0a1b2c3d.seg.nrrd": "NRRD0004\n",
    }
    for name, content in own.items():
        (one.data / name).parent.mkdir(parents=True, exist_ok=True)
        (one.data / name).write_text(content)
    digest, mine = "ab" * 32, one.data / "exercises/mine.yaml"
    text = mine.read_text()
    mine.write_text(text.replace("{phantom: {seed: 1}}", f"{{folder: ../ct, digest: {digest}}}"))
    backup(tmp_path / "b", one.folder)
    assert any(digest in line and "mine" in line for line in left_out())
    two = Place(tmp_path / "two", monkeypatch)
    restore_backup(tmp_path / "b", two.folder)
    for name in own:
        assert (two.data / name).read_bytes() == (one.data / name).read_bytes()


def test_a_backup_needs_no_temporary_folder_and_a_full_disk_is_one_line(
    one: Place, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr("tempfile.tempdir", "/dev/full")
    assert backup(tmp_path / "b", one.folder) == 2

    def full(*_: object) -> None:
        raise sqlite3.OperationalError("database or disk is full")

    monkeypatch.setattr("app.session.archive._copied", full)
    with pytest.raises(NoBackupError, match="disk is full"):
        backup(tmp_path / "out" / "c", one.folder)
    assert list((tmp_path / "out").iterdir()) == []


def test_what_is_planned_is_done_once_by_the_next_who_looks(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("a")
    code = (
        "import os, sys; from pathlib import Path\n"
        "from app.session.journal import Journal, move\n"
        f"place = Path({str(tmp_path)!r})\n"
        "with Journal(place) as journal:\n"
        "    journal.plan([move(place / 'a', place / 'b')])\n"
        "    os._exit(0) if sys.argv[1] == 'dies' else sys.stdin.read()\n"
    )
    import subprocess

    def program(how: str) -> "subprocess.Popen[bytes]":
        environment = os.environ | {"PYTHONPATH": str(ROOT)}
        line = [sys.executable, "-c", code, how]
        return subprocess.Popen(line, stdin=subprocess.PIPE, env=environment)

    with program("lives") as living:
        while not (tmp_path / FOLDER).exists() or not _planned(tmp_path):
            assert living.poll() is None
        settle(tmp_path)
        assert (tmp_path / "a").exists()  # whoever lives does it himself
        living.communicate(b"")
    assert (tmp_path / "b").exists()
    (tmp_path / "b").rename(tmp_path / "a")
    with program("dies") as dying:
        dying.wait()
    assert (tmp_path / "a").exists()
    settle(tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["b"]


def _planned(place: Path) -> bool:
    return any(path.read_bytes().count(b"\n") > 1 for path in (place / FOLDER).glob("*"))


def test_a_plan_that_cannot_be_carried_out_stays_for_later(tmp_path: Path) -> None:
    (tmp_path / "a").write_text("a")
    from app.session.errors import SessionError

    def refuse(what: str, path: Path) -> None:
        if what == "replace":
            raise OSError(28, os.strerror(28), str(path))

    again = pytest.raises(SessionError, match="tried again at the next start")
    with watched(refuse), again, Journal(tmp_path) as journal:
        journal.plan([move(tmp_path / "a", tmp_path / "b")])
    settle(tmp_path)
    assert sorted(path.name for path in tmp_path.iterdir()) == ["b"]


def test_names_and_persons_change_together_or_not_at_all(
    one: Place, monkeypatch: pytest.MonkeyPatch
) -> None:
    def stop(what: str, path: Path) -> None:
        if what == "commit":
            raise KeyboardInterrupt

    before = (one.people.everybody(names=True), (one.people.folder / NAMES_FILE).read_text())
    with watched(stop), pytest.raises(KeyboardInterrupt):
        one.people.take_roster([RosterLine("Cleo", "Clairaut")])
    assert (People().everybody(names=True), (one.people.folder / NAMES_FILE).read_text()) == before
    with watched(stop), pytest.raises(KeyboardInterrupt):
        erase_person("Ada", one.folder, delete_records=True)
    assert (People().everybody(names=True), (one.people.folder / NAMES_FILE).read_text()) == before
    assert {summary.signature for summary in list_sessions(one.folder)} == {"verified"}


@pytest.mark.long("journey")
@pytest.mark.promise(
    "CONTRIBUTING.md: no finished attempt is lost or unsigned, and nothing is left over after "
    "the next start"
)
@pytest.mark.skipif(not hasattr(os, "fork"), reason="needs fork")
def test_a_kill_at_every_step_of_delete_restore_and_backup_leaves_all_or_nothing(
    tmp_path: Path,
) -> None:
    import subprocess

    line = [sys.executable, "-m", "tests.kills", "--kills", "0", "--only", "delete,restore,backup"]
    done = subprocess.run(
        [*line, "--each", "3"], cwd=ROOT, capture_output=True, text=True, timeout=300,
        env=os.environ | {"PYTHONPATH": str(ROOT), "TMPDIR": str(tmp_path)},
    )  # fmt: skip
    assert done.returncode == 0, done.stdout + done.stderr
    assert "0 faults" in done.stdout
