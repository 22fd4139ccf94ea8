"""Lists of people of the form before stations were brought together, opened and restored."""

import sqlite3
import zipfile
from contextlib import closing
from pathlib import Path

import pytest
from test_session_archive import Place

from app.session.archive import backup, erase_person, restore_backup
from app.session.people import PEOPLE, VERSION, People
from app.session.results_file import write_results
from app.session.roster import RosterLine
from app.session.school_tables import SCHOOL, ErasedKeys
from app.session.station import StationKey
from app.session.station_results import tombstones
from app.session.stations import KnownStation, put_stations, revoke, stations_of

OTHER = KnownStation("0123456789abcdef", "B", "ab" * 32, 1)


@pytest.fixture
def one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Place:
    place = Place(tmp_path / "one", monkeypatch)
    for name in ("Ada", "Bob"):
        place.people.add(RosterLine(name, pin="1843"))
    place.people.remark("a1", comment="well done")
    return place


def made_older(path: Path) -> None:
    """Let a list of people be as the version before wrote it: form 2, without the tables."""
    with closing(sqlite3.connect(path)) as connection:
        for name in SCHOOL:
            connection.execute(f"DROP TABLE {name}")
        connection.execute("PRAGMA user_version = 2")
        connection.commit()


def form(path: Path) -> int:
    with closing(sqlite3.connect(path)) as connection:
        return int(connection.execute("PRAGMA user_version").fetchone()[0])


def test_a_list_of_the_form_before_is_opened_and_loses_nothing(one: Place) -> None:
    made_older(one.people.folder / PEOPLE)
    people = People()
    assert [person.pseudonym for person in people.everybody()] == ["Ada", "Bob"]
    assert people.remarks()["a1"].comment == "well done"
    assert people.sign_in("Ada", "1843").pseudonym == "Ada"
    erase_person("Bob", one.folder, delete_records=True)
    assert form(people.folder / PEOPLE) == VERSION == 3


def test_who_was_erased_before_there_were_tombstones_is_told_by_one(one: Place) -> None:
    ada, bob = (one.people.find(name).key for name in ("Ada", "Bob"))
    one.attempts(ada, bob)
    erase_person("Ada", one.folder, delete_records=False)
    erase_person("Bob", one.folder, delete_records=True)
    made_older(one.people.folder / PEOPLE)
    write_results(one.folder.parent / "r", one.folder)
    with People().database.read() as connection:
        erased_keys = ErasedKeys(tombstones(connection))
    assert (erased_keys.of(ada), erased_keys.of(bob), erased_keys.of("p-000000000000")) == (
        "kept",
        "deleted",
        "",
    )


def test_a_backup_of_the_form_before_is_restored(
    one: Place, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    made_older(one.people.folder / PEOPLE)
    with monkeypatch.context() as old:  # packed as it is: nothing opens it first
        old.setattr("app.session.archive.People.wrapped_key", lambda _: {})
        backup(tmp_path / "old.acusbackup", one.folder)
    with zipfile.ZipFile(tmp_path / "old.acusbackup") as archive:
        (tmp_path / "packed").write_bytes(archive.read(f"people/{PEOPLE}"))
    assert form(tmp_path / "packed") == 2
    two = Place(tmp_path / "two", monkeypatch)
    assert restore_backup(tmp_path / "old.acusbackup", two.folder).people == "restored"
    assert [person.pseudonym for person in People().everybody()] == ["Ada", "Bob"]


def test_an_old_backup_lets_no_revoked_station_and_no_erased_person_back(
    one: Place, tmp_path: Path
) -> None:
    with one.people.database.write() as connection:
        put_stations(connection, StationKey.of(), [OTHER])
    backup(tmp_path / "old.acusbackup", one.folder)
    revoke("B")
    erase_person("Ada", one.folder, delete_records=True)
    restore_backup(tmp_path / "old.acusbackup", one.folder, replace_people=True)
    assert [known.revoked for known in stations_of(People()).values()] == [True]
    assert [person.pseudonym for person in People().everybody()] == ["Bob"]
    with closing(sqlite3.connect(one.people.folder / PEOPLE)) as connection:
        assert connection.execute("SELECT count(*) FROM tombstones").fetchone() == (1,)
