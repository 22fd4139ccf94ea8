"""The ledger of a research study: who was enrolled, left, answered, when the data were locked.

An SQLite file that is only added to: each entry holds the SHA-256 of the one before, so that one
that was changed or taken out is noticed, and two programs that enrol at once get two places. It
holds no name, pseudonym or key: a student is a digest, salted with what the sealed list hides, and
has a code of the study's own.
"""

from __future__ import annotations

import hashlib
import hmac
import json
import secrets
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from dataclasses import dataclass
from functools import cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final

from app.core.messages import sentence
from app.research.errors import ResearchError
from app.session.database import Database, number, words

if TYPE_CHECKING:
    from sqlalchemy import Connection, MetaData

LEDGER: Final = "ledger.sqlite"
_VERSION: Final = 1

ENROLLED: Final = "enrolled"
LEFT: Final = "left"
ANSWERED: Final = "answered"
LOCKED: Final = "locked"


@dataclass(frozen=True, slots=True)
class Participant:
    """A student who was enrolled.

    Attributes:
        code: of the study's own; drawn at random.
        person: salted digest of the student's key.
        arm: name.
        stratum: name of the list.
        slot: in the list, from 0.
        enrolled: day and time, ISO 8601, UTC: of day 0.
        consent: `version`, `digest` of the wording, `time` (ISO 8601), `by`: who took it.
        left: why the student left; empty if not.
        left_on: ISO 8601; empty if not.
        withdrawn: whether the data may not be used either.
    """

    code: str
    person: str
    arm: str
    stratum: str
    slot: int
    enrolled: str
    consent: dict[str, str]
    left: str = ""
    left_on: str = ""
    withdrawn: bool = False


class Ledger:
    """What has happened in a study.

    Args:
        folder: of the study.
    """

    def __init__(self, folder: Path) -> None:
        self._database = Database(folder / LEDGER, _tables, _VERSION, "ledger of the study")

    def entries(self) -> list[dict[str, Any]]:
        """Return all entries, in order.

        Raises:
            ResearchError: if one was changed or taken out.
            DatabaseError: if the file cannot be read.
        """
        with self._database.read() as connection:
            return _entries(connection)

    @contextmanager
    def adding(self) -> Iterator[tuple[list[dict[str, Any]], list[dict[str, Any]]]]:
        """Add entries in one transaction, alone among all programs.

        Yields:
            Entries that there are, and a list to which new ones are appended.

        Raises:
            ResearchError, DatabaseError: as `entries`, or if it cannot be written.
        """
        from sqlalchemy import insert

        table = _tables().tables["entries"]
        with self._database.write() as connection:
            there, new = _entries(connection), list[dict[str, Any]]()
            yield there, new
            before = _last_digest(connection)
            for seq, entry in enumerate(new, start=len(there) + 1):
                text = _text(entry)
                before = _chained(before, text)
                connection.execute(insert(table), {"seq": seq, "text": text, "digest": before})


def digest_of_person(salt: bytes, key: str) -> str:
    """Return what stands for a student: HMAC-SHA256 of the key, hexadecimal."""
    return hmac.digest(salt, key.encode(), "sha256").hex()


def new_code(taken: Sequence[str]) -> str:
    """Draw a code for a participant: six letters and digits that cannot be mistaken."""
    letters = "ABCDEFGHJKLMNPQRSTUVWXYZ23456789"
    while True:
        code = "".join(secrets.choice(letters) for _ in range(6))
        if code not in taken:
            return code


def participants_of(entries: Sequence[dict[str, Any]]) -> list[Participant]:
    """Return everybody who was enrolled, by code: their order tells nothing."""
    found: dict[str, dict[str, Any]] = {}
    for entry in entries:
        if entry["kind"] == ENROLLED:
            names = ("code", "person", "arm", "stratum", "slot", "consent")
            found[entry["code"]] = {name: entry[name] for name in names}
            found[entry["code"]]["enrolled"] = entry["time"]
        elif entry["kind"] == LEFT:
            found[entry["code"]] |= {
                "left": entry["reason"],
                "left_on": entry["time"],
                "withdrawn": entry["withdrawn"],
            }
    return [Participant(**found[code]) for code in sorted(found)]


def locked_at(entries: Sequence[dict[str, Any]]) -> str:
    """Return when the data were locked, ISO 8601; empty if they are not."""
    return next((str(entry["time"]) for entry in entries if entry["kind"] == LOCKED), "")


def _entries(connection: Connection) -> list[dict[str, Any]]:
    from sqlalchemy import select

    table = _tables().tables["entries"]
    found, before = [], ""
    for place, row in enumerate(connection.execute(select(table).order_by(table.c.seq)), start=1):
        before = _chained(before, row.text)
        if row.seq != place or row.digest != before:
            raise ResearchError(
                sentence(
                    "entry {place} of the study's ledger is not as it was written: bring the "
                    "ledger back from a backup",
                    place=place,
                )
            )
        found.append(json.loads(row.text))
    return found


def _last_digest(connection: Connection) -> str:
    from sqlalchemy import select

    table = _tables().tables["entries"]
    last = connection.execute(select(table.c.digest).order_by(table.c.seq.desc()).limit(1)).scalar()
    return str(last or "")


def _text(entry: dict[str, Any]) -> str:
    return json.dumps(entry, sort_keys=True, separators=(",", ":"), ensure_ascii=True)


def _chained(before: str, text: str) -> str:
    return hashlib.sha256(f"{before}\n{text}".encode()).hexdigest()


@cache
def _tables() -> MetaData:
    from sqlalchemy import Column, MetaData, Table

    known = MetaData()
    Table(
        "entries",
        known,
        Column("seq", number(whole=True), primary_key=True, autoincrement=False),
        Column("text", words(), nullable=False),
        Column("digest", words(), nullable=False),
    )
    return known
