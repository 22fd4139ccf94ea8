"""People: students by pseudonym and PIN, groups, the instructor, and what is said of attempts.

An SQLite file in the user's data folder holds them; names stand in a file of their own
(`names.json`, by random key), so that everything else can be shown and copied without them. A
record of somebody who signed in holds the random key only. PINs and the password are kept as
Argon2id hashes (RFC 9106). They guard against curiosity, not against the owner of the disk: whoever
can read these files can replace them.
"""

from __future__ import annotations

import errno
import json
import os
import secrets
import time
from collections.abc import Callable, Iterator, Mapping, Sequence
from contextlib import contextmanager
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime, timedelta
from functools import cache
from pathlib import Path
from types import MappingProxyType
from typing import TYPE_CHECKING, Any, Final
from uuid import uuid4

from app.core import paths
from app.core.files import BINARY, beside, step
from app.core.messages import sentence
from app.core.words import name_order
from app.session.accounts import entry_of, owner_of
from app.session.audit import note
from app.session.database import BUSY_SECONDS, Database, number, words
from app.session.errors import PeopleError
from app.session.journal import Journal, Step, move, removal, settle
from app.session.roster import RosterLine, checked_pin, checked_pseudonym, judged_lines
from app.session.school_tables import (
    COUNTED,
    EXCESS,
    SIGNED_REMARKS,
    TOMBSTONES,
    Tombstone,
    add_tables,
)
from app.session.statement_queue import FOLDER, StatementQueue
from app.session.station import StationKey, new_recovery_key, opens
from app.session.tries import (
    INSTRUCTOR,
    NO_SIGN_IN,
    Tries,
    WrongPasswordError,
    hashed_secret,
    matches,
    stranger,
)

if TYPE_CHECKING:
    from sqlalchemy import Connection, MetaData, Table

PEOPLE: Final = "people.sqlite"
NAMES_FILE: Final = "names.json"

VERSION: Final = 3
"""Of the tables; a file of a later one is left alone."""
_SHORTEST_PASSWORD: Final = 8


@dataclass(frozen=True, slots=True)
class Person:
    """A student.

    Attributes:
        key: random; what records hold.
        pseudonym: what screens show.
        groups: names, sorted.
        name: as the roster says; empty where there is none, or nobody asked for it.
        has_pin: whether signing in needs one.
    """

    key: str
    pseudonym: str
    groups: tuple[str, ...] = ()
    name: str = field(default="", repr=False)
    has_pin: bool = True


@dataclass(frozen=True, slots=True)
class RosterReport:
    """What became of a roster.

    Attributes:
        added: pseudonyms that are new.
        updated: that were there already; name and groups are those of the roster now.
        pins: drawn PINs by pseudonym, to be handed out; they are kept nowhere.
        errors: one line each.
    """

    added: tuple[str, ...] = ()
    updated: tuple[str, ...] = ()
    pins: Mapping[str, str] = field(default_factory=lambda: MappingProxyType({}))
    errors: tuple[str, ...] = ()


@dataclass(frozen=True, slots=True)
class Remarks:
    """What the instructor has said of an attempt.

    Attributes:
        comment: text; empty without one.
        void: why it does not count; empty if it does.
        released: whether the student may see its result in an assessment.
        excess: why it does not count although nobody declared it void: it is beyond what a course
            allows at all stations together; else empty.
    """

    comment: str = ""
    void: str = ""
    released: bool = False
    excess: str = ""

    @property
    def uncounted(self) -> str:
        """Return why it does not count; empty if it does."""
        return self.void or self.excess


NOTHING_SAID: Final = Remarks()


class People:
    """Everybody who is known here.

    Args:
        folder: of the files; `people` in the user's data folder by default.
        clock: wall-clock time [s], for delays after wrong tries.
        busy: seconds to wait for another program.
    """

    def __init__(
        self,
        folder: Path | None = None,
        clock: Callable[[], float] = time.time,
        busy: float = BUSY_SECONDS,
    ) -> None:
        self.folder = folder or people_folder()
        settle(self.folder)
        self._clock = clock
        self.database = Database(self.folder / PEOPLE, _tables, VERSION, "list of people", busy)

    # --- the instructor ---------------------------------------------------------------------------
    def has_instructor(self) -> bool:
        """Return whether a password is set: without one everybody may do everything, as before."""
        return (self.folder / PEOPLE).exists() and bool(self._setting("password"))

    def set_instructor(self, password: str) -> str:
        """Set the first password; returns the recovery key, to be printed and locked away.

        Raises:
            PeopleError: if there is a password already, or it is too short.
        """
        _checked_password(password)
        recovery = new_recovery_key()
        wrapped = StationKey.of(self.folder).wrapped(recovery)
        with self.database.write() as connection:
            if _setting(connection, "password"):
                raise PeopleError(
                    sentence("there is an instructor already: change the password instead")
                )
            _set(connection, "password", hashed_secret(password))
            _set(connection, "wrapped", json.dumps(wrapped))
        note("password set", folder=self.folder)
        return recovery

    def check_instructor(self, password: str) -> str:
        """Let the instructor in.

        Returns:
            Why wrong tries are not kept, to be said; empty if they are.

        Raises:
            WrongPasswordError: with how long to wait for the next try.
            PeopleError: if no password is set.
        """
        known = self._setting("password")
        if not known:
            raise PeopleError(
                sentence("no instructor is set: `acus people instructor` sets a password")
            )
        return self._tries().compare(INSTRUCTOR, known, password)

    def change_password(self, old: str, new: str) -> str:
        """Change the password; the recovery key stays.

        Returns:
            A new recovery key where an earlier build had sealed the station's key, in a form that
            nothing reads any more; else empty.

        Raises:
            WrongPasswordError, PeopleError: as `check_instructor`, or if the new one is too short.
            SignatureError: if the station's key cannot be sealed anew.
        """
        _checked_password(new)
        self.check_instructor(old)
        wrapped = self.wrapped_key()
        recovery = new_recovery_key() if wrapped and not opens(wrapped) else ""
        anew = json.dumps(StationKey.of(self.folder).wrapped(recovery)) if recovery else ""
        with self.database.write() as connection:
            _set(connection, "password", hashed_secret(new))
            if anew:
                _set(connection, "wrapped", anew)
        note("password changed", folder=self.folder)
        return recovery

    def recover(self, recovery: str, new: str) -> None:
        """Set another password with the recovery key.

        Raises:
            SignatureError: for a wrong key.
            PeopleError: if the new password is too short, none was ever set, or an earlier build
                set it, whose recovery keys are no longer read.
        """
        _checked_password(new)
        wrapped = self.wrapped_key()
        if not wrapped:
            raise PeopleError(
                sentence("no instructor is set: `acus people instructor` sets a password")
            )
        if not opens(wrapped):
            raise PeopleError(
                sentence(
                    "this recovery key is one of an earlier build, in a form that is no longer "
                    "read: change the password with the one that holds (`acus people "
                    "instructor`), which prints a new recovery key; if nobody knows it, move "
                    "{folder} away and begin a new list of people",
                    folder=self.folder / PEOPLE,
                )
            )
        StationKey.unwrapped(wrapped, recovery)
        with self.database.write() as connection:
            _set(connection, "password", hashed_secret(new))
            connection.execute(_failures().delete())
        note("password recovered", folder=self.folder)

    def wrapped_key(self) -> dict[str, str]:
        """Return the station's key under the recovery key, for a backup; empty without one."""
        text = self._setting("wrapped")
        return dict(json.loads(text)) if text else {}

    # --- students ---------------------------------------------------------------------------------
    def everybody(self, names: bool = False) -> list[Person]:
        """Return all students by pseudonym; with their names if the instructor asks."""
        if not (self.folder / PEOPLE).exists():
            return []
        from sqlalchemy import select

        t = _tables().tables
        with self.database.read() as connection:
            rows = list(connection.execute(select(t["persons"])))
            members: dict[str, list[str]] = {}
            for person, group in connection.execute(select(t["members"])):
                members.setdefault(person, []).append(group)
        known = self.names() if names else {}
        found = [
            Person(
                key=row.key,
                pseudonym=row.pseudonym,
                groups=tuple(sorted(members.get(row.key, ()))),
                name=known.get(row.key, ""),
                has_pin=bool(row.pin),
            )
            for row in rows
        ]
        return sorted(found, key=lambda person: name_order(person.pseudonym))

    def find(self, pseudonym: str) -> Person:
        """Return a student by pseudonym, in whatever case, or by key.

        Raises:
            PeopleError: if there is none; names some that there are.
        """
        everybody = self.everybody()
        wanted = pseudonym.strip().casefold()
        for person in everybody:
            if wanted in (person.pseudonym.casefold(), person.key):
                return person
        some = ", ".join(person.pseudonym for person in everybody[:5]) or "nobody"
        raise PeopleError(
            sentence(
                "{pseudonym!r} is no student here; there: {some}", pseudonym=pseudonym, some=some
            )
        )

    def add(self, line: RosterLine) -> tuple[Person, str]:
        """Add one student; returns the PIN as well, drawn if the line has none.

        Raises:
            PeopleError: if the pseudonym is taken or cannot be one, or the PIN cannot.
        """
        report = self.take_roster([line])
        if report.errors:
            raise PeopleError(report.errors[0])
        if report.updated:
            raise PeopleError(_taken(line.pseudonym))
        return self.find(line.pseudonym), report.pins.get(line.pseudonym, line.pin)

    def take_roster(self, lines: Sequence[RosterLine], partly: bool = False) -> RosterReport:
        """Add the students of a roster in one transaction; those that are there are updated.

        Args:
            lines: of the roster.
            partly: take the right lines although others are wrong; else one error and nothing is
                taken.
        """
        good, errors = judged_lines(lines)
        if errors and not partly:
            return RosterReport(errors=tuple(errors))
        from sqlalchemy import insert, select, update

        t = _tables().tables
        persons, members = t["persons"], t["members"]
        added, updated = [], []
        new_keys: list[str] = []
        changed: list[str] = []
        pins: dict[str, str] = {}
        hashed = {}
        there = {person.pseudonym.casefold() for person in self.everybody()}
        for line in good:  # outside the transaction: a hash takes its time on purpose
            if line.pin or line.pseudonym.casefold() not in there:
                pin = line.pin or f"{secrets.randbelow(10**6):06d}"
                hashed[line.pseudonym] = hashed_secret(pin)
                pins |= {} if line.pin else {line.pseudonym: pin}
        with self.as_one() as (connection, write_names):
            known = {
                row.pseudonym.casefold(): row.key for row in connection.execute(select(persons))
            }
            names = self.names()
            for line in good:
                key = known.get(line.pseudonym.casefold())
                if key is None:
                    key = f"p-{secrets.token_hex(6)}"
                    row = {"key": key, "pseudonym": line.pseudonym, "pin": hashed[line.pseudonym]}
                    connection.execute(insert(persons), row | {"created": _now()})
                    added.append(line.pseudonym)
                    new_keys.append(key)
                else:
                    pins.pop(line.pseudonym, None)
                    if line.pin:
                        new = update(persons).where(persons.c.key == key)
                        connection.execute(new.values(pin=hashed[line.pseudonym]))
                    if line.groups:
                        connection.execute(members.delete().where(members.c.person == key))
                    updated.append(line.pseudonym)
                    changed.append(key)
                if line.groups:
                    rows = [{"person": key, "grp": group} for group in line.groups]
                    connection.execute(insert(members), rows)
                if line.name:
                    names[key] = line.name
                names |= {entry_of(key, kind): value for kind, value in line.accounts.items()}
            write_names(names)
        for what, keys in (("students added", new_keys), ("students changed", changed)):
            if keys:
                note(what, keys, self.folder)
        pinned = MappingProxyType(pins)
        return RosterReport(tuple(added), tuple(updated), pinned, tuple(errors))

    def set_pin(self, pseudonym: str, pin: str) -> None:
        """Give a student another PIN.

        Raises:
            PeopleError: if there is no such student, or it cannot be one.
        """
        from sqlalchemy import update

        person, table = self.find(pseudonym), _tables().tables["persons"]
        hashed = hashed_secret(checked_pin(pin))
        with self.database.write() as connection:
            connection.execute(update(table).where(table.c.key == person.key).values(pin=hashed))
            connection.execute(_failures().delete().where(_failures().c.account == person.key))
        note("PIN set", [person.key], self.folder)

    def rename(self, pseudonym: str, new: str) -> Person:
        """Give a student another pseudonym; attempts stay theirs, for records hold a key.

        Raises:
            PeopleError: if there is no such student, or the new one is taken or cannot be one.
        """
        from sqlalchemy import select, update

        person, wanted = self.find(pseudonym), checked_pseudonym(new)
        persons = _tables().tables["persons"]
        with self.database.write() as connection:
            rows = connection.execute(select(persons.c.key, persons.c.pseudonym))
            if any(
                one.pseudonym.casefold() == wanted.casefold() and one.key != person.key
                for one in rows
            ):
                raise PeopleError(_taken(wanted))
            named = update(persons).where(persons.c.key == person.key)
            connection.execute(named.values(pseudonym=wanted))
        note("student renamed", [person.key], self.folder)
        return self.find(wanted)

    def sign_in(self, pseudonym: str, pin: str) -> Person:
        """Let a student in.

        Raises:
            WrongPasswordError: with how long to wait for the next try; it does not tell whether
                there is such a student.
        """
        from sqlalchemy import select

        if not (self.folder / PEOPLE).exists():
            matches("", pin)
            raise WrongPasswordError(
                sentence("{no_sign_in}: try again", no_sign_in=NO_SIGN_IN)
            )  # and no file is made of it
        table = _tables().tables["persons"].c
        with self.database.read() as connection:
            pins = {str(k): str(p) for k, p in connection.execute(select(table.key, table.pin))}
        try:
            person = self.find(pseudonym)
        except PeopleError:
            person = None
        account = stranger(pseudonym) if person is None else person.key
        self._tries().compare(account, pins.get(account, ""), pin)
        if person is None:  # whose PIN nobody knows
            raise WrongPasswordError(NO_SIGN_IN)
        note("signed in", [person.key], self.folder)
        return person

    def pseudonyms(self) -> dict[str, str]:
        """Return the pseudonyms by key, which is what records name."""
        return {person.key: person.pseudonym for person in self.everybody()}

    # --- attempts ---------------------------------------------------------------------------------
    def remarks(self) -> dict[str, Remarks]:
        """Return what the instructor has said, by id of the attempt."""
        if not (self.folder / PEOPLE).exists():
            return {}
        from sqlalchemy import select

        t = _tables().tables
        with self.database.read() as connection:
            rows = connection.execute(select(t["remarks"]))
            said = {row.attempt: Remarks(row.comment, row.void, row.released) for row in rows}
            for attempt, course, attempts in connection.execute(select(t[EXCESS])):
                why = sentence(
                    "beyond the {attempts} attempts that the course {course} allows at all "
                    "stations together",
                    attempts=attempts,
                    course=course,
                )
                said[attempt] = replace(said.get(attempt, NOTHING_SAID), excess=why)
        return said

    def remark(self, attempt: str, **message: str | bool) -> None:
        """Say something of an attempt: `comment`, `void` (with a reason) or `released`."""
        self.remark_all([attempt], **message)

    def remark_all(self, attempts: Sequence[str], **message: str | bool) -> None:
        """Say the same of several attempts, of all or of none."""
        from sqlalchemy.dialects.sqlite import insert

        table = _tables().tables["remarks"]
        new = {"comment": "", "void": "", "released": False} | message
        with self.database.write() as connection:
            for attempt in attempts:
                put = insert(table).values(attempt=attempt, **new)
                connection.execute(put.on_conflict_do_update(["attempt"], set_=message))
        note("attempts remarked", attempts, self.folder)

    def admitted(self) -> list[tuple[str, str, str, str, str]]:
        """Return what was admitted (`admission`): attempt, record, reason, time and seal."""
        if not (self.folder / PEOPLE).exists():
            return []
        from sqlalchemy import select

        t = _tables().tables["admitted"].c
        wanted = select(t.attempt, t.record, t.why, t.time, t.seal)
        with self.database.read() as connection:
            return [
                (str(a), str(record), str(why), str(time), str(seal))
                for a, record, why, time, seal in connection.execute(wanted)
            ]

    def admit(self, rows: Sequence[tuple[str, str, str, str, str]]) -> None:
        """Keep what was admitted, all or nothing; `admission.admit` seals it."""
        from sqlalchemy.dialects.sqlite import insert

        table = _tables().tables["admitted"]
        names = ("attempt", "record", "why", "time", "seal")
        with self.database.write() as connection:
            for row in rows:
                values = dict(zip(names, row, strict=True))
                put = insert(table).values(**values)
                connection.execute(put.on_conflict_do_update(["attempt"], set_=values))
        note("attempts admitted", [row[0] for row in rows], self.folder)

    # --- erasing ----------------------------------------------------------------------------------
    def erased(self) -> dict[str, str]:
        """Return when each erased person was, by key."""
        if not (self.folder / PEOPLE).exists():
            return {}
        from sqlalchemy import select

        with self.database.read() as connection:
            return {
                row.key: row.time for row in connection.execute(select(_tables().tables["erased"]))
            }

    def erased_attempts(self) -> frozenset[str]:
        """Return ids of records that went with their person: no backup may bring them back."""
        if not (self.folder / PEOPLE).exists():
            return frozenset()
        from sqlalchemy import select

        with self.database.read() as connection:
            found = connection.execute(select(_tables().tables["erased_attempts"]))
            return frozenset(row.id for row in found)

    def forget_keys(
        self,
        keys: Sequence[str],
        comments: Sequence[str] = (),
        attempts: Sequence[str] = (),
        files: Sequence[Path] = (),
        anonymous: bool = False,
    ) -> None:
        """Erase persons for good, with what is known by key, name and PIN, as one step.

        Args:
            keys: of the persons.
            comments: attempts of which nothing said is to be left.
            attempts: ids of records that go too.
            files: of those records.
            anonymous: whether their records stay, as nobody's: what the tombstones say elsewhere.
        """
        steps: list[Step] = [removal(path) for path in files]
        with self.as_one(steps) as (connection, write_names):
            self.forget_in(connection, keys, comments, attempts)
            for key in keys:
                stone = Tombstone.over(key, anonymous)
                connection.execute(_tables().tables[TOMBSTONES].insert(), stone._asdict())
            names = self.names()
            left = {entry: name for entry, name in names.items() if owner_of(entry) not in keys}
            if left != names:
                write_names(left)
        self.database.shrink()

    def forget_in(
        self,
        connection: Connection,
        keys: Sequence[str],
        comments: Sequence[str] = (),
        attempts: Sequence[str] = (),
    ) -> None:
        """Erase persons within a transaction, without their names and files; as `forget_keys`."""
        from sqlalchemy.dialects.sqlite import insert

        t = _tables().tables
        StatementQueue(self.folder / FOLDER).forget(keys)
        for key in keys:
            for name, column in OF_PERSON.items():
                connection.execute(t[name].delete().where(t[name].c[column] == key))
            put = insert(t["erased"]).values(key=key, time=_now())
            connection.execute(put.on_conflict_do_nothing())
        for attempt in attempts:
            put = insert(t["erased_attempts"]).values(id=attempt)
            connection.execute(put.on_conflict_do_nothing())
            connection.execute(t[COUNTED].delete().where(t[COUNTED].c.attempt == attempt))
        for attempt in comments:
            for table in (t["remarks"], t["admitted"], t[SIGNED_REMARKS], t[EXCESS]):
                connection.execute(table.delete().where(table.c.attempt == attempt))

    # --- for rooms that change people with other things -------------------------------------------
    def setting(self, name: str) -> str:
        """Return a setting; empty where there is none."""
        return self._setting(name)

    def put_wrapped(self, connection: Connection, wrapped: Mapping[str, str]) -> None:
        """Keep the station's key under a new recovery key, within a transaction."""
        _set(connection, "wrapped", json.dumps(dict(wrapped)))

    # --- inside -----------------------------------------------------------------------------------
    def _tries(self) -> Tries:
        return Tries(self.database, _failures(), self._clock)

    def _setting(self, name: str) -> str:
        if not (self.folder / PEOPLE).exists():
            return ""
        with self.database.read() as connection:
            return _setting(connection, name)

    def names(self) -> dict[str, str]:
        """Return names by key, and what other programs call students (`accounts.accounts_in`).

        Raises:
            PeopleError: if their file cannot be read, or is damaged.
        """
        path = self.folder / NAMES_FILE
        try:
            document = json.loads(path.read_text(encoding="utf-8"))
            return {str(key): str(name) for key, name in document.items()}
        except FileNotFoundError:
            return {}
        except OSError as error:
            raise PeopleError(
                sentence(
                    "cannot read {path}: {error_strerror}",
                    path=path,
                    error_strerror=error.strerror or error,
                )
            ) from error
        except (ValueError, AttributeError, RecursionError) as error:
            raise PeopleError(
                sentence(
                    "{path} is damaged: bring it back from a backup, or move it away to go on "
                    "without names",
                    path=path,
                )
            ) from error

    @contextmanager
    def as_one(
        self,
        steps: list[Step] | None = None,
        undo: Sequence[Step] = (),
        prepare: Callable[[], None] | None = None,
    ) -> Iterator[tuple[Connection, Callable[[Mapping[str, str]], None]]]:
        """Write in one transaction, with which the file of names and other files change.

        Whatever ends the program: either all of it has happened, or nothing, from the next look on.
        Gives the connection, and a function that writes the file of names.

        Args:
            steps: done with files if the transaction is committed; may grow until then.
            undo: done if it is not.
            prepare: called before the transaction begins, once `undo` stands on the disk.

        Raises:
            PeopleError: if something cannot be written.
        """
        stamp, part = f"stamp:{uuid4().hex}", beside(self.folder / NAMES_FILE)
        planned = False
        steps = [] if steps is None else steps

        def write_names(names: Mapping[str, str]) -> None:
            if not names and not (self.folder / NAMES_FILE).exists():
                return
            step("write", part)
            fd = os.open(part, os.O_WRONLY | os.O_CREAT | os.O_EXCL | BINARY, 0o600)
            with os.fdopen(fd, "wb") as stream:
                text = json.dumps(dict(names), indent=1, ensure_ascii=False) + "\n"
                stream.write(text.encode())
                stream.flush()
                os.fsync(stream.fileno())
            steps.append(move(part, self.folder / NAMES_FILE))

        self.folder.mkdir(parents=True, exist_ok=True, mode=0o700)
        try:
            with Journal(self.folder, undo, alone=True) as journal:
                if prepare is not None:
                    prepare()
                with self.database.write() as connection:
                    yield connection, write_names
                    settings = _tables().tables["settings"].c
                    old = settings.name.like("stamp:%") & (settings.value < _yesterday())
                    connection.execute(_tables().tables["settings"].delete().where(old))
                    _set(connection, stamp, _now())
                    otherwise = [removal(part), *undo]
                    journal.plan_with(self.folder / PEOPLE, stamp, steps, otherwise)
                    planned = True
        except OSError as error:
            if error.errno in (errno.ENOSPC, errno.EDQUOT):
                raise PeopleError(
                    sentence(
                        "there is no room left for people and records ({folder}): make some, then "
                        "try again; nothing was changed",
                        folder=self.folder,
                    )
                ) from error
            raise PeopleError(
                sentence(
                    "cannot write in {folder}: {error_strerror}; nothing was changed",
                    folder=self.folder,
                    error_strerror=error.strerror or error,
                )
            ) from error
        finally:
            if not planned:
                part.unlink(missing_ok=True)


def people_folder() -> Path:
    """Return the folder of everything about people: `people` in the user's data folder."""
    return paths.data() / "people"


def _taken(pseudonym: str) -> str:
    return sentence(
        "{line_pseudonym!r} is taken: choose another pseudonym", line_pseudonym=pseudonym
    )


def _checked_password(password: str) -> None:
    if len(password) < _SHORTEST_PASSWORD:
        raise PeopleError(
            sentence(
                "a password needs at least {shortest_password} characters",
                shortest_password=_SHORTEST_PASSWORD,
            )
        )


def _setting(connection: Connection, name: str) -> str:
    from sqlalchemy import select

    table = _tables().tables["settings"]
    found = connection.execute(select(table.c.value).where(table.c.name == name)).scalar()
    return str(found or "")


def _set(connection: Connection, name: str, value: str) -> None:
    from sqlalchemy import insert

    table = _tables().tables["settings"]
    connection.execute(table.delete().where(table.c.name == name))
    connection.execute(insert(table), {"name": name, "value": value})


def tables() -> Mapping[str, Table]:
    """Return the tables by name."""
    return _tables().tables


def _failures() -> Table:
    return _tables().tables["failures"]


@cache
def _tables() -> MetaData:
    from sqlalchemy import Boolean, Column, MetaData, Table

    known = MetaData()

    def text(name: str, **options: Any) -> Column[str]:
        return Column(name, words(), nullable=False, **options)

    key = text("key", primary_key=True)
    Table("persons", known, key, text("pseudonym"), text("pin"), text("created"))
    Table("members", known, text("person", primary_key=True), text("grp", primary_key=True))
    Table("settings", known, text("name", primary_key=True), text("value"))
    Table("erased_attempts", known, text("id", primary_key=True))
    Table("erased", known, text("key", primary_key=True), text("time"))
    Table(
        "failures",
        known,
        text("account", primary_key=True),
        Column("wrong", number(whole=True), nullable=False),
        Column("last", number(whole=False), nullable=False),
    )
    Table(
        "remarks",
        known,
        text("attempt", primary_key=True),
        text("comment"),
        text("void"),
        Column("released", Boolean, nullable=False),
    )
    admitted = (text(name) for name in ("record", "why", "time", "seal"))
    Table("admitted", known, text("attempt", primary_key=True), *admitted)
    add_tables(known)
    return known


def _now() -> str:
    return datetime.now(UTC).isoformat(timespec="seconds")


def _yesterday() -> str:
    return (datetime.now(UTC) - timedelta(days=1)).isoformat(timespec="seconds")


OF_PERSON: Final = {
    "persons": "key",
    "members": "person",
    "failures": "account",
    SIGNED_REMARKS: "student",
}
"""Tables that hold something of a person, each with the column of its key."""
