"""Pseudonyms and PINs that can be, and rosters of students as CSV.

A roster has this program's own headings, or those of Moodle in English, German and French. Moodle's
participants and grades leave with the headings of its language (`First name`, `Last name` or,
before 4.0, `Surname`, `Email address`, `ID number`, `Username`, `Groups`); its upload of users has
short ones (`firstname`, `lastname`, `group1`). Whatever else such a file holds is left alone.
"""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Final

from app.core.errors import reading
from app.core.files import read_at_most
from app.core.messages import sentence
from app.session.accounts import Account
from app.session.errors import PeopleError
from app.session.header import LONGEST_PSEUDONYM

_PSEUDONYM: Final = re.compile(r"\w(?:[\w .@+-]*[\w.@+-])?")
_KEY: Final = re.compile(r"p-[0-9a-f]{12}")
_PIN: Final = re.compile(r"[0-9]{4,12}")


@dataclass(frozen=True, slots=True)
class RosterLine:
    """One row of a roster: pseudonym, name, PIN (empty: drawn), groups, what others call him."""

    pseudonym: str
    name: str = ""
    pin: str = ""
    groups: tuple[str, ...] = ()
    accounts: Mapping[Account, str] = field(default_factory=dict, repr=False)


def checked_pin(pin: str, whose: str = "") -> str:
    """Return a PIN.

    Raises:
        PeopleError: if it is none; begins with `whose`.
    """
    if not _PIN.fullmatch(pin):
        raise PeopleError(sentence("{whose}a PIN has 4 to 12 digits", whose=whose))
    return pin


def checked_pseudonym(text: str) -> str:
    """Return a pseudonym without blanks round it.

    Raises:
        PeopleError: if it is empty, a path, too long, or looks like a key.
    """
    found = text.strip()
    if not found:
        raise PeopleError(sentence("the pseudonym is empty: give one"))
    if len(found) > LONGEST_PSEUDONYM:
        raise PeopleError(
            sentence(
                "the pseudonym {beginning!r}… has over {longest_pseudonym} characters",
                beginning=found[:20],
                longest_pseudonym=LONGEST_PSEUDONYM,
            )
        )
    if not _PSEUDONYM.fullmatch(found) or ".." in found:
        raise PeopleError(
            sentence(
                "{pseudonym!r} cannot be a pseudonym: letters, digits, blanks and . _ @ + - only, "
                "beginning with a letter or digit",
                pseudonym=found,
            )
        )
    if _KEY.fullmatch(found):
        raise PeopleError(
            sentence(
                "{pseudonym!r} looks like a key of this program: choose another pseudonym",
                pseudonym=found,
            )
        )
    return found


def looks_like_a_key(text: str) -> bool:
    """Return whether a record that names this was made by somebody who had signed in."""
    return _KEY.fullmatch(text) is not None


def roster_in(path: Path) -> tuple[list[RosterLine], list[str]]:
    """Read a roster's file, as `read_roster`; one that is larger than any course is refused.

    Raises:
        PeopleError: if the file cannot be read, or is larger.
    """
    with reading(path, PeopleError):
        return read_roster(read_at_most(path))


def read_roster(data: bytes) -> tuple[list[RosterLine], list[str]]:
    """Read a roster: CSV with a heading, separated by commas, semicolons or tabs.

    Columns: `pseudonym` (needed), `name`, `pin` (4 to 12 digits; drawn where it is empty), `group`
    (several separated by `|`), `username`, `email`, `idnumber`; or those of Moodle
    (see above).

    Returns:
        Its rows, and one line for each row that cannot be read.
    """
    try:
        text = data.decode("utf-16" if data[:2] in (b"\xff\xfe", b"\xfe\xff") else "utf-8-sig")
    except UnicodeDecodeError as error:
        place = data[: error.start].count(b"\n") + 1
        return [], [f"line {place}: the roster is not UTF-8: save it as “CSV UTF-8” and try again"]
    if "\0" in text:
        return [], ["the roster is no text: save it as “CSV UTF-8” and try again"]
    heading = text.split("\n", 1)[0]
    separator = max(",;\t", key=heading.count)
    rows = csv.reader(io.StringIO(text, newline=""), delimiter=separator)
    try:
        table = [(rows.line_num, [cell.strip() for cell in row]) for row in rows]
    except csv.Error as error:
        return [], [f"line {rows.line_num}: {error}: save the roster anew as “CSV UTF-8”"]
    columns = columns_of(table[0][1] if table else ())
    if not columns.fields:
        return [], list(columns.errors)
    errors, width = list(columns.errors), len(columns.fields)
    found: dict[str, RosterLine] = {}
    holders: dict[tuple[Account, str], str] = {}
    for number, row in table[1:]:
        if not any(row):
            errors.append(f"line {number}: the row is empty: delete it")
            continue
        if len(row) != width:
            errors.append(f"line {number}: {len(row)} cells, the heading has {width}")
            continue
        cells, sign = columns.cells(row), columns.between_groups
        groups = cells.get("groups", cells.get("group", "")).split(sign)
        line = RosterLine(
            cells["pseudonym"],
            cells.get("name", ""),
            cells.get("pin", ""),
            tuple(sorted({group.strip() for group in groups if group.strip()})),
            {kind: cells[kind] for kind in Account if cells.get(kind)},
        )
        wrong = [*judged_lines([line])[1], *_wrong_accounts(line, holders)]
        if wrong:
            errors.append(f"line {number}: {'; '.join(wrong)}")
        elif line.pseudonym.casefold() in found:
            errors.append(f"line {number}: {line.pseudonym!r} stands there twice: delete one row")
        else:
            found[line.pseudonym.casefold()] = line
            holders |= {(k, v.casefold()): line.pseudonym for k, v in line.accounts.items()}
    return list(found.values()), errors


def _wrong_accounts(line: RosterLine, holders: Mapping[tuple[Account, str], str]) -> list[str]:
    """Say which identifier of a row is none, or another row's."""
    email = line.accounts.get(Account.EMAIL, "@")
    if "@" not in email:
        return [sentence("{email!r} is no e-mail address: correct it", email=email)]
    return [
        sentence(
            "the {kind} {identifier!r} is that of {holder!r} too: correct one of them",
            kind=kind.value,
            identifier=value,
            holder=holders[kind, value.casefold()],
        )
        for kind, value in line.accounts.items()
        if (kind, value.casefold()) in holders
    ]


def judged_lines(lines: Sequence[RosterLine]) -> tuple[list[RosterLine], list[str]]:
    """Return the lines that can be taken, and what is wrong with the others."""
    good: dict[str, RosterLine] = {}
    errors = []
    for line in lines:
        try:
            pseudonym = checked_pseudonym(line.pseudonym)
            if line.pin:
                checked_pin(line.pin, f"{pseudonym}: ")
            if pseudonym.casefold() in good:
                raise PeopleError(
                    sentence(
                        "{pseudonym!r} stands there twice: delete one row", pseudonym=pseudonym
                    )
                )
            good[pseudonym.casefold()] = replace(line, pseudonym=pseudonym)
        except PeopleError as error:
            errors.append(str(error))
    return list(good.values()), errors


# --- headings ---------------------------------------------------------------------------------
_FIELDS: Final = ("pseudonym", "name", "pin", "group")
_OWN: Final = (*_FIELDS, *Account)

_MOODLE: Final[Mapping[str, tuple[str, ...]]] = {
    "first": ("first name", "firstname", "vorname", "prénom"),
    "last": ("last name", "lastname", "surname", "nachname", "nom de famille", "nom"),
    Account.USERNAME: ("username", "anmeldename", "nom d'utilisateur"),
    Account.EMAIL: (
        *("email address", "email", "e-mail-adresse", "e-mail", "adresse e-mail"),
        *("adresse de courriel", "courriel"),
    ),
    Account.IDNUMBER: ("id number", "idnumber", "id-nummer", "numéro d'identification"),
    "groups": ("groups", "group", "group1", "gruppen", "gruppe", "groupes", "groupe"),
    "pseudonym": ("pseudonym",),
    "pin": ("pin",),
}
_FIELD_OF: Final = {heading: field for field, some in _MOODLE.items() for heading in some}
_FIRST_AND_LAST: Final = {heading for field in ("first", "last") for heading in _MOODLE[field]}


@dataclass(frozen=True, slots=True)
class Columns:
    """What each column of a roster holds.

    Attributes:
        fields: of `_FIELDS` and `Account`, `first`, `last`, `groups`, or empty for a column that is
            left alone.
        by: the field whose value is the pseudonym.
        errors: why the heading cannot be used, one line each; empty if it can.
    """

    fields: tuple[str, ...] = ()
    by: str = "pseudonym"
    errors: tuple[str, ...] = ()

    def cells(self, row: Sequence[str]) -> dict[str, str]:
        """Return the cells of a row by field; first and last name as one name."""
        cells = {field: cell for field, cell in zip(self.fields, row, strict=True) if field}
        cells["pseudonym"] = cells.get(self.by, "")
        first, last = cells.pop("first", ""), cells.pop("last", "")
        if first or last:
            cells["name"] = f"{first} {last}".strip()
        return cells

    @property
    def between_groups(self) -> str:
        """Return what separates groups in a cell."""
        return "," if "groups" in self.fields else "|"


def columns_of(heading: Sequence[str]) -> Columns:
    """Return what the columns of a roster hold, by its heading."""
    names = [name.casefold().replace("’", "'") for name in heading]
    if _FIRST_AND_LAST.isdisjoint(names) and (
        "pseudonym" in names or not {"username", "email address"} & set(names)
    ):
        return _own(names)
    fields = [_FIELD_OF.get(name, "") for name in names]
    twice = next((names[at] for at, f in enumerate(fields) if f and f in fields[:at]), None)
    if twice is not None:
        line = sentence(
            "line 1: the column {column!r} holds what another one does: delete one", column=twice
        )
        return Columns(errors=(line,))
    for by in ("pseudonym", Account.USERNAME, Account.IDNUMBER):
        if by in fields:
            return Columns(tuple(fields), by)
    line = sentence(
        "line 1: this is a table of Moodle without user names and ID numbers, and screens show "
        "neither names nor e-mail addresses: add a column pseudonym, or export it with Username"
    )
    return Columns(errors=(line,))


def _own(names: Sequence[str]) -> Columns:
    if "pseudonym" not in names:
        wanted = ", ".join(_OWN)
        line = sentence(
            "line 1: the heading needs the column pseudonym; columns are {wanted}", wanted=wanted
        )
        return Columns(errors=(line,))
    errors = tuple(
        sentence(
            "line 1: column {column!r} is not known; columns are {wanted}",
            column=name,
            wanted=", ".join(_OWN),
        )
        for name in names
        if name and name not in _OWN
    )
    return Columns(tuple(name if name in _OWN else "" for name in names), errors=errors)
