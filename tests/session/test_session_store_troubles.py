"""A store that is full, read only or gone in mid-write: one line, and nothing is lost."""

import os
import pwd
import signal
import tempfile
import time
from collections import Counter
from collections.abc import Callable, Iterator
from pathlib import Path

import pytest
from postgres_rig import Postgres
from school_stations import SchoolStation, stored
from small_disk import small_disk
from test_session_school_store import key_of, made, meet

from app.session.database import lockable
from app.session.errors import PeopleError
from app.session.school_store import SchoolStore, StoreError, StorePlace, UnreachableStoreError
from app.session.school_store import store as stores
from app.session.school_store.synchronising import waiting
from app.session.station import StationKey

STUDENTS = ("Ada", "Bob", "Cleo")


@pytest.fixture(scope="module")
def postgres() -> Iterator[Postgres]:
    with Postgres() as server:
        yield server


@pytest.fixture
def north(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> SchoolStation:
    """Return a station with six attempts, of 70 kB each."""
    station = SchoolStation(tmp_path / "north", "north", monkeypatch)
    for number in range(6):
        station.record(key_of(STUDENTS[number % 3]))
    return station


def attempts_in(place: StorePlace) -> Counter[str]:
    """Return how often each attempt lies in a store, by its database's own count."""
    from sqlalchemy import create_engine

    engine = create_engine(place.url)
    with engine.connect() as connection:
        rows = connection.exec_driver_sql("SELECT item FROM packets WHERE kind = 'attempt'")
        found = Counter(str(item) for (item,) in rows)
    engine.dispose()
    return found


def refused_by(
    station: SchoolStation, place: StorePlace, words: str, kind: type = StoreError
) -> str:
    """Meet a store that cannot be used: one line, and every attempt waits or is there."""
    with pytest.raises(kind, match=words) as told:
        meet(station, place)
    line = str(told.value)
    assert "\n" not in line
    assert "nothing is lost" in line
    assert len(list(station.folder.glob("*.mcap"))) == station.made
    return line


def is_whole_at_the_next_try(
    station: SchoolStation, place: StorePlace, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """Meet it again: each attempt is there once, and comes to another station once."""
    meet(station, place)
    names = {path.stem for path in station.folder.glob("*.mcap")}
    assert attempts_in(place) == Counter(names)
    assert waiting(station.enter(), StationKey.of()) == 0
    south = SchoolStation(tmp_path / "south", "south", monkeypatch)
    meet(south, place)
    assert set(stored(south)["attempts"]) == names
    assert meet(station, place).sent == 0


@pytest.mark.long("journey")
def test_a_full_store_in_sqlite_says_who_makes_room_and_gets_each_attempt_once_there_is(
    north: SchoolStation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with small_disk(tmp_path / "share", 96) as disk:
        place = made(StorePlace(f"sqlite:///{tmp_path / 'share' / 'school.sqlite'}"))
        refused_by(north, place, "has no room left: its administrator makes some")
        assert waiting(north.enter(), StationKey.of()) == 6
        assert not attempts_in(place)  # all of a batch, or nothing
        disk.grow(8192)
        is_whole_at_the_next_try(north, place, tmp_path, monkeypatch)


@pytest.mark.long("journey")
def test_a_store_whose_pages_are_used_up_is_full_for_whoever_runs_this(
    north: SchoolStation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    """As above where nothing can be mounted: SQLite gives the same answer at its own limit."""
    from sqlalchemy import event

    place = made(StorePlace(f"sqlite:///{tmp_path / 'school.sqlite'}"))
    opened = SchoolStore.open

    def limited(store: SchoolStore, make: bool = True) -> None:
        event.listen(store._engine, "connect", lambda one, _: one.execute(LIMIT))
        opened(store, make)

    with monkeypatch.context() as patch:
        patch.setattr(SchoolStore, "open", limited)
        refused_by(north, place, "has no room left: its administrator makes some")
    is_whole_at_the_next_try(north, place, tmp_path, monkeypatch)


LIMIT = "PRAGMA max_page_count = 20"


@pytest.mark.long("journey")
def test_a_full_store_in_postgresql_says_the_same(
    north: SchoolStation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, postgres: Postgres
) -> None:
    """Its table lies in a tablespace on a small disk, which a server of its own fills for real."""
    place = made(StorePlace(postgres.url()))
    # Beside tmp_path: pytest's own folders are closed to the server's user.
    with (
        tempfile.TemporaryDirectory() as open_to_all,
        small_disk(disk_of := Path(open_to_all) / "small", 256) as disk,
    ):
        Path(open_to_all).chmod(0o755)
        owner = pwd.getpwnam("postgres")
        os.chown(disk_of, owner.pw_uid, owner.pw_gid)
        ask(postgres, f"CREATE TABLESPACE small LOCATION '{disk_of}'")
        try:
            ask(postgres, "ALTER TABLE packets SET TABLESPACE small")
            refused_by(north, place, "has no room left: its administrator makes some")
            assert not attempts_in(place)
            disk.grow(16384)
            is_whole_at_the_next_try(north, place, tmp_path, monkeypatch)
        finally:
            ask(postgres, "DROP TABLE packets, alembic_version")
            ask(postgres, "DROP TABLESPACE small")


def ask(server: Postgres, text: str) -> None:
    """Let its administrator do something."""
    from sqlalchemy import create_engine

    engine = create_engine(server.url(), isolation_level="AUTOCOMMIT")
    with engine.connect() as connection:
        connection.exec_driver_sql(text)
    engine.dispose()


def between_statements(kill: Callable[[], None], patch: pytest.MonkeyPatch) -> None:
    """Kill before the second attempt is written: the first one's row is in the transaction."""
    chained, calls = stores.chained, []

    def killing(before: str, digest: str) -> str:
        calls.append(digest)
        if len(calls) == 3:
            kill()
        return chained(before, digest)

    patch.setattr(stores, "chained", killing)


def before_the_commit(kill: Callable[[], None], patch: pytest.MonkeyPatch) -> None:
    """Kill when everything is written and nothing is promised."""
    patch.setattr(stores, "step", _once(kill, lambda what, path: None))


def after_the_commit(kill: Callable[[], None], patch: pytest.MonkeyPatch) -> None:
    """Kill once the server has promised it, before this station asks anything more."""
    patch.setattr(SchoolStore, "_discard", _once(kill, SchoolStore._discard))


def _once(kill: Callable[[], None], then: Callable[..., object]) -> Callable[..., object]:
    calls: list[int] = []

    def killing(*arguments: object) -> object:
        calls.append(1)
        if len(calls) == 2:  # the first is the opening, or the station's own packet
            kill()
        return then(*arguments)

    return killing


@pytest.mark.long("journey")
@pytest.mark.parametrize("moment", [between_statements, before_the_commit, after_the_commit])
def test_postgresql_killed_in_the_middle_of_a_write_has_each_attempt_once_after_the_next_try(
    moment: Callable[[Callable[[], None], pytest.MonkeyPatch], None],
    north: SchoolStation,
    tmp_path: Path,
    monkeypatch: pytest.MonkeyPatch,
    postgres: Postgres,
) -> None:
    place = made(StorePlace(postgres.url(), seconds=5.0))
    try:
        with monkeypatch.context() as patch:
            moment(lambda: postgres.stop(signal.SIGKILL), patch)
            if moment is after_the_commit:
                patch.setattr("app.session.school_store.synchronising._PACKETS", 3)
            began = time.monotonic()
            refused_by(north, place, "its administrator starts it", UnreachableStoreError)
            assert time.monotonic() - began < 10.0
        refused_by(north, place, "its administrator starts it", UnreachableStoreError)
        postgres.start()
        there = attempts_in(place)
        promised = 5 if moment is after_the_commit else 0  # two parts of three packets
        assert sum(there.values()) == len(there) == promised
        is_whole_at_the_next_try(north, place, tmp_path, monkeypatch)
    finally:
        if not postgres.is_running:
            postgres.start()
        ask(postgres, "DROP TABLE packets, alembic_version")


@pytest.mark.long("journey")
def test_a_store_on_a_share_that_can_only_be_read_gives_and_gets_what_it_can(
    north: SchoolStation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with small_disk(tmp_path / "share", 8192) as disk:
        place = made(StorePlace(f"sqlite:///{tmp_path / 'share' / 'school.sqlite'}"))
        disk.only_read()
        lockable.cache_clear()
        refused_by(north, place, "may only be read by this user: its administrator gives the right")
        disk.grow(8192)
        lockable.cache_clear()
        is_whole_at_the_next_try(north, place, tmp_path, monkeypatch)


@pytest.mark.long("journey")
def test_a_full_place_of_objects_says_who_makes_room(
    north: SchoolStation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    with small_disk(tmp_path / "objects", 96) as disk:
        url = f"sqlite:///{tmp_path / 'school.sqlite'}"
        place = made(StorePlace(url, f"file://{tmp_path / 'objects'}"))
        line = refused_by(north, place, "no room left: their administrator makes some")
        assert "Errno" not in line
        assert not attempts_in(place)
        disk.grow(8192)
        is_whole_at_the_next_try(north, place, tmp_path, monkeypatch)


@pytest.mark.long("journey")
def test_a_station_whose_own_disk_is_full_takes_nothing_and_says_where_to_make_room(
    north: SchoolStation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    place = made(StorePlace(f"sqlite:///{tmp_path / 'school.sqlite'}"))
    meet(north, place)
    with small_disk(tmp_path / "disk", 512) as disk:
        south = SchoolStation(tmp_path / "disk" / "south", "south", monkeypatch)
        with pytest.raises(PeopleError, match=r"no room left for people and records.*make some"):
            meet(south, place)
        assert not list(south.folder.iterdir())  # nothing by half, no rest
        disk.grow(16384)
        assert meet(south, place).gathered.attempts == 6


@pytest.mark.long("journey")
def test_a_database_that_another_program_holds_is_left_after_the_seconds_that_are_allowed(
    north: SchoolStation, tmp_path: Path, monkeypatch: pytest.MonkeyPatch, postgres: Postgres
) -> None:
    """A query that takes as long as it likes: here one that waits for whoever holds the table."""
    from sqlalchemy import create_engine

    places = (
        (StorePlace(f"sqlite:///{tmp_path / 'school.sqlite'}", seconds=1.0), "BEGIN EXCLUSIVE"),
        (StorePlace(postgres.url(), seconds=1.0), "LOCK TABLE packets"),
    )
    for place, hold in places:
        made(place)
        engine = create_engine(place.url, connect_args={})
        with engine.connect() as other:
            if "sqlite" in place.url:
                other.connection.driver_connection.isolation_level = None
            other.exec_driver_sql(hold)
            began = time.monotonic()
            with pytest.raises(UnreachableStoreError, match="takes longer than 1 s: this station"):
                meet(north, place)
            assert time.monotonic() - began < 8.0
            other.rollback()
            if "sqlite" in place.url:
                other.connection.driver_connection.rollback()
        engine.dispose()
        meet(north, place)
        assert set(attempts_in(place).values()) == {1}
    ask(postgres, "DROP TABLE packets, alembic_version")
