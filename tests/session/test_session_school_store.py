"""Stations that share a store: whatever comes in whatever order, all end with the same."""

import json
import shutil
import sqlite3
import zipfile
from collections.abc import Iterator
from dataclasses import replace
from pathlib import Path

import pytest
from postgres_rig import PASSWORD, Postgres
from school_stations import SchoolStation, headed, pool, stored

from app.session import audit
from app.session.course import Course, CourseItem, courses
from app.session.erasing import erase_person
from app.session.people import People
from app.session.roster import RosterLine
from app.session.school_store import (
    SchoolStore,
    StoreError,
    StorePlace,
    Synchronised,
    UnreachableStoreError,
    place_of_store,
    put_place,
    require_password,
    synchronise,
)
from app.session.school_store.synchronising import read_again
from app.session.school_store.tables import metadata


@pytest.fixture(scope="module")
def postgres() -> Iterator[Postgres]:
    with Postgres() as server:
        yield server


@pytest.fixture(params=["sqlite", "postgresql", "objects"])
def place(request: pytest.FixtureRequest, tmp_path: Path) -> StorePlace:
    """Return an empty store of each kind."""
    if request.param == "postgresql":
        server = request.getfixturevalue("postgres")
        _emptied(server.url())
        return made(StorePlace(server.url()))
    url = f"sqlite:///{tmp_path / 'school.sqlite'}"
    objects = f"file://{tmp_path / 'objects'}" if request.param == "objects" else ""
    return made(StorePlace(url, objects))


def made(place: StorePlace) -> StorePlace:
    """Make the tables of a store."""
    store = place.store()
    store.open()
    store.close()
    return place


def _emptied(url: str) -> None:
    from sqlalchemy import create_engine

    engine = create_engine(url)
    with engine.begin() as connection:
        connection.exec_driver_sql("DROP SCHEMA public CASCADE")
        connection.exec_driver_sql("CREATE SCHEMA public")
    engine.dispose()


def meet(station: SchoolStation, place: StorePlace, trust: bool = True) -> Synchronised:
    """Bring a station and the store together."""
    people = station.enter()
    mine = replace(place, gives_course=station.name == "head", pins=True)
    return synchronise(mine, station.folder, people, trust)


def school(tmp_path: Path, patch: pytest.MonkeyPatch) -> list[SchoolStation]:
    others = [SchoolStation(tmp_path / name, name, patch) for name in ("north", "south")]
    return [headed(tmp_path / "head", patch), *others]


def key_of(name: str) -> str:
    (folder,) = (pool()[0] / "data" / "people",)
    return People(folder).find(name).key


@pytest.mark.long("journey")
def test_stations_end_with_the_same_attempts_people_courses_and_marks(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: StorePlace
) -> None:
    head, north, south = school(tmp_path, monkeypatch)
    meet(head, place)
    meet(north, place)
    meet(south, place)
    ada, bob = key_of("Ada"), key_of("Bob")
    for _ in range(2):
        north.record(ada)
        south.record(ada)
    head.record(bob)
    for station in (north, south, head, north, south):
        meet(station, place)
    kept = [stored(station) for station in (head, north, south)]
    assert kept[0] == kept[1] == kept[2]
    assert len(kept[0]["attempts"]) == 5
    assert len(kept[0]["people"]) == 3
    assert len(kept[0]["excess"]) == 2  # the course allows two of Ada's four
    north.enter()
    assert [one.id for one in courses(People().folder)[0]] == ["autumn"]
    again = meet(north, place)
    assert (again.sent, again.gathered.attempts, again.refused) == (0, 0, ())


@pytest.mark.long("journey")
def test_who_is_erased_is_erased_everywhere_and_in_the_store(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: StorePlace
) -> None:
    head, north, south = school(tmp_path, monkeypatch)
    ada = key_of("Ada")
    for station in (head, north, south):
        meet(station, place)
    north.record(ada)
    meet(north, place)
    meet(south, place)
    late = south.record(ada)  # off the network while Ada is erased
    head.enter()
    meet(head, place)
    erase_person("Ada", head.folder, delete_records=True)
    result = meet(head, place)
    assert result.erased > 0
    for station in (south, north, head):
        meet(station, place)
        assert not stored(station)["attempts"]
        assert ada not in stored(station)["people"]
    assert not (south.folder / f"{late}.mcap").exists()
    store = place.store()
    store.open()
    assert ada not in store.students()
    assert all(ada not in str(row) for row in _every_row(place))
    told = b"".join(store.data(store.courses()).values())
    store.close()
    assert ada.encode() not in told
    assert b"Ada" not in told
    if place.objects:
        files = [path for path in (tmp_path / "objects").rglob("*") if path.is_file()]
        assert all(ada.encode() not in _unpacked(path) for path in files)


def _every_row(place: StorePlace) -> list[object]:
    from sqlalchemy import create_engine

    engine = create_engine(place.url)
    with engine.connect() as connection:
        rows = list(connection.exec_driver_sql("SELECT * FROM packets"))
    engine.dispose()
    return rows


def _unpacked(path: Path) -> bytes:
    with zipfile.ZipFile(path) as archive:
        return b"".join(archive.read(name) for name in archive.namelist())


@pytest.mark.long("journey")
def test_a_store_that_was_put_back_to_an_older_state_gets_everything_again(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "school.sqlite"
    place = made(StorePlace(f"sqlite:///{file}"))
    head, north, south = school(tmp_path, monkeypatch)
    ada, bob = key_of("Ada"), key_of("Bob")
    for station in (head, north, south):
        meet(station, place)
    north.record(ada)
    meet(north, place)
    shutil.copy(file, tmp_path / "backup")
    south.record(bob)
    meet(south, place)
    north.record(bob)
    meet(north, place)
    meet(head, place)
    head.enter()
    erase_person("Ada", head.folder, delete_records=True)
    meet(head, place)
    shutil.copy(tmp_path / "backup", file)
    south.record(bob)
    for station in (south, head, north, south, head):
        meet(station, place)
    kept = [stored(station) for station in (head, north, south)]
    assert kept[0] == kept[1] == kept[2]
    assert len(kept[0]["attempts"]) == 3
    store = place.store()
    store.open()
    assert ada not in store.students()
    store.close()


@pytest.mark.long("journey")
def test_a_station_that_lost_its_disk_gets_its_own_attempts_back(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: StorePlace
) -> None:
    head, north, _ = school(tmp_path, monkeypatch)
    meet(head, place)
    meet(north, place)
    shutil.copytree(north.root, tmp_path / "kept")
    north.record(key_of("Ada"))
    meet(north, place)
    before = stored(north)
    shutil.rmtree(north.root)
    shutil.copytree(tmp_path / "kept", north.root)
    meet(north, place)
    assert stored(north) == before


@pytest.mark.long("journey")
def test_limits_hold_after_a_meeting_that_was_broken_off_behind_what_was_sent(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: StorePlace
) -> None:
    head, north, south = school(tmp_path, monkeypatch)
    for station in (head, north, south, north):  # who has nothing more to take in
        meet(station, place)
    ada = key_of("Ada")
    for _ in range(3):  # the course allows two
        north.record(ada)
    with monkeypatch.context() as cut:
        cut.setattr(SchoolStore, "after", cut_off)
        with pytest.raises(UnreachableStoreError):
            meet(north, place)
    assert meet(north, place).sent == 0
    meet(south, place)
    assert stored(north) == stored(south)
    assert len(stored(north)["excess"]) == 1


def cut_off(*_: object) -> None:
    """Lose the line."""
    raise UnreachableStoreError("the line is cut")


@pytest.mark.long("journey")
def test_remarks_travel_and_the_later_one_holds(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: StorePlace
) -> None:
    head, north, south = school(tmp_path, monkeypatch)
    for station in (head, north, south):
        meet(station, place)
    attempt = north.record(key_of("Ada"))
    meet(north, place)
    meet(head, place)
    head.enter()
    People().remark(attempt, comment="look at the rib")
    meet(head, place)
    meet(south, place)
    south.enter()
    People().remark(attempt, comment="seen")
    for station in (south, north, head):
        meet(station, place)
    said = [stored(station)["said"] for station in (head, north, south)]
    assert said[0] == said[1] == said[2] == {(attempt, "comment"): "seen"}


@pytest.mark.long("journey")
def test_a_course_that_its_station_changed_takes_the_place_of_the_one_that_came_before(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: StorePlace
) -> None:
    head, north, south = school(tmp_path, monkeypatch)
    for station in (head, north, south):
        meet(station, place)
    south.enter()
    mine = People().folder / "courses" / "autumn.yaml"
    mine.write_text(mine.read_text().replace("Autumn", "Southern autumn"))
    head.enter()
    item = CourseItem(exercise="liver-01", version=1, attempts=5)
    Course(id="autumn", title="Autumn and winter", groups=("A",), items=(item,)).save(
        People().folder
    )
    meet(head, place)
    result = meet(north, place)
    assert not result.gathered.different
    assert [one.title for one in courses(People().folder)[0]] == ["Autumn and winter"]
    result = meet(south, place)
    assert [one.title for one in courses(People().folder)[0]] == ["Southern autumn"]
    assert any("autumn.yaml" in line for line in result.gathered.different)


@pytest.mark.long("journey")
def test_a_student_left_out_for_a_pseudonym_comes_from_the_store_after_renaming(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: StorePlace
) -> None:
    """The course lay in the store already: nobody has to give it anew."""
    head, north, _ = school(tmp_path, monkeypatch)
    own = north.enter().add(RosterLine("ADA"))[0].key
    meet(head, place)
    first = meet(north, place)
    assert ["rename" in line for line in first.gathered.different] == [True]
    assert not meet(north, place).gathered.different  # nothing new lies there
    people = north.enter()
    people.rename("ADA", "Ada North")
    read_again(people)
    again = meet(north, place)
    assert (again.gathered.people, again.gathered.different) == (1, ())
    assert People().find("Ada").key == key_of("Ada")
    assert People().find("Ada North").key == own


@pytest.mark.long("journey")
def test_a_station_that_is_not_known_waits_until_the_instructor_lets_it_in(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, place: StorePlace
) -> None:
    head, north, _ = school(tmp_path, monkeypatch)
    attempt = north.record(key_of("Ada"))
    meet(north, place)
    result = meet(head, place, trust=False)
    assert len(result.unknown) == 1
    assert result.unknown[0].name == "north"
    assert not stored(head)["attempts"]
    assert len(meet(head, place, trust=False).unknown) == 1  # and is told again
    meet(head, place, trust=True)
    assert set(stored(head)["attempts"]) == {attempt}


@pytest.mark.long("journey")
def test_a_packet_that_was_altered_in_the_store_is_named_and_the_others_are_taken(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    file = tmp_path / "school.sqlite"
    place = made(StorePlace(f"sqlite:///{file}"))
    head, north, _ = school(tmp_path, monkeypatch)
    meet(head, place)
    meet(north, place)
    first, second = north.record(key_of("Ada")), north.record(key_of("Bob"))
    meet(north, place)
    with sqlite3.connect(file) as connection:
        (data,) = connection.execute("SELECT data FROM packets WHERE item = ?", (first,)).fetchone()
        at = data.index(b"MCAP")
        forged = data[:at] + b"XCAP" + data[at + 4 :]
        connection.execute("UPDATE packets SET data = ? WHERE item = ?", (forged, first))
    connection.close()
    result = meet(head, place)
    assert set(stored(head)["attempts"]) == {second}
    assert len(result.refused) == 1
    assert "packet" in result.refused[0]


def test_the_tables_of_the_program_are_those_that_the_steps_of_the_schema_make(
    place: StorePlace,
) -> None:
    from alembic.autogenerate import compare_metadata
    from alembic.runtime.migration import MigrationContext
    from sqlalchemy import create_engine

    store = place.store()
    store.open()
    store.open()  # again
    store.close()
    engine = create_engine(place.url)
    with engine.connect() as connection:
        assert compare_metadata(MigrationContext.configure(connection), metadata()) == []
    engine.dispose()


def test_a_store_of_a_newer_version_is_left_alone(tmp_path: Path) -> None:
    file = tmp_path / "school.sqlite"
    store = SchoolStore(f"sqlite:///{file}")
    store.open()
    store.close()
    with sqlite3.connect(file) as connection:
        connection.execute("UPDATE alembic_version SET version_num = '9999'")
    connection.close()
    with pytest.raises(StoreError, match="newer version of Acus"):
        SchoolStore(f"sqlite:///{file}").open()


def test_a_database_of_another_program_is_left_alone(tmp_path: Path) -> None:
    file = tmp_path / "other.sqlite"
    with sqlite3.connect(file) as connection:
        connection.execute("CREATE TABLE patients (name TEXT)")
    connection.close()
    with pytest.raises(StoreError, match=r"another program.*patients"):
        SchoolStore(f"sqlite:///{file}").open()


@pytest.mark.parametrize(
    ("url", "words"),
    [
        ("school", "is no URL"),
        ("mysql://somewhere/acus", "is no URL"),
        ("sqlite://", "is no URL"),
        ("sqlite:////nowhere/at/all/school.sqlite", "no folder /nowhere/at/all"),
        ("postgresql+psycopg://acus:hidden@127.0.0.1:1/acus", "does not answer"),
        ("postgresql://acus:hidden@127.0.0.1:1/acus", "does not answer"),
    ],
)
def test_a_url_that_leads_nowhere_is_told_in_one_line_without_its_password(
    url: str, words: str
) -> None:
    with pytest.raises(StoreError, match=words) as told:
        SchoolStore(url, seconds=2.0).open()
    assert "\n" not in str(told.value)
    assert "hidden" not in str(told.value)


def test_a_wrong_password_a_missing_database_and_a_reader_are_told(postgres: Postgres) -> None:
    from sqlalchemy import create_engine

    _emptied(postgres.url())
    store = SchoolStore(postgres.url())
    store.open()
    store.close()
    wrong = postgres.url().replace(PASSWORD, "wrong")
    with pytest.raises(StoreError, match="does not know this user and password"):
        SchoolStore(wrong).open()
    with pytest.raises(StoreError, match="no such database"):
        SchoolStore(postgres.url().replace("/postgres", "/nothing")).open()
    engine = create_engine(postgres.url())
    with engine.begin() as connection:
        connection.exec_driver_sql("DROP ROLE IF EXISTS reader")
        connection.exec_driver_sql("CREATE ROLE reader LOGIN PASSWORD 'reading'")
        connection.exec_driver_sql("GRANT USAGE ON SCHEMA public TO reader")
        connection.exec_driver_sql("GRANT SELECT ON ALL TABLES IN SCHEMA public TO reader")
    engine.dispose()
    reader = postgres.url().replace(f"acus:{PASSWORD}", "reader:reading")
    one = SchoolStore(reader)
    one.open()
    from app.session.school_store.packet import Packet

    with pytest.raises(StoreError, match="may only be read"):
        one.put([Packet("0" * 16, "attempt", "a", "", "m", b"data")])
    one.close()


def test_where_the_store_is_is_kept_for_this_user_only(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.delenv("ACUS_STORE", raising=False)
    assert place_of_store(tmp_path) is None
    place = StorePlace("sqlite:////share/school.sqlite", gives_course=True)
    put_place(place, tmp_path)
    assert place_of_store(tmp_path) == place
    assert (tmp_path / "store.json").stat().st_mode & 0o077 == 0
    monkeypatch.setenv("ACUS_STORE", "sqlite:////elsewhere/school.sqlite")
    other = place_of_store(tmp_path)
    assert other is not None
    assert (other.url, other.gives_course) == ("sqlite:////elsewhere/school.sqlite", True)
    monkeypatch.delenv("ACUS_STORE")
    (tmp_path / "store.json").write_text("{")
    with pytest.raises(StoreError, match=r"store\.json.*acus store connect"):
        place_of_store(tmp_path)
    put_place(None, tmp_path)
    assert place_of_store(tmp_path) is None


@pytest.mark.long("journey")
def test_a_server_that_stalls_is_cut_and_this_station_goes_on(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch, postgres: Postgres
) -> None:
    from stalling_proxy import StallingProxy

    _emptied(postgres.url())
    _, north, _ = school(tmp_path, monkeypatch)
    with StallingProxy(postgres.port) as proxy:
        place = made(StorePlace(postgres.url(proxy.port), seconds=1.0))
        meet(north, place)
        north.record(key_of("Ada"))
        for behave in ("stall", "cut"):
            proxy.behave(behave, after=3000)
            with pytest.raises(UnreachableStoreError, match="this station goes on"):
                meet(north, place)
        proxy.behave("pass")
        assert meet(north, place).sent == 1
    document = json.loads(north.enter().setting("school store"))
    assert document["confirmed"] == 1


def test_an_empty_folder_of_a_share_that_is_not_mounted_gets_no_store_of_its_own(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Seen: a station went on as "up to date" with a store that it had made beside the mount."""
    _, north, _ = school(tmp_path, monkeypatch)
    (tmp_path / "share").mkdir()
    with pytest.raises(UnreachableStoreError, match="is not there: look whether its share"):
        meet(north, StorePlace(f"sqlite:///{tmp_path / 'share' / 'school.sqlite'}"))
    assert not list((tmp_path / "share").iterdir())
    empty = tmp_path / "share" / "empty.sqlite"
    empty.touch()
    with pytest.raises(StoreError, match="holds no school's store any more"):
        meet(north, StorePlace(f"sqlite:///{empty}"))


def test_only_a_station_with_a_password_shares_a_store() -> None:
    people = People()
    with pytest.raises(StoreError, match="set the instructor's password first"):
        require_password(people)
    people.set_instructor("correct horse battery")
    require_password(people)


@pytest.mark.long("journey")
def test_what_the_program_exchanges_by_itself_is_not_told_of_whoever_is_here(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    place = made(StorePlace(f"sqlite:///{tmp_path / 'school.sqlite'}"))
    head, north, _ = school(tmp_path, monkeypatch)
    meet(head, place)
    north.record(key_of("Ada"))
    people = north.enter()
    synchronise(place, north.folder, people, True, by=audit.PROGRAM)
    told = {(one.who, one.what) for one in audit.entries()}
    assert {("program", "store synchronised"), ("program", "files taken in")} <= told
