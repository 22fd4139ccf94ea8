"""Students, PINs and the instructor; rosters with every fault that rosters have."""

import json
import shutil
import sqlite3
import stat
import subprocess
import sys
from concurrent.futures import ThreadPoolExecutor
from pathlib import Path
from threading import Barrier

import pytest

from app.session.database import DatabaseError
from app.session.errors import PeopleError
from app.session.people import NAMES_FILE, PEOPLE, People, WrongPasswordError
from app.session.people import tables as people_tables
from app.session.roster import RosterLine, checked_pseudonym, read_roster
from app.session.station import SignatureError, StationKey


class Wall:
    def __init__(self) -> None:
        self.now = 1_000_000.0

    def __call__(self) -> float:
        return self.now


@pytest.fixture
def wall() -> Wall:
    return Wall()


@pytest.fixture
def people(tmp_path: Path, wall: Wall) -> People:
    return People(tmp_path / "people", wall)


def test_nobody_is_known_and_no_file_made_before_somebody_is(people: People) -> None:
    assert people.everybody() == []
    assert not people.has_instructor()
    assert (people.pseudonyms(), people.remarks(), people.erased()) == ({}, {}, {})
    assert not people.folder.exists()


def test_a_student_signs_in_by_pseudonym_and_pin(people: People) -> None:
    person, pin = people.add(RosterLine("Ada", "Ada Lovelace", "1843", ("A",)))
    assert pin == "1843"
    assert people.sign_in("ada", "1843") == person
    assert person.key.startswith("p-")
    with pytest.raises(WrongPasswordError, match="pseudonym or PIN is wrong"):
        people.sign_in("Ada", "0000")
    with pytest.raises(WrongPasswordError, match="pseudonym or PIN is wrong"):
        people.sign_in("Nobody", "0000")


def test_a_drawn_pin_works_and_a_new_one_replaces_it(people: People) -> None:
    _, pin = people.add(RosterLine("Ada"))
    assert len(pin) == 6
    people.sign_in("Ada", pin)
    people.set_pin("Ada", "987654")
    people.sign_in("Ada", "987654")
    with pytest.raises(PeopleError, match="4 to 12 digits"):
        people.set_pin("Ada", "12")


def test_wrong_tries_cost_time_and_the_right_pin_too_meanwhile(people: People, wall: Wall) -> None:
    people.add(RosterLine("Ada", pin="1843"))
    for _ in range(2):
        with pytest.raises(WrongPasswordError, match="try again"):
            people.sign_in("Ada", "0000")
    with pytest.raises(WrongPasswordError, match="wait 5 s before"):
        people.sign_in("Ada", "0000")
    with pytest.raises(WrongPasswordError, match="too many wrong tries: wait 5 s"):
        people.sign_in("Ada", "1843")
    wall.now += 5.1
    with pytest.raises(WrongPasswordError, match="wait 10 s before"):
        people.sign_in("Ada", "0000")
    wall.now += 10.1
    people.sign_in("Ada", "1843")
    with pytest.raises(WrongPasswordError, match="try again"):  # counted anew
        people.sign_in("Ada", "0000")


@pytest.mark.long("journey")
@pytest.mark.promise(
    "docs/people.md: then twice as long each time, up to five minutes; so it is with PINs"
)
@pytest.mark.parametrize("who", ["student", "instructor"])
def test_each_wrong_try_waits_twice_as_long_and_never_more_than_five_minutes(
    people: People, wall: Wall, who: str
) -> None:
    people.add(RosterLine("Ada", pin="1843"))
    people.set_instructor("correct horse")

    def attempt(right: bool) -> None:
        if who == "student":
            people.sign_in("Ada", "1843" if right else "0000")
        else:
            people.check_instructor("correct horse" if right else "wrong")

    for _ in range(2):
        with pytest.raises(WrongPasswordError, match="try again"):
            attempt(right=False)
    for wait in (5, 10, 20, 40, 80, 160, 300, 300, 300):
        with pytest.raises(WrongPasswordError, match=rf"wait {wait} s before"):
            attempt(right=False)
        wall.now += wait - 1.0
        with pytest.raises(WrongPasswordError, match="too many wrong tries: wait 1 s"):
            attempt(right=True)
        wall.now += 1.1
    attempt(right=True)


@pytest.fixture
def compared(monkeypatch: pytest.MonkeyPatch) -> list[str]:
    """What is compared with a hash, by the library that does it."""
    from argon2 import PasswordHasher

    verify, given = PasswordHasher.verify, []

    def counted(self: PasswordHasher, known: str, secret: str) -> bool:
        given.append(secret)
        return verify(self, known, secret)

    monkeypatch.setattr(PasswordHasher, "verify", counted)
    return given


@pytest.mark.long("journey")
@pytest.mark.promise(
    "docs/people.md: Signing in says the same and takes the same time whether or not there "
    "is such a student"
)
def test_signing_in_tells_nobody_who_is_known_here(
    people: People, wall: Wall, compared: list[str]
) -> None:
    people.add(RosterLine("Ada", pin="1843"))

    def tries(pseudonym: str) -> list[tuple[str, int]]:
        told = []
        for seconds in (0.0, 0.0, 0.0, 1.0, 5.0, 1.0, 10.0):
            wall.now += seconds
            before = len(compared)
            with pytest.raises(WrongPasswordError) as error:
                people.sign_in(pseudonym, "0000")
            told.append((str(error.value), len(compared) - before))
        return told

    known, unknown = tries("Ada"), tries("Bob")
    assert known == unknown == tries("Cy")
    assert [work for _, work in known] == [1, 1, 1, 0, 1, 0, 1]
    wall.now += 100.0
    people.sign_in("Ada", "1843")
    stored = (people.folder / PEOPLE).read_bytes()
    assert b"bob" not in stored.lower()  # it may be a name


def test_strangers_who_try_names_fill_no_list(people: People, monkeypatch) -> None:
    monkeypatch.setattr("app.session.tries._STRANGERS", 3)
    monkeypatch.setattr("app.session.tries.matches", lambda known, given: False)
    people.add(RosterLine("Ada", pin="1843"))
    for number in range(8):
        with pytest.raises(WrongPasswordError):
            people.sign_in(f"somebody {number}", "0000")
    with sqlite3.connect(people.folder / PEOPLE) as there:
        assert there.execute("SELECT count(*) FROM failures").fetchone() == (3,)


@pytest.mark.promise("docs/people.md: of many wrong ones three")
def test_of_many_tries_at_one_moment_three_are_compared(
    people: People, compared: list[str]
) -> None:
    people.add(RosterLine("Ada", pin="1843"))
    begin = Barrier(40)

    def sign_in(number: int) -> str:
        alone = People(people.folder, people._clock)
        begin.wait()
        with pytest.raises(WrongPasswordError) as error:
            alone.sign_in("Ada", f"{number:04d}")
        alone.database.close()
        return str(error.value)

    with ThreadPoolExecutor(40) as pool:
        told = list(pool.map(sign_in, range(40)))
    assert len(compared) == 3
    assert sum("too many wrong tries" in text for text in told) == 37


def test_right_passwords_at_one_moment_keep_nobody_out(people: People) -> None:
    people.set_instructor("correct horse")
    begin = Barrier(6)

    def check(_: int) -> None:
        alone = People(people.folder, people._clock)
        begin.wait()
        alone.check_instructor("correct horse")

    with ThreadPoolExecutor(6) as pool:
        list(pool.map(check, range(6)))


@pytest.mark.long("journey")
def test_the_instructor_has_a_password_and_a_recovery_key(people: People, wall: Wall) -> None:
    recovery = people.set_instructor("correct horse")
    assert people.has_instructor()
    people.check_instructor("correct horse")
    for _ in range(3):
        with pytest.raises(WrongPasswordError, match="password is wrong"):
            people.check_instructor("wrong")
    with pytest.raises(WrongPasswordError, match="wait"):
        people.check_instructor("correct horse")
    with pytest.raises(SignatureError, match="not the recovery key"):
        people.recover("AAAA-" * 7 + "AAAA", "new password")
    people.recover(recovery, "new password")
    people.check_instructor("new password")
    people.change_password("new password", "third password")
    people.check_instructor("third password")
    with pytest.raises(PeopleError, match="instructor already"):
        people.set_instructor("another one")
    with pytest.raises(PeopleError, match="at least 8 characters"):
        people.change_password("third password", "short")
    assert StationKey.unwrapped(people.wrapped_key(), recovery) == StationKey.of(people.folder)


@pytest.mark.long("journey")
@pytest.mark.promise("docs/people.md: the next change of the password prints a new one")
def test_a_recovery_key_of_an_earlier_build_is_replaced(people: People) -> None:
    former = people.set_instructor("correct horse")
    old = {"station": "0" * 16, "salt": "00" * 16, "secret": "00" * 32, "tag": "00" * 32}
    with people.database.write() as connection:
        table = people_tables()["settings"]
        new = table.update().where(table.c.name == "wrapped").values(value=json.dumps(old))
        connection.execute(new)
    with pytest.raises(PeopleError, match=f"earlier build.*instructor.*move .*{PEOPLE}"):
        people.recover(former, "new password")
    people.check_instructor("correct horse")
    recovery = people.change_password("correct horse", "new password")
    assert recovery not in ("", former)
    assert StationKey.unwrapped(people.wrapped_key(), recovery) == StationKey.of(people.folder)
    people.recover(recovery, "third password")
    assert people.change_password("third password", "fourth password") == ""


@pytest.mark.promise("docs/people.md: Passwords and PINs are kept as Argon2id hashes only")
def test_neither_names_nor_secrets_stand_in_the_list_of_people(people: People) -> None:
    people.add(RosterLine("Ada", "Ada Lovelace", "184318"))
    people.set_instructor("correct horse")
    data = b"".join(path.read_bytes() for path in people.folder.glob(f"{PEOPLE}*"))
    for secret in (b"Lovelace", b"184318", b"correct horse"):
        assert secret not in data
    assert data.count(b"$argon2id$") >= 2
    names = people.folder / NAMES_FILE
    assert list(json.loads(names.read_text()).values()) == ["Ada Lovelace"]
    assert stat.S_IMODE(names.stat().st_mode) == 0o600
    assert [p.name for p in people.everybody(names=True)] == ["Ada Lovelace"]
    assert [p.name for p in people.everybody()] == [""]


@pytest.mark.parametrize(
    "text",
    ["../x", "/etc/passwd", "a/b", "a\\b", "..", ".", "", " ", "a" * 65, "a\nb", "=1+1", "C:x",
     "p-0123456789ab", "a..b", "x\0"],
)  # fmt: skip
def test_a_pseudonym_that_is_a_path_or_worse_is_one_line(people: People, text: str) -> None:
    with pytest.raises(PeopleError) as error:
        people.add(RosterLine(text))
    assert "\n" not in str(error.value)
    assert people.everybody() == []


@pytest.mark.parametrize("text", ["Ada", "s-1", "Élève 3", "学生", "a.b@c", "7"])
def test_pseudonyms_of_every_language_are_taken(text: str) -> None:
    assert checked_pseudonym(f" {text} ") == text


def test_a_roster_brings_students_groups_and_names(people: People) -> None:
    data = b"pseudonym;name;pin;group\nAda;Ada Lovelace;1843;A|B\nBob;Bob;;B\n"
    lines, errors = read_roster(b"\xef\xbb\xbf" + data)
    assert errors == []
    report = people.take_roster(lines)
    assert report.added == ("Ada", "Bob")
    assert list(report.pins) == ["Bob"]
    people.sign_in("Bob", report.pins["Bob"])
    assert [p.groups for p in people.everybody()] == [("A", "B"), ("B",)]
    again = people.take_roster([RosterLine("Bob", "Bob", "", ("C",)), RosterLine("Cy")])
    assert (again.added, again.updated, list(again.pins)) == (("Cy",), ("Bob",), ["Cy"])
    people.sign_in("bob", report.pins["Bob"])  # kept
    assert people.find("Bob").groups == ("C",)


@pytest.mark.parametrize(
    ("data", "said"),
    [
        (b"pseudonym,pin\nAda,1234\nada,5678\n", "line 3: 'ada' stands there twice"),
        (b"pseudonym,pin\nAda,1234\n,\nBob,1234\n", "line 3: the row is empty"),
        (b"pseudonym,pin\n\nBob,1234\n", "line 2: the row is empty"),
        (b"pseudonym,pin\n,1234\n", "line 2: the pseudonym is empty"),
        (b"pseudonym,pin\n../../x,1234\n", "line 2: '../../x' cannot be a pseudonym"),
        (b"pseudonym,pin\nAda,12a4\n", "line 2: Ada: a PIN has 4 to 12 digits"),
        (b"pseudonym,pin\nAda\n", "line 2: 1 cells, the heading has 2"),
        (b"name,pin\nAda,1234\n", "line 1: the heading needs the column pseudonym"),
        (b"pseudonym,color\nAda,red\n", "line 1: column 'color' is not known"),
        ("pseudonym\nÉlève\n".encode("latin-1"), "line 2: the roster is not UTF-8"),
        (b"pseudonym\0\nAda\n", "the roster is no text"),
        (b"", "line 1: the heading needs the column pseudonym"),
        (b"\xff\xfex", "the roster is not UTF-8"),
    ],
)
def test_each_fault_of_a_roster_is_one_line(data: bytes, said: str) -> None:
    _, errors = read_roster(data)
    assert len(errors) == 1
    assert said in errors[0]
    assert "\n" not in errors[0]


@pytest.mark.promise("docs/people.md: Then nothing is taken, unless `--partly` is given")
def test_a_roster_with_a_wrong_row_takes_nothing_unless_asked(people: People) -> None:
    lines = [RosterLine("Ada"), RosterLine("../x"), RosterLine("Bob")]
    report = people.take_roster(lines)
    assert (len(report.errors), people.everybody()) == (1, [])
    assert people.take_roster(lines, partly=True).added == ("Ada", "Bob")


def test_a_roster_of_excel_in_utf_16_is_read() -> None:
    lines, errors = read_roster("pseudonym\tname\nAda\tÉlève\n".encode("utf-16"))
    assert (errors, lines) == ([], [RosterLine("Ada", "Élève")])


def test_a_student_who_is_renamed_keeps_key_groups_and_pin(people: People) -> None:
    key = people.add(RosterLine("Ada", pin="1843", groups=("A",)))[0].key
    people.add(RosterLine("Bob"))
    renamed = people.rename("ada", " Ada North ")
    assert (renamed.key, renamed.pseudonym, renamed.groups) == (key, "Ada North", ("A",))
    assert people.sign_in("ada north", "1843").key == key
    assert people.rename("Ada North", "ADA NORTH").pseudonym == "ADA NORTH"
    with pytest.raises(PeopleError, match="'bob' is taken: choose another pseudonym"):
        people.rename("Ada North", "bob")
    with pytest.raises(PeopleError, match="cannot be a pseudonym"):
        people.rename("Ada North", "../ada")
    with pytest.raises(PeopleError, match="'Ada' is no student here; there: ADA NORTH, Bob"):
        people.rename("Ada", "Cleo")
    assert [one.pseudonym for one in people.everybody()] == ["ADA NORTH", "Bob"]


def test_remarks_add_up(people: People) -> None:
    people.remark("a1", comment="steadier")
    people.remark("a1", void="camera fell over")
    people.remark("a1", released=True)
    said = people.remarks()["a1"]
    assert (said.comment, said.void, said.released) == ("steadier", "camera fell over", True)


def test_who_is_erased_leaves_nothing_but_a_random_key(people: People) -> None:
    people.add(RosterLine("Ada-unique", "Lovelace", "1843", ("A",)))
    key = people.find("Ada-unique").key
    people.remark("a1", comment="remark-unique")
    people.forget_keys([key], ["a1"])
    assert people.everybody(names=True) == []
    assert list(people.erased()) == [key]
    data = b"".join(path.read_bytes() for path in people.folder.iterdir())
    for text in (b"Ada-unique", b"Lovelace", b"remark-unique"):
        assert text not in data


@pytest.mark.long("journey")
def test_two_programs_add_students_at_once_and_none_is_lost(tmp_path: Path) -> None:
    code = (
        "import sys; from pathlib import Path; from app.session.people import *\n"
        f"people = People(Path({str(tmp_path / 'people')!r}))\n"
        "for k in range(12): people.add(RosterLine(f'{sys.argv[1]}{k}', f'name {k}'))\n"
    )
    children = [subprocess.Popen([sys.executable, "-c", code, name]) for name in ("a", "b")]
    assert [child.wait(timeout=120) for child in children] == [0, 0]
    found = People(tmp_path / "people").everybody(names=True)
    assert len(found) == 24
    assert all(person.name for person in found)


def test_damaged_files_are_one_line_and_stay(people: People) -> None:
    people.add(RosterLine("Ada", "Name"))
    (people.folder / NAMES_FILE).write_text("{")
    with pytest.raises(PeopleError, match="is damaged: bring it back from a backup"):
        people.add(RosterLine("Bob"))
    assert [p.pseudonym for p in people.everybody()] == ["Ada"]  # the transaction was taken back
    (people.folder / PEOPLE).write_bytes(b"x" * 5000)
    with pytest.raises(DatabaseError, match="damaged"):
        People(people.folder).everybody()
    assert (people.folder / PEOPLE).read_bytes() == b"x" * 5000


@pytest.mark.long("journey")
@pytest.mark.parametrize("fault", ["folder", "disk"])
def test_where_tries_cannot_be_written_people_sign_in_and_the_program_counts_for_itself(
    people: People, wall: Wall, monkeypatch: pytest.MonkeyPatch, fault: str
) -> None:
    people.add(RosterLine("Ada", "", "1843"))
    people.set_instructor("correct horse")
    if fault == "folder":
        monkeypatch.setattr("app.session.database.os.access", lambda *_: False)
    else:

        def full(*_: object) -> None:
            raise sqlite3.OperationalError("database or disk is full")

        monkeypatch.setattr("app.session.database.step", full)
    why = people.check_instructor("correct horse")
    assert "wrong tries are not kept" in why
    assert "\n" not in why
    assert people.sign_in("Ada", "1843").pseudonym == "Ada"
    for _ in range(3):
        with pytest.raises(WrongPasswordError, match="is wrong"):
            people.sign_in("Ada", "0000")
    with pytest.raises(WrongPasswordError, match="too many wrong tries: wait 5 s"):
        people.sign_in("Ada", "1843")
    wall.now += 6.0
    assert people.sign_in("Ada", "1843").pseudonym == "Ada"


def test_a_disk_without_room_is_called_full_and_not_one_without_locks(
    people: People, monkeypatch: pytest.MonkeyPatch
) -> None:
    people.add(RosterLine("Ada"))

    def broken(*_: object) -> None:
        raise sqlite3.OperationalError("disk I/O error")

    monkeypatch.setattr("app.session.database.step", broken)
    with pytest.raises(DatabaseError, match="put it on a disk of this computer"):
        people.set_pin("Ada", "1843")
    usage = shutil.disk_usage(people.folder)
    monkeypatch.setattr(
        "app.session.database.shutil.disk_usage", lambda _: usage._replace(free=4096)
    )
    with pytest.raises(DatabaseError, match="disk is full: make room"):
        people.set_pin("Ada", "1843")
