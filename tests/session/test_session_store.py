"""The list of sessions, and deleting that can be undone."""

import json
import os
import struct
from pathlib import Path

import pytest
from mcap.writer import MCAP0_MAGIC
from session_fakes import Bench

from app.core.disclaimer import DISCLAIMER
from app.session.errors import SessionError, SessionNotFoundError
from app.session.scan import scan
from app.session.sidecar import fresh_summary, read_summary, sidecar
from app.session.store import TRASH, delete, find, list_sessions, restore


@pytest.fixture
def store(tmp_path: Path) -> Path:
    bench = Bench(tmp_path)
    bench.run(0.1)
    for _ in range(3):
        bench.trainer.begin("s-1")
        bench.run(0.3)
        bench.trainer.end()
    return tmp_path


def test_sessions_are_listed_newest_first(store: Path) -> None:
    assert [s.id[-4:] for s in list_sessions(store)] == ["0003", "0002", "0001"]


def test_a_folder_that_does_not_exist_holds_no_sessions(tmp_path: Path) -> None:
    assert list_sessions(tmp_path / "none") == []


def test_a_file_in_place_of_the_folder_is_an_error(tmp_path: Path) -> None:
    (tmp_path / "f").write_text("")
    with pytest.raises(SessionError, match="cannot read the folder"):
        list_sessions(tmp_path / "f")


def test_the_summary_derived_from_the_record_is_the_one_beside_it(store: Path) -> None:
    for path in store.glob("*.mcap"):
        beside = read_summary(path)
        sidecar(path).unlink()
        assert read_summary(path).document() == beside.document()


@pytest.mark.parametrize("text", ["", "{", "[]", "{}", "null", '{"id": 1, "exercise": []}'])
def test_a_damaged_summary_is_replaced_by_what_the_record_says(store: Path, text: str) -> None:
    path = next(store.glob("*.mcap"))
    good = read_summary(path)
    sidecar(path).write_text(text)
    assert read_summary(path) == good


def test_a_broken_record_is_listed_as_such_with_the_reason(store: Path) -> None:
    (store / "20990101-000000-beef.mcap").write_bytes(b"not mcap at all")
    broken = next(s for s in list_sessions(store) if s.state == "broken")
    assert broken.id == "20990101-000000-beef"
    assert "not an MCAP file" in broken.reason
    assert len(list_sessions(store)) == 4


@pytest.mark.promise(
    "docs/sessions.md: It is listed as unfinished, never scored as if it had been "
    "finished, and stays unsigned"
)
def test_a_killed_attempt_is_listed_as_unfinished(store: Path) -> None:
    path = find(store, "20260115-093122-0002")
    sidecar(path).unlink()
    data = path.read_bytes()
    path.write_bytes(data[: data.index(b"\x28\xb5\x2f\xfd") + 10])  # in the first zstd frame
    summary = next(s for s in list_sessions(store) if s.id.endswith("0002"))
    assert summary.state == "unfinished"
    assert summary.problems


def test_summaries_carry_the_disclaimer_and_no_nan(store: Path) -> None:
    for file in store.glob("*.json"):
        document = json.loads(file.read_text(), parse_constant=pytest.fail)
        assert document["note"] == DISCLAIMER


def test_the_beginning_of_an_id_is_enough_if_only_one_fits(store: Path) -> None:
    assert find(store, "20260115-093122-0003").stem.endswith("0003")
    with pytest.raises(SessionNotFoundError, match="fits several"):
        find(store, "20260115")
    with pytest.raises(SessionNotFoundError, match="is no session"):
        find(store, "nope")
    with pytest.raises(SessionNotFoundError):
        find(store, "")


def test_deleting_can_be_undone(store: Path) -> None:
    before = [s.document() for s in list_sessions(store)]
    delete(store, "20260115-093122-0002")
    assert len(list_sessions(store)) == 2
    assert sorted(os.listdir(store / TRASH)) == [
        "20260115-093122-0002.json",
        "20260115-093122-0002.mcap",
        "20260115-093122-0002.sig",
    ]
    restore(store, "20260115-093122-0002")
    assert [s.document() for s in list_sessions(store)] == before


def test_the_trash_never_overwrites(store: Path) -> None:
    path = delete(store, "20260115-093122-0002")
    (store / path.name).write_bytes(b"another")
    with pytest.raises(SessionError, match="exists already"):
        delete(store, "20260115-093122-0002")
    with pytest.raises(SessionError, match="exists already"):
        restore(store, "20260115-093122-0002")


def test_a_length_beyond_any_memory_in_a_record_is_said_and_left_out(tmp_path: Path) -> None:
    payload = bytes(16) + struct.pack("<I", 1) + b"a" + struct.pack("<I", 0)
    payload += struct.pack("<Q", 2**63 + 5) + bytes(8)
    path = tmp_path / "a.mcap"
    path.write_bytes(MCAP0_MAGIC + struct.pack("<BQ", 9, len(payload)) + payload)
    found = scan(path)
    assert "the record at byte 8 is damaged and left out" in found.problems[0]
    assert fresh_summary(path).state == "broken"
