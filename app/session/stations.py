"""Other stations that are known here, by their public keys, and what this one is called.

A known station is one whose attempts, remarks and erasures are taken as its own word. Each of its
public keys is a row, sealed by this station, so that nobody else makes a station known. A key that
followed another is taken by the signature of that one; the earlier one stays for what it signed. A
station that is revoked stays revoked, under all its keys.
"""

from __future__ import annotations

import hashlib
import re
from collections.abc import Iterable, Mapping, Sequence
from dataclasses import dataclass, replace
from functools import lru_cache
from pathlib import Path
from typing import TYPE_CHECKING, Any, Final
from uuid import uuid4

from app.core.messages import sentence
from app.session.audit import note
from app.session.errors import PeopleError
from app.session.journal import move, removal
from app.session.people import PEOPLE, People, tables
from app.session.station import (
    StationKey,
    key_file,
    new_recovery_key,
    signature_holds,
    this_station,
)

if TYPE_CHECKING:
    from sqlalchemy import Connection

NAME_SETTING: Final = "station name"

_NAME: Final = re.compile(r"\w(?:[\w .@+-]{0,38}[\w.@+-])?")
_SHORTEST_ID: Final = 4
"""So many digits of an id name a station."""
_STATION: Final = re.compile(r"[0-9a-f]{16}")
_PUBLIC: Final = re.compile(r"[0-9a-f]{64}")


@dataclass(frozen=True, slots=True)
class KnownStation:
    """One public key of a station.

    Attributes:
        station: its id.
        name: as it calls itself.
        public: its public key, hexadecimal.
        counter: of the station when it said its name.
        revoked: whether it is trusted no longer.
    """

    station: str
    name: str
    public: str
    counter: int = 0
    revoked: bool = False

    def document(self) -> dict[str, Any]:
        """Return what is sealed, and what travels."""
        return {
            "station": self.station,
            "name": self.name,
            "public": self.public,
            "counter": self.counter,
            "revoked": self.revoked,
        }

    @classmethod
    def of(cls, document: Mapping[str, Any]) -> KnownStation:
        """Read what `document` gave.

        Raises:
            ValueError, LookupError, TypeError: if it is none.
        """
        one = cls(
            str(document["station"]),
            checked_name(str(document["name"])),
            str(document["public"]),
            int(document["counter"]),
            document["revoked"] is True,
        )
        if not (_STATION.fullmatch(one.station) and _PUBLIC.fullmatch(one.public)):
            raise ValueError(sentence("no station and public key"))
        return one


def checked_name(name: str) -> str:
    """Return the name of a station.

    Raises:
        PeopleError: if it cannot be one.
    """
    name = " ".join(name.split())
    if not _NAME.fullmatch(name):
        raise PeopleError(
            sentence(
                "{name!r} cannot be the name of a station: letters, digits, blanks and . _ @ + - "
                "only, at most 40, beginning with a letter or digit",
                name=name[:60],
            )
        )
    return name


def fingerprint(public: str) -> str:
    """Return what two people compare of a public key, in eight groups of four."""
    digest = hashlib.sha256(public.encode()).hexdigest()[:32]
    return "-".join(digest[at : at + 4] for at in range(0, 32, 4))


def name_of_station(people: People, key: StationKey) -> str:
    """Return what this station is called: the beginning of its id where nobody has named it."""
    return people.setting(NAME_SETTING) or key.station[:4]


def set_name(name: str, people: People | None = None) -> str:
    """Name this station; returns the name as it is kept.

    Raises:
        PeopleError: if it cannot be one.
    """
    people, name = people or People(), checked_name(name)
    with people.database.write() as connection:
        put_setting(connection, NAME_SETTING, name)
    note("station named", folder=people.folder)
    return name


def stations_of(people: People) -> dict[str, KnownStation]:
    """Return the stations that are known, by public key; what this station did not seal is not.

    Raises:
        DatabaseError: if the list of people cannot be read.
    """
    key = this_station()
    if key is None or not (people.folder / PEOPLE).exists():
        return {}
    from sqlalchemy import select

    with people.database.read() as connection:
        rows = list(connection.execute(select(tables()["stations"])))
    known = {}
    for row in rows:
        counter, revoked = int(row.counter), bool(row.revoked)
        one = KnownStation(row.station, row.name, row.public, counter, revoked)
        if key.has_sealed(_sealed(one), row.seal):
            known[one.public] = one
    return known


def known_stations() -> Mapping[str, KnownStation]:
    """Return the stations known here, for lists: read once for each state of the files."""
    path, key = People().folder / PEOPLE, key_file()
    marks = []
    for file in (path, path.with_name(f"{path.name}-wal"), key):
        try:
            stat = file.stat()
            marks.append((stat.st_mtime_ns, stat.st_size, stat.st_ino))
        except OSError:
            marks.append((0, 0, 0))
    return _read_stations(path.parent, tuple(marks))


def mark_of_stations(key: StationKey | None) -> str:
    """Return what the verdicts of lists depend on: this station and those that it knows."""
    if key is None:
        return ""
    known = known_stations()
    if not known:
        return key.station
    text = repr(sorted((one.public, one.name, one.revoked) for one in known.values()))
    return f"{key.station} {hashlib.sha256(text.encode()).hexdigest()[:16]}"


def joined_stations(
    known: Mapping[str, KnownStation], others: Iterable[KnownStation]
) -> dict[str, KnownStation]:
    """Return both lists as one, the same in whatever order they come.

    The name is the one that was said last by the station's own counter; revoked stays revoked.
    """
    every = dict(known)
    for one in others:
        before = every.get(one.public, one)
        later = max(before, one, key=lambda each: (each.counter, each.name))
        every[one.public] = replace(later, revoked=before.revoked or one.revoked)
    for public, one in every.items():
        same = [each for each in every.values() if each.station == one.station]
        last = max(same, key=lambda each: (each.counter, each.name))
        revoked = any(each.revoked for each in same)
        every[public] = replace(one, name=last.name, counter=last.counter, revoked=revoked)
    return every


def followed(public: str, station: str, succession: Sequence[Mapping[str, str]]) -> set[str]:
    """Return all public keys of a station that follow from one that is known, itself included.

    Args:
        public: that is known.
        station: id.
        succession: who followed whom, as `StationKey.succession` gives it.
    """
    keys = {public}
    for row in reversed(succession):
        bare = {name: row.get(name, "") for name in ("station", "public", "before")}
        right = bare["station"] == station and bare["before"] in keys
        if right and signature_holds(
            bare["before"], "succession", bare, str(row.get("signature", ""))
        ):
            keys.add(bare["public"])
    return keys


def put_stations(connection: Connection, key: StationKey, every: Iterable[KnownStation]) -> None:
    """Write known stations, each sealed."""
    from sqlalchemy.dialects.sqlite import insert

    put = insert(tables()["stations"])
    rows = [one.document() | {"seal": key.seal(_sealed(one))} for one in every]
    if rows:
        newer = {name: put.excluded[name] for name in rows[0]}
        connection.execute(put.on_conflict_do_update(["public"], set_=newer), rows)


def revoke(station: str, people: People | None = None) -> KnownStation:
    """Trust a known station no longer, under all its keys; return it.

    Args:
        station: its name, or its id, of which four digits are enough.
        people: of this station.

    Raises:
        PeopleError: if no station of that name is known, or several are.
    """
    people = people or People()
    known = stations_of(people)
    wanted = station.strip().casefold()
    every = known.values()
    ids = {one.station for one in every if one.name.casefold() == wanted}
    if not ids and len(wanted) >= _SHORTEST_ID:
        ids = {one.station for one in every if one.station.startswith(wanted)}
    if len(ids) != 1:
        names = ", ".join(sorted({one.name for one in known.values()})) or "none"
        raise PeopleError(
            sentence(
                "{station!r} is no known station, or several: give name or id of one; known: "
                "{names}",
                station=station,
                names=names,
            )
        )
    (wanted,) = ids
    rows = [replace(one, revoked=True) for one in known.values() if one.station == wanted]
    with people.database.write() as connection:
        put_stations(connection, StationKey.of(people.folder), rows)
    note("station revoked", [wanted], people.folder)
    return rows[0]


def renew_key(people: People | None = None) -> str:
    """Give this station a new key; what the one before sealed and signed stays verified.

    Returns:
        A new recovery key where a password is set, for the one before opens the old key only; else
        empty.

    Raises:
        SignatureError, PeopleError: if the key cannot be read or written; it is unchanged then.
    """
    people = people or People()
    key = StationKey.of(people.folder).renewed()
    recovery = new_recovery_key() if people.has_instructor() else ""
    wrapped = key.wrapped(recovery) if recovery else {}
    stage = people.folder / f".renewing.{uuid4().hex}"
    steps = [move(key_file(stage), key_file(people.folder)), removal(stage)]
    known = stations_of(people)
    with people.as_one(steps, [removal(stage)]) as (connection, _):
        key.keep(stage)
        if wrapped:
            people.put_wrapped(connection, wrapped)
        put_stations(connection, key, known.values())
    note("key renewed", [key.station], people.folder)
    return recovery


def put_setting(connection: Connection, name: str, value: str) -> None:
    """Keep a setting of the list of people."""
    table = tables()["settings"]
    connection.execute(table.delete().where(table.c.name == name))
    connection.execute(table.insert(), {"name": name, "value": value})


# --- inside ---------------------------------------------------------------------------------------
@lru_cache(maxsize=4)
def _read_stations(folder: Path, _: tuple[tuple[int, int, int], ...]) -> dict[str, KnownStation]:
    from app.session.database import DatabaseError

    try:
        return stations_of(People(folder))
    except DatabaseError:
        return {}  # lists go on: then nobody else is known


def _sealed(station: KnownStation) -> dict[str, Any]:
    return {"what": "known station"} | station.document()
