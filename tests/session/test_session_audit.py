"""Who did what: lines that are added, signed and chained, with keys and without names."""

import json
import multiprocessing
import os
import subprocess
from pathlib import Path

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from app.session import audit
from app.session.course import Course, CourseItem
from app.session.people import People
from app.session.roster import RosterLine
from app.session.station import StationKey, key_file


@pytest.fixture(autouse=True)
def at_a_station(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> None:
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "data"))
    audit.act_as(audit.ACCOUNT)


def told() -> list[tuple[str, str, tuple[str, ...]]]:
    return [(one.who, one.what, one.about) for one in audit.entries()]


def test_what_the_instructor_does_is_told_by_keys_and_never_by_names() -> None:
    people = People()
    people.set_instructor("correct horse battery")
    audit.act_as(audit.INSTRUCTOR)
    ada, _ = people.add(RosterLine("Ada", "Ada Lovelace", "1843", ("A",)))
    people.remark("2026-a", comment="look at the rib of Ada")
    people.set_pin("Ada", "271828")
    Course(id="autumn", title="Autumn", items=(CourseItem(exercise="liver-01", version=1),)).save()
    people.sign_in("Ada", "271828")
    assert told() == [
        ("account", "password set", ()),
        ("instructor", "students added", (ada.key,)),
        ("instructor", "attempts remarked", ("2026-a",)),
        ("instructor", "PIN set", (ada.key,)),
        ("instructor", "course saved", ("autumn",)),
        ("instructor", "signed in", (ada.key,)),
    ]
    assert all(one.right for one in audit.entries())
    text = audit.audit_file().read_text()
    for secret in ("Ada", "Lovelace", "271828", "rib", "horse"):
        assert secret not in text
    assert audit.audit_file().stat().st_mode & 0o077 == 0


def test_each_line_is_signed_as_openssl_verifies_it(tmp_path: Path) -> None:
    StationKey.of()
    audit.note("key renewed", ["0123456789abcdef"])
    document = json.loads(audit.audit_file().read_text())
    signature = bytes.fromhex(document.pop("signature"))
    from app.session.station import _message

    message = _message("audit", document)
    public = bytes.fromhex(document["public"])
    der = bytes.fromhex("302a300506032b6570032100") + public  # RFC 8410
    (tmp_path / "key").write_bytes(der)
    (tmp_path / "sig").write_bytes(signature)
    (tmp_path / "text").write_bytes(message)
    done = subprocess.run(
        ["openssl", "pkeyutl", "-verify", "-pubin", "-keyform", "DER", "-inkey", "key",
         "-rawin", "-in", "text", "-sigfile", "sig"],
        cwd=tmp_path, capture_output=True, check=False,
    )  # fmt: skip
    assert b"Verified Successfully" in done.stdout, done.stderr


@settings(max_examples=60, deadline=None)
@given(place=st.integers(0, 4), how=st.sampled_from(("change", "take out", "swap", "put in")))
def test_a_line_that_was_changed_taken_out_or_put_in_is_seen(place: int, how: str) -> None:
    StationKey.of()
    path = audit.audit_file()
    path.unlink(missing_ok=True)
    for number in range(6):
        audit.note("attempts remarked", [f"a{number}"])
    lines = path.read_bytes().splitlines(keepends=True)
    if how == "change":
        lines[place] = lines[place].replace(b'"a', b'"b')
    elif how == "take out":
        del lines[place]
    elif how == "swap":
        lines[place], lines[place + 1] = lines[place + 1], lines[place]
    else:
        lines.insert(place, lines[place])
    path.write_bytes(b"".join(lines))
    assert not all(one.right for one in audit.entries())


def test_a_line_that_a_kill_cut_off_is_no_line_and_the_next_one_follows_the_last() -> None:
    audit.note("backup written")
    whole = audit.audit_file().read_bytes()
    audit.note("backup restored")
    data = audit.audit_file().read_bytes()
    for cut in range(len(whole), len(data)):
        audit.audit_file().write_bytes(data[:cut])
        audit.note("station named")
        assert [(one.what, one.right) for one in audit.entries()] == [
            ("backup written", True),
            ("station named", True),
        ]


def _notes(data: str, who: str) -> None:
    os.environ["ACUS_DATA"] = data
    audit.act_as(who)
    for number in range(25):
        audit.note("attempt deleted", [f"{who}-{number}"])


@pytest.mark.long("journey")
def test_several_programs_add_lines_at_one_time_and_none_is_lost() -> None:
    StationKey.of()
    context = multiprocessing.get_context("spawn")
    data = os.environ["ACUS_DATA"]
    some = [context.Process(target=_notes, args=(data, f"p-{n}")) for n in range(3)]
    for one in some:
        one.start()
    for one in some:
        one.join(60)
    entries = audit.entries()
    assert all(one.right for one in entries)
    assert len({one.about for one in entries}) == 75


def test_before_there_is_a_key_lines_are_chained_and_none_is_drawn_for_them() -> None:
    audit.note("backup written")
    assert not key_file().exists()
    assert [one.right for one in audit.entries()] == [True]
    StationKey.of()
    audit.note("backup written")
    assert [one.right for one in audit.entries()] == [True, True]
    first, second = audit.audit_file().read_bytes().splitlines(keepends=True)
    audit.audit_file().write_bytes(first.replace(b"backup written", b"station named") + second)
    assert [one.right for one in audit.entries()] == [True, False]
    key_file().rename(key_file().with_name("away"))
    audit.note("backup written")  # unsigned after a signed one: somebody took the key away
    key_file().with_name("away").rename(key_file())
    assert [one.right for one in audit.entries()][2] is False


def test_what_a_renewed_key_signed_before_still_holds() -> None:
    from app.session.stations import renew_key

    audit.note("backup written")
    renew_key(People())
    audit.note("backup written")
    assert [one.right for one in audit.entries()] == [True, True, True]


def test_where_it_cannot_be_written_the_work_goes_on(caplog: pytest.LogCaptureFixture) -> None:
    StationKey.of()
    audit.audit_file().mkdir()
    people = People()
    people.remark("a", comment="x")
    assert people.remarks()["a"].comment == "x"
    assert "audit trail cannot be written" in caplog.text


def test_more_than_a_hundred_ids_are_counted_and_what_is_no_id_is_left_out() -> None:
    audit.note("attempts remarked", [f"a{n}" for n in range(150)])
    audit.note("attempts remarked", ["a", "Ada Lovelace", "records/ada"])
    first, second = audit.entries()
    assert (first.about, first.count) == ((), 150)
    assert (second.about, second.count) == (("a",), 1)
    with pytest.raises(ValueError, match="lunch"):
        audit.note("lunch")
