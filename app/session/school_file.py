"""The two files that stations exchange: results of a station, and the course for one.

A ZIP archive whose `manifest.json` tells the SHA-256 of each file in it, and `manifest.sig` holds
the station's Ed25519 signature of the manifest. Results hold finished attempts of the station with
their signatures and numbers, signed remarks, and tombstones. The course for a station holds people
by key and pseudonym, courses, own exercises, known stations, and tombstones.
"""

from __future__ import annotations

import hashlib
import json
import re
import zipfile
import zlib
from collections.abc import Iterable, Mapping
from dataclasses import dataclass, field, replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any, Final

from app import __version__
from app.core.disclaimer import DISCLAIMER
from app.core.messages import sentence
from app.session.backup_file import ArchiveError, may_hold
from app.session.errors import PeopleError
from app.session.roster import checked_pseudonym, looks_like_a_key
from app.session.school_tables import Tombstone
from app.session.station import StationKey, signature_holds
from app.session.station_results import CountedAttempt, SignedRemark
from app.session.stations import (
    KnownStation,
    checked_name,
    fingerprint,
    followed,
    joined_stations,
)

RESULTS: Final = "acus-results"
COURSE: Final = "acus-station"
VERSION: Final = 1
MANIFEST: Final = "manifest.json"
SIGNATURE: Final = "manifest.sig"

_FILE: Final = "file"
"""Purpose of the signature."""
_LARGEST: Final = 1 << 26
_LONGEST_GROUP: Final = 200


class UnknownStationError(ArchiveError):
    """A file of a station that is not known here; tells the fingerprint of its key."""


@dataclass(frozen=True, slots=True)
class SentStudent:
    """A student as a course for a station tells of them.

    Attributes:
        key: that records hold.
        pseudonym: as screens show it.
        groups: names.
        name: empty unless names were asked for.
        pin: its hash; empty unless PINs were asked for.
    """

    key: str
    pseudonym: str
    groups: tuple[str, ...] = ()
    name: str = ""
    pin: str = ""

    def document(self) -> dict[str, Any]:
        """Return what travels."""
        more = {"name": self.name, "pin": self.pin}
        given = {name: value for name, value in more.items() if value}
        return {"key": self.key, "pseudonym": self.pseudonym, "groups": list(self.groups)} | given

    def row(self) -> dict[str, str]:
        """Return the row of a list of people; what is no hash of a PIN is no PIN."""
        pin = self.pin if self.pin.startswith("$argon2id$") else ""
        created = datetime.now(UTC).isoformat(timespec="seconds")
        return {"key": self.key, "pseudonym": self.pseudonym, "pin": pin, "created": created}

    @classmethod
    def of(cls, document: Mapping[str, Any]) -> SentStudent:
        """Read what `document` gave.

        Raises:
            ValueError, LookupError, TypeError, PeopleError: if it is none.
        """
        key, groups = str(document["key"]), tuple(map(str, document["groups"]))
        if not looks_like_a_key(key) or any(len(one) > _LONGEST_GROUP for one in groups):
            raise ValueError(key[:40])
        name, pin = (str(document.get(which, "")) for which in ("name", "pin"))
        return cls(key, checked_pseudonym(str(document["pseudonym"])), groups, name, pin)


@dataclass(frozen=True)
class SchoolManifest:
    """What a file of another station says, signed by it.

    Attributes:
        kind: `acus-results` or `acus-station`.
        sender: the station, with the key that signed.
        succession: who followed whom among its keys.
        files: SHA-256 of each file in it, by name.
        attempts: in their order.
        remarks: signed.
        tombstones: of erased people.
        people: students.
        stations: that the sender knows.
    """

    kind: str
    sender: KnownStation
    succession: tuple[Mapping[str, str], ...] = ()
    files: Mapping[str, str] = field(default_factory=dict)
    attempts: tuple[CountedAttempt, ...] = ()
    remarks: tuple[SignedRemark, ...] = ()
    tombstones: tuple[Tombstone, ...] = ()
    people: tuple[SentStudent, ...] = ()
    stations: tuple[KnownStation, ...] = ()

    def publics(self, known: Mapping[str, KnownStation]) -> set[str]:
        """Return the sender's keys that follow from one that is known; none if none is."""
        own = [one.public for one in known.values() if one.station == self.sender.station]
        keys = {new for one in own for new in followed(one, self.sender.station, self.succession)}
        return keys if self.sender.public in keys else set()


def write_manifest(archive: zipfile.ZipFile, manifest: SchoolManifest, key: StationKey) -> None:
    """Write what a file says of itself, and the signature over it."""
    document = {
        "format": manifest.kind,
        "version": VERSION,
        "software": __version__,
        "sender": manifest.sender.document(),
        "succession": [dict(row) for row in manifest.succession],
        "files": dict(manifest.files),
        "attempts": [one._asdict() for one in manifest.attempts],
        "remarks": [one._asdict() for one in manifest.remarks],
        "tombstones": [one._asdict() for one in manifest.tombstones],
        "people": [one.document() for one in manifest.people],
        "stations": [one.document() for one in manifest.stations],
        "note": DISCLAIMER,
    }
    data = json.dumps(document, indent=1, ensure_ascii=False).encode("utf-8", "surrogatepass")
    archive.writestr(MANIFEST, data, zipfile.ZIP_DEFLATED)
    archive.writestr(SIGNATURE, key.sign(_FILE, {"manifest": _digest(data)}))


def read_manifest(archive: zipfile.ZipFile, source: Path) -> SchoolManifest:
    """Read and check what a file says of itself, and that its station signed that.

    Whether the station is known is not asked here.

    Raises:
        ArchiveError: if it is no such file, damaged, forged or of a newer version.
    """
    try:
        known = {info.filename: info for info in archive.infolist()}
        if known[MANIFEST].file_size > _LARGEST or known[SIGNATURE].file_size > _LARGEST:
            raise ValueError(sentence("its list is too long"))
        data = archive.read(MANIFEST)
        signature = archive.read(SIGNATURE).decode("ascii")
        document: dict[str, Any] = json.loads(data)
        kind, version = document["format"], document["version"]
    except (*_NOT_OURS, zlib.error) as error:
        raise ArchiveError(
            sentence(
                "{source} holds no results and no course of a station: write it again there with "
                "`acus store results` or `acus store station`",
                source=source,
            )
        ) from error
    if kind not in (RESULTS, COURSE):
        raise ArchiveError(
            sentence(
                "{source} is another file of Acus ({kind!r:.40}): give one that `acus store "
                "results` or `acus store station` wrote",
                source=source,
                kind=kind,
            )
        )
    if not isinstance(version, int) or version > VERSION:
        raise ArchiveError(
            sentence(
                "{source} was written by a newer version of Acus: use that version here too",
                source=source,
            )
        )
    manifest = _checked(document, source)
    if not signature_holds(
        manifest.sender.public, _FILE, {"manifest": _digest(data)}, signature.strip()
    ):
        raise ArchiveError(
            sentence(
                "{source} was altered after its station signed it: fetch it anew from the station",
                source=source,
            )
        )
    for name in manifest.files:
        info = known.get(name)
        stored = info is not None and info.compress_type == zipfile.ZIP_STORED
        fits = may_hold(name) or _SUMMARY.fullmatch(name)
        if not fits or info is None or (name.startswith("records/") and not stored):
            raise ArchiveError(_damaged(source, name))
    return manifest


def packed_digest(data: bytes, name: str, archive: zipfile.ZipFile) -> str:
    """Pack a file's bytes under a name; return their SHA-256."""
    packed = name.startswith("records/")
    way = zipfile.ZIP_STORED if packed else zipfile.ZIP_DEFLATED
    archive.writestr(zipfile.ZipInfo(name), data, way)
    return _digest(data)


def attempts_of(rows: Iterable[CountedAttempt]) -> tuple[CountedAttempt, ...]:
    """Return attempts in the order of their station."""
    return tuple(sorted(rows, key=lambda one: (one.station, one.number)))


def stations_with(
    manifest: SchoolManifest,
    known: Mapping[str, KnownStation],
    key: StationKey,
    source: Path,
    trust: bool,
) -> dict[str, KnownStation]:
    """Return the stations that are known once a file is taken in.

    Args:
        manifest: of the file.
        known: stations, before it.
        key: of this station.
        source: path of the file, for messages.
        trust: let its station in although it is not known.

    Raises:
        ArchiveError: if its station is revoked.
        UnknownStationError: if it is not known by the key that signed.
    """
    sender = manifest.sender
    same = [one for one in known.values() if one.station == sender.station]
    if any(one.revoked for one in same):
        raise ArchiveError(
            sentence(
                "{source} comes from the station {name}, which the instructor has revoked: nothing "
                "of it is taken",
                source=source,
                name=same[0].name,
            )
        )
    own = sender.station == key.station
    keys = {sender.public} & set(key.publics) if own else manifest.publics(known)
    if not keys and not (trust and not own and not same):
        raise UnknownStationError(
            sentence(
                "{source} comes from the station {name}, which is not known here by this key: "
                "compare {fingerprint} with `acus store stations` there, then gather it with "
                "--trust",
                source=source,
                name=sender.name,
                fingerprint=fingerprint(sender.public),
            )
        )
    rows = [] if own else [replace(sender, public=each) for each in keys or {sender.public}]
    others = [one for one in manifest.stations if one.station != key.station]
    return joined_stations(known, (*rows, *others))


# --- inside ---------------------------------------------------------------------------------------
_NOT_OURS: Final = (LookupError, ValueError, TypeError, AttributeError, RecursionError)
_SUMMARY: Final = re.compile(r"records/[0-9A-Za-z][0-9A-Za-z._-]{0,63}\.json")
_HEX: Final = re.compile(r"[0-9a-f]{32}|[0-9a-f]{64}")


def _checked(document: Mapping[str, Any], source: Path) -> SchoolManifest:
    try:
        manifest = SchoolManifest(
            kind=str(document["format"]),
            sender=KnownStation.of(document["sender"]),
            succession=tuple(dict(row) for row in document["succession"]),
            files={str(name): str(digest) for name, digest in document["files"].items()},
            attempts=tuple(map(CountedAttempt.of, document["attempts"])),
            remarks=tuple(map(SignedRemark.of, document["remarks"])),
            tombstones=tuple(map(_tombstone, document["tombstones"])),
            people=tuple(map(SentStudent.of, document["people"])),
            stations=tuple(map(KnownStation.of, document["stations"])),
        )
        checked_name(manifest.sender.name)
    except (*_NOT_OURS, PeopleError) as error:
        raise ArchiveError(_damaged(source, MANIFEST)) from error
    mine = {one.station for one in manifest.attempts}
    mine |= {one.station for one in manifest.remarks}
    if mine - {manifest.sender.station}:  # what it vouches for is its own alone
        raise ArchiveError(_damaged(source, MANIFEST))
    return manifest


def _tombstone(document: Mapping[str, Any]) -> Tombstone:
    stone = Tombstone(str(document["digest"]), str(document["salt"]), document["anonymous"] is True)
    if not (_HEX.fullmatch(stone.digest) and _HEX.fullmatch(stone.salt)):
        raise ValueError(stone.digest[:40])
    return stone


def _damaged(source: Path, name: str) -> str:
    return sentence(
        "{source} is damaged at {name}: fetch it anew from its station", source=source, name=name
    )


def _digest(data: bytes) -> str:
    return hashlib.sha256(data).hexdigest()
