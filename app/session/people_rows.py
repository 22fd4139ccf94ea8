"""All that a list of people holds, as rows: read from a foreign file, checked, merged, written new.

Nothing of a foreign file is taken but the values of the columns that this program knows: no other
table, no trigger, no setting of the database.
"""

from __future__ import annotations

import sqlite3
from collections.abc import Mapping, Sequence
from contextlib import closing
from dataclasses import dataclass, field
from pathlib import Path
from typing import Final

from app.core.messages import counted, sentence, sentence_of
from app.session.backup_file import ArchiveError
from app.session.errors import PeopleError
from app.session.people import OF_PERSON, VERSION, People, tables
from app.session.roster import checked_pseudonym, looks_like_a_key
from app.session.school_tables import (
    COUNTED,
    EXCESS,
    NUMBERS,
    SCHOOL,
    SIGNED_REMARKS,
    STATIONS,
    TOMBSTONES,
)
from app.session.stations import NAME_SETTING

Rows = tuple[tuple[str | int | float | None, ...], ...]

_TOLD: Final = 5
"""So many names are told."""


@dataclass(frozen=True)
class PeopleRows:
    """Rows by table, with the columns in the order of `people.tables`."""

    by_table: Mapping[str, Rows] = field(default_factory=dict)

    def rows(self, table: str) -> Rows:
        """Return the rows of a table."""
        return self.by_table.get(table, ())

    def ids(self, table: str) -> frozenset[str]:
        """Return the first column of a table."""
        return frozenset(str(row[0]) for row in self.rows(table))


def read_rows(path: Path, whose: str) -> PeopleRows:
    """Read a list of people that may be anything.

    Args:
        path: the file.
        whose: it is, for messages.

    Raises:
        ArchiveError: if it is empty, damaged, of a newer version, or no list of people.
    """
    try:
        with closing(sqlite3.connect(f"{path.absolute().as_uri()}?mode=ro", uri=True)) as source:
            source.execute("PRAGMA trusted_schema = OFF")
            version = int(source.execute("PRAGMA user_version").fetchone()[0])
            if version > VERSION:
                raise ArchiveError(
                    sentence(
                        "the people of {whose} were written by a newer version of Acus: use that "
                        "version; nothing was changed",
                        whose=whose,
                    )
                )
            if source.execute("PRAGMA quick_check").fetchone()[0] != "ok" or version < 1:
                raise ArchiveError(
                    _no_people(whose, sentence("it is empty, or of another program"))
                )
            kinds = dict(source.execute("SELECT name, type FROM sqlite_master").fetchall())
            return PeopleRows(
                {
                    name: _table(source, name, columns, whose)
                    for name, columns in _columns().items()
                    if _is_table(kinds, name, whose, version)
                }
            )
    except (sqlite3.Error, UnicodeError) as error:  # of a text, or of a name in its definition
        raise ArchiveError(_no_people(whose, sentence_of(error))) from error


def merged(here: PeopleRows, there: PeopleRows) -> PeopleRows:
    """Return the people of a backup in the place of those who are here.

    Persons and groups are those of the backup. What was said of attempts stays where the backup
    says nothing. A password is never taken away, erasures are those of both, and who was erased is
    in neither.
    """
    found = {name: there.rows(name) for name in ("persons", "members")}
    for name in ("remarks", "admitted", "erased", "erased_attempts", COUNTED, TOMBSTONES, EXCESS):
        found[name] = _union(here.rows(name), there.rows(name))
    found[SIGNED_REMARKS] = _latest(here.rows(SIGNED_REMARKS), there.rows(SIGNED_REMARKS))
    revoked = _columns()[STATIONS].index("revoked")
    still = tuple(row for row in here.rows(STATIONS) if row[revoked])
    found[STATIONS] = _union(_union(here.rows(STATIONS), there.rows(STATIONS)), still)
    found["failures"] = here.rows("failures")
    password = "password" in there.ids("settings")
    taken = there if password else here
    found["settings"] = tuple(
        row for row in taken.rows("settings") if row[0] in ("password", "wrapped")
    ) + tuple(row for row in here.rows("settings") if row[0] == NAME_SETTING)
    gone = {str(row[0]) for row in found["erased"]}
    for name, column in OF_PERSON.items():
        place = _columns()[name].index(column)
        found[name] = tuple(row for row in found[name] if row[place] not in gone)
    lost = {str(row[0]) for row in found["erased_attempts"]}
    for name in ("remarks", "admitted", SIGNED_REMARKS, COUNTED, EXCESS):
        found[name] = tuple(row for row in found[name] if row[0] not in lost)
    return PeopleRows(found)


def untaken(of: PeopleRows, left: PeopleRows, whose: str) -> list[str]:
    """Say what of one list is not in another, a line each.

    Args:
        of: the list that is told of.
        left: the list that is here in the end.
        whose: the first one is, such as "of the backup".
    """
    gone = left.ids("erased")
    lines: list[str] = []
    persons = {str(row[0]): str(row[1]) for row in of.rows("persons")}
    missing = [persons[key] for key in sorted(persons) if key not in left.ids("persons") | gone]
    if missing:
        shown = ", ".join(sorted(missing)[:_TOLD]) + (", …" if len(missing) > _TOLD else "")
        words = count_words(len(missing), "student", whose)
        lines.append(
            sentence(
                "{students} ({shown}): their attempts are nobody's here",
                students=words,
                shown=shown,
            )
        )
    there, known = _said(of), _said(left)
    lost = left.ids("erased_attempts")
    for place, word in enumerate(("comment", "void mark", "release")):
        some = [
            name
            for name, said in there.items()
            if said[place] and name not in lost and known.get(name, _NOTHING)[place] != said[place]
        ]
        lines += [count_words(len(some), word, whose)] if some else []
    for table, word in (("members", "membership"), ("admitted", "admission")):
        others = [row for row in of.rows(table) if row not in left.rows(table)]
        others = [row for row in others if not gone & {*map(str, row)}]
        lines += [count_words(len(others), word, whose)] if others else []
    return lines


def count_words(count: int, word: str, whose: str) -> str:
    """Return "1 comment of the backup", or "2 comments of the backup"."""
    return {
        "admission": counted("{n} admission {whose}", "{n} admissions {whose}", count, whose=whose),
        "attempt": counted("{n} attempt {whose}", "{n} attempts {whose}", count, whose=whose),
        "comment": counted("{n} comment {whose}", "{n} comments {whose}", count, whose=whose),
        "membership": counted(
            "{n} membership {whose}", "{n} memberships {whose}", count, whose=whose
        ),
        "name": counted("{n} name {whose}", "{n} names {whose}", count, whose=whose),
        "release": counted("{n} release {whose}", "{n} releases {whose}", count, whose=whose),
        "student": counted("{n} student {whose}", "{n} students {whose}", count, whose=whose),
        "void mark": counted("{n} void mark {whose}", "{n} void marks {whose}", count, whose=whose),
    }[word]


def write_rows(rows: PeopleRows, path: Path) -> None:
    """Write a new list of people with these rows, by this program's own definition.

    Raises:
        DatabaseError: if it cannot be written.
    """
    database = People(path.parent).database
    with database.write() as connection:
        for name, columns in _columns().items():
            values = [dict(zip(columns, row, strict=True)) for row in rows.rows(name)]
            if values:
                connection.execute(tables()[name].insert(), values)
    database.close()


_NOTHING: Final = ("", "", False)


def _said(rows: PeopleRows) -> dict[str, tuple[str, str, bool]]:
    return {
        str(name): (str(comment), str(void), bool(released))
        for name, comment, void, released in rows.rows("remarks")
    }


def _union(first: Rows, second: Rows) -> Rows:
    """Return rows of both by their first column; the second list's where both have one."""
    return tuple({row[0]: row for row in (*first, *second)}.values())


def _latest(first: Rows, second: Rows) -> Rows:
    """Return signed remarks of both, of each the one with the higher counter."""
    counter = _columns()[SIGNED_REMARKS].index("counter")
    rows = sorted((*first, *second), key=lambda row: int(row[counter] or 0))
    return tuple({(row[0], row[1]): row for row in rows}.values())


def _columns() -> dict[str, Sequence[str]]:
    return {name: [column.name for column in table.columns] for name, table in tables().items()}


def _is_table(kinds: Mapping[str, str], name: str, whose: str, version: int) -> bool:
    if name in SCHOOL and version < VERSION and name not in kinds:
        return False  # it was written before there were such tables
    if kinds.get(name) != "table":
        raise ArchiveError(_no_people(whose, sentence("it has no table {name!r}", name=name)))
    return True


def _table(source: sqlite3.Connection, name: str, columns: Sequence[str], whose: str) -> Rows:
    """Read the known columns of a table; every value is text or a number."""
    # by its table: SQLite takes a bare name in quotes that is no column for a text
    wanted = ", ".join(f'"{name}"."{column}"' for column in columns)
    numbers = {"released", "wrong", "last", *NUMBERS}
    found = []
    for row in source.execute(f'SELECT {wanted} FROM "{name}"'):
        for column, value in zip(columns, row, strict=True):
            kinds: tuple[type, ...] = (int, float) if column in numbers else (str,)
            if not isinstance(value, kinds):
                text = f"{name}.{column} holds {value!r:.40}"
                raise ArchiveError(_no_people(whose, text))
        found.append(tuple(row))
    if name == "persons":
        _check_persons([(str(row[0]), str(row[1])) for row in found], whose)
    return tuple(found)


def _check_persons(persons: Sequence[tuple[str, str]], whose: str) -> None:
    """Let only keys and pseudonyms go on that a roster could have brought, each once."""
    names = set()
    for key, pseudonym in persons:
        if not looks_like_a_key(key):
            raise ArchiveError(
                _no_people(whose, sentence("persons.key holds {key!r}", key=key[:40]))
            )
        try:
            names.add(checked_pseudonym(pseudonym).casefold())
        except PeopleError as error:
            raise ArchiveError(
                _no_people(whose, sentence("persons.pseudonym: {error}", error=error))
            ) from error
    if len(names) < len(persons):
        raise ArchiveError(_no_people(whose, sentence("persons.pseudonym holds one twice")))


def _no_people(whose: str, reason: str) -> str:
    return sentence(
        "the people of {whose} cannot be restored: {reason}; nothing was changed",
        whose=whose,
        reason=reason,
    )
