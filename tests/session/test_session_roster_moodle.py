"""Rosters with Moodle's own headings, and what other programs call students.

Headings: `first name`, `last name` (before 4.0 `surname`), `email address`, `id number`, `username`
and `groups` of Moodle's language packs (moodle.php, grades.php) in English, German and French;
those of its upload of users are its field names.
"""

from pathlib import Path

import pytest

from app.session.accounts import Account, accounts_in
from app.session.archive import backup
from app.session.people import People
from app.session.restoring import restore_backup
from app.session.roster import read_roster

ENGLISH = (
    '"First name","Last name",Username,"ID number","Email address",Groups,Roles\r\n'
    'Łukasz,Żak,lzak,007,lzak@clinic.example,"Residents, Group B",Student\r\n'
    "Zoë,Ångström,zoe,008,zoe@clinic.example,,Student\r\n"
)


def test_moodle_s_participants_are_taken_with_names_groups_and_identifiers() -> None:
    lines, errors = read_roster(ENGLISH.encode("utf-8-sig"))
    assert errors == []
    first, second = lines
    assert (first.pseudonym, first.name) == ("lzak", "Łukasz Żak")
    assert first.groups == ("Group B", "Residents")
    assert first.accounts == {
        Account.USERNAME: "lzak", Account.EMAIL: "lzak@clinic.example", Account.IDNUMBER: "007",
    }  # fmt: skip
    assert (second.pseudonym, second.groups, second.pin) == ("zoe", (), "")


@pytest.mark.parametrize(
    "heading",
    [
        "First name,Surname,Username,ID number,Email address,Groups",
        "Vorname;Nachname;Anmeldename;ID-Nummer;E-Mail-Adresse;Gruppen",
        "Prénom\tNom de famille\tNom d'utilisateur\tNuméro d'identification\tAdresse de courriel"
        "\tGroupes",
        "Prénom,Nom,Nom d’utilisateur,Numéro d’identification,Courriel,Groupes",
        "firstname,lastname,username,idnumber,email,group1",
    ],
)
def test_headings_of_each_language_and_of_uploads_say_the_same(heading: str) -> None:
    sign = next(sign for sign in ";\t," if sign in heading)
    row = sign.join(("Ada", "Lovelace", "ada", "1", "ada@x.example", "A"))
    lines, errors = read_roster(f"{heading}\n{row}\n".encode())
    assert errors == []
    assert (lines[0].pseudonym, lines[0].name, lines[0].groups) == ("ada", "Ada Lovelace", ("A",))
    assert lines[0].accounts[Account.IDNUMBER] == "1"


def test_without_user_names_the_id_number_is_the_pseudonym() -> None:
    text = "First name,Last name,ID number,Email address\nAda,Lovelace,r-1843,ada@x.example\n"
    assert [line.pseudonym for line in read_roster(text.encode())[0]] == ["r-1843"]


def test_a_table_with_names_and_addresses_alone_is_refused_with_what_to_do() -> None:
    lines, errors = read_roster(b"First name,Last name,Email address\nAda,L,ada@x.example\n")
    assert lines == []
    assert len(errors) == 1
    assert "add a column pseudonym, or export it with Username" in errors[0]
    told = b"Pseudonym,First name,Last name,Email address\nR1,Ada,L,ada@x.example\n"
    assert read_roster(told)[0][0].pseudonym == "R1"


def test_two_rows_with_one_identifier_and_an_address_that_is_none_are_named() -> None:
    text = "pseudonym,email\nAda,a@x.example\nBob,A@X.example\nEve,nobody\n"
    lines, errors = read_roster(text.encode())
    assert [line.pseudonym for line in lines] == ["Ada"]
    assert errors == [
        "line 3: the email 'A@X.example' is that of 'Ada' too: correct one of them",
        "line 4: 'nobody' is no e-mail address: correct it",
    ]


def test_a_column_that_nobody_knows_is_still_an_error_in_a_roster_of_our_own() -> None:
    errors = read_roster(b"pseudonym,shoe\nAda,41\n")[1]
    assert "column 'shoe' is not known" in errors[0]
    assert read_roster(b"name,pin\nAda,1843\n")[0] == []


def test_identifiers_are_kept_with_the_names_and_updated_by_the_next_roster(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ACUS_DATA", str(tmp_path))
    people = People()
    people.take_roster(read_roster(ENGLISH.encode())[0])
    key = people.find("lzak").key
    people.take_roster(read_roster(b"pseudonym,email\nlzak,new@clinic.example\n")[0])
    known = accounts_in(people.names())[key]
    assert known[Account.EMAIL] == "new@clinic.example"
    assert known[Account.IDNUMBER] == "007"
    assert people.everybody(names=True)[0].name == "Łukasz Żak"
    outside = (path for path in people.folder.iterdir() if path.name != "names.json")
    assert all(b"clinic.example" not in path.read_bytes() for path in outside if path.is_file())


def test_identifiers_come_back_with_a_backup(
    tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "one"))
    (tmp_path / "records").mkdir()
    People().take_roster(read_roster(ENGLISH.encode())[0])
    backup(tmp_path / "all.acusbackup", tmp_path / "records", People())
    before = People().names()
    assert len(before) == 8
    monkeypatch.setenv("ACUS_DATA", str(tmp_path / "other"))
    restore_backup(tmp_path / "all.acusbackup", tmp_path / "records", people=People())
    assert People().names() == before


def test_a_row_with_two_faults_tells_both():
    errors = read_roster(b"pseudonym,pin,email\nada,12,nowhere\n")[1]
    assert len(errors) == 1
    assert errors[0].startswith("line 2: ada: ")
    assert "'nowhere' is no e-mail address" in errors[0]
