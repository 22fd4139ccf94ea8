"""Pseudonyms and PINs that can be, and rosters of students as CSV."""

from __future__ import annotations

import csv
import io
import re
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field, replace
from pathlib import Path
from typing import Final

from app.core.files import read_at_most
from app.core.messages import sentence
from app.session.accounts import Account
from app.session.errors import PeopleError
from app.session.header import LONGEST_PSEUDONYM
from app.session.roster_headings import columns_of

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
    try:
        return read_roster(read_at_most(path))
    except OSError as error:
        raise PeopleError(
            sentence(
                "cannot read {path}: {error_strerror}",
                path=path,
                error_strerror=error.strerror or error,
            )
        ) from error


def read_roster(data: bytes) -> tuple[list[RosterLine], list[str]]:
    """Read a roster: CSV with a heading, separated by commas, semicolons or tabs.

    Columns: `pseudonym` (needed), `name`, `pin` (4 to 12 digits; drawn where it is empty), `group`
    (several separated by `|`), `username`, `email`, `idnumber`; or those of Moodle
    (`roster_headings`).

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
        wrong = judged_lines([line])[1] or _wrong_accounts(line, holders)
        if wrong:
            errors.append(f"line {number}: {wrong[0]}")
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
