"""Everything is read, and what is not as it was written is named."""

import sqlite3
import zipfile
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from school_stations import SchoolStation, headed, pool

from app.session import audit
from app.session.archive import backup, check_backup, check_store
from app.session.backup_file import ArchiveError
from app.session.people import PEOPLE, People
from app.session.store import delete


@pytest.fixture
def station(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> SchoolStation:
    station = headed(tmp_path / "head", monkeypatch)
    for key in sorted(pool()[1]):
        station.record(key)
    return station


@pytest.mark.long("journey")
def test_a_station_on_which_nothing_was_touched_is_right(station: SchoolStation) -> None:
    delete(station.folder, sorted(station.folder.glob("*.mcap"))[0].stem)
    done = check_store(station.folder, People())
    assert (done.files, done.signatures, done.wrong) == (3, {"verified": 3}, ())


def test_each_thing_that_was_altered_is_named(station: SchoolStation) -> None:
    first, second, third = sorted(station.folder.glob("*.mcap"))
    data = bytearray(first.read_bytes())
    data[len(data) // 2] ^= 1
    first.write_bytes(bytes(data))
    second.with_suffix(".sig").write_text("{")
    third.with_suffix(".sig").unlink()
    audit.note("backup written")
    trail = audit.audit_file()
    trail.write_bytes(trail.read_bytes().replace(b"backup written", b"backup restored"))
    done = check_store(station.folder, People())
    assert done.signatures == {"altered": 2, "unsigned": 1}
    assert [first.name in done.wrong[0], second.name in done.wrong[1]] == [True, True]
    assert "audit trail" in done.wrong[2]
    assert len(done.wrong) == 3


def test_a_damaged_list_of_people_is_named(station: SchoolStation) -> None:
    path = People().folder / PEOPLE
    with sqlite3.connect(path) as connection:
        connection.execute("PRAGMA wal_checkpoint(TRUNCATE)")
    connection.close()
    data = bytearray(path.read_bytes())
    data[4096 : 3 * 4096] = b"\xff" * (2 * 4096)
    path.write_bytes(bytes(data))
    done = check_store(station.folder, People())
    assert len(done.wrong) == 1
    assert "acus store restore" in done.wrong[0]


def test_a_backup_is_held_against_its_list(station: SchoolStation, tmp_path: Path) -> None:
    out = tmp_path / "all.acusbackup"
    backup(out, station.folder)
    assert check_backup(out).wrong == ()
    assert check_backup(out).files == 3
    with zipfile.ZipFile(out) as old:
        members = {info: old.read(info) for info in old.infolist()}
    with zipfile.ZipFile(tmp_path / "other", "w") as new:
        for info, data in members.items():
            new.writestr(info, data[:-1] if info.filename.endswith(".yaml") else data)
    assert check_backup(tmp_path / "other").wrong == (
        "people/courses/autumn.yaml is not what was packed",
    )
    with pytest.raises(ArchiveError, match=r"cannot read .*nothing"):
        check_backup(tmp_path / "nothing")


@pytest.mark.long("journey")
@settings(max_examples=40, deadline=None)
@given(where=st.floats(0.0, 0.999), bit=st.integers(0, 7))
def test_a_bit_that_turned_over_in_a_backup_is_seen_or_is_in_nothing_that_is_read(
    where: float, bit: int, tmp_path_factory: pytest.TempPathFactory
) -> None:
    folder = tmp_path_factory.mktemp("backup")
    with pytest.MonkeyPatch.context() as patch:
        station = headed(folder / "head", patch)
        station.record(sorted(pool()[1])[0])
        out = folder / "all.acusbackup"
        backup(out, station.folder)
        whole = out.read_bytes()
        with zipfile.ZipFile(out) as archive:
            before = {name: archive.read(name) for name in archive.namelist()}
        data = bytearray(whole)
        data[int(where * len(data))] ^= 1 << bit
        out.write_bytes(bytes(data))
        try:
            done = check_backup(out)
        except ArchiveError:
            return
        if not done.wrong:
            with zipfile.ZipFile(out) as archive:
                listed = [name for name in before if name != "manifest.json"]
                assert all(archive.read(name) == before[name] for name in listed)
