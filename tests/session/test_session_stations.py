"""Public-key signatures: of this station, of known ones, of revoked ones, and of renewed keys."""

import hmac
import json
import shutil
import sqlite3
import subprocess
from contextlib import closing
from pathlib import Path

import pytest
from cryptography.exceptions import InvalidSignature
from cryptography.hazmat.primitives.asymmetric.ed25519 import Ed25519PublicKey
from session_fakes import Bench
from test_session_archive import Place

from app.session.admission import admissions, admit
from app.session.archive import backup, restore_backup
from app.session.errors import PeopleError
from app.session.header import new_id
from app.session.index import Index
from app.session.people import PEOPLE, People
from app.session.signature import judge_whole, signature_file
from app.session.station import StationKey, key_file, this_station
from app.session.stations import (
    KnownStation,
    followed,
    put_stations,
    renew_key,
    revoke,
    set_name,
    stations_of,
)
from app.session.store import list_sessions, records


@pytest.fixture
def one(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Place:
    place = Place(tmp_path / "one", monkeypatch)
    place.attempts("ada", "bob")
    return place


def attempt(place: Place, student: str) -> None:
    """Record an attempt whose id no other station has."""
    bench = Bench(place.folder)
    object.__setattr__(bench.context, "identify", new_id)
    bench.run(0.1)
    bench.trainer.begin(student)
    bench.run(0.4, 0.03)
    bench.trainer.end()


def canonical(document: dict) -> bytes:
    return json.dumps(document, sort_keys=True, separators=(",", ":")).encode()


def verdicts(folder: Path) -> set[str]:
    index = Index(folder)
    index.refresh()
    listed = {one.signature for one in list_sessions(folder)}
    assert {one.verdict for one in index.attempts()} == listed
    return listed


def know(place: Place, key: StationKey, name: str = "B", revoked: bool = False) -> None:
    with place.people.database.write() as connection:
        known = [KnownStation(key.station, name, one, 1, revoked) for one in key.publics]
        put_stations(connection, StationKey.of(place.people.folder), known)


def copied(source: Path, to: Path) -> None:
    for path in sorted(source.glob("*.mcap")):
        for file in (signature_file(path), path):
            (to / file.name).write_bytes(file.read_bytes())


def test_a_signature_is_ed25519_over_the_document_and_its_hmac_is_over_both(one: Place) -> None:
    path = records(one.folder)[0]
    document = json.loads(signature_file(path).read_text())
    seal, key = document.pop("hmac"), StationKey.of()
    assert seal == hmac.digest(key.secret, canonical(document), "sha256").hex()
    public, signature = document.pop("public"), bytes.fromhex(document.pop("ed25519"))
    holder = Ed25519PublicKey.from_public_bytes(bytes.fromhex(public))
    holder.verify(signature, b"acus record\0" + canonical(document))
    with pytest.raises(InvalidSignature):
        holder.verify(signature, b"acus remark\0" + canonical(document))


@pytest.mark.skipif(shutil.which("openssl") is None, reason="needs openssl")
def test_openssl_verifies_a_signature(one: Place, tmp_path: Path) -> None:
    document = json.loads(signature_file(records(one.folder)[0]).read_text())
    public, signature = (bytes.fromhex(document.pop(name)) for name in ("public", "ed25519"))
    del document["hmac"]
    prefix = bytes.fromhex("302a300506032b6570032100")  # RFC 8410: SubjectPublicKeyInfo of Ed25519
    (tmp_path / "key").write_bytes(prefix + public)
    (tmp_path / "signature").write_bytes(signature)
    (tmp_path / "text").write_bytes(b"acus record\0" + canonical(document))
    line = "openssl pkeyutl -verify -pubin -keyform DER -inkey key -rawin -in text -sigfile"
    done = subprocess.run(
        [*line.split(), "signature"], cwd=tmp_path, capture_output=True, text=True, check=False
    )
    assert "Signature Verified Successfully" in done.stdout, done.stderr


def test_signatures_of_earlier_versions_stay_verified(one: Place) -> None:
    for path in records(one.folder):
        document = json.loads(signature_file(path).read_text())
        for name in ("hmac", "public", "ed25519"):
            del document[name]
        seal = hmac.digest(StationKey.of().secret, canonical(document), "sha256").hex()
        signature_file(path).write_text(json.dumps(document | {"hmac": seal}))
    assert verdicts(one.folder) == {"verified"}
    renew_key(one.people)
    assert verdicts(one.folder) == {"verified"}


def test_a_record_says_which_known_station_signed_it_and_counts(
    one: Place, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    other = StationKey.of()
    two = Place(tmp_path / "two", monkeypatch)
    attempt(two, "cleo")
    copied(one.folder, two.folder)
    assert verdicts(two.folder) == {"verified", "unsigned"}
    know(two, other)
    assert verdicts(two.folder) == {"verified", "verified (station B)"}
    assert all(one.stands for one in Index(two.folder).attempts())
    assert revoke("b", two.people).name == "B"
    assert verdicts(two.folder) == {"verified", "revoked (station B)"}
    assert sum(one.stands for one in Index(two.folder).attempts()) == 1
    theirs = [path for path in records(two.folder) if "revoked" in sentence_of(path)]
    admit(theirs, "the station was stolen after the course")
    assert len(admissions()) == 2
    assert verdicts(two.folder) == {"verified", "admitted"}


def sentence_of(path: Path) -> str:
    return judge_whole(path, this_station()).sentence()


def test_a_known_stations_signature_on_a_changed_record_is_altered(
    one: Place, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    other = StationKey.of()
    two = Place(tmp_path / "two", monkeypatch)
    attempt(two, "cleo")
    copied(one.folder, two.folder)
    know(two, other)
    first, second = sorted(path.name for path in one.folder.glob("*.mcap"))
    document = json.loads(signature_file(two.folder / first).read_text())
    document["shown"]["total"] = "99.000000"
    signature_file(two.folder / first).write_text(json.dumps(document))
    assert "is not that of the station B" in sentence_of(two.folder / first)
    with (two.folder / second).open("ab") as stream:
        stream.write(b"x")
    assert sentence_of(two.folder / second).startswith("altered")


def test_nobody_else_makes_a_station_known(
    one: Place, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    other = StationKey.of()
    two = Place(tmp_path / "two", monkeypatch)
    attempt(two, "cleo")
    copied(one.folder, two.folder)
    know(two, other, revoked=True)
    with closing(sqlite3.connect(two.people.folder / PEOPLE)) as connection:
        connection.execute("UPDATE stations SET revoked = 0")
        connection.commit()
    assert stations_of(two.people) == {}
    assert verdicts(two.folder) == {"verified", "unsigned"}


@pytest.mark.long("journey")
def test_a_renewed_key_keeps_what_was_signed_and_travels_with_its_own_recovery_key(
    one: Place, tmp_path: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    before = StationKey.of()
    old = one.people.set_instructor("correct horse")
    recovery = renew_key(one.people)
    now = StationKey.of()
    assert (now.station, now.secret == before.secret) == (before.station, False)
    assert key_file().stat().st_mode & 0o777 == 0o600
    assert now.publics == (now.public, before.public)
    attempt(one, "ada")
    assert verdicts(one.folder) == {"verified"}
    backup(tmp_path / "all.acusbackup", one.folder)
    two = Place(tmp_path / "two", monkeypatch)
    with pytest.raises(Exception, match="not the recovery key"):
        restore_backup(tmp_path / "all.acusbackup", two.folder, old)
    restore_backup(tmp_path / "all.acusbackup", two.folder, recovery)
    assert StationKey.of() == now
    assert verdicts(two.folder) == {"verified"}


def test_keys_follow_only_by_the_signature_of_the_one_before(one: Place) -> None:
    first = StationKey.of()
    third = first.renewed().renewed()
    chain = third.succession()
    assert followed(first.public, first.station, chain) == set(third.publics)
    assert followed(third.public, first.station, chain) == {third.public}
    forged = [chain[0] | {"public": "0" * 64}, chain[1]]
    assert followed(first.public, first.station, forged) == set(third.publics[1:])


def test_an_admission_survives_a_new_key(one: Place) -> None:
    path = records(one.folder)[0]
    signature_file(path).unlink()
    admit([path], "the disk was full")
    renew_key(one.people)
    assert list(admissions()) == [path.stem]


def test_names_of_stations_are_names(one: Place) -> None:
    assert set_name(" Theatre  2 ") == "Theatre 2"
    for name in ("", "B)\x1b[31m", "x" * 41, "../B"):
        with pytest.raises(PeopleError, match="cannot be the name of a station"):
            set_name(name)
    assert People().setting("station name") == "Theatre 2"
